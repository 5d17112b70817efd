"""A deck among many: evaluated in whatever process, its results in a file, and a row of what is worst in them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
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
from mudline.results.forms import ResultConsumer
from mudline.results.warnings import ContactWatch


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
