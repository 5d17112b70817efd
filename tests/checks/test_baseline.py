"""Known findings, by path, code and line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.checks.suppression import Baseline, BaselineError, read_baseline
from tests.checks.findings import CLAY, CURVES, curve

DECK = f"{CURVES}{CLAY}{curve('Sand', (0.0, 0.0), (0.5, 4000.0))}"
"""Two REF003."""
SCHEMA = Path(__file__).parents[2] / "docs" / "schemas" / "baseline.json"
RULES = select(["REF003", "CRV006"])


def recorded(folder: Path, text: str = DECK, name: str = "decks/a.keyxm") -> Baseline:
    baseline = Baseline(folder)
    path = str(folder / name)
    baseline.record(lint_bytes(text.encode(), path, RULES), text.encode(), path)
    return baseline


def unknown(baseline: Baseline, text: str, name: str = "decks/a.keyxm") -> list[int]:
    path = str(baseline.folder / name)
    found = lint_bytes(text.encode(), path, RULES)
    return [one.line for one in baseline.unknown(found, text.encode(), path)]


def test_what_is_recorded_is_hidden_wherever_it_stands(tmp_path: Path) -> None:
    baseline = recorded(tmp_path)
    assert unknown(baseline, f"C a line more\n\n{DECK.replace(' CURVE', '  CURVE')}") == []
    assert baseline.gone() == 0


def test_what_is_not_recorded_is_told(tmp_path: Path) -> None:
    assert unknown(recorded(tmp_path), DECK.replace("Sand", "Silt")) == [6]
    assert unknown(recorded(tmp_path), DECK, "decks/b.keyxm") == [3, 6]
    above = DECK.replace("Clay\n 0.0", "Clay\n -0.1")
    assert unknown(recorded(tmp_path, above), above.replace("Sand\n 0.0", "Sand\n -0.1")) == [7]


def test_what_is_gone_is_counted_for_the_files_seen(tmp_path: Path) -> None:
    baseline = recorded(tmp_path)
    assert baseline.gone() == 0
    assert unknown(baseline, CURVES + CLAY) == []
    assert baseline.gone() == 1


def test_the_file_is_sorted_and_keeps_to_its_schema(tmp_path: Path) -> None:
    text = recorded(tmp_path).text()
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    validator = pytest.importorskip("jsonschema").Draft202012Validator
    validator.check_schema(schema)
    validator(schema).validate(json.loads(text))
    validator(schema).validate(json.loads(Baseline(tmp_path).text()))
    first, second = json.loads(text)["findings"]
    assert first == {"path": "decks/a.keyxm", "code": "REF003", "content": "CURVE=Clay", "count": 1}
    assert second["content"] == "CURVE=Sand"


def test_it_is_read_as_it_was_written(tmp_path: Path) -> None:
    baseline = recorded(tmp_path)
    path = tmp_path / "known.json"
    path.write_text(baseline.text(), encoding="utf-8")
    again = read_baseline(path)
    assert again.known == baseline.known
    assert again.text() == baseline.text()
    assert unknown(again, DECK) == []


ENTRY = '{"path": "a", "code": "REF003", "content": "", "count": 1}'


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ("\udcff", "not JSON"),
        (f'{{"format": {"9" * 5000}}}', "^a whole number in it is too large$"),
        ("[]", "mudline-baseline/1"),
        ('{"format": "mudline-baseline/2"}', "mudline-baseline/1"),
        ('{"format": "mudline-baseline/1"}', "no list"),
        ('{"format": "mudline-baseline/1", "findings": [3]}', "must have the keys"),
        (f'{{"format": "mudline-baseline/1", "findings": [{ENTRY.replace("1}", "0}")}]}}', "whole number"),
        (f'{{"format": "mudline-baseline/1", "findings": [{ENTRY.replace("1}", "true}")}]}}', "whole number"),
        (f'{{"format": "mudline-baseline/1", "findings": [{ENTRY.replace(chr(34) * 2, "1")}]}}', "must be texts"),
    ],
)
def test_a_file_that_is_none_is_refused_with_the_reason(tmp_path: Path, text: str, reason: str) -> None:
    path = tmp_path / "known.json"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(BaselineError, match=reason):
        read_baseline(path)
