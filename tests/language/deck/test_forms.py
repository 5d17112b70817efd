"""A deck through JSON, YAML and keyword text and back: equal models, numbers to the last bit, every comment."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import assume, given

from mudline.language.deck.forms import form_of
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Severity
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.model import Block
from tests.helpers.builders.keyword_texts import deck_texts, mutated
from tests.helpers.builders.scenes import deck_of
from tests.helpers.samples import FAULTY, SAMPLES
from tests.helpers.schema import validator

NAME = "deck.keyxm"
DECKS = sorted(path for path in SAMPLES.glob("*.keyx*") if path.name not in FAULTY)


def same(one: Deck, other: Deck) -> None:
    """Hold all that a file says of two decks against each other."""
    assert one.sections == other.sections
    assert one.comments == other.comments
    assert one.preamble == other.preamble


def has_refused_values(deck: Deck) -> bool:
    blocks = (block for section in deck.sections for block in section.blocks)
    return any(isinstance(block, Block) and is_refused(block) for block in blocks)


def held(deck: Deck) -> None:
    """Every way between the forms gives the same deck and the same text, and the schema takes what is written.

    A deck with a value that its model refuses is a deck as keyword text only.
    """
    if has_refused_values(deck):
        for form in ("json", "yaml"):
            with pytest.raises(DeckError, match="DOC002"):
                dump(deck, form)
        same(deck, deck_of(dump(deck, "keyword")))
        return
    as_json = dump(deck, "json")
    validator().validate(json.loads(as_json))
    from_json = deck_of(as_json, "deck.json")
    same(deck, from_json)
    assert (from_json.source, from_json.units) == (deck.source, deck.units)
    assert dump(from_json, "json") == as_json
    as_yaml = dump(from_json, "yaml")
    from_yaml = deck_of(as_yaml, "deck.yaml")
    same(deck, from_yaml)
    assert dump(from_yaml, "json") == as_json
    assert dump(from_yaml, "yaml") == as_yaml
    as_keyword = dump(deck, "keyword")
    again = deck_of(as_keyword)
    same(deck, again)
    assert dump(again, "keyword") == as_keyword
    assert dump(from_yaml, "keyword") == as_keyword


def remarks(text: str) -> list[str]:
    """What follows the C of each comment line, in order."""
    return [line[1:] for line in re.split(r"\r\n|\r|\n", text) if line[:1] in ("C", "c") and "=" not in line[:12]]


@pytest.mark.covered
@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
def test_samples(path: Path) -> None:
    deck = load_bytes(path.read_bytes(), path.name)
    assert deck.require() is deck
    held(deck)
    text = path.read_text(encoding="utf-8")
    assert remarks(dump(deck, "keyword")) == remarks(text)


@given(mutated(deck_texts().map(str.encode)))
def test_what_reads_without_an_error_is_the_same_in_every_form(data: bytes) -> None:
    deck = load_bytes(data, NAME)
    assume(all(problem.weight is not Severity.ERROR for problem in deck.problems))
    held(deck)


def test_equations_and_opaque_lines_stay_as_written() -> None:
    lines = [
        *(" =[ a +  B*( c ) ], 1025.0", "*PROPERTIES", "\t 1 ,2;x  ", "", "C-- kept", '  {"no": [json', "-: yaml #")
    ]
    text = "$MODEL\n*OCEAN\n" + "\n".join(lines) + "\n"
    deck = deck_of(text)
    held(deck)
    assert dump(deck, "keyword") == text
    assert json.loads(dump(deck, "json"))["sections"][0]["blocks"] == [
        {"keyword": "OCEAN", "depth": "=[ a +  B*( c ) ]", "density": 1025.0},
        {"keyword": "PROPERTIES", "lines": lines[2:]},
    ]


@pytest.mark.parametrize(
    ("name", "form"),
    [
        ("a.json", "json"),
        ("a.JSON", "json"),
        ("a.yaml", "yaml"),
        ("a.YML", "yaml"),
        ("a.keyx", "keyword"),
        ("json", "keyword"),
    ],
)
def test_form_of(name: str, form: str) -> None:
    assert form_of(name) == form


def test_a_form_and_units_can_be_given() -> None:
    text = dump(deck_of("$MODEL\n*OCEAN\n 1.0\n"), "json")
    deck = load_bytes(text.encode(), "<stdin>", form="json", units="imperial")
    assert deck.units == "imperial"
    assert load_bytes(b"\xef\xbb\xbf" + text.encode(), "a.yaml", form="json").units == "metric"


def test_a_form_is_one_module(tmp_path: Path) -> None:
    """A module in the folder of forms is read and written by suffix, and an option of `convert`."""
    (tmp_path / "upper.py").write_text(
        "from mudline.language.deck.forms import keyword\n"
        "from mudline.language.deck.reading import read_source\n"
        "from mudline.language.syntax.source import Source\n"
        "def write(deck):\n    return keyword.write(deck).upper()\n"
        "def read(data, file):\n    return read_source(Source.from_bytes(data, file))\n",
        encoding="utf-8",
    )
    (tmp_path / "a.keyxm").write_text("$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\nC deep\n", encoding="utf-8")
    program = (
        "import sys; from mudline.language.deck import forms; forms.__path__.append('.')\n"
        "from mudline.cli.main import run\n"
        "first = run(['convert', 'a.keyxm', '-o', 'b.upper'])\n"
        "sys.exit(first or run(['convert', 'b.upper', '--to', 'upper']))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "mudline: a.keyxm -> b.upper\n")
    assert done.stdout == "$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\nC DEEP\n"


@pytest.mark.parametrize("letter", ["\x85", "\u2028", "\u2029"])
def test_other_line_ends_of_unicode_are_letters_in_yaml(letter: str) -> None:
    text = f"C one{letter}two\n$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n"
    written = dump(load_bytes(text.encode(), "deck.keyxm"), "yaml")
    assert letter not in written
    assert load_bytes(written.encode(), "deck.yaml").preamble == [f"C one{letter}two"]
    plain = written.replace({"\x85": "\\N", "\u2028": "\\L", "\u2029": "\\P"}[letter], letter)
    with pytest.raises(DeckError) as caught:
        load_bytes(plain.replace("depth: 100.0", "depth: [1]").encode(), "deck.yaml").require()
    assert caught.value.diagnostics[0].line == 1 + plain[: plain.index("depth")].count("\n")
