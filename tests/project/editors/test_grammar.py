"""The TextMate grammar: fresh, of valid patterns, and, where node is there, cutting decks as mudline does."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import pytest

from tests.cli.runner import ROOT
from tests.project.editors.decks import HOSTILE, SAMPLES
from tests.project.editors.extension import needs_node, node
from tests.project.editors.own_tokens import Classes, first_difference, own_classes
from tests.project.editors.textmate import GRAMMAR, class_of, grammar, grammar_text


def test_the_grammar_is_fresh() -> None:
    assert (ROOT / GRAMMAR).read_text(encoding="utf-8") == grammar_text(), "run make docs"


def test_every_included_rule_is_there() -> None:
    text = json.dumps(grammar())
    assert set(re.findall(r'"include": "#([^"]+)"', text)) == set(grammar()["repository"])


@cache
def _lines(folder: Path) -> dict[str, list[list[tuple[int, int, list[str]]]]]:
    """What the grammar makes of all decks, in one run of node, by the name of the deck."""
    files = {path.name: path for path in SAMPLES}
    for number, text in enumerate(HOSTILE):
        files[str(number)] = folder / str(number)
        files[str(number)].write_text(text, encoding="utf-8", newline="")
    return dict(zip(files, json.loads(node("node", "test/tokens.js", *files.values())), strict=True))


def _classes(text: str, lines: list[list[tuple[int, int, list[str]]]]) -> Classes:
    """The class of each character; node counts in UTF-16."""
    found: Classes = []
    for line, tokens in zip(text.splitlines(keepends=True), lines, strict=False):
        by_unit: Classes = [""] * (len(line.encode("utf-16-le")) // 2 + 1)
        for start, end, scopes in tokens:
            by_unit[start:end] = [class_of(scopes)] * (end - start)
        at = 0
        for char in line:
            found.append(by_unit[at])
            at += 2 if ord(char) > 0xFFFF else 1
    return found


@needs_node
@pytest.mark.parametrize("name", [*(path.name for path in SAMPLES), *map(str, range(len(HOSTILE)))])
def test_decks_are_cut_as_mudline_cuts_them(name: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    lines = _lines(tmp_path_factory.getbasetemp())
    texts = {path.name: path.read_text(encoding="utf-8") for path in SAMPLES} | {
        str(number): text for number, text in enumerate(HOSTILE)
    }
    text = texts[name]
    assert first_difference(text, own_classes(text), _classes(text, lines[name])) == ""
