"""A deck among many: its name below the common folder, its positions, its evaluation in any process, and its row."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from string import Formatter
from typing import NamedTuple

import click

from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.inputs import Input
from mudline.cli.known_results import Kept
from mudline.cli.result_files import behind, beside, line_watch, result_files, suffix
from mudline.cli.streams import reason
from mudline.cli.view import View
from mudline.contact.result import Part
from mudline.deck.loading import load_bytes
from mudline.diagnostics import DeckError, Diagnostic
from mudline.files import recording_looks
from mudline.results.cases import CaseSummary, CaseWatch
from mudline.results.forms import ResultConsumer, form_module
from mudline.results.warnings import ContactWatch

SUMMARY = "summary"
"""The name, without its suffix, of the file with the rows of all decks."""

_POSITIONS = (".csv", ".npz", ".npy")
_FIELDS = ("name", "folder")


@dataclass(frozen=True, slots=True)
class Case:
    """A deck among many; `inside` is its path below the folder that all have in common, with `/`."""

    file: Input
    inside: str
    result: str = ""
    """The file of its results below the folder of all results, with `/`; "" where none is written."""

    @property
    def name(self) -> str:
        """The name of the file without its suffix."""
        return PurePosixPath(self.inside).stem


def named_cases(files: Sequence[Input], form: str) -> tuple[str, list[Case]]:
    """The common folder of decks, and a case for each; with a form each has a file of results of its own.

    Such a file is called as the deck without its suffix; decks of one name with different suffixes keep theirs.
    """
    paths = [os.path.abspath(file.path or file.name) for file in files]  # noqa: PTH100 - links stay what they are called
    try:
        common = os.path.commonpath([os.path.dirname(path) for path in paths])  # noqa: PTH120 - as above
    except ValueError:  # on several drives
        common = ""
    inside = [_inside(path, common) for path in paths]
    cases = [Case(file, name) for file, name in zip(files, inside, strict=True)]
    if not form:
        return common, cases
    plain = [str(PurePosixPath(name).with_suffix("")) for name in inside]
    counts = Counter(name.casefold() for stem in plain for name in (stem, *_others(stem, form)))
    counts.update([SUMMARY])
    stems = [
        stem if all(counts[one.casefold()] == 1 for one in (stem, *_others(stem, form))) else name
        for stem, name in zip(plain, inside, strict=True)
    ]
    return common, [Case(case.file, case.inside, f"{stem}.{form}") for case, stem in zip(cases, stems, strict=True)]


def _inside(path: str, common: str) -> str:
    """A path below a folder; of another drive, below a folder with the name of the drive."""
    if common:
        return Path(os.path.relpath(path, common)).as_posix()
    found = Path(path)
    return PurePosixPath(found.drive.strip(":\\/") or "root", *found.parts[1:]).as_posix()


def _others(stem: str, form: str) -> list[str]:
    return [f"{stem}-{table}" for table in form_module(form).BESIDE]


class MissingPositionsError(Exception):
    """A deck has no file of positions, or several."""


@dataclass(frozen=True, slots=True)
class PositionFiles:
    """Which file of positions a deck has: one for all, one by a pattern, one of a folder, or none."""

    given: str | None

    def check(self) -> None:
        """Refuse a pattern with unknown fields, and a file that is not there; raises click.ClickException."""
        if self.given is None or Path(self.given).exists():
            return
        try:
            names = {name for _, name, _, _ in Formatter().parse(self.given) if name is not None}
        except ValueError as error:
            raise click.UsageError(f"--positions {self.given}: not a pattern: {error}") from error
        if unknown := sorted(names - set(_FIELDS)):
            raise click.UsageError(f"--positions: {{{unknown[0]}}} is unknown: use {{name}} or {{folder}}")
        if not names:
            raise click.ClickException(f"{self.given}: no such file or directory")

    def of(self, case: Case) -> str | None:
        """The file of a deck; raises MissingPositionsError."""
        if self.given is None or Path(self.given).is_file():
            return self.given
        if Path(self.given).is_dir():
            return self._in_folder(case, Path(self.given))
        folder = os.path.dirname(case.file.path or case.file.name) or "."  # noqa: PTH120 - as it was given
        path = self.given.replace("{name}", case.name).replace("{folder}", folder)
        if not Path(path).is_file():
            raise MissingPositionsError(f"its positions are not there: {path}")
        return path

    def _in_folder(self, case: Case, folder: Path) -> str:
        """The file with the name of the deck: in the folder that the deck is in below the common one, or at the top."""
        stem = PurePosixPath(case.inside).with_suffix("")
        for start in dict.fromkeys((folder / stem, folder / case.name)):
            found = [path for end in _POSITIONS if (path := start.with_name(start.name + end)).is_file()]
            if len(found) > 1:
                raise MissingPositionsError(
                    f"several files of positions: {', '.join(path.as_posix() for path in found)}"
                )
            if found:
                return found[0].as_posix()
        ends = f"{', '.join(_POSITIONS[:-1])} or {_POSITIONS[-1]}"
        raise MissingPositionsError(f"its positions are not there: {(folder / stem).as_posix()} with {ends}")


# ------------------------------------------------------------------------------------------------------------ evaluated


class Order(NamedTuple):
    """A deck that is to be evaluated: everything that a process needs."""

    file: Input
    data: bytes
    positions: str | None
    result: str
    folder: str | None
    inputs: EvaluateInputs
    units: str | None
    as_text: bool


class Done(NamedTuple):
    """What evaluating a deck gave: its row and warnings, the files it depends on, and those with its results."""

    kept: Kept
    read: tuple[str, ...] = ()
    written: tuple[Path, ...] = ()


def evaluate_case(order: Order) -> Done:
    """Evaluate a deck and write its results; one that fails has a row with the reason."""
    name = order.file.name
    path = None if order.folder is None else Path(order.folder, order.result)
    with recording_looks() as looked_at:
        try:
            kept = _kept(order, path)
        except DeckError as error:
            return Done(failed(name, _reason(error.diagnostics, name)))
        except (click.ClickException, OSError) as error:
            return Done(failed(name, error.message if isinstance(error, click.ClickException) else reason(error)))
    read = [*looked_at, *(one for one in (order.positions, order.inputs.elements) if one)]
    written = () if path is None else (path, *beside(path).values())
    return Done(kept, tuple(read), written)


def _kept(order: Order, path: Path | None) -> Kept:
    """Evaluate a deck; raises DeckError, click.ClickException, OSError."""
    deck = load_bytes(order.data, order.file.name, units=order.units, folder=order.file.folder)
    evaluation = order.inputs.evaluation(deck, order.positions)
    case, watch = CaseWatch(evaluation), ContactWatch.of(evaluation)
    consumers: list[ResultConsumer] = [case, watch]
    if path is None:
        _run(evaluation.parts(), consumers)
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        quiet, elements = View(quiet=True), evaluation.element_table()
        lines = line_watch(evaluation, suffix(path), None)
        consumers += [] if lines is None else [lines]
        with result_files(evaluation, elements, path, quiet, as_text=order.as_text, synced=False) as sink:
            _run(evaluation.parts(), [*consumers, sink])
            sink.finish(behind(evaluation, watch.warnings(), None, lines))
    warnings = watch.warnings()
    row = case.summary(order.file.name, warnings, order.result or None)
    return Kept(row, tuple((one.diagnostic.code, str(one)) for one in warnings))


def failed(name: str, why: str) -> Kept:
    """The row of a deck that cannot be evaluated."""
    return Kept(CaseSummary(name, "failed", why), ())


def _run(parts: Iterable[Part], consumers: Sequence[ResultConsumer]) -> None:
    for part in parts:
        for consumer in consumers:
            consumer.take(part)


def _reason(found: Sequence[Diagnostic], name: str) -> str:
    """The first of the diagnostics, and how many more there are."""
    first = found[0]
    place = f"line {first.line}" if first.file == name else f"{first.file}:{first.line}"
    more = f" ({len(found) - 1} more)" if len(found) > 1 else ""
    return f"{place}: {first.code} {first.message}{more}"
