"""Commands as functions: each takes a deck or its file and returns the content that the command prints or writes."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from types import NoneType
from typing import TYPE_CHECKING, Any, Literal

from mudline.api import Deck, Paths, content_as, decks_in, given_deck, given_rules, given_units, public
from mudline.basics.arguments import expect, expect_number, expect_word, given_path, several
from mudline.basics.files import write_atomically
from mudline.basics.quantities import csv_lines
from mudline.checks.configuration import Configured
from mudline.checks.context import read_deck
from mudline.checks.engine import naming_causes, readable
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.loading import dump, load_bytes, load_path
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.model.scene import model as scenes

if TYPE_CHECKING:
    from mudline.checks.verdict import Judgement, Overview
    from mudline.editing.comparison.decks import Comparison
    from mudline.editing.comparison.matrix import DiffRow
    from mudline.editing.migration.migrating import Verification
    from mudline.editing.migration.refusals import Continuations
    from mudline.tools.exporting.report import Export
    from mudline.tools.touchdown_study.study import Study

GivenDeck = Deck | str | os.PathLike[str]


# ------------------------------------------------------------------------------------------------------ changed decks


@dataclass(frozen=True, kw_only=True)
class ChangedFile:
    """New content of a deck's file."""

    content: bytes
    source: Deck

    @property
    def deck(self) -> Deck:
        """The new deck; raises DeckError if it cannot be read."""
        return _again(self.source, self.content)

    def content_as(self, name: str) -> bytes:
        """Return the content in the form given by a file name."""
        form = form_of(name)
        return self.content if form == form_of(self.source.file) else dump(self.deck, form).encode()

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the file in one step, in the form of its suffix; raises OSError."""
        file = given_path(path)
        write_atomically(file, self.content_as(file.name))


@dataclass(frozen=True, kw_only=True)
class Fixed(ChangedFile):
    """A deck with fixes made."""

    fixed: list[Diagnostic]
    """Findings that were fixed."""
    left: list[Diagnostic]
    """Findings that remain."""
    note: str
    """Reason why some fixes were not made; "" for none."""


@dataclass(frozen=True, kw_only=True)
class Migrated(ChangedFile):
    """A migrated deck."""

    replaced: dict[str, int]
    """Number of replaced blocks by keyword."""
    files: dict[str, bytes]
    """New files next to the deck, by name."""
    verified: Verification | None
    """Comparison of results and the number of positions; None unless verification was asked for."""

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the deck, and the new files next to it; raises OSError."""
        for name, content in self.files.items():
            write_atomically(given_path(path).with_name(name), content)
        super().write(path)


def format(deck: GivenDeck) -> Deck:  # noqa: A001 - the name of the command
    """Return the deck in canonical layout with its comments, which `write` keeps.

    Raises:
        DeckError: the deck has an error.
        ValueError: formatting would lose or change something; the message names it.
    """
    given = given_deck(deck)
    return _again(given, formatted_file(content_as(given, given.file), given.file))


def formatted_file(data: bytes, name: str) -> bytes:
    """Return the content of a deck's file in canonical layout.

    Raises DeckError with the causes of read errors, and FormatError, a ValueError, as `format` does.
    """
    from mudline.editing.formatting.document import formatted  # noqa: PLC0415 - each function brings what it needs

    try:
        return formatted(data, name)
    except DeckError:
        if form_of(name) == KEYWORD:
            readable(read_deck(data, name))
        raise


def fix(deck: GivenDeck, *, select: Iterable[str] = (), ignore: Iterable[str] = (), unsafe: bool = False) -> Fixed:
    """Make the fixes of findings that cannot change a result; with `unsafe`, all other fixes too.

    Args:
        deck: a deck, or its file, which may have read errors.
        select: rules by code, prefix of a code, or slug; the default rules if empty.
        ignore: rules to leave out, named the same way.
        unsafe: also make fixes that may change the meaning of the deck.

    Raises:
        OSError: the file cannot be read.
        ValueError: a word names no rule.
    """
    from mudline.checks.engine import Fixing, LintSettings  # noqa: PLC0415 - as above
    from mudline.checks.fixing import lint_one  # noqa: PLC0415 - as above

    expect(unsafe, "unsafe", bool, "True or False")
    settings = LintSettings(given_rules(select, ignore), fixing=Fixing.UNSAFE if unsafe else Fixing.SAFE)
    if isinstance(deck, Deck):
        given, data = deck, content_as(deck, deck.file)
    else:
        path = given_path(deck, name="deck")
        given, data = Deck(path.as_posix(), path.name, folder=path.parent), path.read_bytes()
    report = lint_one(given.file, data, settings, given.folder)
    content = data if report.changed is None else report.changed
    return Fixed(content=content, source=given, fixed=[*report.fixed], left=[*report.found], note=report.note)


def migrate(deck: GivenDeck, *, verify: bool = False) -> Migrated:
    """Rewrite the superseded seabed keywords of a deck in the new family; a deck without them is returned unchanged.

    `verify` evaluates old and new deck around every point of every curve.

    Raises:
        DeckError: the deck has errors, or states something that the new family cannot express.
        ValueError: with `verify`, results differ.
    """
    expect(verify, "verify", bool, "True or False")
    given = given_deck(deck)
    result = migrated(_again(given, content_as(given, given.file)), verify=verify)
    if result.verified and result.verified.differences:
        texts = "; ".join(f"{difference.what}: {difference.text}" for difference in result.verified.differences[:3])
        raise ValueError(f"old and new deck differ: {texts}")
    return result if result.replaced else replace(result, content=content_as(given, given.file))


def migrated(deck: Deck, *, verify: bool, among: Continuations | None = None) -> Migrated:
    """Return the migrated form of a deck as read, also if verification fails; without `content` if nothing changes.

    Decks that continue it are searched in its folder, and `among` those given.
    """
    from mudline.editing.migration import migrating  # noqa: PLC0415 - as above
    from mudline.editing.migration.refusals import continuations_beside  # noqa: PLC0415 - as above

    continued_by, extended = continuations_beside(deck, among) if migrating.legacy_blocks(deck) else ([], False)
    with naming_causes(deck):
        new = migrating.migrate(deck, continued_by, extended=extended)
    verified = migrating.verify(new) if verify and new.replaced else None
    return Migrated(content=new.content, source=deck, replaced=dict(new.replaced), files=new.files, verified=verified)


def expand(deck: GivenDeck) -> Iterator[tuple[str, Deck]]:
    """Return the decks that `*VARIATION` and `*COMBINATIONS` describe, each with its name, made one at a time.

    Raises DeckError for a deck with errors, and for variations that cannot be expanded.
    """
    from mudline.editing.variations.planning import plan  # noqa: PLC0415 - as above

    given = given_deck(deck)
    planned = plan(_again(given, content_as(given, given.file)))
    return ((each.path, _again(given, planned.content(each), each.path)) for each in planned.decks)


def _again(deck: Deck, content: bytes, name: str = "") -> Deck:
    """Return the deck of a changed content, with file name, units and folder of the original deck."""
    return public(load_bytes(content, name or deck.file, units=deck.units, folder=deck.folder))


# ------------------------------------------------------------------------------------------------- verdicts and models


def validate(path: Paths, *, units: str | None = None) -> list[Judgement]:
    """Return the judgement on each deck: its `verdict` (`ok`, counts, `str()`), its `errors` and its `warnings`.

    Args:
        path: a file, a folder searched for decks, or several of them.
        units: "metric", "imperial" or "user", in place of the units in the files.

    Raises:
        OSError: a file or a folder cannot be read, or a folder has no deck.
    """
    from mudline.checks.verdict import judge_content  # noqa: PLC0415 - as above

    units = given_units(units)
    return [judge_content(each.read_bytes(), each.as_posix(), units, each.parent) for each in decks_in(path)]


def show(deck: GivenDeck) -> Overview:
    """Return the contents of a deck: its `summary`, the `sheet` of its elements, and its `errors`.

    Raises:
        OSError: the file cannot be read.
        DeckError: the file is not a deck. A deck with errors is shown as far as it can be read.
    """
    from mudline.checks.verdict import overview  # noqa: PLC0415 - as above

    return overview(deck.alone.placed() if isinstance(deck, Deck) else load_path(given_path(deck, name="deck")))


def diff(
    before: GivenDeck,
    after: GivenDeck,
    *,
    tolerance: float = 0.0,
    strict: bool = False,
    units: str | None = None,
    gitignore: bool = True,
) -> Comparison:
    """Return the differences in meaning between two decks or two folders, whatever their forms, layout and order.

    Decks of folders that the configuration excludes are left out.

    Args:
        before: a deck, its file, or a folder, whose decks are compared with those of the same path below `after`.
        after: the second deck or folder; places and values that `before` lacks are "added".
        tolerance: difference of numbers that is ignored, from 0 to 1, relative to the larger number.
        strict: count differences of spelling in superseded keywords as `differences` too.
        units: of the decks of folders: "metric", "imperial" or "user", in place of the units in the files.
        gitignore: leave out files of folders that their .gitignore files hide.

    Raises:
        DeckError: one of two decks has errors; one of many in folders has the `status` "failed".
        OSError: one of two files cannot be read, or the folders have no deck in common.
        ValueError: one argument is a folder, the other is not.
    """
    from mudline.editing.comparison import decks as compared  # noqa: PLC0415 - as above

    expect_number(tolerance, "tolerance", or_zero=True)
    expect(strict, "strict", bool, "True or False")
    expect(gitignore, "gitignore", bool, "True or False")
    units = given_units(units)
    if tolerance > 1.0:
        raise ValueError(f"tolerance must be from 0 to 1, not {tolerance!r}")
    folders = [
        str(path)
        for each, name in ((before, "before"), (after, "after"))
        if not isinstance(each, Deck) and (path := given_path(each, name=name)).is_dir()
    ]
    if len(folders) == 1:
        raise ValueError(f"{folders[0]} is a folder, and the other one is not: give two decks or two folders")
    if folders:
        pairs = compared.paired(folders[0], folders[1], Configured().takes, gitignore=gitignore)
        decks = [compared.compare_pair(pair, tolerance, strict, units) for pair in pairs]
        differences = [each for deck in decks for each in deck.comparison.differences]
        return compared.Comparison(differences, [each for deck in decks for each in deck.comparison.spelling], decks)
    first, second = (readable(given_deck(*each)).alone.placed() for each in ((before, "before"), (after, "after")))
    return compared.compare_decks(first, second, tolerance, strict=strict)


def diff_matrix(
    before: GivenDeck, decks: Iterable[GivenDeck], *, tolerance: float = 0.0, strict: bool = False
) -> list[DiffRow]:
    """Return the values that differ within a family of decks: each with its `values`, that of `before` first.

    Args:
        before: the deck, or its file, with which the others are compared.
        decks: the other decks, or their files.
        tolerance: as in `diff`.
        strict: as in `diff`.

    Raises DeckError for a deck that has errors.
    """
    from mudline.editing.comparison.matrix import matrix  # noqa: PLC0415 - as above

    base = given_deck(before, "before")
    others = several(decks, "decks", (Deck, str, os.PathLike), "several decks")
    return matrix([diff(base, each, tolerance=tolerance, strict=strict).differences for each in others])


def export(deck: GivenDeck, *, to: Literal["moordyn", "orcaflex"], name: str = "", rest_shape: bool = False) -> Export:
    """Return seabed, line and soil of a deck as the input of another program.

    Args:
        deck: a deck, or its file.
        to: "moordyn" or "orcaflex".
        name: name of the main file; if empty that of the deck, with the suffix of the program.
        rest_shape: export the resting shape, and its points as NAME-rest.csv; a line without one keeps its coordinates.

    Raises:
        DeckError: the deck has errors on which the model depends, or no line has a resting shape.
    """
    from mudline.tools.exporting.line_model import build  # noqa: PLC0415 - as above
    from mudline.tools.exporting.report import Export  # noqa: PLC0415 - as above
    from mudline.tools.touchdown_study import rest_shape as resting  # noqa: PLC0415 - as above

    expect_word(to, "to", ("moordyn", "orcaflex"), "'moordyn' or 'orcaflex'")
    expect(name, "name", str, "a str")
    expect(rest_shape, "rest_shape", bool, "True or False")
    given = given_deck(deck)
    file = given_path(name, name="name").name if name else Path(given.file).stem + _SUFFIX[to]
    with naming_causes(given):
        scene = scenes.resolve(given.alone.placed()).require_evaluable()
    rest = resting.rest_shape(scene) if rest_shape else None
    model = build(scene, None if rest is None else rest.places(scene))
    files: dict[str, str] = import_module(f"mudline.tools.exporting.{to}").write(model, file)
    if rest is None:
        return Export(files, model.report)
    nodes = model.line_nodes()
    rows = zip(scene.node_ids[nodes].tolist(), *model.places[nodes].T.tolist(), strict=True)
    table = "".join(csv_lines([("node", "x (m)", "y (m)", "z (m)"), *rows]))
    return Export({**files, f"{Path(file).stem}-rest.csv": table}, model.report, tuple(rest.sentences(scene.units)))


_SUFFIX = {"moordyn": ".txt", "orcaflex": ".yml"}


def study(
    deck: GivenDeck,
    *,
    only: Iterable[str] = (),
    heave: float | None = None,
    period: float | None = None,
    tracked: Callable[[Sequence[str]], Iterable[str]] = iter,
) -> Study:
    """Return the study of a deck's touchdown zone: errors over run time, stiff and extreme cases, recommended settings.

    Args:
        deck: a deck, or its file.
        only: some of "accuracy", "stability" and "pruning"; all if empty.
        heave: amplitude of the hang-off in the deck's units, in place of that of its waves.
        period: period of the motion, in place of that of its waves.
        tracked: iterates over the names of the parts and shows progress, as `tqdm` does.

    Raises:
        DeckError: the deck has errors, or cannot be evaluated. `.advice.text` says why a deck has no touchdown zone.
        ValueError: `only` names no part, or an amplitude or a period is not above 0.
    """
    from mudline.tools.touchdown_study import study as studies  # noqa: PLC0415 - as above

    expect(tracked, "tracked", Callable, "a function of the names of the parts")  # type: ignore[arg-type]  # it is one
    given = given_deck(deck)
    parts = several(only, "only", str, "several str")
    for part in parts:
        expect_word(part, "only", studies.PARTS, "of accuracy, stability and pruning")
    for name, value in (("heave", heave), ("period", period)):
        if value is not None:
            expect_number(value, name)
    with naming_causes(given):
        resolved = scenes.resolve(given.alone.placed()).require()
        return studies.study(resolved, parts or studies.PARTS, heave=heave, period=period, tracked=tracked)


def report(  # noqa: PLR0913 - as many as the command has options
    decks: GivenDeck | Iterable[GivenDeck],
    path: str | os.PathLike[str],
    *,
    sections: Iterable[str] = (),
    rest_shape: bool = False,
    title: str | None = None,
    document: str | None = None,
    revision: str | None = None,
    fields: Mapping[str, str] | None = None,
    date: str | None = None,
    template: str | os.PathLike[str] | None = None,
    logo: str | os.PathLike[str] | None = None,
) -> list[dict[str, Any]]:
    """Write a page about a deck to be signed, or an index with a page for each deck. Return the rows of the index.

    Args:
        decks: a deck, its file or a folder searched for decks; or several of them.
        path: the page; for several decks or a folder the index, with the pages in a folder next to it.
        sections: some of verdict, findings, inputs, model, curves, contact, study and plan; all but study if empty.
        rest_shape: evaluate contact at the resting shape, not at the deck's own coordinates.
        title: title of the page, in place of the deck's own.
        document: number of the document.
        revision: revision of the document.
        date: date of the document.
        fields: further entries of the head, by name.
        template: a jinja2 template, which may extend "page.html".
        logo: a picture for the head, .svg or .png.

    Raises:
        OSError: a file or a folder cannot be read or written, or a folder has no deck.
        ImportError: the extra mudline[report] is not installed.
        ValueError: `sections` names none, a template or logo or a configuration cannot be used.
    """
    from mudline.checks.settings import nearest_settings  # noqa: PLC0415 - as above
    from mudline.tools.reporting import content, pages  # noqa: PLC0415 - as above

    names = several(sections, "sections", str, "several str")
    for name in names:
        expect_word(name, "sections", content.SECTIONS, f"of {', '.join(content.SECTIONS)}")
    expect(rest_shape, "rest_shape", bool, "True or False")
    expect(fields, "fields", (Mapping, NoneType), "texts by name")
    for name, value in (("title", title), ("document", document), ("revision", revision), ("date", date)):
        expect(value, name, (str, NoneType), "a str")
    head = content.PageHead(title, document, revision, date, tuple((fields or {}).items()))
    pictures = ((template, "template"), (logo, "logo"))
    look = content.Look(*(None if file is None else given_path(file, name=name) for file, name in pictures))
    choice = (tuple(names) or content.BY_DEFAULT, head, look, rest_shape)
    alone = [decks] if isinstance(decks, Deck | str | os.PathLike) else None
    listed: list[GivenDeck] = alone or several(
        decks, "decks", (Deck, str, os.PathLike), "decks, or their files or folders"
    )
    inputs: list[content.DeckFile] = []
    many = len(listed) > 1
    for each in listed:
        if isinstance(each, Deck):
            inputs.append(content.DeckFile(content_as(each, each.file), each.file, each.folder))
        else:
            place = given_path(each, "save it to a file", name="decks")
            inputs += [content.DeckFile(file.read_bytes(), file.as_posix(), file.parent) for file in decks_in(place)]
            many = many or place.is_dir()
    if not inputs:
        raise ValueError("decks must be one or more, not none")
    written = pages.Pages(given_path(path), lambda file, text: write_atomically(file, text.encode()), several=many)
    settings = nearest_settings()
    for item in inputs:
        written.add(pages.make_page(item, settings.of(item.name), choice), item.name)
    written.finish(look)
    return written.rows
