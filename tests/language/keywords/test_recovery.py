"""Blocks whose lines do not fit: what is read of them, which line is reported, and what was missing."""

from __future__ import annotations

import pytest

from mudline.language.diagnostics import Span
from mudline.language.syntax.grammars import Content, Node, by_lines

Reported = tuple[int | None, str, str]
"""The line that does not fit, None for the end of the block; what was expected in its place; and what is missing."""


def shown(node: Node | Content) -> str:
    """A tree with the lines by their numbers."""
    if isinstance(node, Content):
        return str(node.span.start)
    return f"{node.data}({' '.join(map(shown, node.children))})"


def read(rule: str, lines: str, *, insert: bool = True) -> tuple[str, list[Reported]]:
    contents = [Content(terminal, Span(at, at + 1)) for at, terminal in enumerate(lines.split())]
    tree, mismatches = by_lines(rule, contents, insert=insert)
    return shown(tree), [
        (one.found.span.start if one.found else None, " ".join(one.expected), one.missing) for one in mismatches
    ]


GEOMETRIC = "geometric_sets"  # K_OPTION? K_SET ROW K_COMPRESSION_CHECK?, repeated


@pytest.mark.parametrize(
    ("rule", "lines", "tree", "reported"),
    [
        (GEOMETRIC, "K_SET ROW K_SET ROW", "geometric_sets(geometric_set(0 1) geometric_set(2 3))", []),
        # a line that was left out is put in before the one that does not fit
        (GEOMETRIC, "ROW", "geometric_sets(geometric_set(0))", [(0, "$END K_OPTION K_SET", "K_SET")]),
        (GEOMETRIC, "K_SET K_SET ROW", "geometric_sets(geometric_set(0) geometric_set(1 2))", [(1, "ROW", "ROW")]),
        ("seabed_profile", "K_SLOPE", "seabed_profile(0)", [(0, "K_TYPE", "K_TYPE")]),
        (
            "seabed_unloading",
            "K_STIFFNESS K_SET K_SET K_STIFFNESS",
            "seabed_unloading(unloading_set(0) unloading_set(1) unloading_set(2 3))",
            [(0, "$END K_SET", "K_SET"), (2, "K_STIFFNESS", "K_STIFFNESS")],
        ),
        # else it is left out itself
        (GEOMETRIC, "K_XYZ K_SET ROW", "geometric_sets(geometric_set(1 2))", [(0, "$END K_OPTION K_SET", "")]),
        ("ocean", "ROW ROW", "ocean(0)", [(1, "$END", "")]),
        ("embedment", "K_SET ROW K_GEN ROW", "embedment(embedment_curve(0 1 3))", [(2, "$END K_SET ROW", "")]),
        # what the end lacks: the first of it is reported, in the place of the end
        (GEOMETRIC, "K_SET", "geometric_sets(geometric_set(0))", [(None, "ROW", "ROW")]),
        (GEOMETRIC, "K_OPTION", "geometric_sets(geometric_set(0))", [(None, "K_SET", "K_SET")]),
        ("ocean", "", "ocean()", [(None, "ROW", "ROW")]),
        ("seabed_profile", "", "seabed_profile()", [(None, "K_TYPE", "K_TYPE")]),
        # of several the one that ends the block, else one that is not there yet
        ("time", "", "time()", [(None, "K_STEP ROW", "ROW")]),
        ("criteria", "", "criteria()", [(None, "K_CRITERION K_OPTION K_VARIABLE", "K_OPTION")]),
        (
            "excel_variations",
            "",
            "excel_variations()",
            [(None, "K_DIRECTORY K_EXCEL K_FILENAME K_SUBDIRECTORY", "K_EXCEL")],
        ),
        ("para_force", "", "para_force()", [(None, "K_DATA1 K_PLOT K_SCALE K_TITLE K_UNITS", "K_DATA1")]),
        ("drift", "K_VESSEL", "drift(vessel_drift(0))", [(None, "K_FILE ROW", "K_FILE")]),
        (
            "seabed_unloading",
            "K_SET K_SET",
            "seabed_unloading(unloading_set(0) unloading_set(1))",
            [(1, "K_STIFFNESS", "K_STIFFNESS"), (None, "K_STIFFNESS", "K_STIFFNESS")],
        ),
    ],
)
def test_lines_that_do_not_fit(rule: str, lines: str, tree: str, reported: list[Reported]) -> None:
    assert read(rule, lines) == (tree, reported)


def test_where_lines_may_be_of_unknown_form_none_is_put_in() -> None:
    """But at the end, where there is none that it could be."""
    assert read(GEOMETRIC, "K_SET K_SET ROW", insert=False) == ("geometric_sets(geometric_set(0 2))", [(1, "ROW", "")])
    assert read(GEOMETRIC, "K_SET", insert=False) == ("geometric_sets(geometric_set(0))", [(None, "ROW", "ROW")])
