"""Broken JSON and YAML documents: refused with the line and the path of what is wrong, never a traceback."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Diagnostic
from tests.helpers.builders.keyword_texts import deck_texts, mutated
from tests.helpers.processes import TIMEOUT
from tests.helpers.schema import validator

TEXT = """\
C title
$MODEL
*OCEAN
 500.0, 1025.0
*NODE
 1, 0.0, 0.0
C far
 2, 0.0, =[L]
 GEN=1, 2
*ELEMENT
 1, 1, {End}
*ELEMENT SETS
 SET=a
 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=a
 1.0, 2.0, 0.5, 0.4, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=a
 STIFFNESS=clay
*SEABED STIFFNESS
 CURVE=clay
 0.0, 0.0
 1.0, 10.0
*TITLE
 opaque
"""
JSON = dump(load_bytes(TEXT.encode(), "a.keyxm"), "json")
Path = tuple[str | int, ...]
BLOCKS: Path = ("sections", 0, "blocks")


def refusal(text: str, name: str) -> tuple[Diagnostic, ...]:
    with pytest.raises(DeckError) as caught:
        load_bytes(text.encode(), name)
    assert caught.value.diagnostics
    return caught.value.diagnostics


def read_or_refuse(data: bytes, name: str) -> Deck | None:
    """The deck, or None where it is refused as it should be: with a DeckError."""
    try:
        return load_bytes(data, name)
    except DeckError:
        return None


def document() -> dict[str, Any]:
    made: dict[str, Any] = json.loads(JSON)
    return made


def changed(path: Path, value: object) -> dict[str, Any]:
    """The document with another value at a path; a value of None takes the key out."""
    made = document()
    place: Any = made
    for part in path[:-1]:
        place = place[part]
    if value is GONE:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return made


GONE = object()

BREAKS: list[tuple[Path, object, str]] = [
    (("surprise",), 1, "surprise"),
    (("format",), "mudline-deck/9", "mudline-deck/1"),
    (("format",), GONE, "mudline-deck/1"),
    (("units",), "metres", "units"),
    (("units",), ["metric"], "units"),
    (("source",), 5, "source"),
    (("preamble",), "C title", "preamble"),
    (("comments",), [{"before": -1, "text": ""}], "comments[0].before"),
    (("comments",), [{"before": 0}], "comments[0].text"),
    (("sections",), GONE, "sections"),
    (("sections", 0), [], "sections[0]"),
    (("sections", 0, "name"), GONE, "sections[0].name"),
    (("sections", 0, "name"), 3, "sections[0].name"),
    (("sections", 0, "blocks"), None, "sections[0].blocks"),
    ((*BLOCKS, 0), 5, "sections[0].blocks[0]"),
    ((*BLOCKS, 0, "keyword"), GONE, "sections[0].blocks[0]"),
    ((*BLOCKS, 0, "keyword"), ["OCEAN"], "sections[0].blocks[0]"),
    ((*BLOCKS, 0, "depht"), 1.0, "sections[0].blocks[0].depht"),
    ((*BLOCKS, 0, "depth"), GONE, "sections[0].blocks[0].depth"),
    ((*BLOCKS, 0, "depth"), "deep", "sections[0].blocks[0].depth"),
    ((*BLOCKS, 0, "depth"), True, "sections[0].blocks[0].depth"),
    ((*BLOCKS, 1, "entries", 0, "nodes"), [[1.5, 2.0, 3.0]], "sections[0].blocks[1].entries[0].nodes"),
    ((*BLOCKS, 1, "entries", 0, "nodes"), [[1, None, 0.0]], "sections[0].blocks[1].entries[0].nodes"),
    ((*BLOCKS, 1, "entries", 0, "nodes"), [[1, 2.0, 3.0, 4.0, 5.0]], "sections[0].blocks[1].entries[0].nodes"),
    ((*BLOCKS, 1, "entries", 1, "generate"), [1], "sections[0].blocks[1].entries[1].generate"),
    ((*BLOCKS, 1, "entries", 1, "generate"), [1, 2.5], "sections[0].blocks[1].entries[1].generate"),
    ((*BLOCKS, 2, "entries", 0, "elements"), [[1, 1, "End"]], "sections[0].blocks[2].entries[0].elements"),
    ((*BLOCKS, 3, "sets", 0, "members", 0, "elements"), [2**53 + 2], "sections[0].blocks[3].sets[0].members[0]"),
    ((*BLOCKS, 3, "sets", 0, "name"), "a\r", "sections[0].blocks[3].sets[0].name"),
    ((*BLOCKS, 4, "sets", 0, "option"), "BOX", "sections[0].blocks[4].sets[0].option"),
    ((*BLOCKS, 4, "sets", 0, "rigid", "Do"), "wide", "sections[0].blocks[4].sets[0].rigid.Do"),
    ((*BLOCKS, 5, "type"), "SOFT", "sections[0].blocks[5].type"),
    ((*BLOCKS, 6, "curves", 0, "points"), [[0.0], [1.0, 2.0]], "sections[0].blocks[6].curves[0].points"),
    ((*BLOCKS, 7, "lines"), GONE, "sections[0].blocks[7]"),
    ((*BLOCKS, 7, "lines"), " opaque", "sections[0].blocks[7].lines"),
    ((*BLOCKS, 7, "lines"), ["a\nb"], "sections[0].blocks[7].lines[0]"),
]


@pytest.mark.parametrize(("path", "value", "named"), BREAKS)
def test_a_broken_document_is_refused_by_the_reader_and_by_the_schema(path: Path, value: object, named: str) -> None:
    broken = changed(path, value)
    assert not validator().is_valid(broken)
    for text, name in ((json.dumps(broken, indent=1), "a.json"), (yaml.safe_dump(broken, sort_keys=False), "a.yaml")):
        found = refusal(text, name)
        assert any(named in one.message for one in found), [str(one) for one in found]
        assert all(one.code in ("DOC001", "DOC002") and one.file == name for one in found)
        if value is not GONE and path != ("format",):
            assert all(one.line > 1 for one in found)


@pytest.mark.parametrize("text", ["[]", "5", '"text"', "null", "true", "{}", '{"format": null}'])
def test_other_documents(text: str) -> None:
    assert not validator().is_valid(json.loads(text))
    for name in ("a.json", "a.yaml"):
        (found,) = refusal(text, name)
        assert "mudline-deck/1" in found.message


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e400", "-1e999"])
def test_json_numbers_are_finite(number: str) -> None:
    assert '"depth": 500.0' in JSON
    refusal(JSON.replace('"depth": 500.0', f'"depth": {number}'), "a.json")
    refusal(JSON.replace("[0.0, 0.0]", f"[0.0, {number}]"), "a.json")


@pytest.mark.parametrize("number", [".nan", ".inf", "-.INF", "1e400", ".NaN"])
def test_yaml_numbers_are_finite(number: str) -> None:
    text = dump(load_bytes(TEXT.encode(), "a.keyxm"), "yaml")
    before = text[: text.index("500.0")]
    found = refusal(text.replace("depth: 500.0", f"depth: {number}"), "a.yaml")
    assert {(one.line, one.column) for one in found} == {(before.count("\n") + 1, len(before) - before.rindex("\n"))}


@pytest.mark.parametrize(
    ("text", "line", "word"),
    [
        *(("{", 1, "JSON"), ("", 1, "JSON"), ('{\n "format": "mudline-deck/1",\n}', 0, "JSON")),
        *(("{'a': 1}", 1, "JSON"), ('{"format": 1, "format": 2}', 1, "twice")),
        *(('{\n"a": [{"b": 1,\n"b": 2}]}', 0, "twice"), ("{} {}", 1, "JSON"), ('{"a": "\x01"}', 1, "JSON")),
        *(('{"a": 01}', 1, "JSON"), ("[" * 100_000, 1, "deep"), ('{"a":' * 100_000, 1, "deep")),
    ],
)
def test_broken_json(text: str, line: int, word: str) -> None:
    (found, *_) = refusal(text, "a.json")
    assert word in found.message
    assert found.line == line or not line


@pytest.mark.parametrize(
    ("text", "line", "word"),
    [
        *(("a: [", 1, "YAML"), ("a: 1\na: 2\n", 2, "twice"), ("a: 1\nb:\n  c: 1\n  'c': 2\n", 4, "twice")),
        *(("a: &x 1\nb: *x\n", 2, "alias"), ("a: 1\n b: 2\n", 2, "YAML"), ("a: !!python/name:os 1\n", 1, "tag")),
        *(("1: 2\n", 1, "key"), ("[a]: 2\n", 1, "key"), ("a: 1\n--- \nb: 2\n", 2, "YAML"), ("a: \x01\n", 1, "YAML")),
        *(("[" * 100_000, 1, "deep"), ("- " * 50_000 + "a", 1, "deep"), ("a: *x\n", 1, "alias")),
        ("a: {b: 1, b: 2}", 1, "twice"),
    ],
)
def test_broken_yaml(text: str, line: int, word: str) -> None:
    (found, *_) = refusal(text, "a.yaml")
    assert word in found.message
    assert found.line == line


def test_a_document_that_would_fill_the_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.language.deck.loading.LARGEST_FILE", 10)
    (found,) = refusal('{"format": "mudline-deck/1"}', "a.json")
    assert (found.code, "more than 10 bytes" in found.message) == ("DOC001", True)


@pytest.mark.alike
@pytest.mark.parametrize("level", ["- ", "? ", "[", "{a: ", "- ["])
def test_deep_yaml_does_not_crash_the_process(level: str) -> None:
    code = (
        "from mudline.language.deck.loading import load_bytes\nfrom mudline.language.diagnostics import DeckError\n"
        f"try:\n    load_bytes({level!r}.encode() * 100_000, 'a.yaml')\nexcept DeckError:\n    print('refused')\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=TIMEOUT, check=False)
    assert (run.returncode, run.stdout) == (0, "refused\n")


@given(mutated(deck_texts().map(lambda t: dump(load_bytes(t.encode(), "a.keyxm"), "json").encode())), st.booleans())
def test_mutated_json_is_read_or_refused(data: bytes, as_yaml: bool) -> None:
    deck = read_or_refuse(data, "a.yaml" if as_yaml else "a.json")
    if deck is not None:
        validator().validate(json.loads(dump(deck, "json")))
