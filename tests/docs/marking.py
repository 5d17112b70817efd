"""Text of the program as Markdown."""

from __future__ import annotations

import re

MADE = "<!-- Made from the program by `make docs`: change the program, not this page. -->"

_KEYWORD = r"[*$][A-Z][A-Z-]*(?:[ ,][A-Z][A-Z-]*)*"
_SETTING = r"(?<![A-Z=])[A-Z]{2}[A-Z_]*(?: [A-Z]+)*=(?:\[\.\.\.\]|[A-Z][A-Z0-9]*(?:-[A-Z]+)*\b)?"
_LIST = r"/[^/|]*:[^/|]*/"
_LANGUAGE = re.compile(f"{_KEYWORD}|{_SETTING}|{_LIST}")


def marked(text: str) -> str:
    """Words of the deck language as code, where they are not yet: an asterisk would begin emphasis."""
    pieces = text.split("`")
    pieces[::2] = [_LANGUAGE.sub(r"`\g<0>`", piece) for piece in pieces[::2]]
    return "`".join(pieces)


def anchor(heading: str) -> str:
    """The anchor of a heading: lower case, blanks to hyphens, punctuation dropped."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")
