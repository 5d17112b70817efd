"""What rules find in a deck."""

from __future__ import annotations

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules, select
from tests.helpers.builders import decks

PIPE = decks.PIPE + decks.STEEL
PROPERTIES = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n"
CURVES = "$MODEL\n*SEABED STIFFNESS\n"
RESTART = "$LOAD CASE\n*RESTART\n LAST=static\n"


def found(text: str, *codes: str) -> list[tuple[str, int, int]]:
    """Code, line and column of the findings of some rules; of all without codes."""
    findings = lint_bytes(text.encode(), "deck.keyxm", select(codes) if codes else rules())
    return [(finding.code, finding.line, finding.column) for finding in findings]


def messages(text: str, code: str) -> list[str]:
    return [finding.message for finding in lint_bytes(text.encode(), "deck.keyxm", select([code]))]


def curve(name: str, *points: tuple[float, float]) -> str:
    return f" CURVE={name}\n" + "".join(f" {ratio}, {force}\n" for ratio, force in points)


CLAY = curve("Clay", (0.0, 0.0), (0.5, 4000.0))
ON_CLAY = "*SEABED STIFFNESS\n" + CLAY + PROPERTIES + " STIFFNESS=Clay\n"


def points(*given: tuple[float, float]) -> str:
    return CURVES + curve("a", *given) + PROPERTIES + " STIFFNESS=a\n"


def in_units(text: str, suffix: str, code: str) -> list[tuple[int, int]]:
    return [(one.line, one.column) for one in lint_bytes(text.encode(), f"deck.{suffix}", select([code]))]


def repaired(text: str, code: str) -> str:
    """The text with the repairs of all findings of a code, each on lines of its own."""
    lines = text.split("\n")
    for finding in lint_bytes(text.encode(), "deck.keyxm", select([code])):
        assert finding.fix is not None
        for edit in reversed(finding.fix.edits):
            (line, start), (last, end) = edit.start, edit.end
            assert line == last
            lines[line - 1] = lines[line - 1][: start - 1] + edit.text + lines[line - 1][end - 1 :]
    return "\n".join(lines)
