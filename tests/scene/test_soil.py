"""Sets and nodes that `*P-Y` and `*T-Z` name."""

from __future__ import annotations

import pytest

from tests.scene.decks import PIPE, all_told, messages, told

CURVE = " DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n"
POINTS = " 0.0, 0.0\n 4000.0, 0.01\n"
SETS = "*ELEMENT SETS\n SET=Pile\n 1, 2\n"
LINE = (PIPE + SETS).count("\n") + 2


@pytest.mark.parametrize("keyword", ["P-Y", "T-Z"])
def test_names_that_lead_nowhere(keyword: str) -> None:
    text = PIPE + SETS + f"*{keyword}\n SET=PILE\n{CURVE} SET=Pale\n{CURVE} NODE=99\n{POINTS} NODE=11\n{POINTS}"
    assert all_told(text) == [("E", "REF001", LINE + 4, 6), ("E", "REF006", LINE + 8, 7)]
    assert messages(text) == [
        "set 'Pale' is not defined (did you mean Pile?): define it in *ELEMENT SETS",
        "node 99 is not defined: define it in *NODE, or correct the number",
    ]


def test_lines_make_sets_and_nodes_of_their_own() -> None:
    rest = f"*P-Y\n SET=Riser\n NODE={{End}}\n{POINTS} NODE=99\n{POINTS}"
    assert told(PIPE + "*LINES\n LINE=Riser\n" + rest) == [("W", "REF006", LINE + 3, 7)]
    assert told(PIPE + rest) == [
        ("E", "REF001", LINE - 3, 6),
        ("E", "REF006", LINE - 2, 7),
        ("E", "REF006", LINE + 1, 7),
    ]


def test_what_is_not_given_is_not_told() -> None:
    assert told(f"$MODEL\n*P-Y\n SET=ALL\n{CURVE}*T-Z\n SET=ALL\n FILE=a.tz\n NODE=1\n{POINTS}") == []
    assert [code for _, code, *_ in all_told(PIPE + f"*T-Z\n SET=\n NODE=x,y\n{POINTS}")] == [
        "SYN003",
        "SYN003",
        "SYN016",
    ]
