"""Misspelt names in JSON and YAML: told with the name that was meant, and the rest of the deck is checked."""

from __future__ import annotations

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.diagnostics import DeckError

DECK = b"""\
$MODEL
*OCEAN
 50.0, 1025.0, 9.81
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 900.0
 0.5, 4200.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=Clay
 FRICTION=0.3, 0.6
"""


def found(old: str, new: str, form: str) -> list[tuple[str, str]]:
    text = dump(load_bytes(DECK, "deck.keyxm"), form)
    assert old in text
    data = text.replace(old, new, 1).encode()
    return [(one.code, one.message) for one in lint_bytes(data, f"deck.{form}", rules())]


@pytest.mark.parametrize("form", ["json", "yaml"])
@pytest.mark.parametrize(
    ("old", "new", "meant"),
    [
        ("stiffness", "stifness", "stiffness"),
        ("ELASTIC", "ELASTC", "ELASTIC"),
        ("SEABED PROPERTIES", "SEABED PROPERTEIS", "SEABED PROPERTIES"),
        ("longitudinal", "longitudnal", "longitudinal"),
    ],
)
def test_one_near_name_is_told_and_the_rest_is_checked(old: str, new: str, meant: str, form: str) -> None:
    (code, message), *others = found(old, new, form)
    assert code == "DOC002"
    assert message.endswith(f"(did you mean {meant}?)")
    assert [one for one, _ in others] == ["CRV007"]


def test_a_name_that_is_like_no_other_is_told_alone() -> None:
    assert [code for code, _ in found("stiffness", "whatever", "json")] == ["DOC002"]


def test_the_deck_is_refused_all_the_same() -> None:
    text = dump(load_bytes(DECK, "deck.keyxm"), "json").replace("stiffness", "stifness", 1)
    with pytest.raises(DeckError, match="did you mean stiffness"):
        load_bytes(text.encode(), "deck.json")
