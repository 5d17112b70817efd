"""The deck that a scene is made from holds values only; nothing that works with it knows equations."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import cast

import pytest

from mudline.checks.context import LintContext
from mudline.checks.engine import problems_in
from mudline.checks.registry import rules
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import Diagnostic, Severity
from mudline.language.keywords.library.loads import Boundary
from mudline.language.keywords.model import Part
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation
from mudline.model.scene.model import Scene, resolve
from tests.checks.legality import NAME
from tests.checks.legality import deck as random_deck
from tests.helpers.builders.scenes import scene_of

LAST = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n"
GIVEN = "$PREPROCESSOR\n*PARAMETERS\n dof, 6\n soil, 50.0\n"


def linted(text: str) -> list[Diagnostic]:
    deck = load_bytes(text.encode(), NAME)
    return deck.diagnose(problems_in(LintContext(deck), rules()))


def equations(value: object) -> Iterator[Equation]:
    """All equations in a value and below it."""
    if isinstance(value, Equation):
        yield value
    elif isinstance(value, Table):
        yield from (word for word in value.words.values() if isinstance(word, Equation))
    elif isinstance(value, Part):
        for name in type(value).model_fields:
            yield from equations(getattr(value, name, None))
    elif isinstance(value, list):
        for item in value:
            yield from equations(item)


def in_deck(scene: Scene, *, written: bool = False) -> list[Equation]:
    deck = scene.context.written if written else scene.deck
    sections = [section for section in deck.sections if section.name != "PREPROCESSOR"]
    return [found for section in sections for block in section.blocks for found in equations(block)]


@pytest.mark.untraced
def test_no_equation_is_left_in_random_decks() -> None:
    met = 0
    for seed in range(60):
        number = re.compile(r"(?<=[ ,=])\d+\.\d+(?=[,\n])")
        scene = resolve(load_bytes(number.sub("=[soil]", random_deck(seed)).encode(), NAME))
        assert in_deck(scene) == []
        met += len(in_deck(scene, written=True))
    assert met > 500


def test_sections_behind_the_model_are_evaluated() -> None:
    scene = scene_of(GIVEN + "$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n" + LAST + " 1, =[dof], =[soil/2]\n")
    block = cast("Boundary", next(block for _, block in scene.deck.blocks("BOUNDARY", "LOAD CASE")))
    node = block.types[0].entries[0]
    assert (node.dof, node.value) == (6, 25.0)  # type: ignore[union-attr]  # a node, no range
    assert scene.findings == []


@pytest.mark.parametrize(
    ("equation", "code", "severity"),
    [("=[dfo]", "REF013", "error"), ("=[1/0]", "SYN017", "error"), ("=[cu(2)]", "SYN017", "warning")],
)
def test_a_fault_behind_the_model_is_a_finding_and_does_not_block(equation: str, code: str, severity: str) -> None:
    text = GIVEN + "$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n" + LAST + f" 1, 2, {equation}\n"
    found = [one for one in linted(text) if one.code in ("REF013", "SYN017")]
    assert [(one.code, one.severity, one.line, one.column) for one in found] == [(code, Severity(severity), 11, 8)]
    assert not found[0].blocks
    value = scene_of(text).deck.sections[2].blocks[0].types[0].entries[0].value  # type: ignore[union-attr]
    assert math.isnan(value)


@pytest.mark.parametrize(
    ("lines", "line", "column", "field"),
    [
        ("$MODEL\n*ELEMENT SETS\n SET=A\n =[dof]\n", 8, 2, "elements"),
        (LAST + " =[dof], 1\n", 8, 2, "node"),
        ("$MODEL\n*ELEMENT\n 1, 1, =[dof]\n", 7, 8, "node2"),
    ],
)
def test_a_number_that_names_something_is_given_by_no_equation(lines: str, line: int, column: int, field: str) -> None:
    found = [one for one in linted(GIVEN + lines) if one.line == line and one.column == column]
    message = f"'=[dof]' is an equation: expected a number or a {{label}} for {field}"
    assert [(one.code, one.message) for one in found] == [("SYN002", message)]


def test_an_equation_in_a_list_has_a_value_and_a_place() -> None:
    body = "$MODEL\n*AUXILIARY\n BODY=NONE\n 1, =[{}]\n"
    assert in_deck(scene_of(GIVEN + body.format("dof"))) == []
    found = [one for one in linted(GIVEN + body.format("dfo")) if one.code == "REF013"]
    assert [(one.line, one.column) for one in found] == [(8, 5)]
