"""How time grows with the points of a curve, the curves, the sets, the planes and the steps."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mudline.contact.input import ContactInput, LawAssignment
from mudline.contact.model import ContactModel
from mudline.curves import ForceCurve
from mudline.deck.loading import load_bytes
from mudline.scene.model import resolve
from mudline.study.options import StudyOptions
from mudline.study.pruning.clock import spent
from mudline.study.pruning.cost import stepping
from mudline.study.pruning.fitting import exponent, per_unit, upper_half
from mudline.study.pruning.growing_deck import deck_with_sets
from mudline.study.pruning.motion import positions, series
from mudline.study.pruning.pipe import Pipe
from mudline.study.pruning.seabeds import planes
from mudline.study.pruning.variants import Variant, everything, line

NODES = 10_001
FEW_NODES = 1001
ELEMENTS = 2048
LADDERS = {
    "points on the curve": (2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096),
    "curves": (1, 2, 4, 8, 16, 32, 64, 128, 256, 512),
    "sets": (1, 2, 4, 8, 16, 32, 64, 128, 256, 512),
    "planes": (1, 2, 4, 8, 16, 32, 64, 128, 256),
    "steps, curve": (1, 2, 4, 8, 16, 32, 64, 128, 256),
    "steps, everything": (1, 2, 4, 8, 16, 32, 64),
}
_DEEPEST = 0.5


class GrowthRow(NamedTuple):
    """Seconds for a size of one thing, the rest kept."""

    what: str
    size: int
    seconds: float


class Fit(NamedTuple):
    """How seconds grow with the size.

    exponent: of a power law through all sizes.
    upper: of one through the larger half.
    factor: time of the largest size over that of the smallest.
    unit: seconds that one more unit costs at the upper end.
    """

    what: str
    least: int
    largest: int
    exponent: float
    upper: float
    factor: float
    unit: float


def growth(pipe: Pipe, options: StudyOptions) -> Iterator[GrowthRow]:
    """All ladders; longer by a factor of four with `full`."""
    for what, sizes in LADDERS.items():
        for size in [*sizes, *((4 * sizes[-1],) if options.full else ())]:
            options.progress(f"{what}: {size}")
            yield GrowthRow(what, size, _MEASURED[what](pipe, size))


def fits(rows: Sequence[GrowthRow]) -> Iterator[Fit]:
    """One for each ladder."""
    for what in dict.fromkeys(row.what for row in rows):
        ladder = [row for row in rows if row.what == what]
        sizes, seconds = [float(row.size) for row in ladder], [row.seconds for row in ladder]
        factor = seconds[-1] / seconds[0]
        numbers = (exponent(sizes, seconds), upper_half(sizes, seconds), factor, per_unit(sizes, seconds))
        yield Fit(what, ladder[0].size, ladder[-1].size, *numbers)


def spread(points: int, scale: float) -> ForceCurve:
    """A curve of this many points, crowded towards the mudline."""
    ratios = _DEEPEST * np.linspace(0.0, 1.0, points) ** 2
    return ForceCurve(np.column_stack([ratios, scale * np.sqrt(ratios)]))


def _points(pipe: Pipe, size: int) -> float:
    return _pressed(pipe, replace(line(pipe, NODES), curves=(spread(size, 1000.0),)))


def _curves(pipe: Pipe, size: int) -> float:
    """Curves in stretches of the line, as sets have them."""
    elements = np.arange(NODES - 1)
    law = LawAssignment("curve", elements, {"curve": elements * size // (NODES - 1)})
    made = tuple(spread(10, 1000.0 + number) for number in range(size))
    return _pressed(pipe, replace(line(pipe, NODES), laws=(law,), curves=made))


def _sets(pipe: Pipe, size: int) -> float:
    """Reading the deck until its evaluator stands."""
    del pipe
    text = deck_with_sets(size, ELEMENTS).encode()
    return spent(lambda: resolve(load_bytes(text, "sets.keyxm")).contact(), few=True).best


def _planes(pipe: Pipe, size: int) -> float:
    return _pressed(pipe, replace(line(pipe, NODES), seabed=planes(size, pipe.length * NODES)))


def _pressed(pipe: Pipe, inputs: ContactInput) -> float:
    model = ContactModel(inputs)
    points = positions(Variant("", lambda _: inputs), inputs, pipe)
    return spent(lambda: model.evaluate(points)).best


def _stepped(make: Callable[[Pipe, int], ContactInput]) -> Callable[[Pipe, int], float]:
    def measured(pipe: Pipe, size: int) -> float:
        inputs = make(pipe, FEW_NODES)
        points = positions(Variant("", lambda _: inputs), inputs, pipe)
        return stepping(ContactModel(inputs), series(points, pipe, size)).best

    return measured


_MEASURED: dict[str, Callable[[Pipe, int], float]] = {
    "points on the curve": _points,
    "curves": _curves,
    "sets": _sets,
    "planes": _planes,
    "steps, curve": _stepped(line),
    "steps, everything": _stepped(everything),
}
