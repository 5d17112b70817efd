"""Measure what holds for any deck, and write its tables into the pages: python -m tests.benchmarks.studies

`--only PART ...` measures some parts, the tables of the others stay as they are; `--only` alone writes the pages again.
"""

from __future__ import annotations

import argparse
import sys

from tests.benchmarks.studies import curves, landings, release
from tests.benchmarks.tables import FOLDER, rewrite

PARTS = {"curves": curves, "landings": landings, "release": release}
TABLES = {**curves.TABLES, **landings.TABLES, **release.TABLES}
PAGES = ("precision", "stability")


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
