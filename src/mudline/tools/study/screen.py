"""The study of a deck as people read it: its tables and sentences, for a terminal and for a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mudline.basics.quantities import headed, shown, unit_names
from mudline.basics.short_repr import cut
from mudline.tools.study.report import Study

_MOST_CONTACTS, _MOST_FAILURES = 8, 5
_NAME, _WHY = 34, 90
"""Columns of the name of a contact and of the reason of a stage, which is folded."""
_DIGITS = 3


class ScreenTable(NamedTuple):
    """A table: its title, heads, rows, which of its columns are texts, and a note below it."""

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    left: Sequence[str]
    note: str = ""


def precision_table(found: Study) -> ScreenTable | None:
    """A row for each motion and scheme; a motion is named in its first. None without any."""
    rows = [] if found.precision is None else found.precision.rows
    cells, last = [], ""
    for one, tenth in zip(rows[::2], rows[1::2], strict=True):
        name = "" if one.contact == last else _name(one.contact)
        last = one.contact
        pairs = [(found.milliseconds(row.step), _micro(row.run_time)) for row in (one, tenth)]
        own = "diverges" if one.error_at_own_step is None else f"{_number(100.0 * one.error_at_own_step)} %"
        cells.append((name, one.scheme, *pairs[0], *pairs[1], *([own] if found.own else [])))
    heads = ["contact", "scheme", headed("step,\n1 %", found.step_unit), "run time\n[us per s]"]
    heads += [headed("step,\n0.1 %", found.step_unit), "run\ntime"]
    heads += [f"error\n{_at_own(found)}"] if found.own else []
    title = "Error of speed, duration and largest force, relative to the exact ones, against run time"
    return ScreenTable(title, heads, cells, heads[:2]) if cells else None


def stability_table(found: Study) -> ScreenTable | None:
    """A row for each contact, the shortest critical step first. None without any."""
    judged, units = found.stability or [], unit_names(found.units)
    mass = {"metric": "kg/m", "imperial": "slug/ft"}.get(found.units, "")
    heads = ["contact", "deck line", headed("stiffness", units.stiffness), headed("mass", mass)]
    heads += [headed("explicit", found.step_unit), headed("landings\nwithin 1 %", found.step_unit)]
    heads += [_at_own(found)] if found.own else []
    files = {one.row.file for one in judged}
    elsewhere = len(files) == 1 and not found.deck.endswith(next(iter(files)))
    cells = []
    for row, words in judged[:_MOST_CONTACTS]:
        line = str(row.deck_line) if len(files) == 1 else f"{row.file}:{row.deck_line}"
        landing = f"{found.milliseconds(row.landing_step)}{' (jump)' if row.jump else ''}"
        numbers = (_number(row.stiffness), _number(row.mass), found.milliseconds(row.explicit_step))
        cells.append((_name(row.contact), line, *numbers, landing, *([words] if found.own else [])))
    more = len(judged) - len(cells)
    note = [f"Lines are those of {next(iter(files))}."] if elsewhere else []
    note += [f"{more} more contacts have larger critical steps; JSON has all."] if more else []
    title = "Stable steps of velocity Verlet (explicit), and of landings with HHT (-0.3)"
    return ScreenTable(title, heads, cells, [heads[0], *heads[6:]], " ".join(note)) if cells else None


def extremes_sentences(found: Study) -> list[str]:
    """How many extreme cases held, then the first that did not; nothing where none was tried."""
    extremes = found.extremes
    if extremes is None or not extremes.tried:
        return []
    lines = [f"Extremes of this deck: {extremes.held} of {extremes.tried} held ({', '.join(extremes.cases)})"]
    lines += [
        f"{failure.case} (line {failure.deck_line} of {failure.file}): {failure.message}"
        for failure in extremes.failed[:_MOST_FAILURES]
    ]
    more = len(extremes.failed) - _MOST_FAILURES
    return [*lines, f"{more} more failed: JSON has all"] if more > 0 else lines


def stages_table(found: Study) -> ScreenTable | None:
    """A row for each stage of the evaluation. None where they were not measured."""
    pruning = found.stages
    if pruning is None:
        return None
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
    heads = ("stage", "in", "deck line", "share", "without it", "why")
    title = f"What the deck needs: a step of {pruning.elements} elements takes {_time(pruning.step)}"
    return ScreenTable(title, heads, cells, ("stage", "in", "why"))


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


def _micro(seconds: float | None) -> str:
    return "-" if seconds is None else _number(1e6 * seconds)


def _time(seconds: float) -> str:
    """A time with its unit, to three digits."""
    for scale, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "us")):
        if seconds * scale >= 1.0:
            return f"{shown(seconds * scale, _DIGITS)} {unit}"
    return f"{shown(seconds * 1e9, _DIGITS)} ns"
