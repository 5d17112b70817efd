"""Findings that are hidden: by comments, `C mudline: ignore CRV005`, `ignore-block`, `ignore-file`; by a baseline.

A comment applies to the next line that is neither blank nor a comment, to its block (from the keyword to the next one),
or to the whole file. It names codes, prefixes of codes and slugs; without a name it applies to all codes. A baseline
records known findings by path, code and the text of their line, not by its number.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from mudline.basics.overwriting import reading
from mudline.basics.paths import relative_path
from mudline.basics.spelling import nearest
from mudline.checks.context import LintContext
from mudline.checks.registry import find, rules
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Diagnostic, Problem, Repair, Severity, Span
from mudline.language.rules import Rule, first_reported
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import LeafKind

STY010 = Code("STY010", "unused-suppression", Severity.WARNING)

MARK = re.compile(r"[Cc][ \t]+mudline[ \t]*:[ \t]*", re.IGNORECASE)
"""Beginning of a comment for mudline."""

_ORDER = re.compile(r"[\w-]+")
_WORD = re.compile(r"[^,\s]+")
_REASON = r"(?:(?<=[\s,])|^)--(?=\s|$)"
_PLACES = {"ignore": "the next line", "ignore-block": "this block", "ignore-file": "this file"}
"""Scope of lines outside of any block."""
_NOTHING = ("nothing",)
"""Scope of a comment that applies to nothing."""


class Word(NamedTuple):
    """Name in a comment: its text, its place, and the codes of the rules that it names, if any."""

    text: str
    span: Span
    codes: frozenset[str]


@dataclass(slots=True, eq=False)
class Directive:
    """Suppression comment.

    scope: the line, the block or the file that it applies to; nothing after the last line.
    reason: the text behind `--`, "" without one.
    """

    order: str
    leaf: Span
    span: Span
    words: list[Word]
    scope: Hashable = _NOTHING
    reason: str = ""

    @property
    def codes(self) -> set[str]:
        """Codes that it names; "" stands for all but that of an unused comment."""
        return {code for word in self.words for code in word.codes} if self.words else {""}


@dataclass(eq=False)
class Suppressions:
    """Comments of a deck that hide findings, and those that look like one.

    origin: places in the deck's text, which of a JSON or YAML deck is the keyword text that it would be.
    misspelt: the words of comments that look like one, each with the word that was meant.
    """

    origin: TextOrigin
    directives: list[Directive] = field(default_factory=list)
    misspelt: list[tuple[Word, str]] = field(default_factory=list)

    def reported(self, problems: Iterable[Problem]) -> list[Problem]:
        """Return the problems that no comment hides."""
        return [problem for problem in problems if not self.hiding(problem)]

    def unused(self, problems: Sequence[Problem], chosen: Iterable[Rule]) -> list[Problem]:
        """Return STY010 for comments that hide none of the problems, if the rules named there are among the chosen."""
        selected = {rule.code.code for rule in chosen}
        return first_reported(self._unused(problems, selected)) if STY010.code in selected else []

    def hiding(self, problem: Problem) -> Directive | None:
        """Return the comment that hides a problem; a comment without codes does not hide that it is unused."""
        codes = [problem.code.code] if problem.code is STY010 else [problem.code.code, ""]
        keys = ((scope, code) for scope in self._scopes(problem) for code in codes)
        return min((self._first[key] for key in keys if key in self._first), key=lambda each: each.leaf, default=None)

    @cached_property
    def _first(self) -> dict[tuple[Hashable, str], Directive]:
        """First comment with a scope and a code."""
        return {(each.scope, code): each for each in reversed(self.directives) for code in each.codes}

    def unknown(self) -> Iterator[Problem]:
        """Yield problems for names that no rule has, and for unknown instructions in comments."""
        for word, meant in self.misspelt:
            message = f"{word.text!r} is not an instruction: did you mean {meant}?"
            yield Problem(STY010, message, word.span, repair=_replacing(word, meant))
        for directive in self.directives:
            for number, word in enumerate(directive.words):
                if not word.codes:
                    near = nearest(word.text, (name for rule in rules() for name in (rule.code.code, rule.code.slug)))
                    hint = f"did you mean {near}?" if near else "`mudline rules` lists all rules; remove it"
                    repair = _replacing(word, near) if near else _removing(directive, number, "unsafe")
                    yield Problem(STY010, f"{word.text!r} names no rule: {hint}", word.span, repair=repair)

    def _scopes(self, problem: Problem) -> tuple[Hashable, ...]:
        line = self.origin.place(problem).line
        block = self.origin.tree.at(self.origin.source.offset(line, 1))
        return (("line", line), block.where, ("file",))

    def _unused(self, problems: Iterable[Problem], selected: set[str]) -> Iterator[Problem]:
        present: dict[Hashable, set[str]] = {}  # codes of the findings in every scope
        for problem in problems:
            for scope in self._scopes(problem):
                present.setdefault(scope, set()).add(problem.code.code)
        everything = {rule.code.code for rule in rules() if not rule.off}
        for directive in self.directives:
            codes_found = present.get(directive.scope, set()) - {STY010.code}
            place = _place(directive)
            if not directive.words and not codes_found and everything <= selected:
                message = f"nothing is found in {place}: remove this comment"
                yield Problem(STY010, message, directive.span, repair=_removing(directive, 0, "safe"))
            for number, word in enumerate(directive.words):
                judged = (word.codes & everything) or word.codes
                if word.codes and STY010.code not in word.codes and judged <= selected and not word.codes & codes_found:
                    message = f"{word.text} is not found in {place}: remove it from this comment"
                    yield Problem(STY010, message, word.span, repair=_removing(directive, number, "safe"))


def _replacing(word: Word, replacement: str) -> Repair:
    return Repair("unsafe", f"write {replacement}", ((word.span, replacement),))


def _removing(directive: Directive, number: int, applicability: str) -> Repair:
    """Return a repair that removes a word and its separator, or the comment if nothing else is named."""
    words = directive.words
    if len(words) <= 1:
        return Repair(applicability, "remove the comment", ((directive.leaf, ""),))
    own = words[number].span
    last = number == len(words) - 1
    span = Span(words[number - 1].span.end, own.end) if last else Span(own.start, words[number + 1].span.start)
    return Repair(applicability, f"remove {words[number].text}", ((span, ""),))


def _place(directive: Directive) -> str:
    """Return the scope of a comment in words."""
    if directive.scope != _NOTHING:
        return _PLACES[directive.order]
    return "what is not a block (put it below its *KEYWORD)" if directive.order == "ignore-block" else "what follows"


def suppressions(context: LintContext) -> Suppressions | None:
    """Return the suppressions of a deck's comments; None if no comment is for mudline. Rules call `context.once`.

    A deck without a text, which a program made, hides nothing.
    """
    origin = context.text
    text = origin.source.unified if origin and origin.source.readable else ""
    if origin is None or "mudline" not in text.lower():
        return None
    suppressions_ = Suppressions(origin)
    waiting: list[Directive] = []
    for leaf in origin.tree.leaves():
        if leaf.kind is LeafKind.COMMENT:
            directive = _directive(text, leaf.span, suppressions_)
            if directive is not None and directive.order == "ignore":
                waiting.append(directive)
        elif waiting and leaf.kind is not LeafKind.BLANK:
            line = origin.source.position(leaf.span.start)[0]
            for directive in waiting:
                directive.scope = ("line", line)
            waiting.clear()
    return suppressions_ if suppressions_.directives or suppressions_.misspelt else None


def _directive(text: str, leaf: Span, found: Suppressions) -> Directive | None:
    mark = MARK.match(text, *leaf)
    order = _ORDER.match(text, mark.end(), leaf.end) if mark else None
    if order is None:
        return None
    name = order.group().lower()
    if name not in _PLACES:
        if near := nearest(name, _PLACES):
            found.misspelt.append((Word(order.group(), Span(*order.span()), frozenset()), near))
        return None
    end = leaf.start + len(text[slice(*leaf)].rstrip())
    reason = re.search(_REASON, text[order.end() : end])
    names = list(_WORD.finditer(text, order.end(), order.end() + reason.start() if reason else end))
    codes = {word: frozenset(rule.code.code for rule in find(word)) for word in {each.group() for each in names}}
    words = [Word(each.group(), Span(*each.span()), codes[each.group()]) for each in names]
    directive = Directive(name, leaf, Span(leaf.start, end), words)
    directive.reason = text[order.end() + reason.end() : end].strip() if reason else ""
    if name == "ignore-file":
        directive.scope = ("file",)
    elif name == "ignore-block" and (spot := found.origin.tree.at(leaf.start)).block:
        directive.scope = spot.where
    found.directives.append(directive)
    return directive


# --------------------------------------------------------------------------------------------------------- the baseline

FORMAT = "mudline-baseline/1"
_RECORDED = 500
"""Number of characters of a line that are recorded."""


class BaselineError(ValueError):
    """File that is not a baseline; the message gives the reason."""


class BaselineEntry(NamedTuple):
    """Key of known findings: path from the baseline's folder, code, and line without outer spaces."""

    path: str
    code: str
    content: str


@dataclass
class Baseline:
    """Known findings and how often each is there; `folder` is that of the baseline's file."""

    folder: Path
    known: Counter[BaselineEntry] = field(default_factory=Counter)
    met: Counter[BaselineEntry] = field(default_factory=Counter)
    seen: set[str] = field(default_factory=set)

    def record(self, found: Iterable[Diagnostic], data: bytes, path: str) -> None:
        """Add the findings of a file, whose content is `data`."""
        self.known.update(self._entries(found, data, path))

    def unknown(self, found: Sequence[Diagnostic], data: bytes, path: str) -> list[Diagnostic]:
        """Return the findings of a file that are not recorded, or that exceed the recorded number of their kind."""
        self.seen.add(relative_path(path, self.folder))
        new: list[Diagnostic] = []
        for one, entry in zip(found, self._entries(found, data, path), strict=True):
            self.met[entry] += 1
            if self.met[entry] > self.known[entry]:
                new.append(one)
        return new

    def gone(self) -> int:
        """Return the number of recorded findings of the files seen that are no longer there."""
        return sum(max(count - self.met[entry], 0) for entry, count in self.known.items() if entry.path in self.seen)

    def text(self) -> str:
        """Return the content of the file: sorted, an entry a line, ends with LF."""
        entries = sorted((entry, count) for entry, count in self.known.items() if count)
        lines = [json.dumps({**entry._asdict(), "count": count}, ensure_ascii=True) for entry, count in entries]
        inner = ",\n".join(f"  {line}" for line in lines)
        return f'{{\n "format": "{FORMAT}",\n "findings": [' + (f"\n{inner}\n ]\n}}\n" if lines else "]\n}\n")

    def _entries(self, findings: Iterable[Diagnostic], data: bytes, path: str) -> Iterator[BaselineEntry]:
        source = Source.from_bytes(data, "")
        relative = relative_path(path, self.folder)
        lines = len(source.line_starts)
        for finding in findings:
            content = source.line(finding.line).strip()[:_RECORDED] if finding.line <= lines else ""
            yield BaselineEntry(relative, finding.code, content)


def read_baseline(path: Path) -> Baseline:
    """Return the baseline in a file; raises OSError, or BaselineError for a file that is not a baseline."""
    reading(path)
    try:
        document = json.loads(path.read_bytes())
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BaselineError(f"it is not JSON ({error})") from error
    except ValueError as error:  # of more digits than Python reads
        raise BaselineError("a whole number in it is too large") from error
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise BaselineError(f'it has no "format": "{FORMAT}"')
    findings = document.get("findings")
    if not isinstance(findings, list):
        raise BaselineError('it has no list "findings"')
    baseline = Baseline(path.parent)
    for number, finding in enumerate(findings):
        entry, count = _entry(finding, number)
        baseline.known[entry] += count
    return baseline


def _entry(finding: object, number: int) -> tuple[BaselineEntry, int]:
    if not isinstance(finding, dict) or finding.keys() != {"code", "content", "count", "path"}:
        raise BaselineError(f"findings[{number}] must have the keys code, content, count, path, and no others")
    path, code, content, count = (finding[key] for key in ("path", "code", "content", "count"))
    if not (isinstance(path, str) and isinstance(code, str) and isinstance(content, str)):
        raise BaselineError(f"findings[{number}]: path, code and content must be texts")
    if not isinstance(count, int) or isinstance(count, bool) or count < 1:
        raise BaselineError(f"findings[{number}]: count must be a whole number from 1")
    return BaselineEntry(path, code, content), count
