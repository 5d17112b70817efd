"""Run the dynamic benchmark and write its page: python -m tests.benchmarks.dynamics [--only PART ...] [--no-peers]

The parts are the reference, the schemes, the chains and the bouncing beam. Tables of parts that are not run, and of
programs that are not installed, stay as they are; the page is written from the tables.
"""

from __future__ import annotations

import argparse
import sys
from os import times

from tests.benchmarks.dynamics import limits, peers, schemes
from tests.benchmarks.dynamics.page import write
from tests.benchmarks.dynamics.tables import load, save
from tests.benchmarks.peers import Environment, Peer, installed

PARTS = ("reference", "schemes", "chains", "bouncing")
COST = ("part", "processor time [s]", "elapsed time [s]")


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
        begin = spent()
        if part == "reference":
            references()
        elif part == "schemes":
            runs()
        elif part == "chains":
            chains(place(peers.MOORDYN))
        else:
            bounces(place(peers.EXUDYN))
        if given.no_peers:
            continue
        own = [round(end - start, 1) for start, end in zip(begin, spent(), strict=True)]
        kept = {row["part"]: (float(row[COST[1]]), float(row[COST[2]])) for row in load("cost")}
        cost = {**kept, part: own}
        save("cost", COST, [(name, *cost[name]) for name in PARTS if name in cost])
    write()


def spent() -> tuple[float, float]:
    """Processor time of this program and of all that it has started, and the clock, s."""
    used = times()
    return sum(used[:4]), used.elapsed


def references() -> None:
    """The limits of steps and the reference."""
    save("limits", limits.LIMITS, limits.limits())
    rows, path = schemes.integrate(say)
    save("reference", schemes.REFERENCE, rows)
    save("path", schemes.PATH, path)


def runs() -> None:
    """All schemes with all steps, and the damping that they meet."""
    truth, done = schemes.Truth.of(load("path")), []
    for name, steps in schemes.wanted():
        say(f"{name}, {steps} steps in {schemes.EVERY:g} s")
        done.append(schemes.row(name, steps, *schemes.measure(name, steps), truth))
        save("schemes", schemes.RUNS, done)
    rows = []
    for name, steps in limits.WATCHED:
        say(f"damping by suction in {name}, {steps} steps in {schemes.EVERY:g} s")
        rows.append(limits.suction(name, steps))
    save("suction", limits.SUCTION, rows)


def chains(moordyn: Environment) -> None:
    """The chain in three depths."""
    tensions, shares = peers.chains(say, moordyn, load("chains"))
    save("chains", peers.CHAINS, tensions)
    save("anchor", peers.ANCHOR, shares)


def bounces(exudyn: Environment) -> None:
    """The bouncing beam."""
    if exudyn.reason:
        say(f"Exudyn was not run ({exudyn.reason}): the tables of the bouncing beam stay as they are")
        return
    found, path = peers.bounces(say, exudyn)
    save("bouncing", peers.BOUNCES, found)
    save("bouncing-path", peers.BOUNCE_PATH, path)


if __name__ == "__main__":
    main()
