"""Rules over lists, sections, ends of curves, units and stability: thresholds, and where they are silent."""

from __future__ import annotations

import pytest

from mudline.deck.forms.json import to_json
from mudline.deck.loading import load_bytes
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from tests.lint.findings import CLAY, CURVES, PIPE, PROPERTIES, RESTART, curve, found, messages

ON_CLAY = "*SEABED STIFFNESS\n" + CLAY + PROPERTIES + " STIFFNESS=Clay\n"
FLEXIBLE = PIPE.replace("RIGID", "FLEXIBLE").replace(
    "207.0E9, 79.6E9, 0.25, 0.22, 7850.0", ", , , , 90, 1, 0.2, 0.4, 0.3"
)


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


# ------------------------------------------------------------------------------------------------- lists and repeats


def listed(count: int, separator: str = ", ") -> str:
    return "$MODEL\n*ELEMENT SETS\n SET=a\n  " + separator.join(map(str, range(1, count + 1))) + "\n"


def test_a_list_of_twenty_is_fine() -> None:
    assert found(listed(20), "REF012") == []
    assert found(listed(21), "REF012") == [("REF012", 4, 74)]


@pytest.mark.parametrize("separator", [", ", ",", " , "])
def test_a_long_list_is_split_into_lines_of_twenty(separator: str) -> None:
    text = repaired(listed(45, separator), "REF012")
    assert [line.replace(" ", "").count(",") for line in text.split("\n")[3:6]] == [19, 19, 4]
    assert [line[:3].count(" ") for line in text.split("\n")[3:6]] == [2, 2, 2]
    assert found(text, "REF012") == []


def test_a_split_line_ends_as_the_lines_of_the_file() -> None:
    finding = lint_bytes(listed(21).replace("\n", "\r\n").encode(), "deck.keyxm", select(["REF012"]))[0]
    assert finding.fix is not None
    assert (finding.fix.applicability, finding.fix.edits[0].text) == ("safe", "\r\n  ")


def test_a_list_with_an_empty_field_is_told_and_not_split() -> None:
    findings = lint_bytes(listed(25).replace("20,", "20,,").encode(), "deck.keyxm", select(["REF012"]))
    assert [finding.fix for finding in findings] == [None]


def test_lists_of_files_with_lone_returns_are_split_and_those_of_documents_are_only_told() -> None:
    finding = lint_bytes(listed(21).replace("\n", "\r").encode(), "deck.keyxm", select(["REF012"]))[0]
    assert finding.fix is not None
    assert finding.fix.edits[0].text == "\r  "
    document = to_json(load_bytes(listed(21).encode(), "deck.keyxm")).encode()
    assert [one.fix for one in lint_bytes(document, "deck.json", select(["REF012"]))] == [None]


def test_sets_are_repeated_without_case_and_over_blocks() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET=a\n 1\n SET=b\n 2\n*ELEMENT SETS\n SET=A\n 3\n SET=ALL\n 1\n SET=All\n"
    text += " SET=\n SET=a\n"
    assert found(text, "REF016") == [("REF016", 8, 6), ("REF016", 14, 6)]


def test_items_of_lists_repeat_parameters() -> None:
    text = "$PREPROCESSOR\n*PARAMETERS\n soil_k, 1\n Soil, /K:2, mu:3/\n n, /1 2/\n n, /3 4/\n od\n x, =[soil_k]\n"
    assert found(text, "REF017") == [("REF017", 4, 2), ("REF017", 6, 2)]
    assert "and 1 more" in messages(text, "REF017")[1]


# ---------------------------------------------------------------------------------------------------------- sections


@pytest.mark.parametrize(
    ("di", "fires"), [("0.2499", False), ("0.25", True), ("0.3", True), ("=[0.25]", True), ("x", False)]
)
def test_a_pipe_needs_a_wall(di: str, fires: bool) -> None:
    assert bool(found(PIPE.replace("0.22", di), "GEO001")) is fires


def test_a_number_beside_its_curve() -> None:
    text = "$MODEL\n*GEOMETRIC SETS\n SET=ALL, {}\n {}, 90, 1, 0.2, 0.4, 0.3\n"
    assert found(text.format("EI=x, GJ=y", ", , , 1"), "GEO002") == []
    assert found(text.format("EI=x, GJ=y", ", 2, 3, 1"), "GEO002") == [("GEO002", 4, 4), ("GEO002", 4, 7)]
    assert found(text.format("EA=x", ", , , =[2*3]"), "GEO002") == [("GEO002", 4, 8)]
    mooring = "$MODEL\n*GEOMETRIC SETS\n OPTION=MOORING\n SET=ALL, EA=x\n 1, 90, 0.2\n"
    assert found(mooring, "GEO002") == []


def test_the_drag_diameter_is_told_only_under_a_curve() -> None:
    assert found(FLEXIBLE + ON_CLAY, "GEO003") == [("GEO003", 12, 22)]
    assert found(FLEXIBLE + PROPERTIES + " STIFFNESS=5E4\n", "GEO003") == []
    assert found(FLEXIBLE.replace("0.3\n", "0.3, 0.35\n") + ON_CLAY, "GEO003") == []
    assert found(PIPE + ON_CLAY, "GEO003") == []


def test_elements_without_length() -> None:
    text = "$MODEL\n*NODE\n 1, 1, 0\n 2, 1, 0\n 3, 1, 1E-9\n*ELEMENT\n 1, 1, 2\n 2, 2, 3\n 3, 3, 3\n 4, 3, 9\n"
    assert found(text, "GEO004") == [("GEO004", 7, 2), ("GEO004", 9, 2)]
    assert "both its ends are node 3" in messages(text, "GEO004")[1]
    finding = lint_bytes((text + "*FLEX JOINTS\n x\n").encode(), "deck.keyxm", select(["GEO004"]))[0]
    assert finding.severity == "warning"


def test_a_generator_of_elements_without_length_is_told_once() -> None:
    text = "$MODEL\n*NODE\n 1, 1, 0\n 9, 1, 0\n GEN=1, 9\n*ELEMENT\n 1, 1, 2\n GEN=1, 8\n"
    assert found(text, "GEO004") == [("GEO004", 7, 2), ("GEO004", 8, 2)]


# ------------------------------------------------------------------------------------------------------------ curves


@pytest.mark.parametrize(
    ("given", "place"),
    [
        (((0, 10), (1, 1000)), []),
        (((0, 10.1), (1, 1000)), [(4, 2)]),
        (((-1, -1000), (1, 1000)), []),
        (((-1, 0), (1, 1000)), [(3, 2)]),
        (((0.1, 100), (1, 1000)), []),
        (((0.1, 100), (0.1, 200), (1, 1000)), []),
        (((0, 0), (1, 0)), []),
    ],
)
def test_the_force_at_zero(given: tuple[tuple[float, float], ...], place: list[tuple[int, int]]) -> None:
    assert [(line, column) for _, line, column in found(points(*given), "CRV007")] == place


def test_a_force_at_zero_that_overflows_is_not_told() -> None:
    assert found(points((1, -1e308), (2, 1e308)), "CRV007") == []


def test_curves_that_pull() -> None:
    assert found(points((0, 0), (1, -1), (2, -3), (3, 9)), "CRV012") == [("CRV012", 5, 2)]
    assert "1 more" in messages(points((0, 0), (1, -1), (2, -3), (3, 9)), "CRV012")[0]
    assert found(points((-1, -5), (0, 0), (1, 5)), "CRV012") == []
    assert found(points((0.1, 10), (0.2, 30)), "CRV012") == [("CRV012", 3, 2)]
    assert found(points((1, 3), (0, 0), (2, 2)), "CRV012") == [("CRV012", 6, 2)]


def test_a_steep_end() -> None:
    assert found(points((0, 0), (1, 1), (2, 101)), "CRV008") == []
    assert found(points((0, 0), (1, 1), (2, 101.1)), "CRV008") == [("CRV008", 6, 2)]
    assert found(points((0, 0), (1, 1), (2, 1), (3, 200)), "CRV008") == [("CRV008", 7, 2)]
    assert found(points((0, 0), (1, 1000)), "CRV008") == []
    assert found(points((0, 0), (1, 1000), (2, 1001), (3, 1201)), "CRV008") == [("CRV008", 7, 2)]
    assert found(points((0, 0), (1, 1), (2, 91), (3, 1000)), "CRV008") == []
    assert found(points((0, 0), (1, 1), (2, 1)), "CRV008", "CRV013") == [("CRV013", 6, 2)]


def test_exchanged_columns_are_told_once_and_exchanged() -> None:
    text = points((0, 0), (1200, 0.1), (4200, 0.5))
    assert [code for code, _, _ in found(text, "CRV009", "CRV010", "UNT002")] == ["CRV009"]
    assert repaired(text, "CRV009").split("\n")[3:6] == [" 0, 0", " 0.1, 1200", " 0.5, 4200"]


@pytest.mark.parametrize("given", [((0, 0), (10, 0.5)), ((0, 0), (11, 1)), ((0, 0), (0, 0)), ((0, 0), (0.1, 900))])
def test_columns_in_their_order(given: tuple[tuple[float, float], ...]) -> None:
    assert found(points(*given), "CRV009") == []


def test_columns_with_a_bad_row_or_of_a_document_are_not_exchanged() -> None:
    text = points((0, 0), (1200, 0.1), (4200, 0.5)).replace("4200, 0.5", "4200, 0.5\n 1, 2, 3\n x, y")
    assert [one.fix for one in lint_bytes(text.encode(), "deck.keyxm", select(["CRV009"]))] == [None]


def test_ratios_up_to_five() -> None:
    assert found(points((0, 0), (5, 1)), "CRV010") == []
    assert found(points((5.1, 1), (0, 0)), "CRV010") == [("CRV010", 4, 2)]
    assert found(CURVES + " CURVE=a\n", "CRV010", "CRV009") == []


def test_elements_beyond_their_curve() -> None:
    deep = PIPE.replace("-0.05", "-0.126")
    assert found(PIPE.replace("-0.05", "-0.125") + ON_CLAY, "CRV014") == []
    assert found(deep + ON_CLAY, "CRV014") == [("CRV014", 14, 2)]
    assert "10 elements lie" in messages(deep + ON_CLAY, "CRV014")[0]
    assert found(deep + ON_CLAY + "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=2\n", "CRV014") == []
    assert found(deep.replace("0.25, 0.22", "x, 0.22") + ON_CLAY, "CRV014") == []
    assert found(RESTART + ON_CLAY.join(["$MODEL\n", ""]), "CRV014") == []


# ------------------------------------------------------------------------------------------------------------- units


@pytest.mark.parametrize(
    ("suffix", "gravity", "fires"),
    [
        ("keyxm", "9.80665", False),
        ("keyxm", "10.01", True),
        ("keyxm", "32.2", True),
        ("keyxi", "32.174", False),
        ("keyxi", "9.81", True),
        ("keyx", "1.62", False),
        ("keyxm", "=[4.905*2]", False),
        ("keyxm", "=[nothing]", False),
        ("keyxm", "", False),
    ],
)
def test_gravity(suffix: str, gravity: str, fires: bool) -> None:
    text = f"$MODEL\n*OCEAN\n 500.0, 1025.0, {gravity}\n"
    assert in_units(text, suffix, "UNT001") == ([(3, 17)] if fires else [])


def test_magnitudes_by_unit_system() -> None:
    text = PIPE + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (1, 9.9))
    text += PROPERTIES + " STIFFNESS=99.0\n"
    assert in_units(text, "keyxm", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(text, "keyxi", "UNT002") == in_units(text, "keyx", "UNT002") == []
    kips = text.replace("1, 9.9", "1, 0.69").replace("=99.0", "=1.99")
    assert in_units(kips, "keyxi", "UNT002") == [(14, 2), (20, 12)]
    assert in_units(kips, "keyx", "UNT002") == []
    at_limits = text.replace("1, 9.9", "1, 0.7").replace("=99.0", "=2.0")
    assert in_units(at_limits, "keyxi", "UNT002") == []


def test_the_least_force_falls_with_the_diameter_of_a_cable() -> None:
    text = PIPE.replace("0.25, 0.22", "0.017, 0.0") + ON_CLAY.replace("4000.0", "{}")
    assert found(text.format(1.71), "UNT002") == []
    assert len(found(text.format(1.69), "UNT002")) == 1


def test_magnitudes_at_their_limits() -> None:
    text = PIPE + "*SEABED STIFFNESS\n" + curve("a", (0, 0), (1, 10)) + curve("b", (0, 0), (1, 0))
    assert found(text + PROPERTIES + " STIFFNESS=100\n SET=ALL\n STIFFNESS=0\n", "UNT002") == []
    assert found("$MODEL\n*ELASTIC SURFACE\n 50\n", "UNT002") == [("UNT002", 3, 2)]


def test_friction_of_every_keyword() -> None:
    text = "$MODEL\n*ELASTIC SURFACE\n 5E4, 2.0, 2.1\n*RIGID SURFACE\n 3, 0.5\n" + PROPERTIES + " FRICTION=, 5\n"
    text += "*SEABED FRICTION\n SET=ALL\n COEFFICIENTS=0.5, 2.5\n STIFFNESS=1E5\n"
    text += "$LOAD CASE\n*FRICTION\n 500.0, 250.0\n"
    assert [(line, column) for _, line, column in found(text, "UNT003")] == [(3, 12), (5, 2), (9, 13), (12, 20)]


# --------------------------------------------------------------------------------------------------------- stability

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


@pytest.mark.parametrize(("product", "words"), [(0.9, "11 %"), (1.9, "far too fast"), (3.0, "central difference")])
def test_what_a_coarse_step_does(product: float, words: str) -> None:
    assert words in messages(TIME.format(f", {product / (1e5 / MASS) ** 0.5}"), "STB002")[0]


def test_steps_on_curves_and_without_any_mass() -> None:
    text = PIPE + ON_CLAY + "$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10, 1\n"
    assert f"omega = {(32000 / MASS) ** 0.5:.4g} rad/s" in messages(text, "STB002")[0]
    assert found(text.replace("7850.0", "0.0"), "STB002") == []
    assert found("$LOAD CASE\n*TIME\n STEP=FIXED\n 0, 10, 1\n", "STB002") == []
