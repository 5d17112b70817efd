"""Rules over suction, stiffness jumps and time steps: thresholds, and where they are silent."""

from __future__ import annotations

import re

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from tests.checks.findings import (
    ON_CLAY,
    PIPE,
    PROPERTIES,
    RESTART,
    found,
    in_units,
    messages,
    points,
)

SUCTION = PIPE.replace("0.25", "0.3") + "*SEABED SUCTION\n SET=ALL\n"


@pytest.mark.parametrize(
    ("lines", "needed"),
    [
        (" COHESION=5000\n", "61666.6"),
        (" COHESION=5000\n REGULARISATION=0.1\n", "42662.9"),
        (" COHESION=5000\n CYCLIC=0.5\n", "30833.3"),
        (" FORCE=1000, 0\n DEPTH=0.1, 0\n CUTOFF=0.2, 0.5\n", "20000 "),
    ],
)
def test_the_stiffness_that_suction_needs(lines: str, needed: str) -> None:
    assert needed in messages(SUCTION + lines, "STB001")[0]
    assert found(SUCTION + lines, "STB001") == [("STB001", 14, 2)]


@pytest.mark.parametrize(
    "lines",
    [
        " COHESION=0\n",
        " FORCE=1000, 0\n",
        " COHESION=5000\n CUTOFF=0.2, 1\n",
        " COHESION=5000\n REGULARISATION=0\n",
        " COHESION==[x]\n",
        " COHESION=5000\n SET=ALL\n COHESION=0\n",
    ],
)
def test_suction_without_a_release_that_is_known(lines: str) -> None:
    assert found(SUCTION + lines, "STB001") == []


def test_suction_in_other_units() -> None:
    """Feet and pounds per square foot give the same case; user units have no law from a cohesion."""
    text = SUCTION.replace("0.3, 0.22", f"{0.3 / 0.3048}, 0.5") + " COHESION=104.427\n"
    message = lint_bytes(text.encode(), "deck.keyxi", select(["STB001"]))[0].message
    assert float(message.split(" = ")[1].split()[0]) == pytest.approx(61666.617838 / 47.880259, rel=1e-4)
    assert in_units(text, "keyx", "STB001") == []
    own = SUCTION + " FORCE=1, 1\n DEPTH=1, 0\n"
    assert in_units(own, "keyx", "STB001") == []
    assert in_units(own + " REGULARISATION=2\n", "keyx", "STB001") == [(14, 2)]


def test_jumps_inside_a_curve() -> None:
    assert found(points((0, 0), (1, 1), (2, 10001)), "STB003") == []
    assert found(points((0, 0), (1, 1), (2, 10002), (3, 10002), (4, 10002.5)), "STB003") == [
        ("STB003", 5, 2),
        ("STB003", 7, 2),
    ]


@pytest.mark.parametrize(
    ("stiffness", "fires"), [("3.1E8", False), ("3.3E8", True), ("3.3", False), ("3.1", True), ("0", False)]
)
def test_jumps_beside_a_curve(stiffness: str, fires: bool) -> None:
    """The curve has 8000 N / 0.25 m = 32000 N/m2."""
    text = PIPE + "*ELEMENT SETS\n SET=Rock\n GEN=4, 6\n" + ON_CLAY + f" SET=Rock\n STIFFNESS={stiffness}\n"
    assert found(text, "STB003") == ([("STB003", 25, 12)] if fires else [])


TIME = PIPE + PROPERTIES + " STIFFNESS=1E5\n$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10{}\n"


MASS = 7850.0 * 0.25 * 3.141592653589793 * (0.25**2 - 0.22**2)


def test_the_step_at_its_limit() -> None:
    limit = 0.5 / (1e5 / MASS) ** 0.5
    assert found(TIME.format(f", {limit * 0.999}"), "STB002") == []
    assert found(TIME.format(f", {limit * 1.001}"), "STB002") == [("STB002", 20, 9)]
    assert found(TIME.format("") + RESTART, "STB002") == found(TIME.format(", , 5"), "STB002") == []


def test_steps_are_looked_at_only_when_asked() -> None:
    data = TIME.format(", 9").encode()
    assert "STB002" not in {finding.code for finding in lint_bytes(data, "deck.keyxm", select())}


@pytest.mark.parametrize(("product", "words"), [(0.9, "11 %"), (1.9, "far too fast"), (3.0, "three times")])
def test_what_a_coarse_step_does(product: float, words: str) -> None:
    assert words in messages(TIME.format(f", {product / (1e5 / MASS) ** 0.5}"), "STB002")[0]


@pytest.mark.parametrize(
    ("blocks", "line"),
    [
        ("*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.3, 0.6\n STIFFNESS=1E9, 2E9\n", " STIFFNESS=1E9, 2E9"),
        ("*SEABED SUCTION\n SET=ALL\n COHESION=5E6\n", " COHESION=5E6"),
        ("*SEABED UNLOADING\n SET=ALL\n STIFFNESS=1E9\n", " STIFFNESS=1E9"),
    ],
)
def test_the_line_is_that_of_the_numbers(blocks: str, line: str) -> None:
    text = TIME.format(", 9").replace("$LOAD CASE\n", f"{blocks}$LOAD CASE\n")
    assert re.search(rf"node 1, line {text.splitlines().index(line) + 1}\b", messages(text, "STB002")[0])


def test_steps_on_curves_and_without_any_mass() -> None:
    text = PIPE + ON_CLAY + "$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10, 1\n"
    assert f"omega = {(32000 / MASS) ** 0.5:.4g} rad/s" in messages(text, "STB002")[0]
    assert found(text.replace("7850.0", "0.0"), "STB002") == []
    assert found("$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10, 1\n", "STB002") == []
