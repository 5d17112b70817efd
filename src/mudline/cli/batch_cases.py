"""Decks of a batch: names below the common folder, positions, evaluation in any process, and the table of all."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path, PurePosixPath
from string import Formatter
from typing import NamedTuple

import click

from mudline.basics.display import Cell, DisplayColumn, DisplayTable, Value, text
from mudline.basics.files import reason, recording_looks
from mudline.basics.quantities import shown
from mudline.basics.short_repr import counted
from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.inputs import Input
from mudline.cli.result_files import beside, result_files
from mudline.cli.streams import UnwrittenError, refusing
from mudline.cli.view import View
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Diagnostic
from mudline.model.results.cases import CASES, CaseSummary, case_summary
from mudline.model.results.forms import TABLES
from mudline.model.results.series import SeriesSummary
from mudline.model.results.warnings import ContactWarning, ContactWatch
from mudline.tools.running.remembered import state

SUMMARY = "summary"
"""Name, without suffix, of the file with the rows of all decks."""

_POSITIONS = (".csv", ".npz", ".npy")
_FIELDS = ("name", "folder")


@dataclass(frozen=True, slots=True)
class BatchCase:
    """A deck of a batch.

    Attributes:
        file: the deck.
        inside: its path below the common folder of all decks, with `/`.
        results: the files of its results below the folder of all results, with `/`; the elements first.
    """

    file: Input
    inside: str
    results: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name of the file without its suffix."""
        return PurePosixPath(self.inside).stem


def named_cases(files: Sequence[Input], form: str, tables: Sequence[str] = TABLES) -> tuple[str, list[BatchCase]]:
    """Return the common folder of the decks, and a case for each deck.

    A result file has the name of the deck without its suffix. Decks that differ only in their suffix keep it.
    """
    paths = [os.path.abspath(file.place) for file in files]  # noqa: PTH100 - links stay what they are called
    try:
        common = os.path.commonpath([os.path.dirname(path) for path in paths])  # noqa: PTH120 - as above
    except ValueError as error:
        raise click.UsageError("the decks have no common folder: run mudline batch for each drive") from error
    inside = [Path(os.path.relpath(path, common)).as_posix() for path in paths]
    plain = [str(PurePosixPath(name).with_suffix("")) for name in inside]
    short, whole = ([_results(f"{stem}.{form}", tables) for stem in stems] for stems in (plain, inside))
    counts = Counter(result.casefold() for results in short for result in results)
    counts.update([f"{SUMMARY}.{form}"])
    return common, [
        BatchCase(file, name, results if all(counts[result.casefold()] == 1 for result in results) else longer)
        for file, name, results, longer in zip(files, inside, short, whole, strict=True)
    ]


def _results(path: str, tables: Sequence[str]) -> tuple[str, ...]:
    return (path, *(file.as_posix() for file in beside(Path(path), tables).values()))


# ------------------------------------------------------------------------------------------------------ positions


def check_positions(given: str | None) -> None:
    """Raise click.ClickException for a pattern with unknown fields, and for a missing file."""
    if given is None or Path(given).exists():
        return
    with refusing(ValueError, before=f"--positions {given}: not a pattern: "):
        names = {name for _, name, _, _ in Formatter().parse(given) if name is not None}
    if unknown := sorted(names - set(_FIELDS)):
        raise click.UsageError(f"--positions: {{{unknown[0]}}} is unknown: use {{name}} or {{folder}}")
    if not names:
        raise click.ClickException(f"{given}: no such file or directory")


def positions_of(case: BatchCase, given: str | None) -> str | None:
    """Return the positions file of a deck: the same for all, from a pattern, from a folder, or None.

    Raises click.ClickException if there is none or more than one, and OSError.
    """
    if given is None or Path(given).is_file():
        return given
    if Path(given).is_dir():
        return _in_folder(case, given)
    folder = os.path.dirname(case.file.place) or "."  # noqa: PTH120 - as it was given
    path = given.replace("{name}", case.name).replace("{folder}", folder)
    if not Path(path).is_file():
        raise click.ClickException(f"its positions were not found: {path}")
    return path


def _in_folder(case: BatchCase, folder: str) -> str:
    """Return the file named as the deck, from the deck's subfolder of the positions folder or from its top."""
    stem = str(PurePosixPath(case.inside).with_suffix(""))
    for start in dict.fromkeys((stem, case.name)):
        files = [path.as_posix() for end in _POSITIONS if (path := Path(folder, f"{start}{end}")).is_file()]
        if len(files) > 1:
            raise click.ClickException(f"several files of positions: {', '.join(files)}")
        if files:
            return files[0]
    ends = f"{', '.join(_POSITIONS[:-1])} or {_POSITIONS[-1]}"
    raise click.ClickException(f"its positions were not found: {Path(folder, stem).as_posix()} with {ends}")


# -------------------------------------------------------------------------------------------------------- evaluated


class Order(NamedTuple):
    """A deck to evaluate, with all data that a process needs; `output` is the folder of all results."""

    case: BatchCase
    data: bytes
    inputs: EvaluateInputs
    output: Path
    units: str | None

    def from_anywhere(self) -> Order:
        """Return the order for a worker with another working folder; the files have the same absolute paths there."""
        file, given = self.case.file, self.inputs
        positions, elements = (path and os.path.abspath(path) for path in (given.positions, given.elements))  # noqa: PTH100 - links stay what they are called
        return self._replace(
            case=replace(self.case, file=file._replace(path=os.path.abspath(file.place))),  # noqa: PTH100 - as above
            inputs=replace(given, positions=positions, elements=elements),
            output=self.output.absolute(),
        )


class Done(NamedTuple):
    """Result of a deck.

    Attributes:
        row: the row of the summary.
        warnings: codes and texts of its warnings.
        written: states of its result files, by paths relative to the output folder.
        read: files that the deck names.
    """

    row: CaseSummary
    warnings: Sequence[tuple[str, str]] = ()
    written: Mapping[str, str] = {}
    read: Sequence[str] = ()


def evaluate_case(order: Order) -> Done:
    """Evaluate a deck and write its results; a deck that fails has a row with the reason, and no results.

    If results cannot be written, those of an earlier run remain.
    """
    name = order.case.file.name
    with recording_looks() as looked_at:
        try:
            row, warnings, written = _evaluated(order)
        except DeckError as error:
            why = _reason(error.diagnostics, name)
        except UnwrittenError as error:
            return failed(name, error.message)
        except click.ClickException as error:
            why = error.message
        except OSError as error:
            why = reason(error)
        else:
            return Done(row, [(each.diagnostic.code, str(each)) for each in warnings], written, list(looked_at))
    for result in order.case.results:
        with suppress(OSError):
            (order.output / result).unlink()
    return failed(name, why)


def failed(name: str, why: str) -> Done:
    """Return the result of a deck that cannot be evaluated."""
    return Done(CaseSummary(name, "failed", why))


def _evaluated(order: Order) -> tuple[CaseSummary, list[ContactWarning], dict[str, str]]:
    """Return row, warnings, states of the result files; raises DeckError, click.ClickException, OSError."""
    file = order.case.file
    deck = load_bytes(order.data, file.name, units=order.units, folder=file.folder)
    evaluation = order.inputs.evaluation(deck)
    path = order.output / order.case.results[0]
    path.parent.mkdir(parents=True, exist_ok=True)
    watch = ContactWatch(evaluation)
    series, only = SeriesSummary(evaluation, "case"), order.inputs.summary_only
    with result_files(evaluation, path, View(quiet=True), summary_only=only, synced=False) as sink:
        evaluation.run([series, watch, sink])
        warnings = watch.warnings()
        sink.finish(warnings)
    states = {result: state(str(order.output / result)) for result in order.case.results}
    return case_summary(series, file.name, warnings, order.case.results[0]), warnings, states


def _reason(diagnostics: Sequence[Diagnostic], name: str) -> str:
    """Return the first of the diagnostics, and the count of the others."""
    first = diagnostics[0]
    place = f"line {first.line}" if first.file == name else f"{first.file}:{first.line}"
    more = f" ({len(diagnostics) - 1} more)" if len(diagnostics) > 1 else ""
    return f"{place}: {first.code} {first.message}{more}"


# ----------------------------------------------------------------------------------------------------- the table of all

_DIGITS = 5
_SHORT = 24
"""Letters of a name that is never wrapped."""
_LARGE = 1e7
"""Limit above which numbers have an exponent."""


def print_cases(ranked: Sequence[CaseSummary], folder: str, names: Mapping[str, str], view: View) -> None:
    """Print the failed decks and then the others, with their `names` below a folder; -v prints all."""
    printer = view.printer()
    failed = [row for row in ranked if row.failed]
    evaluated = ranked[len(failed) :]
    where = f" in {inside}" if (inside := _inside(folder)) else ""
    short = all(len(names[row.deck]) <= _SHORT for row in ranked)
    deck = text("deck", lambda row: names[row.deck], whole=short)
    if failed:
        printer.table(DisplayTable(f"Failed{where}", [deck, text("reason", "reason")], failed).first(view.most, "deck"))
    if evaluated:
        title, columns = f"Contact of {counted(len(evaluated), 'deck')}{where}", _columns(evaluated[: view.most])
        printer.table(DisplayTable(title, [deck, *columns], evaluated).first(view.most, "deck"))
    doubtful = sum(bool(row.warnings) for row in evaluated)
    parts = [f"{counted(len(ranked), 'deck')}: {len(evaluated)} evaluated"]
    parts += [f"{doubtful} with warnings"] if doubtful else []
    parts += [f"{len(failed)} failed"] if failed else []
    printer.line((", ".join(parts), "bold red" if failed else "green"))


def _inside(folder: str) -> str:
    """Return a folder relative to the working folder; "" for the working folder itself."""
    place, here = Path(folder), Path.cwd()
    if place == here:
        return ""
    return (place.relative_to(here) if place.is_relative_to(here) else place).as_posix()


def _columns(listed: Sequence[CaseSummary]) -> Iterator[DisplayColumn]:
    """Yield the columns of the evaluated decks with a heading; units and steps only where decks differ in them."""
    systems = {row.units for row in listed}
    units = listed[0].units or "user" if len(systems) == 1 else "user"
    shown_names = {name for name, quantity in CASES.items() if quantity.heading}
    shown_names |= {"units"} if len(systems) > 1 else set()
    shown_names |= {"steps"} if any(row.steps != 1 for row in listed) else set()
    if all(row.submerged_weight == row.empty_weight for row in listed):
        shown_names.remove("empty_weight")
    for name, quantity in CASES.items():
        if name in shown_names:
            value = _VALUES.get(name, partial(_shortened, name))
            yield quantity.column(units, value, optional=True)


def _shortened(name: str, row: CaseSummary) -> Cell:
    cell: Cell = getattr(row, name)
    return _number(cell) if isinstance(cell, float) else cell


def _touchdown(row: CaseSummary) -> str:
    """Return the range of arc lengths of the touchdown points; "all" or "none" for a line without touchdown point."""
    if row.touchdown_from is None:
        return "all" if row.contact_length else "none"
    low, high = _number(row.touchdown_from), _number(row.touchdown_to)
    return low if low == high else f"{low} to {high}"


def _number(value: float | None) -> str:
    """Return a number with few digits, without an exponent below 1e7."""
    short = shown(value, _DIGITS)
    return f"{value:.0f}" if value is not None and "e+" in short and abs(value) < _LARGE else short


_VALUES: dict[str, Value] = {
    "touchdown_from": _touchdown,
    "contact_length": lambda row: _number(row.contact_length) if row.contact_length else "",
    "warnings": lambda row: row.warnings or "",
}
"""Cells that are not the value of a row."""
