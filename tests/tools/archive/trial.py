"""Decks to index, and what an archive holds of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mudline.tools.archive.rows import TABLES
from tests.cli.runner import Outcome, run

LINE = """\
C {title}
$MODEL
*OCEAN
 {depth}, 1025.0, 9.81
*NODE
 1, -0.05, 0.0
 2, -0.05, 5.0
 3, -0.05, 10.0
*ELEMENT
 1, 1, 2
 2, 2, 3
*ELEMENT SETS
 SET=TDZ
 1
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.5, 0.46, 7850.0
*SEABED STIFFNESS
 CURVE={curve}
 0.0, 0.0
 0.1, {force}
 0.5, 3000.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50000.0
 SET=TDZ
 STIFFNESS={curve}
"""


def deck(title: str = "a line", *, depth: float = 500.0, curve: str = "Clay", force: float = 1200.0) -> str:
    """A legal deck: two elements in contact, one of them on a curve."""
    return LINE.format(title=title, depth=depth, curve=curve, force=force)


def write(folder: Path, **texts: str) -> Path:
    """Write decks by their names without suffix."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.keyxm").write_text(text, encoding="utf-8")
    return folder


def index(*arguments: str | Path, archive: Path) -> Outcome:
    """Index in this process, without a configuration."""
    return run("index", *arguments, "-o", archive, "--isolated", "--jobs", "1")


def summary(outcome: Outcome) -> str:
    """The counts that a run reports."""
    assert outcome.code == 0, outcome.err
    return outcome.err.splitlines()[-1].removeprefix("mudline: ").partition(" -> ")[0]


def ask(archive: Path, sql: str) -> list[dict[str, Any]]:
    """The rows of an answer, as the shell of DuckDB gives it anywhere."""
    import duckdb  # noqa: PLC0415 - an extra

    with duckdb.connect(archive / "archive.duckdb", read_only=True) as connection:
        answer = connection.execute(sql)
        names = [column[0] for column in answer.description or ()]
        return [dict(zip(names, row, strict=True)) for row in answer.fetchall()]


def contents(archive: Path) -> dict[str, list[str]]:
    """Every row of every table."""
    return {table: sorted(str(list(row.values())) for row in ask(archive, f"FROM {table}")) for table in TABLES}
