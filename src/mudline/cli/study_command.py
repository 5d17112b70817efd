"""`mudline study`."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterator
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mudline.cli import DONE, WRONG_USAGE, options
from mudline.cli.inputs import GivenDeck, refuses_bad_decks
from mudline.cli.streams import emit, emit_json, notify, notify_missing, write_text, writing
from mudline.cli.view import View, tracked
from mudline.files import suffix_of
from mudline.linting.engine import naming_causes
from mudline.linting.output import visible
from mudline.quantities import csv_lines, headed, shown, unit_names
from mudline.scene.model import resolve
from mudline.short_repr import cut
from mudline.study import PARTS, Study, jump_note, study

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

_PICTURES = ("png", "svg")
_WIDTH = 100
_MOST_CONTACTS, _MOST_NOTES, _MOST_FAILURES = 8, 3, 5
_NAME, _WHY = 34, 90
"""Columns of the name of a contact and of the reason of a stage, which is folded."""
_DIGITS = 3


@options.command("study")
@options.deck
@options.option("--only", multiple=True, type=click.Choice(PARTS), help="Study this part alone; repeatable.")
@options.option(
    "--plot",
    metavar=f"FILE.{'|'.join(_PICTURES)}",
    help="Draw error against run time, with the deck's own step (needs the extra mudline[plot]).",
)
@options.option("-o", "--output", metavar="FILE.json", help="Write the study as JSON into this file.")
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    deck: str,
    only: tuple[str, ...],
    plot: str | None,
    output: str | None,
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Measure what accuracy costs on a deck, which steps are stable, and what the deck does not need.

    precision: error against run time of three schemes on the deck's stiffest contacts. stability: critical steps, the
    largest steps at which landings keep their speed, and extreme values. pruning: what the stages of the evaluation
    take, and what those would add that the deck does not have.
    """
    for path, option, forms in ((plot, "--plot", _PICTURES), (output, "-o", ("json",))):
        if path is not None and suffix_of(path) not in forms:
            names = " or ".join(f".{form}" for form in forms)
            raise click.UsageError(f"{option} {path}: unknown file format: give a name ending in {names}")
    if plot and find_spec("matplotlib") is None:
        notify_missing("--plot", "matplotlib", "plot")
        return WRONG_USAGE
    given = GivenDeck(deck, stdin_name, units).load()
    with naming_causes(given):
        scene = resolve(given).require()
    found = study(scene, only or PARTS, draw=plot is not None, tracked=lambda parts: tracked(parts, view))
    if plot:
        _plot(found, Path(plot), view)
    if output:
        write_text(Path(output), [json.dumps(found.json(), indent=1, ensure_ascii=False, allow_nan=False), "\n"])
        if not view.quiet:
            notify(f"study -> {Path(output).as_posix()}")
    if output_format == "json":
        emit_json(found.json())
    elif output_format == "csv":
        emit(_csv(found.json()))
    elif not (output and view.quiet):
        _print(found, view.printer())
    return DONE


def _plot(found: Study, path: Path, view: View) -> None:
    if found.drawn is None or not found.drawn.curves:
        notify("--plot: there is nothing to draw, as no contact of this deck has a motion")
        return
    from mudline.study.picture import draw  # noqa: PLC0415 - needs the extra `plot`

    with writing(path) as stream:
        draw(found, suffix_of(path), stream, visible)
    if not view.quiet:
        notify(f"plot -> {path.as_posix()}")


def _csv(whole: dict[str, Any]) -> Iterator[str]:
    """The tables of the parts, each under its heading, with an empty line between them."""
    failed = whole["extremes"]["failed"] if whole["extremes"] else None
    tables = [rows for rows in (whole["precision"], whole["stability"], failed, whole["stages"]) if rows]
    for number, rows in enumerate(tables):
        lines = [_flat(row) for row in rows]
        yield from ["\n"] * (number > 0)
        yield from csv_lines(chain([list(lines[0])], (list(line.values()) for line in lines)))


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """A row without rows inside it."""
    jump = row.pop("without_jump", ...)
    if jump is not ...:
        row |= {f"without_jump_{name}": jump and jump[name] for name in ("step", "deck_line")}
    return row


# ----------------------------------------------------------------------------------------------------------- the screen


def _print(found: Study, printer: Printer) -> None:
    if found.advice.text and not any(found.advice.text in notes for notes in found.notes.values()):
        _paragraph(printer, found.advice.text, "bold")
        printer.line("")
    for part, table in (("precision", _print_precision), ("stability", _print_stability), ("pruning", _print_stages)):
        if part in found.notes and (part != "precision" or found.precision is not None):
            table(found, printer)


def _paragraph(printer: Printer, text: str, style: str = "", indent: str = "") -> None:
    width = min(printer.width, _WIDTH)
    for line in textwrap.wrap(printer.visible(text), width, subsequent_indent=indent, break_on_hyphens=False):
        printer.line((line, style), fold=False)


def _print_notes(found: Study, part: str, printer: Printer) -> None:
    notes = found.notes[part]
    for note in notes[:_MOST_NOTES]:
        _paragraph(printer, note, "dim")
    if len(notes) > _MOST_NOTES:
        printer.line((f"{len(notes) - _MOST_NOTES} more such reasons", "dim"))
    if notes:
        printer.line("")


def _at_own(found: Study) -> str:
    """The heading of what the deck's own step does; "" without one."""
    if found.own is None:
        return ""
    return f"at {shown(found.own.step * (1e3 if found.step_unit else 1.0))} {found.step_unit}".rstrip()


def _number(value: float) -> str:
    """Three digits, as people write them."""
    if 1e3 <= value < 1e4:
        return f"{value:.0f}"
    return shown(value, _DIGITS).replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def _name(contact: str) -> str:
    """The name of a contact without the word for its law, which its line shows."""
    return cut(contact.removeprefix("curve:"), _NAME)


def _print_precision(found: Study, printer: Printer) -> None:
    """A line for each motion and scheme; a motion is named in its first."""
    precision, unit = found.precision, found.step_unit
    rows = [] if precision is None else precision.rows
    cells, last = [], ""
    for one, tenth in zip(rows[::2], rows[1::2], strict=True):
        name = "" if one.contact == last else _name(one.contact)
        last = one.contact
        pairs = [(found.milliseconds(row.step), _micro(row.run_time)) for row in (one, tenth)]
        own = "diverges" if one.error_at_own_step is None else f"{_number(100.0 * one.error_at_own_step)} %"
        cells.append((name, one.scheme, *pairs[0], *pairs[1], *([own] if found.own else [])))
    names = ["contact", "scheme", headed("step,\n1 %", unit), "run time\n[us per s]"]
    names += [
        headed("step,\n0.1 %", unit),
        "run\ntime",
        *([f"error\n{_at_own(found)}"] if found.own else []),
    ]
    if cells:
        title = "Error of speed, duration and largest force, relative to the exact ones, against run time"
        printer.table(title, names, cells, left=names[:2])
    _print_notes(found, "precision", printer)


def _micro(seconds: float | None) -> str:
    return "-" if seconds is None else _number(1e6 * seconds)


def _print_stability(found: Study, printer: Printer) -> None:
    judged, units = found.stability or [], unit_names(found.units)
    mass = {"metric": "kg/m", "imperial": "slug/ft"}.get(found.units, "")
    names = ["contact", "deck line", headed("stiffness", units.stiffness), headed("mass", mass)]
    names += [headed("explicit", found.step_unit), headed("landings\nwithin 1 %", found.step_unit)]
    names += [_at_own(found)] if found.own else []
    files = {one.row.file for one in judged}
    elsewhere = len(files) == 1 and not found.deck.endswith(next(iter(files)))
    cells = []
    for row, words in judged[:_MOST_CONTACTS]:
        line = str(row.deck_line) if len(files) == 1 else f"{row.file}:{row.deck_line}"
        landing = f"{found.milliseconds(row.landing_step)}{' (jump)' if row.jump else ''}"
        numbers = (_number(row.stiffness), _number(row.mass), found.milliseconds(row.explicit_step))
        cells.append((_name(row.contact), line, *numbers, landing, *([words] if found.own else [])))
    if cells:
        more = len(judged) - len(cells)
        note = [f"Lines are those of {next(iter(files))}."] if elsewhere else []
        note += [f"{more} more contacts have larger critical steps; JSON has all."] if more else []
        left = [names[0], *names[6:]]
        printer.table(
            "Stable steps of velocity Verlet (explicit), and of landings with HHT (-0.3)",
            names,
            cells,
            left=left,
            note=" ".join(note),
        )
    for one in judged[:_MOST_NOTES]:
        if one.row.jump:
            _paragraph(printer, jump_note(found, one.row))
            printer.line("")
    _print_extremes(found, printer)
    _print_notes(found, "stability", printer)


def _print_extremes(found: Study, printer: Printer) -> None:
    extremes = found.extremes
    if extremes is None or not extremes.tried:
        return
    counts = f"Extremes of this deck: {extremes.held} of {extremes.tried} held ({', '.join(extremes.cases)})"
    _paragraph(printer, counts)
    for failure in extremes.failed[:_MOST_FAILURES]:
        place = f"line {failure.deck_line} of {failure.file}"
        _paragraph(printer, f"  {failure.case} ({place}): {failure.message}", "red", indent="    ")
    if len(extremes.failed) > _MOST_FAILURES:
        printer.line(f"  {len(extremes.failed) - _MOST_FAILURES} more failed: JSON has all")
    printer.line("")


def _print_stages(found: Study, printer: Printer) -> None:
    pruning = found.stages
    if pruning is None:
        return
    cells = []
    for row in pruning.rows:
        share = "" if row.share is None else f"{100.0 * row.share:.0f} %"
        optional = row.stage not in {"floor", "normal law"} and row.time is not None
        without = _time(pruning.step - row.time) if optional and row.time is not None else ""
        if row.cost_if_added is not None:
            without = f"+ {_time(row.cost_if_added)} a node"
        why = cut(row.why.partition(";")[0].partition(" (inferred)")[0], _WHY)
        line = "" if row.deck_line is None else str(row.deck_line)
        cells.append((row.stage, "yes" if row.active else "no", line, share, without, why))
    names = ("stage", "in", "deck line", "share", "without it", "why")
    title = f"What the deck needs: a step of {pruning.elements} elements takes {_time(pruning.step)}"
    printer.table(title, names, cells, left=("stage", "in", "why"))
    _print_notes(found, "pruning", printer)


def _time(seconds: float) -> str:
    """A time with its unit, to three digits."""
    for scale, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "us")):
        if seconds * scale >= 1.0:
            return f"{shown(seconds * scale, _DIGITS)} {unit}"
    return f"{shown(seconds * 1e9, _DIGITS)} ns"
