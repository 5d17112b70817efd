"""A deck with legacy seabed keywords to one in the new family, in the same form and checked against the old one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from mudline.codes import MIG001
from mudline.deck.forms import form_of
from mudline.deck.forms.keyword import as_text
from mudline.deck.loading import dump, load_path
from mudline.deck.model import Deck, Opaque, comment_texts
from mudline.deck.reading import TextOrigin, read_source
from mudline.diagnostics import DeckError, Problem
from mudline.keywords.catalogue import is_superseded, supersedes
from mudline.migration.refusals import refusals, superseded_blocks
from mudline.migration.rewriting import Rewriting, rewrite, unused_definitions
from mudline.scene.deck_values import data_lines
from mudline.scene.model import Scene, resolve
from mudline.scene.restart import decks_before
from mudline.syntax.edits import edited_bytes
from mudline.syntax.source import Source

_SUFFIXES = frozenset({".keyx", ".keyxm", ".keyxi", ".das"})
_LARGEST = 50_000_000
_NEWER = {"SEABED PROPERTIES", "SEABED STIFFNESS"}
"""New keywords whose laws would be combined with those of a migrated deck."""


class Continuations:
    """The decks that continue a deck, among those to be migrated and those in its folder."""

    def __init__(self, files: Iterable[Path]) -> None:
        self._visited: set[Path] = set()
        self._by_base: dict[Path, set[str]] = {}
        self._extended: set[Path] = set()
        for file in files:
            self._visit(file)

    def of(self, file: Path) -> list[str]:
        """Names of the decks that continue a deck and have seabed keywords of their own."""
        if file.parent not in self._visited:
            self._visited.add(file.parent)
            for other in sorted(file.parent.iterdir()):
                if other.suffix.lower() in _SUFFIXES:
                    self._visit(other)
        return sorted(self._by_base.get(file.resolve(), ()))

    def extend(self, file: Path) -> bool:
        """Whether a deck that continues a deck, among those visited, has a model of its own: more elements or sets."""
        return file.resolve() in self._extended

    def _visit(self, file: Path) -> None:
        if file in self._visited:
            return
        self._visited.add(file)
        try:
            if file.stat().st_size > _LARGEST or b"RESTART" not in file.read_bytes().upper():
                return
            deck = load_path(file)
        except (OSError, DeckError):
            return  # an unreadable deck continues nothing; where it is to be migrated itself, that is an error
        keywords = deck.keywords()
        if not keywords:
            return
        bases = [base.resolve() for base in decks_before(deck)]
        self._extended.update(bases)
        if keywords & _NEWER or any(map(is_superseded, keywords)):
            for base in bases:
                self._by_base.setdefault(base, set()).add(file.as_posix())


def continuations_beside(deck: Deck) -> tuple[list[str], bool]:
    """What `Continuations.of` and `extend` give for a deck and its folder; the decks of a folder are read once."""
    if deck.folder is None or not deck.folder.is_dir():
        return [], False
    found, file = _continuations_in(deck.folder), deck.folder / Path(deck.file).name
    return found.of(file), found.extend(file)


@lru_cache(maxsize=1)
def _continuations_in(_: Path) -> Continuations:
    """Those of a folder, whose decks are read when they are asked for."""
    return Continuations(())


@dataclass(frozen=True, slots=True)
class Migration:
    """A migrated deck: the scenes before and after, the new deck and its content, the new files beside it by name.

    `replaced` counts the legacy blocks by keyword.
    """

    before: Scene
    after: Scene
    deck: Deck
    content: bytes
    files: dict[str, bytes] = field(default_factory=dict)
    replaced: Counter[str] = field(default_factory=Counter)


def legacy_blocks(deck: Deck) -> Counter[str]:
    """Count the blocks of each legacy keyword in the model."""
    return Counter(block.keyword for _, block in superseded_blocks(deck))


def migrate(deck: Deck, continued_by: Sequence[str] = (), *, extended: bool = False) -> Migration:
    """Rewrite the legacy seabed keywords of a deck in the new family; the deck keeps its form.

    `continued_by` names decks that continue this one with seabed keywords of their own; `extended` says that one may
    have more elements, so that what no element of this deck follows is kept. Raises DeckError for a deck
    with errors, and (MIG001) for what the new family cannot say.
    """
    before = resolve(deck).require()
    if problems := list(refusals(deck, before, continued_by)):
        raise DeckError(deck.diagnose(problems))
    text = as_text(deck)
    made = rewrite(text, unused_definitions(before, extended=extended))
    origin = text.origin
    assert isinstance(origin, TextOrigin)  # noqa: S101 - `as_text` gives no other
    content = edited_bytes(origin.source, made.edits)
    changed = read_source(Source.from_bytes(content, deck.file), units=deck.units)
    changed = replace(changed, source=deck.source, folder=deck.folder)
    after = _checked(deck, before, changed, made)
    if not isinstance(deck.origin, TextOrigin):
        content = dump(changed, form_of(deck.file)).encode()
    files = {name: lines.encode() for name, lines in made.files.items()}
    return Migration(before, after, changed, content, files, legacy_blocks(deck))


def _checked(deck: Deck, before: Scene, changed: Deck, made: Rewriting) -> Scene:
    """The scene of the new deck; raises DeckError when it lost anything or has new faults."""
    after = resolve(changed)
    faults = [problem.message for problem in after.errors()]
    lost = Counter(_comments(deck)) - Counter(_comments(changed))
    faults += [f"the comment {text!r} would be lost or read as data" for text in lost]
    if _others(deck) != _others(changed):
        faults.append("a block of another keyword would change")
    expected = Counter(problem.code.code for problem in before.findings)
    new = Counter(problem.code.code for problem in after.findings)
    if not np.array_equal(before.law, after.law):
        faults.append("an element would have a law of another kind")
    for code in (new - expected) - Counter({"REF015": len(made.files)}):
        faults.append(f"it would have a new finding {code}")
    if faults:
        where, _ = superseded_blocks(deck)[0]
        problems = [Problem(MIG001, f"the deck is left unchanged: {fault}", where=where) for fault in faults]
        raise DeckError(deck.diagnose(problems))
    return after


def _comments(deck: Deck) -> Iterator[str]:
    """The text of every comment, those among the lines of opaque blocks included."""
    yield from comment_texts(deck)
    opaque = (block.lines for section in deck.sections for block in section.blocks if isinstance(block, Opaque))
    for lines in opaque:
        data = set(data_lines(lines))
        yield from (line[1:] for line in lines if line not in data)


def _others(deck: Deck) -> list[object]:
    """Everything but the blocks that a migration rewrites, without the comments.

    Those in an opaque block are among its lines, and a keyword below it that becomes a comment is among them.
    """
    return [
        (
            section.name,
            section.lines,
            [line for line in data_lines(block.lines) if line.strip()] if isinstance(block, Opaque) else block,
        )
        for section in deck.sections
        for block in section.blocks
        if section.name != "MODEL" or not (is_superseded(block.keyword) or supersedes(block.keyword))
    ]
