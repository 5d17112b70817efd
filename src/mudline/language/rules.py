"""Rules of the checks: code, function, and the docstring that becomes the rule's page; registry of all rules."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache
from itertools import islice
from pathlib import Path
from textwrap import dedent
from typing import Any, NamedTuple, TypeVar

from mudline.basics.limits import MOST_REPORTED
from mudline.language.diagnostics import MORE, Code, Problem

Check = Callable[[Any], Iterable[Problem]]
F = TypeVar("F", bound=Check)

_HEADINGS = r"(?m)^(Example(?: on .+)?|Finds|File|Bytes|Cut|Dialect):[ \t]*(.*)$"
_MARKS = " -+"
_MARKED = re.compile(r"    ([ +|-])(.*)")
_BASES = Path(__file__).parent / "codes" / "examples"
"""Folder of the decks that examples stand on."""
RULES: dict[str, Rule] = {}
"""Registered rules by code, in the order of their registration."""


class RulePage(NamedTuple):
    """Parts of a rule's docstring.

    Attributes:
        title: first sentence.
        why: text after the title.
        bad: deck with the fault.
        good: the same deck, corrected.
        place: line and column of the finding in the bad deck.
        file: file name of both decks.
        encoding: encoding of the bad deck's bytes.
        dialect: dialect under which the bad deck has the fault.
    """

    title: str
    why: str
    bad: str
    good: str
    place: tuple[int, int]
    file: str
    encoding: str
    dialect: str

    @property
    def bad_bytes(self) -> bytes:
        """Bytes of the bad deck's file."""
        return self.bad.encode(self.encoding)


class Rule(NamedTuple):
    """Rule: code, function that checks, and the docstring that becomes its page.

    Attributes:
        code: code and slug.
        check: function that takes the `ResolvedDeck` if the rule `blocks`, else the `LintContext`; None if reading or
            resolving a deck reports the findings.
        docstring: text of the page, in the form that `rule` describes.
        off: True if the rule runs only where it is selected.
        blocks: True if the findings can keep a deck from being evaluated.
    """

    code: Code
    check: Check | None
    docstring: str
    off: bool = False
    blocks: bool = False

    @property
    def page(self) -> RulePage:
        """Page described by the docstring; raises ValueError if the docstring lacks a part."""
        return described_by(self.code, self.docstring)

    def findings(self, subject: object) -> list[Problem]:
        """Return the findings in a subject; a very long list ends early (see `first_reported`)."""
        return first_reported(self.check(subject) if self.check else ())


def rule(code: Code, *, off: bool = False, blocks: bool = False) -> Callable[[F], F]:
    """Register a function as the rule of a code; `off` keeps the rule from running unless it is selected.

    A rule that `blocks` needs only the resolved deck, and stands in `mudline.model.scene.rules`. Each of its findings
    tells whether it keeps the deck from being evaluated. Findings of other rules never do, whatever their severity.

    The docstring begins with the title: one sentence on a line of its own. The text after the title gives the reason.
    The other parts:

    * `Example:` has a bad and a good deck in one text, indented by four spaces. A line after a space is in both decks,
      a line after `-` only in the bad deck, a line after `+` only in the good deck.
    * `Example on clay:` changes the deck clay.keyxm of `mudline/language/codes/examples`. It has only the lines around
      each change, and an empty line between two changes. The lines after a space, with or without those after `+`,
      must be consecutive lines of that deck, and occur once. A line after `|` is added to both decks.
    * `Finds: line:column` is the place of the only finding in the bad deck.
    * `File: name` is the name of both decks; default deck.keyxm.
    * `Bytes: encoding` saves the bad deck in another encoding than UTF-8.
    * `Cut: yes` leaves out the last line end of the bad deck.
    * `Dialect: name` reads both decks in a dialect.

    Raises ValueError if another rule has the code or slug. Faults of the docstring are reported when the plugin is
    loaded: a missing part, a line without a mark or without a place in the base deck, two equal decks.
    """

    def register(check: F) -> F:
        add(Rule(code, check, check.__doc__ or "", off, blocks))
        return check

    return register


def add(declared: Rule) -> None:
    """Register a rule; raises ValueError for a code or slug that another rule has."""
    code = declared.code
    if code.code in RULES or any(code.slug == known.code.slug for known in RULES.values()):
        raise ValueError(f"there is already a rule {code.code} or {code.slug}")
    RULES[code.code] = declared


@cache
def described_by(code: Code, docstring: str) -> RulePage:
    """Return the parts of a rule's docstring (see `rule`).

    Raises ValueError if a part is missing, or if the example does not give two different decks.
    """
    first, _, rest = docstring.partition("\n")
    parts = re.split(_HEADINGS, f"{first.strip()}\n{dedent(rest)}")
    title, _, why = parts[0].strip().partition("\n")
    sections = {name: (line, body) for name, line, body in zip(parts[1::3], parts[2::3], parts[3::3], strict=True)}
    heading = next((name for name in sections if name.startswith("Example")), "Example")
    lacking = [name for name in (heading, "Finds") if name not in sections]
    if lacking or not title or not why.strip():
        raise ValueError(f"the docstring of {code.code} must have {' and '.join(lacking) or 'a title and a reason'}")
    words = {name: line.strip() for name, (line, _) in sections.items()}
    place = re.fullmatch(r"([0-9]+):([0-9]+)", words["Finds"])
    if place is None:
        raise ValueError(f"Finds: {words['Finds']} of {code.code} must be line:column of the bad deck")
    example = sections[heading][1].strip("\n").replace(r"\t", "\t")  # Python 3.13 expands TABs in docstrings
    base = heading.partition(" on ")[2]
    rows = _rows_on(base, code, example) if base else _rows(code, example, _MARKS)
    bad, good = ("".join(f"{text}\n" for mark, text in rows if mark != left_out) for left_out in "+-")
    described = RulePage(
        title=title.strip(),
        why=why.strip(),
        bad=bad.removesuffix("\n") if "Cut" in words else bad,
        good=good,
        place=(int(place[1]), int(place[2])),
        file=words.get("File", "deck.keyxm"),
        encoding=words.get("Bytes", "utf-8"),
        dialect=words.get("Dialect", "mudline"),
    )
    if described.bad_bytes == good.encode():
        raise ValueError(f"the decks of the example of {code.code} must differ in a line with - or +")
    return described


def _rows(code: Code, example: str, marks: str) -> list[tuple[str, str]]:
    """Return mark and text of each line of an example; an empty line is in both decks."""
    rows: list[tuple[str, str]] = []
    for line in example.split("\n"):
        marked = _MARKED.fullmatch(line or "     ")
        if marked is None or marked[1] not in marks:
            expected = "a space, - or +" if marks == _MARKS else "a space, |, - or +"
            raise ValueError(f"the line {line!r} of the example of {code.code} must have four spaces, then {expected}")
        rows.append((marked[1], marked[2]))
    return rows


def _rows_on(base: str, code: Code, example: str) -> list[tuple[str, str]]:
    """Return mark and text of each line of a base deck with the changes of an example."""
    bases = {file.stem: file for file in sorted(_BASES.glob("*.keyxm"))}
    if base not in bases:
        raise ValueError(f"the example of {code.code} must be on {', '.join(bases)}, and is on {base}")
    rest = bases[base].read_text(encoding="utf-8").splitlines()
    rows: list[tuple[str, str]] = []
    for change in example.split("\n\n"):
        changed = _rows(code, change, f"{_MARKS}|")
        with_good = [text for mark, text in changed if mark in " +"]
        without = [text for mark, text in changed if mark == " "]
        places = _places(rest, with_good) or _places(rest, without)
        if len(places) != 1:
            lines = ", ".join(repr(mark + text) for mark, text in changed)
            raise ValueError(
                f"of the lines {lines} of the example of {code.code}, those after a space, with or without those "
                f"after +, must stand once in the rest of {base}"
            )
        rows += [*((" ", text) for text in rest[: places[0].start]), *changed]
        rest = rest[places[0].stop :]
    return [*rows, *((" ", text) for text in rest)]


def _places(lines: list[str], sought: list[str]) -> list[slice]:
    """Return the slices of a deck that equal the sought lines; none if no line is sought."""
    count = len(sought)
    places = [slice(at, at + count) for at in range(len(lines)) if count]
    return [place for place in places if lines[place] == sought]


def findings(rules: Iterable[Rule], subject: object) -> list[list[Problem]]:
    """Return the findings of each rule in a subject."""
    return [rule.findings(subject) for rule in rules]


def first_reported(problems: Iterable[Problem]) -> list[Problem]:
    """Return the findings that are reported individually; the last one tells that there are more."""
    first = list(islice(problems, MOST_REPORTED + 1))
    if len(first) > MOST_REPORTED:
        first[-1] = replace(first[-1], message=MORE, repair=None)
    return first
