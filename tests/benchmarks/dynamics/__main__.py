"""Run the dynamic benchmark and write its page: python -m tests.benchmarks.dynamics [--only PART ...] [--no-peers]

The parts are the reference, the schemes, the chains and the bouncing beam. Tables of parts that are not run, and of
programs that are not installed, stay as they are; the page is written from the tables.
"""

from __future__ import annotations

import argparse
import sys

from tests.benchmarks.dynamics import peers, schemes
from tests.benchmarks.dynamics.page import write
from tests.benchmarks.dynamics.tables import load, save
from tests.benchmarks.peers import Environment, Peer, installed

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

    if "reference" in given.only:
        save("limits", schemes.LIMITS, schemes.limits())
        rows, path = schemes.integrate(say)
        save("reference", schemes.REFERENCE, rows)
        save("path", schemes.PATH, path)
    if "schemes" in given.only:
        truth, done = schemes.Truth.of(load("path")), []
        for name, steps in schemes.wanted():
            say(f"{name}, {steps} steps in {schemes.EVERY:g} s")
            done.append(schemes.row(name, steps, *schemes.measure(name, steps), truth))
            save("schemes", schemes.RUNS, done)
    if "chains" in given.only:
        tensions, shares = peers.chains(say, place(peers.MOORDYN), load("chains"))
        save("chains", peers.CHAINS, tensions)
        save("anchor", peers.ANCHOR, shares)
    if "bouncing" in given.only:
        exudyn = place(peers.EXUDYN)
        if exudyn.reason:
            say(f"Exudyn was not run ({exudyn.reason}): the tables of the bouncing beam stay as they are")
        else:
            found, path = peers.bounces(say, exudyn)
            save("bouncing", peers.BOUNCES, found)
            save("bouncing-path", peers.BOUNCE_PATH, path)
    write()


if __name__ == "__main__":
    main()
