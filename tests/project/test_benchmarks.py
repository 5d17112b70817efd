"""The benchmarks: their runner works, their page lists every goal, and what they feed the programs is what they say."""

from __future__ import annotations

from pathlib import Path

import pytest

import mudline
from tests.benchmarks import decks
from tests.benchmarks.bench import Bench, Results, Work
from tests.benchmarks.goals import GOALS
from tests.benchmarks.page import write
from tests.benchmarks.peers import PEERS, Environment
from tests.benchmarks.runner import ROOT, Figure, cpu

PAGE = ROOT / "docs" / "benchmarks.md"
MISSING = {peer.name: Environment(peer, "no distribution") for peer in PEERS}


def rows_of(text_of_page: str) -> list[list[str]]:
    lines = [line for line in text_of_page.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_the_page_lists_every_goal_with_its_limit() -> None:
    rows = rows_of(PAGE.read_text(encoding="utf-8"))
    for goal in GOALS:
        wanted = f"{goal.direction} {goal.limit:g}"
        assert [row for row in rows if row[0] == goal.what and row[1].startswith(wanted)], goal


def test_a_page_says_what_is_met_missed_and_not_measured(tmp_path: Path) -> None:
    results = Results(
        figures={"rows 2": Figure([2.0, 1.9, 2.5], 2.1), "memory 2": Figure([150.0], 150.0)},
        series={"rows": {"mudline": [(10**n, 1e-6 * 10**n) for n in range(2, 8)]}},
    )
    results.save(tmp_path / "results.json")
    write(Results.load(tmp_path / "results.json"), MISSING, tmp_path)
    text_of_page = (tmp_path / "benchmarks.md").read_text(encoding="utf-8")
    rows = {row[0]: row[1:] for row in rows_of(text_of_page)}
    assert rows["text to array, 2 columns: np.loadtxt / mudline"] == ["at least 1.8", "2", "1.9 to 2.5", "2.1", "yes"]
    assert rows["peak memory of the process, 2 columns"][1:] == ["150 MB", "one run", "150", "**missed**"]
    assert rows["text to array, 4 columns: np.loadtxt / mudline"][1] == "not measured"
    assert rows["rows"] == ["mudline", "100 to 10,000,000", "10", "1.00"]
    assert rows["meshio"][0] == "not installed: no distribution"
    assert f"Of {len(GOALS)} goals 1 are met, 1 missed, {len(GOALS) - 2} not measured." in text_of_page


def test_a_quick_run_reads_tables(tmp_path: Path) -> None:
    bench = Bench(tmp_path, quick=True, environments=MISSING)
    work = Work("import mudline", "return mudline.read(path)")
    found = bench.costs({"read": bench.timed(work, "curve", 1000)}, 3)
    assert 0.0 < cpu(found["read"])[0] < 10.0


@pytest.mark.parametrize("write_deck", [decks.apart, decks.alike])
def test_decks_have_41_lines_and_no_findings(write_deck: decks.Writer, tmp_path: Path) -> None:
    for number in range(20):
        text_of_deck = write_deck(number)
        path = tmp_path / f"{number}.keyxm"
        path.write_text(text_of_deck, encoding="utf-8")
        assert mudline.lint(path) == []
        for converted in (text_of_deck, decks.as_yaml(text_of_deck), decks.as_python(text_of_deck)):
            assert converted.count("\n") == 41
