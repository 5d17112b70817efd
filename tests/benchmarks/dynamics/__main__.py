"""Run the dynamic benchmark and write its page: python -m tests.benchmarks.dynamics [--only PART ...] [--no-peers]

The parts are the reference, the schemes, the chains and the bouncing beam. Tables of parts that are not run, and of
programs that are not installed, stay as they are; the tables of the page are made from them.
"""

from __future__ import annotations

import argparse
import sys

from tests.benchmarks.dynamics import limits, peers, pictures, schemes
from tests.benchmarks.dynamics.page import TABLES
from tests.benchmarks.peers import Environment, Peer, installed
from tests.benchmarks.tables import FOLDER, load, rewrite, save

PARTS = ("reference", "schemes", "chains", "bouncing")


def say(words: str) -> None:
    """Report what is done next."""
    sys.stderr.write(f"{words}\n")


def main() -> None:
    """Compute what is asked for, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--only", nargs="*", choices=PARTS, default=list(PARTS), help="these parts only; none: the page"
    )
    parser.add_argument("--no-peers", action="store_true", help="install and run no other program")
    given = parser.parse_args()

    def place(peer: Peer) -> Environment:
        return Environment(peer, "left out of this run") if given.no_peers else installed(peer)

    for part in (part for part in PARTS if part in given.only):
        if part == "reference":
            references()
        elif part == "schemes":
            runs()
        elif part == "chains":
            chains(place(peers.MOORDYN))
        else:
            bounces(place(peers.EXUDYN))
    rewrite(FOLDER / "benchmark.md", TABLES)
    pictures.run()


def references() -> None:
    """The limits of steps and the reference."""
    save("benchmark-limits", limits.LIMITS, limits.limits())
    rows, path = schemes.integrate(say)
    save("benchmark-reference", schemes.REFERENCE, rows)
    save("benchmark-path", schemes.PATH, path)


def runs() -> None:
    """All schemes with all steps."""
    truth, done = schemes.Truth.of(load("benchmark-path")), []
    for name, steps in schemes.wanted():
        say(f"{name}, {steps} steps in {schemes.EVERY:g} s")
        done.append(schemes.row(name, steps, *schemes.measure(name, steps), truth))
        save("benchmark-schemes", schemes.RUNS, done)


def chains(moordyn: Environment) -> None:
    """The chain in three depths."""
    tensions, shares = peers.chains(say, moordyn, load("benchmark-chains"))
    save("benchmark-chains", peers.CHAINS, tensions)
    save("benchmark-anchor", peers.ANCHOR, shares)


def bounces(exudyn: Environment) -> None:
    """The bouncing beam."""
    if exudyn.reason:
        say(f"Exudyn was not run ({exudyn.reason}): the tables of the bouncing beam stay as they are")
        return
    found, path = peers.bounces(say, exudyn)
    save("benchmark-bouncing", peers.BOUNCES, found)
    save("benchmark-bouncing-path", peers.BOUNCE_PATH, path)


if __name__ == "__main__":
    main()
