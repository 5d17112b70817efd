"""What a rule is, and the list of all rules: the checks of reading and resolving, and rules that only advise."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from importlib import import_module

from mudline import codes
from mudline.diagnostics import Code, Problem
from mudline.linting import plugins
from mudline.linting.context import LintContext
from mudline.scene.checks.running import all_checks

Check = Callable[[LintContext], Iterable[Problem]]

MODULES = (
    "references",
    "geometry",
    "sections",
    "curves",
    "seabed",
    "extensions",
    "units",
    "stability",
    "legacy",
    "style",
    "style_suppression",
)
"""The modules of `mudline.linting.rules`."""

_HEADINGS = re.compile(r"^(Bad|Good|Finds|File|Bytes|Cut|Dialect):[ \t]*(.*)$", re.MULTILINE)
_RULES: dict[str, Rule] = {}


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: its code, the function that finds, and what its page says.

    `title` is the first sentence, `why` the text behind it, `bad` a deck that it finds something in at `place` (line
    and column), `good` the same deck mended; `file` is the name that the examples are read under. `encoding` is that of
    the bad deck's bytes, `dialect` the one under which it is at fault. A rule that is `off` runs only where it is
    selected.
    """

    code: Code
    check: Check
    title: str
    why: str
    bad: str
    good: str
    place: tuple[int, int]
    file: str
    encoding: str
    off: bool
    dialect: str = "mudline"

    @property
    def advises(self) -> bool:
        """Whether its findings, whatever their severity, never keep a deck from being evaluated."""
        return not isinstance(self.check, Noticed)

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
        return "" if self.bad.endswith("\n") else "the file ends behind the last character, without a line end"


@dataclass(frozen=True, slots=True)
class Noticed:
    """What reading and resolving a deck, or a check of its scene, noticed under a code."""

    code: Code

    def __call__(self, context: LintContext) -> Iterable[Problem]:
        """The problems of the code."""
        return context.told(self.code)


def rule(code: Code, *, off: bool = False) -> Callable[[Check], Check]:
    """Register a function as the rule of a code that only advises; `off` keeps it from running unless it is selected.

    Its docstring begins with the title, a sentence on a line of its own; the text behind it says why. Then come a bad
    and a good deck, indented below `Bad:` and `Good:`, and `Finds: line:column`, the place of the one finding in the
    bad deck. `File: name` (default deck.keyxm) is the name of both decks. `Bytes: encoding` saves the bad deck in
    another encoding than UTF-8; `Cut: yes` leaves out its last line end; `Dialect: name` reads both decks in a dialect.

    Raises ValueError for a docstring that lacks a part, and for a code or slug that another rule has.
    """

    def register(check: Check) -> Check:
        _register(_described(code, check, check.__doc__ or "", off=off))
        return check

    return register


def _register(described: Rule) -> None:
    code = described.code
    if any(code.code == known.code.code or code.slug == known.code.slug for known in _RULES.values()):
        raise ValueError(f"there is a rule {code.code} or {code.slug} already")
    _RULES[code.code] = described


def _described(code: Code, check: Check, page: str, *, off: bool = False) -> Rule:
    parts = _HEADINGS.split(inspect.cleandoc(page))
    title, _, why = parts[0].strip().partition("\n")
    found = {name: (line, body) for name, line, body in zip(parts[1::3], parts[2::3], parts[3::3], strict=True)}
    lacking = [name for name in ("Bad", "Good", "Finds") if name not in found]
    if lacking or not title or not why.strip():
        raise ValueError(f"the docstring of {code.code} lacks {', '.join(lacking) or 'a title or a reason'}")
    words = {name: line.strip() for name, (line, _) in found.items()}
    bad, good = (_example(found[name][1]) for name in ("Bad", "Good"))
    line, column = (int(number) for number in words["Finds"].split(":"))
    return Rule(
        code=code,
        check=check,
        title=title.strip(),
        why=why.strip(),
        bad=bad.removesuffix("\n") if "Cut" in words else bad,
        good=good,
        place=(line, column),
        file=words.get("File", "deck.keyxm"),
        encoding=words.get("Bytes", "utf-8"),
        off=off,
        dialect=words.get("Dialect", "mudline"),
    )


def _example(body: str) -> str:
    """The indented lines of an example, without their indentation."""
    lines = body.strip("\n").rstrip().split("\n")
    return "".join(f"{line.removeprefix('    ')}\n" for line in lines)


@cache
def _collected() -> tuple[tuple[Rule, ...], tuple[str, ...]]:
    declared = {code.code: (code, code.page) for code in vars(codes).values() if isinstance(code, Code) and code.page}
    for found in all_checks():
        declared.setdefault(found.code.code, (found.code, found.find.__doc__ or ""))
    for code, page in declared.values():
        _register(_described(code, Noticed(code), page))
    for module in MODULES:
        import_module(f"mudline.linting.rules.{module}")
    faults = plugins.load(_RULES)
    return tuple(_RULES[code] for code in sorted(_RULES)), faults


def rules() -> tuple[Rule, ...]:
    """All rules, by code, those of installed plugins among them.

    Raises PluginError when a plugin cannot be used: a run with fewer rules than people believe is worse than none.
    """
    found, faults = _collected()
    if faults:
        raise plugins.PluginError(faults)
    return found


def find(word: str) -> list[Rule]:
    """The rules that a code, a prefix of a code or a slug names, in any case."""
    wanted = word.strip()
    code, slug = wanted.upper(), wanted.lower()
    exact = [found for found in rules() if code == found.code.code or slug == found.code.slug]
    if exact or not wanted.isalnum():
        return exact
    return [found for found in rules() if found.code.code.startswith(code)]
