"""The commands as functions: they take a deck or its file, and return what the command of the name prints or writes."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

from mudline.api import Deck, decks_in, given_deck, given_path, public
from mudline.basics.arguments import expect, expect_number, expect_word, several
from mudline.basics.files import write_atomically
from mudline.basics.quantities import checked_units
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.writing import keyword_file
from mudline.language.diagnostics import Diagnostic
from mudline.model.scene import model as scenes

if TYPE_CHECKING:
    from mudline.checks.verdict import Judgement
    from mudline.editing.backbone_block import BackboneCurve
    from mudline.editing.migration.migrating import Verdict
    from mudline.tools.exporting.report import Report
    from mudline.tools.touchdown_study.study import Study

GivenDeck = Deck | str | os.PathLike[str]


# ----------------------------------------------------------------------------------------------------- decks of decks


@dataclass(frozen=True, kw_only=True)
class ChangedFile:
    """The new content of a deck's file."""

    content: bytes
    source: Deck

    @property
    def deck(self) -> Deck:
        """The new deck; raises DeckError for one that cannot be read."""
        return _again(self.source, self.content)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the file in one step; raises OSError."""
        write_atomically(given_path(path), self.content)


@dataclass(frozen=True, kw_only=True)
class Fixed(ChangedFile):
    """A deck with fixes made: the findings that are `fixed`, those that are `left`, and in `note` why not all are."""

    fixed: list[Diagnostic]
    left: list[Diagnostic]
    note: str


@dataclass(frozen=True, kw_only=True)
class Migrated(ChangedFile):
    """A migrated deck: how many blocks were `replaced` by keyword, new `files` beside it by name, and the proof.

    `verified` says what was compared, at how many positions; None where that was not asked for.
    """

    replaced: dict[str, int]
    files: dict[str, bytes]
    verified: Verdict | None

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the deck, and the new files beside it; raises OSError."""
        for name, content in self.files.items():
            write_atomically(given_path(path).with_name(name), content)
        super().write(path)


def format(deck: GivenDeck) -> Deck:  # noqa: A001 - the name of the command
    """Return the deck in canonical layout, comments kept: `write` writes it so.

    Raises:
        DeckError: the deck has an error.
        ValueError: formatting would lose or change something; the message says what.
    """
    from mudline.editing.formatting.document import formatted  # noqa: PLC0415 - each function brings what it needs

    given = given_deck(deck)
    return _again(given, formatted(_content(given), given.file))


def fix(deck: GivenDeck, *, select: Iterable[str] = (), ignore: Iterable[str] = (), unsafe: bool = False) -> Fixed:
    """Make the fixes of findings that cannot change a result, `unsafe` the others too.

    Args:
        deck: a deck, or its file, which may also be one that cannot be read as it is.
        select: rules by code, prefix of a code, or slug; the default ones if empty.
        ignore: rules that are left out, named the same way.
        unsafe: make fixes too that may change what the deck means.

    Raises:
        OSError: the file cannot be read.
        ValueError: a word names no rule.
    """
    from mudline.checks.engine import Fixing, LintSettings  # noqa: PLC0415 - as above
    from mudline.checks.fixing import lint_one  # noqa: PLC0415 - as above
    from mudline.checks.registry import select as chosen  # noqa: PLC0415 - as above

    expect(unsafe, "unsafe", bool, "True or False")
    words = [several(given, name, str, "several str") for given, name in ((select, "select"), (ignore, "ignore"))]
    settings = LintSettings(tuple(chosen(*words)), fixing=Fixing.UNSAFE if unsafe else Fixing.SAFE)
    if isinstance(deck, Deck):
        given, data = deck, _content(deck)
    else:
        path = given_path(deck, name="deck")
        given, data = Deck(path.as_posix(), path.name, folder=path.parent), path.read_bytes()
    report = lint_one(given.file, data, settings, given.folder)
    content = data if report.changed is None else report.changed
    return Fixed(content=content, source=given, fixed=[*report.fixed], left=[*report.found], note=report.note)


def migrate(deck: GivenDeck, *, verify: bool = False) -> Migrated:
    """Rewrite the legacy seabed keywords of a deck in the new family; without any it stays as it is.

    `verify` evaluates old and new deck around every point of every curve.

    Raises:
        DeckError: the deck has errors, or says what the new family cannot.
        ValueError: with `verify`, results differ.
    """
    from mudline.editing.migration import migrating  # noqa: PLC0415 - as above
    from mudline.editing.migration.refusals import continuations_beside  # noqa: PLC0415 - as above

    expect(verify, "verify", bool, "True or False")
    given = given_deck(deck)
    if not migrating.legacy_blocks(given):
        return Migrated(content=_content(given), source=given, replaced={}, files={}, verified=None)
    current = _again(given, _content(given))
    continued_by, extended = continuations_beside(current) if current.folder else ([], False)
    made = migrating.migrate(current, continued_by, extended=extended)
    verified = migrating.verify(made) if verify else None
    if verified and verified.differences:
        texts = "; ".join(f"{one.what}: {one.text}" for one in verified.differences[:3])
        raise ValueError(f"old and new deck differ: {texts}")
    return Migrated(
        content=made.content, source=given, replaced=dict(made.replaced), files=made.files, verified=verified
    )


def expand(deck: GivenDeck) -> Iterator[tuple[str, Deck]]:
    """Return the decks that `*VARIATION` and `*COMBINATIONS` describe, one after the other, each with its name.

    Raises DeckError for a deck with errors, and for what cannot be expanded.
    """
    from mudline.editing.variations.planning import plan  # noqa: PLC0415 - as above

    given = given_deck(deck)
    planned = plan(_again(given, _content(given)))
    return ((each.path, _again(given, planned.content(each), each.path)) for each in planned.decks)


def _content(deck: Deck) -> bytes:
    """The content of a deck's file as `Deck.write` would write it."""
    form = form_of(deck.file)
    return keyword_file(deck.alone) if form == KEYWORD else dump(deck.alone, form).encode()


def _again(deck: Deck, content: bytes, name: str = "") -> Deck:
    """The deck of a changed content, in the place of a deck."""
    return public(load_bytes(content, name or deck.file, units=deck.units, folder=deck.folder))


# ------------------------------------------------------------------------------------------------- verdicts and models


def validate(
    path: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], *, units: str | None = None
) -> list[Judgement]:
    """Return of each deck whether it is legal: its `verdict` with counts, its `errors` and its `warnings`.

    Args:
        path: a file, a folder with decks below it, or several of them.
        units: "metric", "imperial" or "user", instead of what the files tell.

    Raises:
        OSError: a file cannot be read, or a folder has no deck.
    """
    from mudline.checks.verdict import judge_content  # noqa: PLC0415 - as above

    units = None if units is None else checked_units(units)
    return [judge_content(each.read_bytes(), each.as_posix(), units, each.parent) for each in decks_in(path)]


class Export(NamedTuple):
    """The model of a deck for another program: `files` by name, and the `report` of what does not carry over."""

    files: dict[str, str]
    report: Report

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Write the files into a folder; raises OSError."""
        for name, text in self.files.items():
            write_atomically(given_path(folder, name="folder") / name, text.encode())


def export(deck: GivenDeck, *, to: Literal["moordyn", "orcaflex"], name: str = "") -> Export:
    """Return seabed, line and soil of a deck as the input of another program.

    Args:
        deck: a deck, or its file.
        to: "moordyn" or "orcaflex".
        name: of the main file; that of the deck, with the other program's suffix, if empty.

    Raises:
        DeckError: the deck has errors on which the model depends.
    """
    from mudline.tools.exporting.line_model import build  # noqa: PLC0415 - as above

    expect_word(to, "to", ("moordyn", "orcaflex"), "'moordyn' or 'orcaflex'")
    expect(name, "name", str, "a str")
    given = given_deck(deck)
    model = build(scenes.resolve(given.alone.placed()).require_evaluable())
    file = given_path(name, name="name").name if name else Path(given.file).stem + _SUFFIX[to]
    return Export(import_module(f"mudline.tools.exporting.{to}").write(model, file), model.report)


_SUFFIX = {"moordyn": ".txt", "orcaflex": ".yml"}


def backbone(  # noqa: PLR0913 - as many as the command has options
    model: str,
    *,
    diameter: float,
    strength: float | tuple[float, float],
    weight: float = 0.0,
    depth: float | None = None,
    tolerance: float = 0.005,
    first: float = 0.001,
    name: str | None = None,
    legacy: bool = False,
    extend: bool = False,
) -> BackboneCurve:
    """Return the penetration resistance of a published model as a curve of few points, all in one system of units.

    Args:
        model: f114, skempton, aubeny, aubeny-rough, merifield, merifield-rough or randolph-quiggin.
        diameter: external diameter of the pipe.
        strength: undrained shear strength at the mudline, or that and its increase per depth.
        weight: submerged weight of the soil per volume.
        depth: largest ratio z/D; as far as the model is published if None.
        tolerance: largest error of the interpolation, as a share of the largest force.
        first: smallest ratio of a point above 0; below it a straight line replaces the model.
        name: of the curve, or of the set if `legacy`; that of the model if None.
        legacy: make a block of `*EMBEDMENT`, not of `*SEABED STIFFNESS`.
        extend: let `depth` go beyond the ratios for which the model is published.

    Raises ValueError for an argument that the model cannot have.
    """
    from mudline.editing.backbone_block import backbone_curve  # noqa: PLC0415 - as above

    return backbone_curve(
        model,
        diameter=diameter,
        strength=strength,
        weight=weight,
        depth=depth,
        tolerance=tolerance,
        first=first,
        name=name,
        legacy=legacy,
        extend=extend,
    )


def study(
    deck: GivenDeck, *, only: Iterable[str] = (), heave: float | None = None, period: float | None = None
) -> Study:
    """Return the study of a deck's touchdown zone: errors over run time, stiff and extreme cases, what it needs.

    Args:
        deck: a deck, or its file.
        only: some of "accuracy", "stability" and "pruning"; all if empty.
        heave: amplitude of the hang-off in the deck's units, instead of what its waves give.
        period: that of its motion, likewise.

    Raises:
        DeckError: the deck has errors, or cannot be evaluated. Where it has no touchdown zone, `.advice.text` says why.
        ValueError: `only` names no part, or an amplitude or a period is not above 0.
    """
    from mudline.tools.touchdown_study import study as studies  # noqa: PLC0415 - as above

    given = given_deck(deck)
    parts = several(only, "only", str, "several str")
    for part in parts:
        expect_word(part, "only", studies.PARTS, "of accuracy, stability and pruning")
    for name, value in (("heave", heave), ("period", period)):
        if value is not None:
            expect_number(value, name)
    resolved = scenes.resolve(given.alone.placed()).require()
    return studies.study(resolved, parts or studies.PARTS, heave=heave, period=period)
