"""Measure what holds for any deck, and write its tables into the pages: python -m tests.benchmarks.studies

`--only PART ...` measures some parts, the tables of the others stay as they are; `--only` alone writes the pages again.
"""

from __future__ import annotations

import argparse
import sys

from tests.benchmarks.studies import critical, curves, extremes, friction, landings, pruning, steps
from tests.benchmarks.tables import FOLDER, rewrite

PARTS = {
    "curves": curves,
    "steps": steps,
    "critical": critical,
    "landings": landings,
    "friction": friction,
    "extremes": extremes,
    "pruning": pruning,
}
TABLES = {**curves.TABLES, **steps.TABLES, **landings.TABLES, **pruning.TABLES}
PAGES = ("precision", "stability", "pruning")


def main() -> None:
    """Measure what is asked for, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="*", choices=PARTS, default=list(PARTS))
    given = parser.parse_args()
    for part in given.only:
        PARTS[part].run(lambda words: print(words, file=sys.stderr))
    for page in PAGES:
        rewrite(FOLDER / f"{page}.md", TABLES)


if __name__ == "__main__":
    main()
