"""What is written as JSON and YAML means the same to other readers; decks in other encodings mean the same to ours."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from pydantic_core import from_json

import mudline
from mudline.language.deck.loading import load_bytes, load_path
from tests.api.test_pickles import DECKS
from tests.cli.runner import SAMPLES, Json, no_constant, run
from tests.helpers.builders.decks import CLEAN

TRICKY = [
    *(
        "on",
        "off",
        "yes",
        "No",
        "y",
        "true",
        "NULL",
        "~",
        "nan",
        ".nan",
        ".inf",
        "-.Inf",
        "=",
        "<<",
        "-",
        "?",
        "|",
        ">",
    ),
    *(
        "1e5",
        "1E5",
        "1.e5",
        "+1",
        "1_000",
        "0x1F",
        "0o17",
        "017",
        "0b11",
        "1:30",
        "190:20:30.15",
        "2026-11-24",
        ".5",
        "5.",
    ),
    *(
        "2026-11-24 12:00:00",
        "- a",
        "a: b",
        "a #b",
        "!t",
        "&a",
        "*a",
        "%a",
        "@a",
        "`a",
        "'",
        "[a]",
        "Ø 12",
        "a\u0085b",
        "\u2028",
    ),
    *("\ud83d\ude00".encode("utf-16", "surrogatepass").decode("utf-16"), "a'b", "\\n", "///"),
]
"""Names that YAML 1.1, YAML 1.2 or both take for something else where they are not quoted."""
NAMED = CLEAN.replace("CURVE=Clay", "CURVE={name}").replace("*SEABED STIFFNESS", "C {name}\n*SEABED STIFFNESS")


def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object whose keys are there once."""
    found = dict(pairs)
    assert len(found) == len(pairs)
    return found


def read_by_all(text: str) -> Json:
    """JSON as two readers have it, which take nothing that JSON does not have."""
    found = json.loads(text, object_pairs_hook=once, parse_constant=no_constant)
    assert from_json(text.encode(), allow_inf_nan=False) == found
    return found


def read_yaml(text: str) -> Json:
    """YAML as PyYAML takes it, by the rules of YAML 1.1; long tables are texts with a row a line."""
    return with_rows(yaml.safe_load(text))


def with_rows(value: Json) -> Json:
    if isinstance(value, dict):
        return {key: with_rows(one) for key, one in value.items()}
    if isinstance(value, list):
        return [with_rows(one) for one in value]
    rows = value.splitlines() if isinstance(value, str) and value.endswith("\n") else []
    return [json.loads(f"[{row}]") for row in rows] or value


@pytest.mark.parametrize("path", [path for path in DECKS if path.stem not in {"broken", "scr-vessel-bad"}], ids=str)
def test_decks_as_other_readers_have_them(path: Path) -> None:
    deck = mudline.read(path)
    assert read_yaml(deck.to_yaml()) == read_by_all(deck.to_json())


@pytest.mark.parametrize("name", TRICKY)
def test_names_that_yaml_takes_for_something_else(name: str) -> None:
    deck = mudline.from_keyword(NAMED.format(name=name))
    found = read_by_all(deck.to_json())
    assert read_yaml(deck.to_yaml()) == found
    assert mudline.from_yaml(deck.to_yaml()).sections == deck.sections == mudline.from_json(deck.to_json()).sections


@pytest.mark.covered
@pytest.mark.parametrize(
    "words",
    [
        ("lint", "--output-format", "json"),
        ("lint", "--output-format", "sarif"),
        ("lint", "--output-format", "gitlab"),
        ("evaluate", "--output-format", "json"),
        ("validate", "--output-format", "json"),
        ("curves", "--output-format", "json"),
        ("study", "--output-format", "json"),
    ],
    ids=" ".join,
)
def test_results_as_other_readers_have_them(words: tuple[str, ...]) -> None:
    command, *options = words
    read_by_all(run(command, str(SAMPLES / "scr-touchdown.keyxm"), *options).out)


# ----------------------------------------------------------------------------------------------------------- encodings

BOM = b"\xef\xbb\xbf"
REWRITTEN = {
    "bom": lambda data: BOM + data,
    "crlf": lambda data: data.replace(b"\n", b"\r\n"),
    "cr": lambda data: data.replace(b"\n", b"\r"),
    "bom and crlf": lambda data: BOM + data.replace(b"\n", b"\r\n"),
}


@pytest.mark.parametrize("path", DECKS, ids=lambda path: path.name)
@pytest.mark.parametrize("form", REWRITTEN)
def test_a_deck_in_another_encoding_has_the_same_findings_and_values(path: Path, form: str) -> None:
    data = path.read_bytes()
    assert data.isascii()
    deck = load_path(path)
    twin = load_bytes(REWRITTEN[form](data), str(path), folder=path.parent)
    assert twin == deck
    assert twin.diagnose(twin.problems) == deck.diagnose(deck.problems)
