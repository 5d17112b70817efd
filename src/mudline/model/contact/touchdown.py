"""Touchdown of lines: touchdown points, length on the seabed, and the forces there; of elements with a law."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from mudline.basics.quantities import LINES, finite
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.columns import (
    NO_ELEMENT,
    ElementResults,
    NodeResults,
    ResultColumn,
    ResultTable,
    Values,
    by_number,
)
from mudline.model.contact.input import ContactInput, LawKind
from mudline.model.contact.lines import ElementForce, LineSummary, TouchdownPoint
from mudline.model.contact.result import ContactResult, ResultPart, total_normal_force


@dataclass(frozen=True, slots=True, eq=False)
class _TouchdownPoints:
    """Touchdown points (k,) of a line, ascending by step and along the line.

    Attributes:
        step: step of each point.
        arc: arc length.
        places: (k, 3) coordinates, NaN if the result does not know its positions.
        after: whether contact lies behind the point.
    """

    step: IndexArray
    arc: FloatArray
    places: FloatArray
    after: BoolArray


@dataclass(frozen=True, slots=True, eq=False)
class LineSeries:
    """A line over some steps (s,), with the names of `LINES`; NaN and -1 mean "none".

    Attributes:
        number: number of the line, from 0.
        touchdown_points: number of touchdown points at each step.
        first_touchdown, last_touchdown: arc length of the first and the last touchdown point.
        contact_length, reaction, submerged_weight, empty_weight, ratio: as in `LineSummary`.
        largest_force, largest_uplift: largest force out of the seabed and largest pull, per unit length and with their
            signs.
        force_at, uplift_at: indices of the elements with these forces.
        found: the touchdown points.
    """

    number: int
    touchdown_points: IndexArray
    first_touchdown: FloatArray
    last_touchdown: FloatArray
    contact_length: FloatArray
    reaction: FloatArray
    submerged_weight: FloatArray
    empty_weight: FloatArray
    ratio: FloatArray
    largest_force: FloatArray
    force_at: IndexArray
    largest_uplift: FloatArray
    uplift_at: IndexArray
    found: _TouchdownPoints


class Touchdown:
    """Finder of the touchdown of every line of an input."""

    def __init__(self, given: ContactInput) -> None:
        self.given = given
        self.lines = given.lines
        self._own_nodes = [np.flatnonzero(self.lines.of_node == line) for line in range(len(self.lines.elements))]
        self._carries, self._rigid = given.law != LawKind.NONE, given.law == LawKind.RIGID
        with np.errstate(over="ignore", invalid="ignore"):
            self._weights = None if given.weight is None else given.weight * given.length
            self._empty = self._weights if given.empty_weight is None else given.empty_weight * given.length

    def length(self, line: int) -> float:
        """Length of a line; infinite where it overflows."""
        return float(self.lines.arcs[line][-1])

    def series(self, part: ResultPart) -> list[LineSeries]:
        """Return each line over some steps, without lines that have no evaluated element."""
        result = part.result
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return [
                self._line(line, result)
                for line, elements in enumerate(self.lines.elements)
                if result.evaluated[elements].any()
            ]

    def _line(self, line: int, result: ContactResult) -> LineSeries:
        elements, nodes = self.lines.elements[line], self.lines.nodes[line]
        gap, arc = result.gap[:, nodes], self.lines.arcs[line]
        touches = gap < 0.0
        if result.restrained is not None:
            touches |= result.restrained[:, nodes]
        known = ~np.isnan(gap)
        between = known[:, :-1] & known[:, 1:] & self._carries[elements]
        changes = (touches[:, :-1] != touches[:, 1:]) & between
        step, segment = np.nonzero(changes)
        before, behind = gap[step, segment], gap[step, segment + 1]
        portion = np.clip(before / (before - behind), 0.0, 1.0)
        portion = np.where(np.isnan(portion), 0.5, portion)
        steps, length, after = len(gap), np.diff(arc), touches[step, segment + 1]
        at, places = arc[segment] + portion * length[segment], np.full((len(step), 3), np.nan)
        if result.positions is not None:
            begin, end = (np.asarray(result.positions[step, nodes[segment + i]], np.float64) for i in (0, 1))
            places = begin + portion[:, np.newaxis] * (end - begin)
        both = touches[:, :-1] & touches[:, 1:] & between
        lies = both @ length
        np.add.at(lies, step, np.where(after, 1.0 - portion, portion) * length[segment])
        first, last = np.full(steps, np.nan), np.full(steps, np.nan)
        first[step[::-1]], last[step] = at[::-1], at
        force = result.force[:, elements]
        held = (result.contact[:, elements] & self._carries[elements]) | (both & self._rigid[elements])
        weight, empty = (
            np.full(steps, np.nan) if of is None else np.where(held, of[elements], 0.0).sum(axis=1)
            for of in (self._weights, self._empty)
        )
        reaction = total_normal_force(result, self._own_nodes[line])
        pushes, pulls = _extreme(force, elements, 1.0), _extreme(force, elements, -1.0)
        counts = np.bincount(step, minlength=steps)
        return LineSeries(
            line,
            counts,
            first,
            last,
            lies,
            reaction,
            weight,
            empty,
            reaction / np.where(weight > 0.0, weight, np.nan),
            *pushes,
            *pulls,
            _TouchdownPoints(step, at, places, after),
        )

    def summaries(self, part: ResultPart, lines: Sequence[LineSeries]) -> Iterator[LineSummary]:
        """Yield every line at each of some steps, from its `series`: one step after the other."""
        ends = [np.searchsorted(line.found.step, np.arange(part.count + 1)).tolist() for line in lines]
        for step in range(part.count):
            for line, cuts in zip(lines, ends, strict=True):
                with np.errstate(over="ignore", invalid="ignore"):
                    row = self._summary(line, part.result, step, slice(cuts[step], cuts[step + 1]))
                yield row

    def _summary(self, line: LineSeries, result: ContactResult, step: int, cut: slice) -> LineSummary:
        elements = self.lines.elements[line.number]
        ids = self.given.element_ids
        return LineSummary(
            time=None if result.times is None else float(result.times[step]),
            line=line.number + 1,
            first_element=int(ids[elements[0]]),
            last_element=int(ids[elements[-1]]),
            length=self.length(line.number),
            touchdown=tuple(
                TouchdownPoint(arc, x, y, z, "after" if after else "before")
                for arc, (x, y, z), after in zip(
                    line.found.arc[cut].tolist(),
                    line.found.places[cut].tolist(),
                    line.found.after[cut].tolist(),
                    strict=True,
                )
            ),
            contact_length=float(line.contact_length[step]),
            largest_force=self._place(float(line.largest_force[step]), int(line.force_at[step]), result, step),
            largest_uplift=self._place(float(line.largest_uplift[step]), int(line.uplift_at[step]), result, step),
            reaction=finite(float(line.reaction[step])),
            submerged_weight=finite(float(line.submerged_weight[step])),
            empty_weight=finite(float(line.empty_weight[step])),
            ratio=finite(float(line.ratio[step])),
        )

    def _place(self, force: float, element: int, result: ContactResult, step: int) -> ElementForce | None:
        if element < 0:
            return None
        x, y, z = math.nan, math.nan, math.nan
        if result.positions is not None:
            ends = np.asarray(result.positions[step, self.given.element_nodes[element]], np.float64)
            x, y, z = ends.mean(axis=0).tolist()
        number, arc = int(self.given.element_ids[element]), float(self.lines.element_arc[element])
        return ElementForce(force, number, arc, x, y, z)


class LineResults(ResultTable):
    """The lines with an evaluated element."""

    quantities = LINES
    _blanks = MappingProxyType(dict.fromkeys(("largest_force_element", "largest_uplift_element"), NO_ELEMENT))

    def __init__(self, given: ContactInput, elements: IndexArray) -> None:
        lines = np.unique(given.lines.of_element[elements])
        super().__init__(given, lines)
        self.finder = Touchdown(given)
        ids, along = given.element_ids, [given.lines.elements[line] for line in lines.tolist()]
        self._fixed = {
            "line": lines + 1,
            "first_element": np.array([ids[each[0]] for each in along], np.int64),
            "last_element": np.array([ids[each[-1]] for each in along], np.int64),
            "length": np.array([self.finder.length(line) for line in lines.tolist()], np.float64),
        }

    def columns(self, part: ResultPart) -> list[ResultColumn]:
        """Return the columns of `LINES`."""
        with np.errstate(over="ignore", invalid="ignore"):
            values = [self._values(line) for line in self.finder.series(part)]
        names = [name for name in LINES if name not in self._fixed]
        figures = {name: side_by_side([each[name] for each in values], part.count) for name in names}
        return self._columns(figures, part.result)

    def _values(self, line: LineSeries) -> dict[str, Values]:
        given, lines = self.finder.given, self.finder.lines
        ids = np.append(given.element_ids, NO_ELEMENT)
        arcs = np.append(lines.element_arc, np.nan)
        values: dict[str, Values] = {name: getattr(line, name) for name in LINES if hasattr(line, name)}
        for name, at in (("largest_force", line.force_at), ("largest_uplift", line.uplift_at)):
            values |= {f"{name}_element": ids[at], f"{name}_arc_length": arcs[at]}
        there = np.flatnonzero(line.touchdown_points)
        rows = np.searchsorted(line.found.step, there), np.searchsorted(line.found.step, there, side="right") - 1
        for name, row in zip(("first_touchdown", "last_touchdown"), rows, strict=True):
            places = np.full((len(line.reaction), 3), np.nan)
            places[there] = line.found.places[row]
            values |= {f"{name}_{axis}": places[:, i] for i, axis in enumerate("xyz")}
        return values


def result_table(given: ContactInput, name: str, evaluated: BoolArray, present: BoolArray) -> ResultTable:
    """Return the rows of the evaluated "elements", the "nodes" with a position, or the lines ("summary")."""
    if name == "nodes":
        return NodeResults(given, by_number(given, present))
    return (ElementResults if name == "elements" else LineResults)(given, np.flatnonzero(evaluated))


def side_by_side(values: Sequence[Values], steps: int) -> Values:
    """Return values (s,) of k lines over `steps` steps as (s, k)."""
    return np.stack(values, axis=1) if values else np.zeros((steps, 0))


def line_summaries(result: ContactResult) -> list[LineSummary]:
    """Return every line of a result at each of its steps.

    Raises ValueError for a result without an input.
    """
    finder, part = Touchdown(result.known), ResultPart(0, result.as_series())
    return list(finder.summaries(part, finder.series(part)))


def _extreme(force: FloatArray, elements: IndexArray, sign: float) -> tuple[FloatArray, IndexArray]:
    """Return the largest force (steps,) with a sign, and its element; NaN and -1 if there is none."""
    ranked = np.nan_to_num(force * sign, nan=-np.inf, neginf=-np.inf, posinf=np.inf)
    column = ranked.argmax(axis=1)
    largest = ranked[np.arange(len(force)), column]
    acts = largest > 0.0
    return np.where(acts, largest * sign, np.nan), np.where(acts, elements[column], -1)
