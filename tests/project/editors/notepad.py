"""The user-defined language of Notepad++, from the words of the catalogue; `make docs` writes it."""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr

from tests.project.editors.words import words

LANGUAGE = "editors/notepad++/mudline.xml"

_NUMBERS = ("prefix1", "prefix2", "extras1", "extras2", "suffix1", "suffix2", "range")
_FOLDERS = (
    *(f"Folders in code{n}, {part}" for n in (1, 2) for part in ("open", "middle", "close")),
    *(f"Folders in comment, {part}" for part in ("open", "middle", "close")),
)
_DELIMITERS = '00" 01 02((" EOL)) 03=[ 04 05((] EOL)) 06{ 07 08((} EOL)) 09 10 11 12 13 14 15 16 17 18 19 20 21 22 23'
"""Texts in quotes, equations and labels, each up to the end of the line at most."""
_THEME = "000000"
_STYLES = {
    "DEFAULT": (_THEME, 0),
    "COMMENTS": ("2E7D32", 0),
    "LINE COMMENTS": ("2E7D32", 0),
    "NUMBERS": ("B45309", 0),
    "KEYWORDS1": ("7B1FA2", 1),
    "KEYWORDS2": ("0B57A4", 1),
    "KEYWORDS3": ("0B57A4", 0),
    "KEYWORDS4": ("00695C", 0),
    "KEYWORDS5": ("AD1457", 0),
    **{f"KEYWORDS{n}": (_THEME, 0) for n in (6, 7, 8)},
    "OPERATORS": ("616161", 0),
    **dict.fromkeys(("FOLDER IN CODE1", "FOLDER IN CODE2", "FOLDER IN COMMENT"), (_THEME, 0)),
    "DELIMITERS1": ("8D6E00", 0),
    "DELIMITERS2": ("AD1457", 0),
    "DELIMITERS3": ("8D6E00", 0),
    **{f"DELIMITERS{n}": (_THEME, 0) for n in (4, 5, 6, 7, 8)},
}
"""Colour of the letters on the theme's own ground, and 1 for bold."""
_SETTINGS = 'caseIgnored="yes" allowFoldOfComments="no" foldCompact="no" forcePureLC="1" decimalSeparator="0"'
"""A comment begins in the first column."""
_MOST = 30 * 1024
"""Characters that Notepad++ takes in a list."""


def language_text() -> str:
    """The whole file."""
    known = words()
    read = known["read"]
    settings = {key: choices for keyword in read.values() for key, choices in keyword["settings"].items()}
    choices = {word for keyword in read.values() for listed in keyword["settings"].values() for word in listed}
    lists = {
        "Comments": "00C 01 02 03 04",
        **{f"Numbers, {name}": "" for name in _NUMBERS},
        "Operators1": ", =",
        "Operators2": "",
        **dict.fromkeys(_FOLDERS, ""),
        "Keywords1": _listed(f"${name}" for name in known["sections"]),
        "Keywords2": _listed(f"*{name}" for name in read),
        "Keywords3": _listed(f"*{name}" for name in known["keywords"] if name not in read),
        "Keywords4": _listed(settings),
        "Keywords5": _listed(choices - settings.keys()),
        **{f"Keywords{n}": "" for n in (6, 7, 8)},
        "Delimiters": _DELIMITERS,
    }
    assert all(len(text) < _MOST for text in lists.values())
    prefixes = " ".join(f'Keywords{n}="no"' for n in range(1, 9))
    return "\n".join(
        (
            '<?xml version="1.0" encoding="UTF-8"?>',
            "<!-- Made from the program by `make docs`: change the program, not this file. -->",
            "<NotepadPlus>",
            '  <UserLang name="mudline deck" ext="keyx keyxm keyxi das" udlVersion="2.1">',
            "    <Settings>",
            f"      <Global {_SETTINGS}/>",
            f"      <Prefix {prefixes}/>",
            "    </Settings>",
            "    <KeywordLists>",
            *(f"      <Keywords name={quoteattr(name)}>{escape(text)}</Keywords>" for name, text in lists.items()),
            "    </KeywordLists>",
            "    <Styles>",
            *(f"      <WordsStyle {_style(name)}/>" for name in _STYLES),
            "    </Styles>",
            "  </UserLang>",
            "</NotepadPlus>",
            "",
        )
    )


def _style(name: str) -> str:
    """The attributes of a style; black letters are those of the theme."""
    colour, bold = _STYLES[name]
    own = int(colour != _THEME)
    return f'name="{name}" fgColor="{colour}" bgColor="FFFFFF" colorStyle="{own}" fontStyle="{bold}" nesting="0"'


def _listed(names: Iterable[str]) -> str:
    """Names parted by blanks, the longest first; one of several words stands in quotes, which keep it in one line."""
    ordered = sorted(set(names), key=lambda name: (-len(name.split()), name))
    return " ".join(f"'{name}'" if " " in name or "," in name else name for name in ordered)
