"""Decks as people write them: every keyword with a model, opaque ones, comments and blank lines anywhere."""

from __future__ import annotations

import json
import re

from hypothesis import reject
from hypothesis import strategies as st

from mudline.language.deck.loading import dump, load_bytes
from mudline.language.diagnostics import DeckError
from mudline.language.keywords.text import cut_number
from tests.helpers.builders.documents import document
from tests.helpers.builders.spellings import cased, comments, gaps, pads


@st.composite
def _canonical(draw: st.DrawFn) -> str:
    made = json.dumps(draw(document()))
    try:
        return dump(load_bytes(made.encode(), "a.json"), "keyword")
    except DeckError:  # a rule between two fields leaves no text for it
        reject()


canonical_texts = _canonical()
"""Whole decks without a fault, as they are written from a document."""

_KEY = re.compile(r"( *[$*]? *[A-Z][A-Z ,]*)(=.*|)")
"""A head of a section or a keyword, or a setting."""


@st.composite
def respelt(draw: st.DrawFn, line: str) -> str:
    """A line with other blanks, a key in upper and lower case."""
    if line[:1] in ("C", "c"):
        return line
    found = _KEY.fullmatch(line)
    if found and (found[2] or found[1].strip()[0] in "$*"):
        return draw(cased(found[1])) + found[2].replace("=", draw(pads) + "=" + draw(pads), 1) + draw(pads)
    return line.replace(", ", draw(pads) + "," + draw(pads) + " ") + draw(pads)


@st.composite
def deck_texts(draw: st.DrawFn) -> str:
    """A whole deck without a fault, with comments and blank lines put in, and with line ends of any kind."""
    lines = []
    for line in draw(canonical_texts).split("\n")[:-1]:
        lines += draw(st.lists(comments | gaps, max_size=1)) if draw(st.integers(0, 3)) == 0 else []
        lines.append(draw(respelt(line)))
    if lines and lines[-1] == "*":  # a file that was cut off
        lines.append(" x")
    ends = draw(st.sampled_from([["\n"], ["\r\n"], ["\r"], ["\n", "\r\n", "\r"]]))
    text = "".join(line + ends[index % len(ends)] for index, line in enumerate(lines))
    last = lines[-1].strip() if lines else ""
    # Without its line end a head or a number at the end would be a file that was cut off.
    whole = last.startswith(("*", "$")) or cut_number(last.rpartition("=")[2])
    return text if draw(st.booleans()) or whole else text.removesuffix("\n").removesuffix("\r")


@st.composite
def mutated(draw: st.DrawFn, originals: st.SearchStrategy[bytes]) -> bytes:
    """Bytes changed, cut out and put in at a few places."""
    data = bytearray(draw(originals))
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(data)))
        match draw(st.sampled_from(["flip", "cut", "insert", "end"])):
            case "flip" if at < len(data):
                data[at] ^= 1 << draw(st.integers(0, 7))
            case "cut":
                del data[at : at + draw(st.integers(1, 20))]
            case "insert":
                data[at:at] = draw(st.one_of(st.sampled_from(SHARDS), st.binary(max_size=4)))
            case _:
                del data[at:]
    return bytes(data)


SHARDS = [
    *(b"$", b"*", b"=[", b"]", b"{", b"}", b'"', b"/", b",", b"=", b"\r", b"\n", b"\r\n", b"C", b"C ", b"SET="),
    *(b"GEN=1,", b"nan", b"1e400", b"1,5", b"\n$MODEL\n*NODE\n", b"\n*EMBEDMENT\n", b"\nCURVE=x\n", b"\nCabc\n"),
    *(b"\xef\xbb\xbf", b"\x00"),
]
"""Pieces that mean something in a deck."""
