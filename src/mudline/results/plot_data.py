"""What is kept of an evaluation whose steps come and go, to draw it: memory does not grow with the number of steps.

One step whole, the extents of all steps, and bins of what changes over time; nothing here needs matplotlib.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact import ContactInput, ContactResult
from mudline.contact.result import Part
from mudline.contact.touchdown import Touchdown
from mudline.curves import ForceCurve
from mudline.results.evaluation import Evaluation
from mudline.results.totals import traces
from mudline.scene.numbering import Floats, Indices, Mask
from mudline.short_repr import listed_numbers

PICTURES = ("png", "svg", "pdf")
"""Forms of a picture."""
_BINS = 2000
"""Pieces of time of which the least and the largest value are drawn."""
_POINTS = 4000
"""Evaluated points that are drawn on the curves."""
_LOOP_STEPS = 5000
"""Steps of a force-penetration loop that are drawn."""
_FOLLOWED_LINES = 64
"""Lines whose touchdown is followed over time."""
MOST_LOOPS = 6
"""Elements whose force-penetration loop can be asked for."""
TOUCHDOWN = ("first", "last")
"""Figures of a line (`LineSeries`) that are drawn over time."""


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
    def heights(self) -> Floats:
        """The heights (n,) of the nodes, NaN where they are not known."""
        if self.result.positions is None:
            return np.full(self.result.gap.shape, np.nan)
        return np.asarray(self.result.positions[:, 0], dtype=np.float64)

    @property
    def seabed(self) -> Floats:
        """The height (n,) of the seabed right below each node."""
        with np.errstate(all="ignore"):
            found: Floats = self.heights - self.result.gap / self.result.normal[..., 0]
        return found


class Extents:
    """The least and the largest of several values over the steps, NaN where there is none."""

    def __init__(self, count: int) -> None:
        self.least = np.full(count, np.nan)
        self.most = np.full(count, np.nan)

    def take(self, values: Floats) -> None:
        """Look at each value at some steps (steps, count)."""
        self.least = np.fmin(self.least, np.fmin.reduce(values, axis=0))
        self.most = np.fmax(self.most, np.fmax.reduce(values, axis=0))

    def take_bins(self, bins: Indices, values: Floats) -> None:
        """Look at one value at some steps (steps,), which belong to these bins."""
        np.fmin.at(self.least, bins, values)
        np.fmax.at(self.most, bins, values)


class Cycle(NamedTuple):
    """An element over the steps: penetration, force per unit length, and state of suction, None without."""

    penetration: Floats
    force: Floats
    state: NDArray[np.int8] | None


class PlotData:
    """What is drawn of results: the step with the largest total reaction, envelopes, points on curves, times, loops.

    Parts are given to `take` in the order of the steps.

    Attributes:
        given: what was evaluated.
        steps, times: number of steps, and their times (steps,); None for a single state without a time.
        elements: indices of those that are evaluated.
        looped: indices of the elements whose force-penetration loop is kept.
        chosen: the step with the largest total reaction; pulled: that with the largest pull of an element, None
            without one; slid: that with the largest friction on a node, None without friction.
        touched: (m,) elements that are in contact at some step.
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

        `elements` are the numbers of those whose loop is wanted. Raises ValueError for numbers that no evaluated
        element has, for too many of them, and for a single state, which has no loop.
        """
        self.given = given
        self.steps = steps
        self.times = times
        self.elements: Indices = np.flatnonzero(evaluated)
        self.looped = self._looped(elements)
        self.chosen: Chosen | None = None
        self.pulled: Chosen | None = None
        self.slid: Chosen | None = None
        self.touched: Mask = np.zeros(len(evaluated), np.bool_)
        self.force, self.depth = Extents(len(evaluated)), Extents(len(evaluated))
        self.curves: Sequence[ForceCurve] = given.curves
        self._curve_of = given.curve_index
        self.on_curve: Indices = self.elements[self._curve_of[self.elements] >= 0]
        self.points: list[Points] = []
        self._every = max(1, steps * len(self.on_curve) // _POINTS)
        self._seen = 0
        bins = min(_BINS, steps)
        self.reaction = Extents(bins)
        self.lines: list[int] = np.unique(given.lines.of_element[self.elements]).tolist()[:_FOLLOWED_LINES]
        self.more_lines = len(np.unique(given.lines.of_element[self.elements])) - len(self.lines)
        self.touchdown = {(line, name): Extents(bins) for line in self.lines for name in TOUCHDOWN} if steps > 1 else {}
        self._finder = Touchdown(given)
        self._every_loop = max(1, -(-steps // _LOOP_STEPS))
        self._loops: list[Cycle] = []
        self._largest, self._pull, self._friction = -np.inf, 0.0, 0.0

    @classmethod
    def of_evaluation(cls, evaluation: Evaluation, elements: Sequence[int] = ()) -> PlotData:
        """Prepare for the parts of an evaluation; raises as the class does."""
        evaluated: Mask = np.all(evaluation.present[evaluation.scene.element_nodes], axis=1)
        return cls(evaluation.model.input, evaluated, evaluation.steps, evaluation.time, elements=elements)

    @classmethod
    def of_result(cls, result: ContactResult, elements: Sequence[int] = ()) -> PlotData:
        """Return the data of a whole result, of a state or a series.

        Raises ValueError for a result that does not know what was evaluated, and as the class does.
        """
        series = result.as_series()
        data = cls(result.known, series.evaluated, len(series.depth), series.times, elements=elements)
        data.take(Part(0, series))
        return data

    def _looped(self, elements: Sequence[int]) -> Indices:
        if not elements:
            return np.zeros(0, np.intp)
        places = {number: index for index, number in enumerate(self.given.element_ids.tolist())}
        known = set(self.elements.tolist())
        wanted = list(dict.fromkeys(elements))
        if self.steps == 1:
            raise ValueError("force over penetration needs time steps, and this is one state")
        unknown = [number for number in wanted if places.get(number) not in known]
        if unknown:
            numbers = listed_numbers(unknown)
            raise ValueError(f"no evaluated element has the number {numbers}: give numbers of elements in the results")
        if len(wanted) > MOST_LOOPS:
            raise ValueError(f"{len(wanted)} elements are too many to draw: give at most {MOST_LOOPS}")
        return np.array([places[number] for number in wanted], np.intp)

    # ------------------------------------------------------------------------------------------- as the parts come

    def take(self, part: Part) -> None:
        """Look at some steps."""
        of_part = traces(part)
        bins = np.arange(part.start, part.start + part.count) * min(_BINS, self.steps) // self.steps
        self.reaction.take_bins(bins, of_part["reaction"].values)
        self._choose(part, of_part["reaction"].values, of_part["pull"].values)
        self.touched |= part.result.contact.any(axis=0) & part.result.evaluated
        self.force.take(part.result.force)
        self.depth.take(part.result.depth)
        if self.touchdown:
            for line in self._finder.series(part):
                for name in TOUCHDOWN if line.number in self.lines else ():
                    self.touchdown[line.number, name].take_bins(bins, getattr(line, name))
        self._sample(part)
        self._take_loop(part)

    def _choose(self, part: Part, reaction: Floats, pull: Floats) -> None:
        step = int(np.argmax(np.nan_to_num(reaction, posinf=np.inf)))
        if self.chosen is None or reaction[step] > self._largest:
            self._largest = float(reaction[step])
            self.chosen = Chosen(part.start + step, part.result.step(step))
        step = int(np.argmax(np.nan_to_num(pull)))
        if pull[step] > self._pull:
            self._pull = float(pull[step])
            self.pulled = Chosen(part.start + step, part.result.step(step))
        if part.result.friction is not None:
            friction = np.nan_to_num(np.abs(part.result.friction)).max(axis=(1, 2), initial=0.0)
            step = int(np.argmax(friction))
            if friction[step] > self._friction:
                self._friction = float(friction[step])
                self.slid = Chosen(part.start + step, part.result.step(step))

    def _sample(self, part: Part) -> None:
        """Evaluated points at even distances; those of the chosen step are drawn anyway."""
        size = part.count * len(self.on_curve)
        taken = np.arange(-self._seen % self._every, size, self._every)
        self._seen += size
        if taken.size:
            step, row = np.divmod(taken, len(self.on_curve))
            element = self.on_curve[row]
            result = part.result
            found = result.ratio[step, element], result.force[step, element]
            self.points.append(Points(self._curve_of[element], *found, part.start + step))

    @property
    def known(self) -> bool:
        """Whether the total reaction is known at some step."""
        return not np.isnan(self.reaction.most).all()

    def points_of(self, chosen: Chosen) -> Points:
        """The points of a step on the curves: of all elements, or of some at even distances."""
        element = self.on_curve[thinned_evenly(len(self.on_curve), _POINTS)]
        step = np.full(len(element), chosen.step, np.intp)
        return Points(self._curve_of[element], chosen.result.ratio[element], chosen.result.force[element], step)

    def _take_loop(self, part: Part) -> None:
        if not self.looped.size:
            return
        steps = np.arange(-part.start % self._every_loop, part.count, self._every_loop)
        at = np.ix_(steps, self.looped)
        states = part.result.state
        self._loops.append(Cycle(part.result.depth[at], part.result.force[at], None if states is None else states[at]))

    def loop(self, place: int) -> Cycle:
        """The path of one of the chosen elements."""
        depth, force = (
            np.concatenate([getattr(one, name)[:, place] for one in self._loops]) for name in Cycle._fields[:2]
        )
        states = [one.state[:, place] for one in self._loops if one.state is not None]
        state = np.concatenate(states) if states else None
        return Cycle(depth, force, None if state is None or (state < 0).all() else state)

    # ------------------------------------------------------------------------------------------------ what there is

    @property
    def drawn(self) -> Chosen:
        """The chosen step; ValueError before there are results."""
        if self.chosen is None:
            raise ValueError("there are no results to draw yet")
        return self.chosen

    @property
    def bin_times(self) -> Floats:
        """The time of the first step of each bin; the number of the step where there are no times."""
        bins = min(_BINS, self.steps)
        first = -(-np.arange(bins) * self.steps // bins)
        return first.astype(np.float64) if self.times is None else self.times[first]


def thinned_evenly(count: int, most: int) -> Indices:
    """Rows of so many, at even distances, at most `most`."""
    return np.arange(0, count, max(1, -(-count // most)))
