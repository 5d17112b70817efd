"""Generated documents with one thing changed: reader and schema agree, and a refusal names the path and the line."""

from __future__ import annotations

import json
from typing import Any

import yaml
from hypothesis import given
from hypothesis import strategies as st

from mudline.language.deck.forms.yaml import CoreDumper
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.language.keywords.faults import DocumentPath, path_text
from tests.helpers.builders.documents import KEYWORDS, Values, alone, block
from tests.helpers.schema import validator
from tests.language.deck.test_round_trips import values

blocks = st.sampled_from(KEYWORDS).flatmap(lambda keyword: block(keyword).map(lambda made: alone(keyword, made)))

BEYOND_THE_SCHEMA = (
    *("has no model", "takes no", "needs", "opens a section or a block", "too large for double precision"),
    *("fields, expected", "field, expected", "lines are given: expected", "is no "),
)
"""What the schema does not say: values that must fit one another, where a keyword belongs, what rows in a text hold."""


def paths(value: object, path: DocumentPath = ()) -> list[DocumentPath]:
    """Every place in a document."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [*([path] if path else []), *(found for key, item in inner for found in paths(item, (*path, key)))]


def at(made: Values, path: DocumentPath) -> Any:  # noqa: ANN401 - anything that JSON holds
    """The value at a path."""
    value: Any = made
    for part in path:
        value = value[part]
    return value


def change(made: Values, path: DocumentPath, value: object, *, how: str) -> None:
    """Put a value at a path, or an unknown key beside it, or take it out."""
    place = at(made, path[:-1])
    match how:
        case "replace":
            place[path[-1]] = value
        case "remove":
            del place[path[-1]]
        case _ if isinstance(place, dict):
            place["unheard of"] = value
        case _:
            place.append(value)


odd = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**70), 2**70),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=4),
    st.sampled_from(
        ["=[x]", "=[x]\n", "{l}", "{l}\n", "ALL", "ALL\n", [], {}, [[]], [{}], [1, 2], 10**309, 2**53 + 1, 1.0]
    ),
)


@st.composite
def mutants(draw: st.DrawFn) -> tuple[Values, DocumentPath]:
    """A document with one place changed."""
    made = json.loads(json.dumps(draw(blocks)))  # no list twice, which would be an alias in YAML
    path = draw(st.sampled_from(paths(made)))
    change(made, path, draw(odd), how=draw(st.sampled_from(["replace", "replace", "replace", "remove", "add"])))
    return made, path


def as_yaml_text(made: Values) -> str:
    """The document as YAML 1.2 text, in which 1e5 is a number."""
    return yaml.dump(made, Dumper=CoreDumper)


def read(text: str, form: str) -> Deck | tuple[Diagnostic, ...]:
    try:
        return load_bytes(text.encode(), "a", form=form)
    except DeckError as error:
        return error.diagnostics


@given(mutants())
def test_schema_and_reader_agree(mutant: tuple[Values, DocumentPath]) -> None:
    made, _ = mutant
    allowed = validator().is_valid(made)
    as_json = read(json.dumps(made), "json")
    as_yaml = read(as_yaml_text(made), "yaml")
    if isinstance(as_json, Deck):
        assert allowed
        assert isinstance(as_yaml, Deck)
        assert values(as_yaml) == values(as_json)
    else:
        assert not isinstance(as_yaml, Deck)
        messages = [one.message for one in as_json]
        assert [one.message for one in as_yaml] == messages or len(messages) > 1
        assert not allowed or any(words in message for words in BEYOND_THE_SCHEMA for message in messages), messages


@given(mutants())
def test_a_refusal_names_the_place(mutant: tuple[Values, DocumentPath]) -> None:
    made, path = mutant
    for text, form in ((json.dumps(made, indent=1), "json"), (as_yaml_text(made), "yaml")):
        found = read(text, form)
        if isinstance(found, Deck):
            continue
        assert {one.code for one in found} == {"DOC002"}
        named = [one.message.partition(":")[0] for one in found]
        around = {path_text(path[:length]) for length in range(len(path))}
        inside = path_text(path[:-1]) if path[:-1] else ""
        assert any(name in around or name.startswith(inside) for name in named), named
        assert all(1 <= one.line <= text.count("\n") + 1 for one in found)


@given(blocks, st.data())
def test_what_keyword_text_cannot_say_is_refused(made: Values, data: st.DataObject) -> None:
    """Any text in the place of another one is kept to the letter, or the deck is not written."""
    texts = [path for path in paths(made) if path[0] == "sections" and isinstance(at(made, path), str)]
    word = data.draw(st.text(' ,=[]{}"/$*C-x1\u00e9', max_size=6))
    change(made, data.draw(st.sampled_from(texts)), word, how="replace")
    deck = read(json.dumps(made), "json")
    if not isinstance(deck, Deck):
        return
    try:
        text = dump(deck, "keyword")
    except DeckError as error:
        (found,) = error.diagnostics
        assert found.code == "DOC002"
        assert "cannot be written as keyword text" in found.message
        return
    again = load_bytes(text.encode(), "a.keyxm")
    assert values(again) == values(deck)
    assert dump(again, "keyword") == text
