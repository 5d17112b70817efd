"""Names that are hostile to a target come out as names of it, each once, and are listed with what they became."""

from __future__ import annotations

import re
from types import ModuleType

import pytest
import yaml
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from mudline.tools.exporting import moordyn, orcaflex
from mudline.tools.exporting.report import ExportReport, Outcome, TargetNames, one_line
from tests.tools.exporting.decks import model_of, text
from tests.tools.exporting.test_moordyn import tables

HOSTILE = (
    *("a#b", "--- LINES ---", 'say "so"', "it's", "x" * 300, "Røret på bunnen", "海底管道", "none", "1", "a: [b"),
    *("%YAML", "\u2028", "~"),
)
TARGETS = {moordyn: ("A-Za-z0-9_", 32), orcaflex: (r"A-Za-z0-9_. ()", 50)}
MODEL = model_of(text())


def taken(names: list[str], letters: str, longest: int) -> tuple[list[str], ExportReport]:
    report = ExportReport(MODEL.scene)
    given_names = TargetNames(report, letters, longest)
    where = MODEL.sections[0].where
    return [given_names.take(name, where) for name in names], report


@pytest.mark.parametrize("target", TARGETS, ids=lambda target: target.__name__.rpartition(".")[2])
@given(names=st.lists(st.text(max_size=320), max_size=8))
@example(names=list(HOSTILE))
@example(names=["Section A", "section a", "Section-A", "Section_A"])
@settings(suppress_health_check=[HealthCheck.differing_executors])
def test_names_are_valid_unique_and_listed(target: ModuleType, names: list[str]) -> None:
    letters, longest = TARGETS[target]
    found, report = taken(names, letters, longest)
    assert len({name.casefold() for name in found}) == len(names)
    for written, name in zip(names, found, strict=True):
        assert re.fullmatch(f"[A-Za-z][{letters}]{{0,{longest - 1}}}", name)
        assert written == name or name in {entry.target for entry in report.entries if entry.status is Outcome.RENAMED}


@given(st.text())
@example("--- POINTS ---\n# x")
def test_a_comment_is_one_line_of_ascii_without_marks(written: str) -> None:
    found = one_line(written)
    assert found.isascii()
    assert found.isprintable()
    assert "--" not in found
    assert "#" not in found


@pytest.mark.parametrize("name", [name[:240] for name in HOSTILE if name not in ("none", "1", "\u2028", 'say "so"')])
def test_a_deck_with_such_a_name_is_written_whole(name: str) -> None:
    deck = text(
        sets=f"*ELEMENT SETS\n SET={name}\n GEN=1, 10\n", sections=f" OPTION=MOORING\n SET={name}\n 1.0E8, 50.0, 0.1\n"
    )
    model = model_of(deck)
    found = tables(moordyn.write(model, "a.txt")["a.txt"])
    assert list(found) == ["LINE TYPES", "POINTS", "LINES", "OPTIONS", "end"]
    assert found["LINES"][0][1] == found["LINE TYPES"][0][0]
    assert len(yaml.safe_load(orcaflex.write(model_of(deck), "a.yml")["a.yml"])["LineTypes"]) == 1
    (entry,) = (entry for entry in model.report.entries if entry.status is Outcome.RENAMED)
    assert entry.target == found["LINE TYPES"][0][0]
    assert entry.keyword.startswith("*GEOMETRIC SETS name ")
