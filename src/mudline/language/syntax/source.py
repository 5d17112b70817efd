"""Text of one file: decoding, line ends, and encoding to the same bytes."""

from __future__ import annotations

import re
from array import array
from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from operator import methodcaller

from mudline.basics.limits import LARGEST_DECK, LONGEST_LINE, MOST_LINES, MOST_WORDED
from mudline.basics.short_repr import short_repr
from mudline.language.codes.lines import SYN012, SYN018
from mudline.language.diagnostics import Problem, Severity, Span

_BOM = b"\xef\xbb\xbf"
CONTROLS = "".join(map(chr, (*range(9), 11, 12, *range(14, 32), 127, 0xFEFF)))
"""Invisible characters other than blanks; they are ignored before a `*` or `$`."""
_CONTROL = re.compile(f"[{re.escape(CONTROLS)}]")
_NO_CONTROLS = bytes(byte for byte in range(256) if chr(byte) not in CONTROLS)
_BEFORE_HEAD = re.compile(rf"[ \t{re.escape(CONTROLS)}]++(?=[*$])")
END_MARK = "\x1a"
"""End-of-file mark that old systems write behind the last character (Ctrl-Z)."""
_END = f"{END_MARK} \t\r\n"
_CALLED = {
    "\0": "NUL character",
    END_MARK: "end-of-file mark (Ctrl-Z)",
    "\ufeff": "byte-order mark inside the file",
}
_LONE_CR = re.compile(r"\r(?!\n)")
_FOREIGN_DATA = re.compile(r"(?:\A|(?<=[\r\n]))(?!C(?:[^A-Za-z]|\Z))[^\r\n]*[^\x00-\x7f]")
"""Non-ASCII letter in a line that is not a comment."""
BINARY = "the file looks like binary data"
"""Beginning of the message that refuses such a file."""
_BINARY_SHARE = 0.1
_SAMPLE = 65536
_FEW = 8


@dataclass(frozen=True)
class Source:
    """Text of a file without byte-order mark; `to_bytes` returns the bytes that were read.

    `readable` is False if the content is not the text of a deck, but UTF-16, binary data, a web page or two versions
    with merge marks: such content is kept, but not parsed.
    `clean` is True if the text has none of the control characters that are ignored; False does not mean that it has.
    """

    name: str
    text: str
    encoding: str = "utf-8"
    bom: bool = False
    readable: bool = True
    problems: tuple[Problem, ...] = field(default=(), compare=False)
    clean: bool = field(default=False, compare=False)

    __repr__ = short_repr

    @classmethod
    def from_bytes(cls, data: bytes, name: str) -> Source:
        """Return the source, decoded as UTF-8, else as CP1252 or Latin-1; UTF-16 and binary data are refused."""
        bom = data.startswith(_BOM)
        body = data[len(_BOM) :] if bom else data
        refusal = _refusal(body)
        if refusal:
            problem = Problem(SYN012, refusal, Span(0, 0), Severity.ERROR)
            return cls(name, body.decode("latin-1"), "latin-1", bom, readable=False, problems=(problem,))
        text, encoding, problems = _decode(body)
        if foreign := _not_a_deck(text):
            return cls(name, text, encoding, bom, readable=False, problems=(foreign,))
        clean = not body.translate(None, _NO_CONTROLS) and (body.isascii() or _BOM not in body)
        controls = [] if clean else _control_characters(text)
        return cls(name, text, encoding, bom, problems=(*problems, *controls), clean=clean)

    def to_bytes(self, text: str | None = None) -> bytes:
        """Return the bytes of `text` (default: the text as read) in the file's encoding, with byte-order mark, if any.

        Raises UnicodeEncodeError if a changed text has a character that the encoding lacks.
        """
        body = (self.text if text is None else text).encode(self.encoding)
        return _BOM + body if self.bom else body

    @cached_property
    def unified(self) -> str:
        """Copy of equal length in which each lone CR is a LF, so that every line ends with LF.

        Control characters before a `*` or `$` at the beginning of a line, and end-of-file marks, become blanks.
        """
        text = _LONE_CR.sub("\n", self.text) if "\r" in self.text else self.text
        return text if self.clean else _ended(_heads_found(text))

    @cached_property
    def line_starts(self) -> array[int]:
        """Offset of the first character of every line; CR, CRLF and LF each end one."""
        starts = array("q", [0])
        starts.extend(map(methodcaller("end"), re.finditer("\n", self.unified)))
        return starts

    def position(self, offset: int) -> tuple[int, int]:
        """Return line and column of an offset, both from 1, in code points."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def offset(self, line: int, column: int) -> int:
        """Return the offset of a line and column, both from 1."""
        return self.line_starts[line - 1] + column - 1

    def line_span(self, number: int) -> Span:
        """Return the span of a line (from 1) without its end; an empty one at the end of the text beyond it."""
        starts, text = self.line_starts, self.text
        start, end = (starts[at] if at < len(starts) else len(text) for at in (number - 1, number))
        while end > start and text[end - 1] in "\r\n":
            end -= 1
        return Span(start, end)

    def line_around(self, offset: int) -> Span:
        """Return the span of the line around an offset without its end."""
        return self.line_span(self.position(offset)[0])

    def line(self, number: int) -> str:
        """Return the text of a line (from 1) without its end."""
        return self.text[slice(*self.line_span(number))]

    def lines(self) -> list[str]:
        """Return all lines with their ends."""
        return [self.text[start:end] for start, end in pairwise([*self.line_starts, len(self.text)])]


def _ended(text: str) -> str:
    """Return a text with blanks in place of the end-of-file marks behind its last character."""
    body = text.rstrip(_END)
    return body + text[len(body) :].replace(END_MARK, " ") if END_MARK in text[len(body) :] else text


def _heads_found(text: str) -> str:
    """Return a text of LF lines with blanks in place of the control characters before a `*` or `$`."""
    pieces: list[str] = []
    done = at = 0
    while control := _CONTROL.search(text, at):
        start = max(text.rfind("\n", at, control.start()) + 1, at)
        if match := _BEFORE_HEAD.match(text, start):
            pieces += (text[done:start], " " * (match.end() - start))
            done = match.end()
        at = text.find("\n", control.end()) + 1 or len(text)
    return "".join((*pieces, text[done:])) if pieces else text


_MERGE_MARK = re.compile(r"(?:\A|(?<=[\r\n]))(?:<{7}|>{7}|\|{7})(?=[ \r\n]|\Z)")
KEY_FILE = re.compile(r"\s*<\?xml[^>]*>\s*<KeyFile\b")
"""Beginning of a key file of a password manager, which has a suffix of decks."""
_NO_DECK = re.compile(
    rf"(?P<key>{KEY_FILE.pattern})|\s*(?:(?P<lfs>version https://git-lfs\.)|(?P<page><(?:!DOCTYPE|html)\b)"
    r"|(?P<xml><\?xml\b))",
    re.IGNORECASE,
)
"""Beginnings of files that are often mistaken for decks."""
_INSTEAD = {
    "lfs": "this is a pointer of Git LFS, not a deck: fetch the deck with git lfs pull",
    "key": "this is a key file of a password manager, not a deck",
    "page": "this is a web page, not a deck: fetch the file again, where you are logged in",
    "xml": "this is an XML file, not a deck: choose the keyword file",
}


def _not_a_deck(text: str) -> Problem | None:
    """Return the problem of a text that is not a deck; None if it may be a deck."""
    if match := _NO_DECK.match(text):
        return Problem(SYN018, _INSTEAD[str(match.lastgroup)], Span(*match.span()))
    marks = any(mark in text for mark in ("<<<<<<<", ">>>>>>>", "|||||||"))  # the pattern is slow in a large file
    if marks and (match := _MERGE_MARK.search(text)):
        message = "a merge conflict is not solved: keep one of its versions, and remove its marks"
        return Problem(SYN018, message, Span(*match.span()))
    return None


_OF_NUMBERS = b"+-.,0123456789eEdD \t"
_STRANGE = bytes({*range(9), 11, *range(14, 26), *range(27, 32), 127})
"""Control characters that are rare in any text."""


def _refusal(body: bytes) -> str:
    """Return the reason why bytes are not read at all, or ""."""
    if body.startswith((b"\xff\xfe", b"\xfe\xff")) or _looks_like_utf16(body[:_SAMPLE]):
        return "the file is UTF-16, which no deck reader takes: save it as UTF-8"
    sample = body[:_SAMPLE].replace(b"\r\n", b"\n")
    strange = len(sample) - len(sample.translate(None, _STRANGE))
    if strange > max(_BINARY_SHARE * len(sample), _FEW):
        share = f"{strange} control characters in its first {len(sample)} bytes"
        return f"{BINARY} ({share}): choose the keyword file, or save it as text"
    return _excess(body) if len(body) > MOST_WORDED else ""


def _excess(body: bytes) -> str:
    """Return the message for an exceeded limit: memory grows with the lines, most with lines of words."""
    if len(body) > LARGEST_DECK:
        return _divide(f"{LARGEST_DECK} bytes")
    words = body.translate(None, _OF_NUMBERS)  # counting all lines would take twice the time
    lines = words.count(b"\n") + words.count(b"\r")
    if lines > MOST_LINES:
        return _divide(f"{MOST_LINES} lines")
    if lines > MOST_WORDED and len(words.split()) > MOST_WORDED:
        return _divide(f"{MOST_WORDED} lines of keywords, settings and other words")
    starts = range(0, len(body) - LONGEST_LINE + 1, LONGEST_LINE)
    ends = (body.find(b"\n", at, at + LONGEST_LINE) + body.find(b"\r", at, at + LONGEST_LINE) for at in starts)
    return _divide(f"{LONGEST_LINE} bytes on one line") if -2 in ends else ""


def _divide(limit: str) -> str:
    return f"more than {limit}: is this a deck? If so, divide it, as by *RESTART"


def _looks_like_utf16(sample: bytes) -> bool:
    if 0 not in sample:
        return False
    even, odd = sample[0::2].count(0), sample[1::2].count(0)
    half = len(sample) // 2
    return half > _FEW and max(even, odd) > 0.4 * half and min(even, odd) <= 0.05 * half


def _decode(body: bytes) -> tuple[str, str, list[Problem]]:
    try:
        return body.decode("utf-8"), "utf-8", []
    except UnicodeDecodeError as error:
        start = error.start
    try:
        text, encoding, shown = body.decode("cp1252"), "cp1252", "CP1252"
    except UnicodeDecodeError:
        text, encoding, shown = body.decode("latin-1"), "latin-1", "Latin-1"
    message = f"byte 0x{body[start]:02X} is not UTF-8; the file is read as {shown}: save it as UTF-8"
    severity = None if _FOREIGN_DATA.search(text) else Severity.INFO
    if severity is None:
        message += ", or give --encoding; a name that is not defined may be one read wrongly"
    return text, encoding, [Problem(SYN012, message, Span(start, start + 1), severity)]


def _control_characters(text: str) -> list[Problem]:
    """Return one problem for all control characters, at the first one; none for a text without them."""
    first = _CONTROL.search(text)
    if first is None:
        return []
    count = sum(1 for _ in _CONTROL.finditer(text))
    more = f" (and {count - 1} more control characters)" if count > 1 else ""
    what = _CALLED.get(first.group(), "control character")
    message = f"{what} U+{ord(first.group()):04X}{more}: remove it"
    return [Problem(SYN012, message, Span(*first.span()))]
