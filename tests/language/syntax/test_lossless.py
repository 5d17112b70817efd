"""The leaves of the tree laid end to end are the text, and the source gives back the bytes that were read."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from lark import Lark

from mudline.basics.resources import grammar_file
from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.fixing import fix_bytes
from mudline.checks.registry import select
from mudline.editing.formatting.document import formatted
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import Severity
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import matchable, parse
from tests.helpers.builders.keyword_texts import deck_texts, mutated
from tests.helpers.samples import SAMPLES

FILES = sorted(path for path in SAMPLES.iterdir() if path.is_file())
BOM = b"\xef\xbb\xbf"
LEXER = Lark(matchable(grammar_file("deck.lark").read_text(encoding="utf-8")), parser=None, lexer="basic")


def read_back(data: bytes) -> Source:
    """The source of some bytes, after a comparison of its leaves and bytes with them, and of its leaves with lark's."""
    source = Source.from_bytes(data, "deck.keyxm")
    leaves = list(parse(source).leaves())
    if source.readable:
        tokens = LEXER.lex(source.unified)
        assert [(leaf.kind.value, leaf.span.start) for leaf in leaves] == [(one.type, one.start_pos) for one in tokens]
    at = 0
    for leaf in leaves:
        assert leaf.span.start == at
        assert leaf.span.end > at
        at = leaf.span.end
    assert at == len(source.text)
    assert source.to_bytes() == data
    return source


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"], ids=["LF", "CRLF", "CR"])
@pytest.mark.parametrize("mark", [b"", BOM], ids=["plain", "BOM"])
def test_samples(path: Path, end: bytes, mark: bytes) -> None:
    data = path.read_bytes()
    source = read_back(mark + data.replace(b"\n", end))
    assert source.text.encode() == data.replace(b"\n", end)
    assert not source.problems
    assert source.bom == bool(mark)
    read_back(mark + data.replace(b"\n", end).rstrip())


_sample_bytes = st.sampled_from([path.read_bytes()[:6000] for path in FILES])


@given(mutated(st.one_of(deck_texts().map(str.encode), _sample_bytes)))
def test_mutated_decks(data: bytes) -> None:
    read_back(data)


@given(st.binary(max_size=300))
@example(b"\r")
@example(b"\r\r\n\n")
@example(b" \r \n\t\r")
@example(b"\xef\xbb")
@example(BOM + BOM)
@example(b"C\r")
@example(b"C \r\n*\r$\r1\r\r2")
@example("\xe9t\xe9 \u20ac".encode("cp1252", "ignore"))
@example(b"\x81\xe9")
def test_random_bytes(data: bytes) -> None:
    read_back(data)


@given(st.text(st.sampled_from('$*C c=1-,.\t\r\nx[]{}"/\x85\u2028\u0660\x0b\x0c'), max_size=60))
def test_random_lines(text: str) -> None:
    source = read_back(text.encode())
    assert source.text == text or not source.readable


@pytest.mark.parametrize("text", ["", "\n", "C", "C\n", "C only\nC comments\n", "C one\r\n\r\nc two", "  \t"])
def test_nothing_to_read(text: str) -> None:
    read_back(text.encode())
    deck = load_bytes(text.encode(), "deck.keyxm")
    assert deck.sections == []
    assert deck.problems == []


@pytest.mark.parametrize(
    ("encoding", "word", "named", "byte"),
    [("cp1252", "Tiefe \u20ac", "CP1252", "0x80"), ("latin-1", "\xe9t\xe9 \x81", "Latin-1", "0xE9")],
)
def test_other_encodings_are_read_with_a_warning(encoding: str, word: str, named: str, byte: str) -> None:
    data = f"$MODEL\n*OCEAN\n 1.0\nR {word}\n".encode(encoding)
    source = read_back(data)
    assert word in source.text
    assert source.encoding == encoding
    deck = load_bytes(data, "deck.keyxm")
    found = [problem for problem in deck.diagnose(deck.problems) if named in problem.message]
    assert [(problem.code, problem.severity) for problem in found] == [("SYN012", Severity.WARNING)]
    assert byte in found[0].message
    assert (found[0].line, found[0].column) == (4, 3 + word.encode(encoding).index(int(byte, 16)))
    assert len(deck.sections) == 1
    comment = load_bytes(data.replace(b"R ", b"C "), "deck.keyxm")
    assert [one.severity for one in comment.diagnose(comment.problems) if named in one.message] == [Severity.INFO]


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_utf16_is_refused(encoding: str) -> None:
    data = "$MODEL\n*OCEAN\n 100.0, 1025.0, 9.81\n".encode(encoding)
    source = read_back(data)
    assert not source.readable
    deck = load_bytes(data, "deck.keyxm")
    (found,) = deck.diagnose(deck.problems)
    assert (found.code, found.severity, found.line, found.column) == ("SYN012", Severity.ERROR, 1, 1)
    assert "UTF-16" in found.message
    assert deck.sections == []


def test_binary_data_is_refused() -> None:
    data = bytes(range(32)) * 40 + b"$MODEL\n*OCEAN\n 1.0\n"
    assert not read_back(data).readable
    deck = load_bytes(data, "deck.keyxm")
    (found,) = deck.diagnose(deck.problems)
    assert (found.code, found.severity) == ("SYN012", Severity.ERROR)
    assert "binary" in found.message


def test_control_characters_are_told_once_at_the_first() -> None:
    deck = load_bytes(b"$MODEL\r\n*OCEAN\r\n 1.0\r\nC \x07 and \x1b\r\n\x1a", "deck.keyxm")
    found = [problem for problem in deck.diagnose(deck.problems) if problem.code == "SYN012"]
    assert [(problem.severity, problem.line, problem.column) for problem in found] == [(Severity.WARNING, 4, 3)]
    assert "U+0007 (and 2 more" in found[0].message


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_control_characters_before_a_head_are_read_over(end: str) -> None:
    plain = f"$MODEL{end}*OCEAN{end} 1.0{end} *NODE{end} 1, 0.0, 0.0{end}"
    strange = plain.replace("$", "\x0c$").replace("*O", " \x0c\x00 *O").replace(" *N", "\x1a*N")
    deck, again = (load_bytes(text.encode(), "deck.keyxm") for text in (plain, strange))
    assert again.sections == deck.sections
    assert again.preamble == []
    assert [problem.code.code for problem in again.problems] == ["SYN012"]
    assert read_back(strange.encode()).text == strange
    laid = formatted(strange.encode(), "deck.keyxm").decode()
    assert laid == plain.replace("$", "\x0c$").replace("*O", "\x0c\x00*O").replace(" *N", "\x1a*N")
    fixed = fix_bytes(strange.encode(), "deck.keyxm", LintSettings(select(["STY005"]), fixing=Fixing.SAFE)).changed
    assert fixed == plain.replace(" *N", "*N").encode()
