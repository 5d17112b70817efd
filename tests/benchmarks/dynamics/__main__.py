"""Run the dynamic benchmark and write its page: python -m tests.benchmarks.dynamics [--only PART ...] [--no-peers]

The parts are the reference, the schemes and the chains. Tables of parts that are not run, and of MoorDyn if it is not
installed, stay as they are; the tables of the page are made from them.
"""

from __future__ import annotations

import argparse
import sys

from tests.benchmarks.dynamics import peers, pictures, schemes
from tests.benchmarks.dynamics.page import TABLES
from tests.benchmarks.peers import Environment, installed
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import FOLDER, load, rewrite, save

PARTS = ("reference", "schemes", "chains")


def main() -> None:
    """Compute what is asked for, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--only", nargs="*", choices=PARTS, default=list(PARTS), help="these parts only; none: the page"
    )
    parser.add_argument("--no-peers", action="store_true", help="install and run no other program")
    given = parser.parse_args()

    for part in (part for part in PARTS if part in given.only):
        if part == "reference":
            save("benchmark-path", schemes.PATH, schemes.integrate(_say))
        elif part == "schemes":
            runs()
        else:
            moordyn = peers.MOORDYN
            place = Environment(moordyn, "left out of this run") if given.no_peers else installed(moordyn)
            save("benchmark-chains", peers.CHAINS, peers.chains(_say, place, load("benchmark-chains")))
    rewrite(FOLDER / "benchmark.md", TABLES)
    pictures.run()


def _say(words: str) -> None:
    print(words, file=sys.stderr)


def runs() -> None:
    """All schemes with all steps."""
    truth, done = schemes.Truth.of(load("benchmark-path")), []
    for name, scheme in SCHEMES.items():
        for steps in schemes.STEPS[scheme.explicit]:
            _say(f"{name}, {steps} steps in {schemes.EVERY:g} s")
            done.append(schemes.row(name, steps, *schemes.measure(name, steps), truth))
    save("benchmark-schemes", schemes.RUNS, done)


if __name__ == "__main__":
    main()
