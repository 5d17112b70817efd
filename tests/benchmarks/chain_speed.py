"""Processor seconds and memory of `mudline lint` and `diff`: python tests/benchmarks/chain_speed.py [--count N]

Decks of N element sets (100 000), of which each has the next as its subset, and of N parameters, of which each is
defined by the next; and two decks with a set of 10^7 numbers by GEN=, with and without an increment. Each run is a
process of its own, without the cache; printed are the lowest of three, start of the interpreter included.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

_MODEL = "$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 0.0, 1.0\n*ELEMENT\n 1, 1, 2\n"
_GENERATED = 10**7
_RUNS = 3


def sets(count: int) -> str:
    """Sets of which each has the next as its subset."""
    links = "".join(f" SET=S{i}\n SUBSET=S{i + 1}\n" for i in range(count))
    return f"{_MODEL}*ELEMENT SETS\n{links} SET=S{count}\n 1\n"


def parameters(count: int) -> str:
    """Parameters of which each is defined by the next."""
    links = "".join(f" p{i}, =[p{i + 1} + 1]\n" for i in range(count))
    return f"$PREPROCESSOR\n*PARAMETERS\n{links} p{count}, 1.0\n{_MODEL}"


def generated(step: int) -> str:
    """A set of ten million numbers."""
    return f"{_MODEL}*ELEMENT SETS\n SET=A\n GEN=1, {_GENERATED * step}, {step}\n"


def cost(*arguments: str | Path) -> str:
    """Processor seconds and peak memory of a command."""
    best, memory = float("inf"), 0
    for _ in range(_RUNS):
        words = [sys.executable, "-m", "mudline", *map(str, arguments)]
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{' '.join(words)} ended with {process.returncode}")
        best = min(best, used.ru_utime + used.ru_stime)
        memory = max(memory, used.ru_maxrss // 1024)
    return f"{best:6.2f} s {memory:5} MB"


def main() -> None:
    """Write the decks, run the commands, print a line each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000, help="links of a chain")
    count: int = parser.parse_args().count
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for kind, text in (("subsets", sets(count)), ("parameters", parameters(count)), ("one set", sets(1))):
            deck = folder / "chain.keyxm"
            deck.write_text(text, encoding="utf-8")
            print(f"lint, {kind:<22} {cost('lint', '--no-cache', deck)}")
        for step in (1, 2):
            decks = [folder / f"{side}.keyxm" for side in ("one", "other")]
            for deck in decks:
                deck.write_text(generated(step), encoding="utf-8")
            print(f"diff, 10^7 by GEN=, step {step:<3} {cost('diff', *decks)}")


if __name__ == "__main__":
    main()
