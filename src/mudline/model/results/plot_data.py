"""Data kept from an evaluation for plots: memory does not grow with the number of steps.

One step is kept whole, next to the extremes of all steps and bins of values over time; nothing here needs matplotlib.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import listed_numbers
from mudline.model.contact import ContactInput, ContactResult
from mudline.model.contact.lines import TouchdownPoint
from mudline.model.contact.result import ResultPart
from mudline.model.contact.touchdown import Touchdown
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.extremes import Best, Extremes, StepValues
from mudline.model.results.totals import carried, step_figures
from mudline.model.scene.numbering import Floats, Indices, Mask

_BINS = 2000
"""Number of bins over time, of which the least and the largest value are drawn."""
_POINTS = 4000
"""Largest number of evaluated points drawn on the curves."""
_LOOP_STEPS = 5000
"""Largest number of steps of a force-penetration loop."""
_FOLLOWED_LINES = 64
"""Largest number of lines whose touchdown is drawn over time."""
MOST_LOOPS = 6
"""Largest number of elements with a force-penetration loop."""


class Points(NamedTuple):
    """Evaluated points of elements on a curve: its index, ratio, force, and the step."""

    curve: Indices
    ratio: Floats
    force: Floats
    step: Indices


class Chosen(NamedTuple):
    """A step that is drawn, and its result."""

    step: int
    result: ContactResult

    @property
    def part(self) -> ResultPart:
        """The step as a series of one."""
        return ResultPart(self.step, self.result.as_series())

    @property
    def places(self) -> Floats:
        """The positions (n, 3) of the nodes, NaN where unknown."""
        if self.result.positions is None:
            return np.full((*self.result.gap.shape, 3), np.nan)
        return np.asarray(self.result.positions, dtype=np.float64)

    @property
    def seabed(self) -> Floats:
        """The height (n,) of the seabed vertically below each node."""
        with np.errstate(all="ignore"):
            heights: Floats = self.places[:, 0] - self.result.gap / self.result.normal[..., 0]
        return heights


class Bins:
    """The least and the largest of a value over the steps of each bin, NaN without a value."""

    def __init__(self, count: int) -> None:
        self.least, self.largest = np.full(count, np.nan), np.full(count, np.nan)

    def take(self, bins: Indices, values: Floats) -> None:
        """Add some steps (steps,), which belong to these bins."""
        np.fmin.at(self.least, bins, values)
        np.fmax.at(self.largest, bins, values)


class Cycle(NamedTuple):
    """An element over the steps: penetration, force per unit length, and state of suction, None without suction."""

    penetration: Floats
    force: Floats
    state: NDArray[np.int8] | None


class PlotData:
    """Data of plots: steps with the largest figures, envelopes, points on curves, values over time, loops.

    Parts are passed to `take` in the order of the steps.

    Attributes:
        given: the input.
        steps: number of steps.
        times: (steps,) times; None for a single state without a time.
        elements: indices of the evaluated elements.
        looped: indices of the elements whose force-penetration loop is kept.
        largest: the step with the largest total `reaction`, the largest `pull` of an element and the largest `friction`
            on a node, if there is any.
        touched: (m,) elements that are in contact with a law of the seabed at some step.
        force, depth: extremes of the elements over the steps.
        lines: numbers of the evaluated lines, from 0.
        more_lines: number of lines whose touchdown is not kept.
        reaction: extremes of the total reaction, in bins of steps.
        touchdown: extremes of the arc length of the first and the last touchdown point of a line, in bins of steps;
            empty for a single state.
    """

    def __init__(
        self,
        given: ContactInput,
        evaluated: Mask,
        steps: int,
        times: Floats | None = None,
        *,
        elements: Sequence[int] = (),
    ) -> None:
        """Prepare for the results of an input.

        `elements` are the numbers of elements with a loop. Raises ValueError for numbers that no evaluated element has,
        for too many of them, and for a single state, which has no loop.
        """
        self.given, self.steps, self.times = given, steps, times
        self.elements: Indices = np.flatnonzero(evaluated)
        places = {int(given.element_ids[index]): index for index in self.elements.tolist()}
        numbers = list(dict.fromkeys(elements))
        if numbers and steps == 1:
            raise ValueError("force over penetration needs time steps, and this is one state")
        if unknown := [number for number in numbers if number not in places]:
            words = f"no evaluated element has the number {listed_numbers(unknown)}"
            raise ValueError(f"{words}: give numbers of elements in the results")
        if len(numbers) > MOST_LOOPS:
            raise ValueError(f"{len(numbers)} elements are too many to draw: give at most {MOST_LOOPS}")
        self.looped: Indices = np.array([places[number] for number in numbers], np.intp)
        self.largest: dict[str, Chosen] = {}
        self.touched: Mask = np.zeros(len(evaluated), np.bool_)
        self.force, self.depth = Extremes(len(evaluated)), Extremes(len(evaluated))
        self.on_curve: Indices = self.elements[given.curve_index[self.elements] >= 0]
        self._bins = min(_BINS, steps)
        self.reaction = Bins(self._bins)
        lines = np.unique(given.lines.of_element[self.elements]).tolist()
        self.lines: list[int] = lines[:_FOLLOWED_LINES]
        self.more_lines = len(lines) - len(self.lines)
        followed = self.lines if steps > 1 else []
        self.touchdown = {line: (Bins(self._bins), Bins(self._bins)) for line in followed}
        self._finder = Touchdown(given)
        self._largest: dict[str, Best] = {}
        self._points: list[Points] = []
        self._seen, self._every = 0, max(1, steps * len(self.on_curve) // _POINTS)
        self._loops: list[Cycle] = []

    @classmethod
    def of_evaluation(cls, evaluation: Evaluation, elements: Sequence[int] = ()) -> PlotData:
        """Return an object ready for the parts of an evaluation; raises ValueError as the class does."""
        return cls(evaluation.model.input, evaluation.evaluated, evaluation.steps, evaluation.time, elements=elements)

    @classmethod
    def of_result(cls, result: ContactResult, elements: Sequence[int] = ()) -> PlotData:
        """Return the data of a whole result, of a state or a series.

        Raises ValueError for a result without an input, and as the class does.
        """
        series = result.as_series()
        data = cls(result.known, series.evaluated, len(series.depth), series.times, elements=elements)
        data.take(ResultPart(0, series))
        return data

    # ------------------------------------------------------------------------------------------- as the parts come

    def take(self, part: ResultPart) -> None:
        """Add some steps."""
        result = part.result
        of_part = {name: np.asarray(figure.values[:, 0], np.float64) for name, figure in step_figures(part).items()}
        bins = np.arange(part.start, part.start + part.count) * self._bins // self.steps
        self.reaction.take(bins, of_part["reaction"])
        self._choose("reaction", part, of_part["reaction"])
        self._choose("pull", part, of_part["pull"])
        if result.friction is not None:
            self._choose("friction", part, np.nan_to_num(np.abs(result.friction)).max(axis=(1, 2), initial=0.0))
        self.touched |= carried(result).any(axis=0) & result.evaluated
        self.force.take(part.start, StepValues(result.force))
        self.depth.take(part.start, StepValues(result.depth))
        for line in self._finder.series(part) if self.touchdown else ():
            if line.number in self.touchdown:
                for kept, values in zip(
                    self.touchdown[line.number], (line.first_touchdown, line.last_touchdown), strict=True
                ):
                    kept.take(bins, values)
        if self.looped.size:
            every = -(-self.steps // _LOOP_STEPS)
            at = np.ix_(np.arange(-part.start % every, part.count, every), self.looped)
            states = None if result.state is None else result.state[at]
            self._loops.append(Cycle(result.depth[at], result.force[at], states))
        size = part.count * len(self.on_curve)
        picked = np.arange(-self._seen % self._every, size, self._every)
        self._seen += size
        if picked.size:
            step, row = np.divmod(picked, len(self.on_curve))
            self._points.append(self._points_of(part, step, self.on_curve[row]))

    def _choose(self, name: str, part: ResultPart, values: Floats) -> None:
        """Keep the step with the largest of these values (steps,), if no earlier step has a larger one.

        An unknown one counts as 0. Only the total reaction may be 0 or less.
        """
        largest = self._largest.setdefault(name, Best(1, -1.0))
        largest.take(part.start, StepValues(np.nan_to_num(values, posinf=np.inf)[:, np.newaxis]))
        step = int(largest.steps[0])
        if step >= part.start and (name == "reaction" or largest.values[0] > 0.0):
            self.largest[name] = Chosen(step, part.result.step(step - part.start))

    def _points_of(self, part: ResultPart, step: Indices, element: Indices) -> Points:
        point = part.result.ratio[step, element], part.result.force[step, element]
        return Points(self.given.curve_index[element], *point, part.start + step)

    # ------------------------------------------------------------------------------------------------ what there is

    @property
    def drawn(self) -> Chosen:
        """The step with the largest total reaction."""
        return self.largest["reaction"]

    @property
    def known(self) -> bool:
        """True if the total reaction is known at some step."""
        return not np.isnan(self.reaction.largest).all()

    @property
    def bin_times(self) -> Floats:
        """The time of the first step of each bin; the number of the step without times."""
        first = -(-np.arange(self._bins) * self.steps // self._bins)
        return first.astype(np.float64) if self.times is None else self.times[first]

    def points(self) -> Points:
        """Return evaluated points on curves, evenly spaced: those of the drawn step, then those of all steps.

        Only points in contact are returned, if there are any.
        """
        element = self.on_curve[:: max(1, -(-len(self.on_curve) // _POINTS))]
        of_drawn = self._points_of(self.drawn.part, np.zeros(len(element), np.intp), element)
        every = Points(*(np.concatenate(columns) for columns in zip(*self._points, of_drawn, strict=True)))
        known = ~np.isnan(every.ratio)
        touching = known & ((every.ratio > 0.0) | (every.force != 0.0))
        shown = touching if touching.any() else known
        return Points(every.curve[shown], every.ratio[shown], every.force[shown], every.step[shown])

    def loop(self, place: int) -> Cycle:
        """Return the path of one of the chosen elements."""
        depth = np.concatenate([cycle.penetration[:, place] for cycle in self._loops])
        force = np.concatenate([cycle.force[:, place] for cycle in self._loops])
        states = [cycle.state[:, place] for cycle in self._loops if cycle.state is not None]
        state = np.concatenate(states) if states else None
        return Cycle(depth, force, None if state is None or (state < 0).all() else state)

    def touchdown_points(self, lines: Collection[int]) -> list[TouchdownPoint]:
        """Return the touchdown points of these lines at the drawn step."""
        series = [line for line in self._finder.series(self.drawn.part) if line.number in lines]
        return [point for row in self._finder.summaries(self.drawn.part, series) for point in row.touchdown]
