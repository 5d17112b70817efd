"""The samples are what they say they are: lossless, clean, or faulty in every announced place."""

from __future__ import annotations

import re

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.diagnostics import Severity
from tests.helpers.samples import FAULTY, SAMPLES

DECKS = sorted(path.name for path in SAMPLES.glob("*.keyx?"))
CLEAN = [name for name in DECKS if name not in FAULTY]

INFO = {"imperial-riser.keyxi": {"GEO003"}, "legacy-flowline.keyxm": {"LEG001", "CRV002"}}
"""What a clean deck may be told beside OFTEN, all of it info."""
OFTEN = {"TIM005", "GEO010"}
"""A keyword of static runs without effect, and lines with free ends."""

_FAULTS = (
    "9 SYN011, 12 SYN007, 20 REF013, 23 REF014, 25 SYN017, 30 SYN002, 36 SYN003, 38 SYN002, 43 REF007, 46 "
    "REF010, 53 REF006, 59 REF009, 66 REF005, 70 SYN016, 75 REF008, 77 REF010, 82 SYN005, 86 SYN006, 89 "
    "SBD010, 92 SYN008, 97 SYN009, 106 SYN001, 108 SBD010, 110 REF001, 114 REF002, 116 SYN004, 120 "
    "SBD006, 120 SBD008, 125 SBD002, 132 SYN015, 135 CRV003, 138 CRV004, 143 CRV002, 145 CRV005, 145 "
    "CRV012, 147 CRV001, 147 REF003, 150 REF004, 151 CRV006, 152 CRV007, 155 SYN013, 158 SYN010, 167 "
    "SYN014"
)
FAULTS = [(int(line), code) for line, code in (each.split() for each in _FAULTS.split(", "))]
"""Line and code of what is found in the broken sample."""


def found(data: bytes, name: str) -> list[tuple[int, str]]:
    """Line and code of each finding, also of those that follow from another one and stand under it."""
    findings = lint_bytes(data, name, select())
    return sorted((one.line, one.code) for finding in findings for one in (finding, *finding.following))


def found_in(name: str) -> list[tuple[int, str]]:
    return found((SAMPLES / name).read_bytes(), name)


# ---------------------------------------------------------------------------------------------------------- as text


@pytest.mark.parametrize("name", DECKS)
def test_a_sample_begins_with_what_it_shows_and_says_that_it_is_synthetic(name: str) -> None:
    text = (SAMPLES / name).read_text(encoding="utf-8")
    header = re.match(r"(?:C.*\n)+", text)
    assert header is not None
    assert "shows:" in header[0].lower()
    assert "synthetic" in header[0].lower()


# --------------------------------------------------------------------------------------------------------- findings


@pytest.mark.parametrize("name", CLEAN)
def test_clean_samples_are_told_nothing_or_info(name: str) -> None:
    findings = lint_bytes((SAMPLES / name).read_bytes(), name, select())
    assert {finding.severity for finding in findings} <= {Severity.INFO}
    assert {finding.code for finding in findings} <= INFO.get(name, set()) | OFTEN


def test_each_of_twenty_faults_all_over_a_deck_is_one_finding() -> None:
    good, bad = ((SAMPLES / name).read_text(encoding="utf-8").split("\n") for name in ("scr-vessel.keyxm", FAULTY[1]))
    changed = [number for number, lines in enumerate(zip(good, bad, strict=True), 1) if len(set(lines)) > 1]
    findings = lint_bytes((SAMPLES / FAULTY[1]).read_bytes(), FAULTY[1], select(), folder=SAMPLES)
    told = [one.line - (one.code == "CRV003") for one in findings]  # of two points the later one
    assert told == changed[1:]  # the first one is the line that says what the deck shows
    assert len(told) == 20


def test_the_broken_deck_has_these_faults() -> None:
    assert found_in("broken.keyxm") == FAULTS


def test_every_fault_is_announced_by_the_nearest_comment_above_it() -> None:
    lines = (SAMPLES / "broken.keyxm").read_text(encoding="utf-8").split("\n")
    numbered = [int(match[1]) for line in lines if (match := re.match(r"C +(\d+) (?:SYN|REF|CRV|SBD)", line))]
    assert numbered == list(range(1, 39))
    for line, code in FAULTS:
        announced = next(text for text in reversed(lines[: line - 1]) if re.match(r"C +\d+ ", text))
        assert code in announced, (line, code)
