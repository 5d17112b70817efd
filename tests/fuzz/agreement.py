"""Targets that compare answers: of several commands, of a text before and after fixes, of one deck in several forms."""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from difflib import SequenceMatcher
from itertools import zip_longest
from pathlib import Path

from mudline.checks.engine import Fixing, LintSettings, lint_bytes, naming_causes
from mudline.checks.fixing import FixState, StageReader, fix_bytes
from mudline.checks.registry import rules, select
from mudline.checks.verdict import errors_beside, judge_content, overview
from mudline.editing.comparison.decks import compare_decks
from mudline.editing.variations.planning import plan
from mudline.language.deck.keyword_text import with_raw_lines
from mudline.language.deck.loading import coverage_of, dump, load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Diagnostic, Severity, Where
from mudline.language.syntax.source import Source
from mudline.model.results.evaluation import evaluate_scene
from mudline.model.scene.model import resolve
from mudline.tools.reporting.content import DeckFile, PageHead, report_on
from tests.cli.runner import run

NAME = "deck.keyxm"


class BrokenPromiseError(AssertionError):
    """A promise that does not hold; the message says which."""


def _errors(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    return [one for one in found if one.severity is Severity.ERROR]


def _all(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Findings, and those that are under them."""
    return [each for one in found for each in (one, *one.following)]


# ---------------------------------------------------------------------------------------------------------- one verdict


def _evaluates(data: bytes) -> bool | None:
    deck = load_bytes(data, NAME)
    try:
        with naming_causes(deck):
            scene = resolve(deck).require_evaluable()
        for _ in evaluate_scene(scene).parts():
            pass
    except DeckError as error:
        if all(one.code.startswith("RUN") or one.severity is Severity.INFO for one in error.diagnostics):
            return None  # the run lacks something, as nodes without positions, or the deck does not show it
        return False
    return not errors_beside(deck)


def _file(data: bytes) -> DeckFile:
    return DeckFile(data, NAME, None)


_VERDICTS: dict[str, Callable[[bytes], bool | None]] = {
    "lint": lambda data: not _errors(lint_bytes(data, NAME, select())),
    "validate": lambda data: judge_content(data, NAME, None, None).verdict.ok,
    "evaluate": _evaluates,
    "show": lambda data: not overview(load_bytes(data, NAME)).errors,
    "report": lambda data: report_on(_file(data), LintSettings(rules()), ["verdict"], PageHead()).json["verdict"]["ok"],
}


def verdicts(data: bytes) -> None:
    """Whether a deck has errors is the same for all commands."""
    if b"mudline:" in data:
        return  # what its comments suppress is hidden by lint alone
    found = {name: check(data) for name, check in _VERDICTS.items()}
    if len({*found.values()} - {None}) > 1:
        raise BrokenPromiseError(f"these take the deck: {[name for name, good in found.items() if good]}")


# ---------------------------------------------------------------------------------------------------------------- fixes


def fixes(data: bytes) -> None:
    """Each error of a fixed deck was one before, with its code and at its place; safe fixes keep the meaning."""
    before = _state(data)
    known = {*before.errors()}
    for fixing in (Fixing.SAFE, Fixing.UNSAFE):
        settings = LintSettings(rules(), fixing=fixing)
        result = fix_bytes(data, NAME, settings)
        if result.changed is None:
            continue
        after = _state(result.changed)
        old, new = _lines(data), _lines(result.changed)
        origins = _origins(old, new)
        for code, line in after.errors():
            places = origins[line - 1] if line else [0]
            if not any((code, place) in known for place in places):
                raise BrokenPromiseError(f"after {fixing} fixes: new {code}")
        whole = fixing is Fixing.SAFE and not before.errors() and coverage_of(before.context.deck).whole
        if whole and compare_decks(before.context.deck, after.context.deck).differences:
            raise BrokenPromiseError("safe fixes change what the deck means")
        removed = sum(1 for line in old if line.strip()) - sum(1 for line in new if line.strip())
        listed = sum(edit.end[0] - edit.start[0] + 1 for one in result.fixed if one.fix for edit in one.fix.edits)
        if removed > listed:
            raise BrokenPromiseError(f"after {fixing} fixes: {removed} lines are gone, {listed} of them are listed")


def _state(data: bytes) -> FixState:
    return StageReader(NAME, LintSettings(rules()), None).read(data)


def _lines(data: bytes) -> list[str]:
    return Source.from_bytes(data, NAME).unified.split("\n")


def _origins(old: list[str], new: list[str]) -> list[Sequence[int]]:
    """For each line of a new text the lines of the old one that it may come from, from 1; of equal ones any."""
    equal: dict[str, list[int]] = {}
    for number, line in enumerate(old, 1):
        equal.setdefault(line, []).append(number)
    found: list[Sequence[int]] = []
    for _, first, last, start, end in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        found += [equal.get(line) or range(first, last + 2) for line in new[start:end]]
    return found


# ---------------------------------------------------------------------------------------------------- the same findings


def line_ends(data: bytes) -> None:
    """A deck has the same findings at the same places, whether its lines end with LF, CRLF or CR."""
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    found = [
        [(one.line, one.column, one.code, one.message) for one in _all(lint_bytes(text, NAME, rules()))]
        for text in (data, data.replace(b"\n", b"\r\n"), data.replace(b"\n", b"\r"))
    ]
    for end, other in zip(("CRLF", "CR"), found[1:], strict=True):
        if other != found[0]:
            first = next(one for pair in zip_longest(found[0], other) if pair[0] != pair[1] for one in pair if one)
            raise BrokenPromiseError(f"with {end} other findings, the first is {first[2]}")


def forms(data: bytes) -> None:
    """Keyword text, JSON and YAML of a deck have the same codes; a block that cannot be read is there as it is written.

    Codes of style and of the spelling of numbers are of the text alone.
    """
    deck = load_bytes(data, NAME)
    if not isinstance(deck.origin, TextOrigin) or not deck.origin.source.readable:
        return
    kept, places = with_raw_lines(deck)
    try:
        texts = {form: dump(kept, form) for form in ("keyword", "json", "yaml")}
    except DeckError:
        return
    codes = {}
    for form, text in texts.items():
        name = NAME if form == "keyword" else f"deck.{form}"
        codes[form] = Counter(
            one.code for one in _all(lint_bytes(text.encode(), name, rules())) if _is_of_any_form(one)
        )
        back, again = with_raw_lines(load_bytes(text.encode(), name))
        if again != places or any(_block(back, where) != _block(kept, where) for where in places):
            raise BrokenPromiseError(f"{form} does not keep a faulty block as it is written")
        if dump(back, "json") != texts["json"]:
            raise BrokenPromiseError(f"{form}, read and written as JSON, is another deck")
    for form in ("json", "yaml"):
        if codes[form] != codes["keyword"]:
            other = (codes[form] - codes["keyword"]) + (codes["keyword"] - codes[form])
            raise BrokenPromiseError(f"{form} has other codes than keyword text: {', '.join(sorted(other))}")


def _block(deck: Deck, where: Where) -> object:
    return deck.sections[where.section].blocks[where.block]


def _is_of_any_form(found: Diagnostic) -> bool:
    return found.severity is not Severity.INFO and not found.code.startswith("STY")


def messages(data: bytes) -> None:
    """Each error that `format` tells stands in what `lint` tells, with the same words."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / NAME
        path.write_bytes(data)
        outcome = run("format", "--check", str(path))
        if b"mudline:" in data:
            return
        said = {f"{one.line}:{one.column}: error: {one.code} {one.message}" for one in lint_bytes(data, NAME, rules())}
        for line in outcome.err.splitlines():
            _, found, words = line.partition(f"{NAME}:")
            if found and ": error: " in words and words not in said and words.isascii():
                raise BrokenPromiseError(f"lint does not say this: {words[:80]}")


def expansion(data: bytes) -> None:
    """What `expand` refuses of a deck with variations is an error for `lint`."""
    deck = load_bytes(data, NAME)
    if not deck.keywords("PREPROCESSOR") & {"VARIATION", "COMBINATIONS"}:
        return
    try:
        plan(deck)
    except DeckError as error:
        if not _errors(lint_bytes(data, NAME, rules())):
            raise BrokenPromiseError(f"expand refuses: {error.diagnostics[0].message[:60]}") from error
