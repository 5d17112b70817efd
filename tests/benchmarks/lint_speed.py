"""Seconds of `mudline lint`: python tests/benchmarks/lint_speed.py [--yamllint PROGRAM]

Linting is timed in one process and without the cache, beside yamllint on the same decks as YAML if that program is
given; then a start on one deck, `--version`, the cache and `--jobs 2`. Each run is a process of its own; printed are
the medians, and ratios to the time of mudline. Files and byte code are read once before.
"""

from __future__ import annotations

import argparse
import compileall
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import mudline

_HEAD = "C deck {0}\n$MODEL\n*OCEAN\n {1}.0, 1025.0, 9.81\n*NODE\n"
_TAIL = """\
*ELEMENT SETS
 SET=TDZ
 1, 2, 3
 SET=Riser
 GEN=4, 7
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.5, 0.46, 7850.0
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.1, 1200.0
 0.5, 3000.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50000.0
 SET=TDZ
 STIFFNESS=Clay
"""


def deck(number: int) -> str:
    """A deck of 41 lines, unlike the others in its depth."""
    nodes = "".join(f" {i}, -0.05, {5 * (i - 1)}.0\n" for i in range(1, 9))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, 8))
    return f"{_HEAD.format(number, 500 + number)}{nodes}*ELEMENT\n{elements}{_TAIL}"


def write(folder: Path, count: int) -> None:
    """So many decks."""
    folder.mkdir()
    for i in range(count):
        (folder / f"deck{i:05}.keyxm").write_text(deck(i), encoding="utf-8")


def write_yaml(decks: Path, folder: Path) -> None:
    """The same decks as YAML."""
    folder.mkdir()
    for path in sorted(decks.iterdir()):
        text = mudline.read(path).to_yaml()
        (folder / f"{path.stem}.yaml").write_text(text, encoding="utf-8")


def seconds(words: Sequence[str | Path], cache: Path) -> float:
    """The time of a process; it may find something, and has to end by itself."""
    environment = {**os.environ, "MUDLINE_CACHE_DIR": str(cache)}
    start = time.perf_counter()
    done = subprocess.run(words, env=environment, capture_output=True, check=False)
    taken = time.perf_counter() - start
    if done.returncode not in (0, 1):
        raise SystemExit(done.stderr.decode("utf-8", "replace"))
    return taken


def medians(runs: dict[str, list[str | Path]], rounds: int, cache: Path) -> dict[str, float]:
    """Each round times every run once, so that a busy machine slows all of them alike."""
    taken: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, words in runs.items():
            taken[name].append(seconds(words, cache))
    return {name: statistics.median(times) for name, times in taken.items()}


def main() -> None:
    """Time all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--yamllint", nargs="+", help="the words that run yamllint, such as its program's path")
    parser.add_argument("--decks", type=int, default=1000, help="decks to lint (default 1000)")
    parser.add_argument("--many", type=int, default=10_000, help="decks for the cache (default 10 000)")
    parser.add_argument("--rounds", type=int, default=5, help="rounds to take the median of (default 5)")
    given = parser.parse_args()
    compileall.compile_dir(Path(mudline.__file__).parent, quiet=1)
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        cache = place / "cache"
        write(place / "decks", given.decks)
        write(place / "many", given.many)
        program: list[str | Path] = [sys.executable, "-m", "mudline"]
        lint = [*program, "lint", "--no-cache"]
        first = min((place / "decks").iterdir())
        runs: dict[str, list[str | Path]] = {
            f"lint {given.decks} decks": [*lint, "--jobs", "1", place / "decks"],
            f"lint {given.decks} decks, --jobs 2": [*lint, "--jobs", "2", place / "decks"],
            "lint 1 deck": [*lint, first],
            "--version": [*program, "--version"],
        }
        if given.yamllint:
            write_yaml(place / "decks", place / "yaml")
            runs[f"yamllint {given.decks} files"] = [*given.yamllint, "-d", "default", place / "yaml"]
        found = medians(runs, given.rounds, cache)
        unit = next(iter(found.values()))
        for run, taken in found.items():
            print(f"{run:>32}{taken:>10.3f} s (x {taken / unit:.2f})")
        cold, warm = (seconds([*program, "lint", "--jobs", "1", place / "many"], cache) for _ in range(2))
        print(f"{f'lint {given.many} decks, first':>32}{cold:>10.3f} s")
        print(f"{'unchanged, second':>32}{warm:>10.3f} s (x 1/{cold / warm:.1f})")


if __name__ == "__main__":
    main()
