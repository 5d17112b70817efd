"""What a rule is: a function that finds, with a docstring that becomes its page; and what it sees of a deck."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, wraps
from itertools import chain, islice
from operator import is_
from textwrap import dedent
from typing import Any, NamedTuple, TypeVar

from mudline.deck.model import Deck
from mudline.deck.reading import TextOrigin
from mudline.diagnostics import MORE, Blocks, Code, Problem, Where
from mudline.keywords.catalogue import holds_in_soil
from mudline.limits import MOST_REPORTED
from mudline.scene.context import placed_blocks
from mudline.scene.model import Scene, resolve
from mudline.variations.names import (
    may_vary,
    misspelt_keywords,
    misspelt_sections,
    undefined_parameters,
    undefined_variations,
)

T = TypeVar("T")


@dataclass(eq=False)
class LintContext:
    """A deck as it is written (equations and all) and its scene (evaluated and resolved, as far as that goes).

    `dialect` is the deck language that the deck must keep to: "mudline", or "flexcom" without extension keywords.
    `fixing` says that repairs are made: those that another deck beside this one forbids must not be among them.
    """

    deck: Deck
    dialect: str = "mudline"
    fixing: bool = False
    _made: dict[object, Any] = field(default_factory=dict, repr=False)

    @property
    def text(self) -> TextOrigin | None:
        """Tree, source and places of a deck that was read from text; None for one in JSON or YAML."""
        return self.deck.origin if isinstance(self.deck.origin, TextOrigin) else None

    @cached_property
    def scene(self) -> Scene:
        """The scene of the deck."""
        return resolve(self.deck)

    def blocks(self, keyword: str, section: str = "MODEL") -> Sequence[tuple[Where, Any]]:
        """What `Deck.blocks` gives for the deck of the scene, whose equations are evaluated."""
        return self.scene.context.blocks(keyword, section)

    def written(self, keyword: str, section: str = "MODEL") -> Sequence[tuple[Where, Any]]:
        """What `Deck.blocks` gives for the deck itself, with its equations."""
        return self._written.get((section, keyword), ())

    @cached_property
    def _written(self) -> dict[tuple[str, str], list[tuple[Where, Any]]]:
        evaluated, own = self.scene.deck.sections, self.deck.sections
        if len(evaluated) == len(own) and all(
            all(map(is_, a.blocks, b.blocks)) for a, b in zip(evaluated, own, strict=True)
        ):
            return self.scene.context.placed  # no equation, and no deck that it continues
        return placed_blocks(self.deck)

    @cached_property
    def keywords(self) -> set[str]:
        """Names of the keywords in the models of the deck of the scene, those that are not read among them."""
        return self.scene.deck.keywords()

    @cached_property
    def in_soil(self) -> bool:
        """Whether the model has soil springs."""
        return any(map(holds_in_soil, self.keywords))

    @cached_property
    def noticed(self) -> dict[str, list[Problem]]:
        """What reading and resolving the deck, and the checks of its scene, report, by code."""
        found: dict[str, list[Problem]] = {}
        for problem in chain(self.scene.findings, _of_variations(self.deck)):
            found.setdefault(problem.code.code, []).append(problem)
        return found

    def once(self, make: Callable[[LintContext], T]) -> T:
        """What a function makes of this deck, made once for all rules that ask."""
        try:
            found: T = self._made[make]
        except KeyError:
            found = self._made[make] = make(self)
        return found

    def problems_of(self, code: Code) -> Sequence[Problem]:
        """What reading and resolving the deck, and the checks of its scene, report under a code."""
        return self.noticed.get(code.code, ())


def entries_of_sets(blocks: Iterable[tuple[Where, Any]]) -> Iterator[tuple[Where, Any]]:
    """Every entry below a SET= of some blocks, with its place."""
    for where, block in blocks:
        for index, entry in enumerate(block.sets):
            yield where.inside("sets", index), entry


def _of_variations(deck: Deck) -> Iterator[Problem]:
    """Undefined names in variations: they are faults of the varied decks, and not of this one."""
    if not may_vary(deck):
        return
    for find in (undefined_parameters, undefined_variations, misspelt_keywords, misspelt_sections):
        for problem in islice(find(deck), MOST_REPORTED):
            yield replace(problem, blocks=Blocks.NEVER)


# --------------------------------------------------------------------------------------------- what a rule is

Check = Callable[[LintContext], Iterable[Problem]]

_HEADINGS = r"(?m)^(Example|Finds|File|Bytes|Cut|Dialect):[ \t]*(.*)$"
RULES: dict[str, Rule] = {}
"""The rules that are registered, by code, in the order of their registration."""


class RulePage(NamedTuple):
    """What the docstring of a rule says.

    `title` is the first sentence, `why` the text after it, `bad` a deck that the rule finds something in at `place`
    (line and column), `good` the deck corrected; `file` is the name that the examples are read under. `encoding` is
    that of the bad deck's bytes, `dialect` the one under which it is at fault.
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
        """The bad deck as a file."""
        return self.bad.encode(self.encoding)

    @property
    def good_bytes(self) -> bytes:
        """The good deck as a file."""
        return self.good.encode()

    @property
    def remark(self) -> str:
        """What the text of the bad deck does not show about its file, or ""."""
        if self.dialect != "mudline":
            return f"with --dialect {self.dialect}"
        if self.encoding != "utf-8":
            return f"saved as {self.encoding.upper()}"
        return "" if self.bad.endswith("\n") else "the file ends without a line end"


class Rule(NamedTuple):
    """A rule: its code, the function that finds, and the docstring that becomes its page.

    A rule that is `off` runs only where it is selected. The findings of a rule whose check is not `Noticed` never keep
    a deck from being evaluated, whatever their severity.
    """

    code: Code
    check: Check
    docstring: str
    off: bool = False

    @property
    def page(self) -> RulePage:
        """What the docstring says; raises ValueError for one that lacks a part."""
        return described_by(self.code, self.docstring)


@dataclass(frozen=True, slots=True)
class Noticed:
    """What reading and resolving a deck, or a check of its scene, reports under a code."""

    code: Code

    def __call__(self, context: LintContext) -> Iterable[Problem]:
        """The problems of the code."""
        return context.problems_of(self.code)


def rule(code: Code, *, off: bool = False) -> Callable[[Check], Check]:
    """Register a function as the rule of a code that only advises; `off` keeps it from running unless it is selected.

    Its docstring begins with the title, a sentence on a line of its own; the text after it says why. Below `Example:`
    are a bad and a good deck in one, indented by four spaces: a line after a space is in both, one after `-` in the bad
    deck only, one after `+` in the good deck only. `Finds: line:column` is the place of the only finding in the bad
    deck. `File: name` (default deck.keyxm) is the name of both decks. `Bytes: encoding` saves the bad deck in another
    encoding than UTF-8; `Cut: yes` leaves out its last line end; `Dialect: name` reads both decks in a dialect.

    Raises ValueError for a code or slug that another rule has. A docstring that lacks a part, a line of the example
    that has no mark, and two decks that are the same are faults of a plugin, found when it is loaded.
    """

    def register(check: Check) -> Check:
        add(Rule(code, check, check.__doc__ or "", off))
        return check

    return register


def limited(check: Check) -> Check:
    """Give the first findings of a rule, as many as are reported one by one."""

    @wraps(check)
    def first(context: LintContext) -> Iterator[Problem]:
        return islice(check(context), MOST_REPORTED)

    return first


def add(declared: Rule) -> None:
    """Register a rule; raises ValueError for a code or slug that another rule has."""
    code = declared.code
    if code.code in RULES or any(code.slug == known.code.slug for known in RULES.values()):
        raise ValueError(f"there is already a rule {code.code} or {code.slug}")
    RULES[code.code] = declared


@cache
def described_by(code: Code, docstring: str) -> RulePage:
    """Return what a docstring says of a rule (see `rule`); raises ValueError for a docstring that lacks a part."""
    first, _, rest = docstring.partition("\n")
    parts = re.split(_HEADINGS, f"{first.strip()}\n{dedent(rest)}")
    title, _, why = parts[0].strip().partition("\n")
    found = {name: (line, body) for name, line, body in zip(parts[1::3], parts[2::3], parts[3::3], strict=True)}
    lacking = [name for name in ("Example", "Finds") if name not in found]
    if lacking or not title or not why.strip():
        raise ValueError(f"the docstring of {code.code} must have {' and '.join(lacking) or 'a title and a reason'}")
    words = {name: line.strip() for name, (line, _) in found.items()}
    place = re.fullmatch(r"([0-9]+):([0-9]+)", words["Finds"])
    if place is None:
        raise ValueError(f"Finds: {words['Finds']} of {code.code} must be line:column of the bad deck")
    bad, good = _decks(code, found["Example"][1].replace(r"\t", "\t"))  # Python 3.13 makes blanks of TABs in docstrings
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
    if described.bad_bytes == described.good_bytes:
        raise ValueError(f"the decks of the example of {code.code} must differ in a line with - or +")
    return described


def _decks(code: Code, example: str) -> tuple[str, str]:
    """The bad and the good deck of an example; an empty line is in both."""
    bad: list[str] = []
    good: list[str] = []
    for line in example.strip("\n").split("\n"):
        marked = re.fullmatch(r"    ([ +-])(.*)", line or "     ")
        if marked is None:
            raise ValueError(
                f"the line {line!r} of the example of {code.code} must have four spaces, then a space, - or +"
            )
        mark, text = marked.groups()
        if mark != "+":
            bad.append(f"{text}\n")
        if mark != "-":
            good.append(f"{text}\n")
    return "".join(bad), "".join(good)


def first_reported(problems: Iterable[Problem]) -> Iterator[Problem]:
    """As many findings as are reported one by one; the next one says that there are more."""
    found = iter(problems)
    yield from islice(found, MOST_REPORTED)
    for further in islice(found, 1):
        yield replace(further, message=MORE, repair=None)
