"""A deck among many: its name below the common folder, its positions, its evaluation in any process; table of all."""

from __future__ import annotations

import os
import textwrap
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from string import Formatter
from typing import TYPE_CHECKING, NamedTuple

import click

from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.evaluate_one import MOST_ROWS
from mudline.cli.inputs import Input
from mudline.cli.known_results import Kept
from mudline.cli.result_files import behind, beside, line_watch, result_files, write_tables
from mudline.cli.streams import counted, reason
from mudline.cli.view import View
from mudline.cluster.storage import exists, is_folder, join, resolved
from mudline.contact.result import Part
from mudline.deck.loading import load_bytes
from mudline.diagnostics import DeckError, Diagnostic
from mudline.files import is_url, recording_looks, suffix_of
from mudline.quantities import CASES, shown
from mudline.results.cases import CaseSummary, CaseWatch
from mudline.results.forms import FORMS, ResultConsumer
from mudline.results.series import SeriesSummary, series_tables
from mudline.results.warnings import ContactWatch

if TYPE_CHECKING:
    from mudline.cli.printing import Printer


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
    if all(is_url(file.path or "") for file in files):
        here = str(Path.cwd())
        common = os.path.relpath(common, here).replace(os.sep, "/").replace(":/", "://", 1)
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
    return [f"{stem}-{table}" for table in FORMS[form].beside]


class MissingPositionsError(Exception):
    """A deck has no file of positions, or several."""


@dataclass(frozen=True, slots=True)
class PositionFiles:
    """Which file of positions a deck has: one for all, one by a pattern, one of a folder, or none."""

    given: str | None

    def check(self) -> None:
        """Refuse a pattern with unknown fields, and a file that is not there; raises click.ClickException."""
        if self.given is None or _there(self.given):
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
        if self.given is None or _is_file(self.given):
            return self.given
        if _there(self.given):
            return self._in_folder(case, self.given)
        folder = os.path.dirname(case.file.path or case.file.name) or "."  # noqa: PTH120 - as it was given
        path = self.given.replace("{name}", case.name).replace("{folder}", folder)
        if not _is_file(path):
            raise MissingPositionsError(f"its positions were not found: {path}")
        return path

    def from_folder(self, folder: str) -> PositionFiles:
        """The same, given in a working folder that may not be this one."""
        if self.given is None or self.given.startswith("{folder}"):
            return self
        return PositionFiles(resolved(self.given, folder))

    def _in_folder(self, case: Case, folder: str) -> str:
        """The file with the name of the deck: in the folder that the deck is in below the common one, or at the top."""
        stem = str(PurePosixPath(case.inside).with_suffix(""))
        for start in dict.fromkeys((join(folder, stem), join(folder, case.name))):
            found = [path for end in _POSITIONS if _is_file(path := start + end)]
            if len(found) > 1:
                raise MissingPositionsError(f"several files of positions: {', '.join(map(slashed, found))}")
            if found:
                return slashed(found[0])
        ends = f"{', '.join(_POSITIONS[:-1])} or {_POSITIONS[-1]}"
        raise MissingPositionsError(f"its positions were not found: {slashed(join(folder, stem))} with {ends}")


def _there(path: str) -> bool:
    return "{" not in path and exists(path) if is_url(path) else Path(path).exists()


def _is_file(path: str) -> bool:
    if not is_url(path):
        return Path(path).is_file()
    return _there(path) and not is_folder(path)


def slashed(path: str) -> str:
    """A path or URL as it is printed, with `/` between folders on every system."""
    return path if is_url(path) else Path(path).as_posix()


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
    summary_only: bool


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
    evaluation = replace(order.inputs, positions=order.positions).evaluation(deck)
    case, watch = CaseWatch(evaluation), ContactWatch.of(evaluation)
    consumers: list[ResultConsumer] = [case, watch]
    if path is None:
        _run(evaluation.parts(), consumers)
    elif order.summary_only:
        if evaluation.time is None:
            raise click.ClickException("--summary-only is for time steps: the positions are one state")
        path.parent.mkdir(parents=True, exist_ok=True)
        series = SeriesSummary(evaluation)
        _run(evaluation.parts(), [*consumers, series])
        write_tables(series_tables(series), path)
    else:
        path.parent.mkdir(parents=True, exist_ok=True)
        quiet, elements = View(quiet=True), evaluation.element_table()
        lines = line_watch(evaluation, suffix_of(path), None)
        consumers += [] if lines is None else [lines]
        with result_files(evaluation, elements, path, quiet, synced=False) as sink:
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


# ------------------------------------------------------------------------------------------------------------ the table

_GAP = "  "
_SHORTEST = 20
"""Columns that a deck's name gets on the narrowest terminal."""
_DIGITS = 5
_LARGE = 1e7
"""Numbers from here on have an exponent."""

Cell = Callable[[CaseSummary], str]


def print_cases(rows: Sequence[CaseSummary], folder: str, names: Mapping[str, str], view: View) -> None:
    """Print a line for each deck, called by its name below the folder; most of many only with -v."""
    if not rows:
        return
    printer = view.printer()
    printer.write(_lines(rows, _title(len(rows), folder), names, printer, all_of=view.verbose))


def _title(count: int, folder: str) -> str:
    if is_url(folder):
        return f"Contact of {counted(count, 'deck')} in {folder}"
    place, here = Path(folder), Path.cwd()
    inside = place.relative_to(here) if place.is_relative_to(here) else place
    return f"Contact of {counted(count, 'deck')}" + (f" in {inside.as_posix()}" if folder and inside.parts else "")


def _lines(
    rows: Sequence[CaseSummary], title: str, names: Mapping[str, str], printer: Printer, *, all_of: bool
) -> Iterator[str]:
    """The table: on a narrow terminal without the columns that are needed least, and with long names shortened."""
    listed = rows if all_of else rows[:MOST_ROWS]
    columns, dropped = _fitting(listed, printer.width)
    cells = {head: [cell(row) for row in listed] for head, cell in columns.items()}
    widths = {head: max(map(len, (*head.split("\n"), *texts))) for head, texts in cells.items()}
    available = max(printer.width - _width(widths), _SHORTEST)
    decks = [printer.elided(names[row.deck], available) for row in listed]
    first = max(map(printer.columns, ("deck", *decks)))
    yield _bold(printer.elided(title, max(printer.width, _SHORTEST)), printer)
    heads = [head.split("\n") for head in widths]
    depth = max(map(len, heads), default=1)
    for line in range(depth):
        parts = [head[line - depth + len(head)] if line >= depth - len(head) else "" for head in heads]
        yield _row("deck" if line == depth - 1 else "", first, parts, widths)
    yield printer.rule * (first + _width(widths))
    for number, (row, deck) in enumerate(zip(listed, decks, strict=True)):
        padding = " " * (first - printer.columns(deck))
        if row.failed:
            yield from _reason_lines(row, f"{deck}{padding}{_GAP}", first, printer)
        else:
            yield _row(deck + padding, first, [texts[number] for texts in cells.values()], widths)
    if left := len(rows) - len(listed):
        yield _dim(f"{counted(left, 'more deck')}: -v shows all", printer)
    if dropped:
        note = f"left out on a narrow terminal: {', '.join(dropped)}"
        yield from (_dim(text, printer) for text in textwrap.wrap(note, max(printer.width, _SHORTEST)))
    yield ""
    yield _total(rows, printer)


def _reason_lines(row: CaseSummary, before: str, first: int, printer: Printer) -> Iterator[str]:
    """A deck that failed and why, in as many lines as that needs."""
    indent = " " * (first + len(_GAP))
    width = max(printer.width - len(indent), _SHORTEST)
    texts = textwrap.wrap(printer.visible(f"failed: {row.reason}"), width, break_on_hyphens=False)
    for number, text in enumerate(texts):
        start = "" if number else click.style("failed", fg="red", bold=True) if printer.colored else "failed"
        yield f"{indent if number else before}{start}{text if number else text.removeprefix('failed')}"


def _fitting(rows: Sequence[CaseSummary], width: int) -> tuple[dict[str, Cell], list[str]]:
    """The columns that fit beside the names, and the names of those that do not."""
    columns, droppable = _columns([row for row in rows if not row.failed])
    dropped = []
    for head in droppable:
        widths = {head: max(map(len, (*head.split("\n"), *map(cell, rows)))) for head, cell in columns.items()}
        if _width(widths) + _SHORTEST <= width:
            break
        del columns[head]
        dropped.append(" ".join(head.split("\n")).split(" [")[0].replace("- ", ""))
    return columns, dropped


def _columns(rows: Sequence[CaseSummary]) -> tuple[dict[str, Cell], list[str]]:
    """The columns by their headings, and those that are left out first on a narrow terminal."""
    systems = {row.units for row in rows}
    units = next(iter(systems)) or "" if len(systems) == 1 else ""

    def head(name: str, label: str = "") -> str:
        quantity = CASES[name]
        unit = quantity.unit_name(units)
        text = label or quantity.label or name
        return f"{text}\n[{unit}]" if unit else text

    def number(name: str) -> Cell:
        return lambda row: _number(getattr(row, name))

    def count(name: str) -> Cell:
        return lambda row: "" if getattr(row, name) is None else str(getattr(row, name))

    optional = ("steps", "in_contact", "largest_force_element", "contact_length")
    cells: dict[str, Cell] = {
        "units": count("units"),
        "steps": count("steps"),
        "in_contact": count("in_contact"),
        "touchdown": _touchdown,
        **{name: number(name) for name in ("contact_length", "largest_force")},
        "largest_force_element": count("largest_force_element"),
        **{name: number(name) for name in ("largest_uplift", "reaction", "ratio")},
        "warnings": lambda row: str(row.warnings or ""),
    }
    unused = {name for name in ("largest_uplift", "warnings") if not any(map(cells[name], rows))}
    unused |= {"steps"} if all(row.steps == 1 for row in rows) else set()
    unused |= {"units"} if len(systems) < 2 else set()
    heads = {
        name: head("touchdown_from", "touchdown\nat") if name == "touchdown" else head(name)
        for name in cells
        if name not in unused
    }
    return {text: cells[name] for name, text in heads.items()}, [heads[name] for name in optional if name in heads]


def _touchdown(row: CaseSummary) -> str:
    """Between which arc lengths the touchdown points are, or that all of the line is on the seabed or above."""
    if row.failed:
        return ""
    if row.touchdown_from is None:
        return "all" if row.contact_length else "none"
    low, high = _number(row.touchdown_from), _number(row.touchdown_to)
    return low if low == high else f"{low} to {high}"


def _number(value: float | None) -> str:
    """A number with few digits; one that is large for that is whole, rather than with an exponent."""
    text = shown(value, _DIGITS)
    return f"{value:.0f}" if value is not None and "e+" in text and abs(value) < _LARGE else text


def _total(rows: Sequence[CaseSummary], printer: Printer) -> str:
    failed, doubtful = sum(row.failed for row in rows), sum(bool(row.warnings) for row in rows)
    parts = [f"{counted(len(rows), 'deck')}: {len(rows) - failed} evaluated"]
    parts += [f"{doubtful} with warnings"] if doubtful else []
    parts += [f"{failed} failed"] if failed else []
    text = ", ".join(parts)
    return click.style(text, fg="red" if failed else "green", bold=bool(failed)) if printer.colored else text


def _width(widths: Mapping[str, int]) -> int:
    """Columns of a line behind the name."""
    return sum(widths.values()) + len(_GAP) * len(widths)


def _row(deck: str, first: int, cells: Sequence[str], widths: Mapping[str, int]) -> str:
    padded = [cell.rjust(width) for cell, width in zip(cells, widths.values(), strict=True)]
    return _GAP.join([deck.ljust(first), *padded]).rstrip()


def _bold(text: str, printer: Printer) -> str:
    return click.style(text, bold=True) if printer.colored else text


def _dim(text: str, printer: Printer) -> str:
    return click.style(text, dim=True) if printer.colored else text
