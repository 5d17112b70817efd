"""Steps of one element on a seabed with all laws that have a history, in exact arithmetic, compared with the evaluator.

The equations are those of docs/contact.md: a plane with its normal, a law along it, an unloading line, friction with
its stick points, a lateral spring. Roots, sines and cosines have 60 digits, all else is rational. Each number of a
result is compared with what follows exactly from the numbers before it (gap, depth, force, reaction), and from the
history as the evaluator had it before the step: no link hides behind the condition of another.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from sys import float_info
from typing import TYPE_CHECKING, NamedTuple

from mudline.study.exact import ROUNDING, SMALLEST, Compared, ExactCurve, ExactLinear, ExactSmoothed, Tally
from mudline.study.exact_geometry import (
    ONE,
    ZERO,
    ExactPlane,
    Vector,
    cross,
    dot,
    largest_term,
    minus,
    product,
    root,
    sine_and_cosine,
    times,
    vector,
)

if TYPE_CHECKING:
    from mudline.contact.result import ContactResult
    from mudline.contact.tables import ContactState

_TWO = Fraction(2)
_LARGEST = Fraction(float_info.max) * (1 - Fraction(1, 2**50))
_CLOSE = Fraction(1, 2**40)
"""A part of the largest term: nearer to a limit than this, rounding may fall to either side of it."""

NormalLaw = ExactLinear | ExactCurve | ExactSmoothed


@dataclass(frozen=True, slots=True)
class ExactFriction:
    """Coefficients and springs along u1 and u2; a spring is a constant, or mu N / a mobilisation length."""

    coefficients: tuple[float, float]
    springs: tuple[float, float] | None
    mobilisation: tuple[float, float] | None
    ellipse: bool = False
    angle: float | None = None

    def spring(self, side: int, normal_force: Fraction) -> Fraction:
        """The stiffness of a direction under a normal force."""
        if self.springs is not None:
            return Fraction(self.springs[side])
        if self.mobilisation is None:
            raise ValueError("friction has neither springs nor mobilisation lengths")
        return self.limit(side, normal_force) / Fraction(self.mobilisation[side])

    def limit(self, side: int, normal_force: Fraction) -> Fraction:
        """The Coulomb limit of a direction."""
        return Fraction(self.coefficients[side]) * normal_force


@dataclass(frozen=True, slots=True)
class ExactElement:
    """One element, its seabed and all its laws.

    Attributes:
        law: per unit length; None where the nodes have one.
        nodal: of each node.
        unloading: stiffness of the unloading line.
        uplift: stiffness and extent of the spring against uplift.
    """

    diameter: float
    length: Fraction
    plane: ExactPlane
    law: NormalLaw | None
    nodal: ExactSmoothed | ExactLinear | None = None
    unloading: float | None = None
    friction: ExactFriction | None = None
    lateral: float | None = None
    uplift: tuple[float, float] | None = None


class _Trial(NamedTuple):
    """Of a direction: elongation, the largest term of it, spring, force in the spring, limit."""

    elongation: Fraction
    term: Fraction
    spring: Fraction
    force: Fraction
    limit: Fraction


class ExactStep:
    """One step: what is exact, and its comparison with a result; without a result, whether some number overflows."""

    def __init__(self, element: ExactElement, tally: Tally, bound: float) -> None:
        self._element, self._tally, self._bound = element, tally, bound
        friction = element.friction
        law = element.law or element.nodal
        self._onset = ZERO if law is None else onset(law)
        self._deeper = self._steps = 0
        self._straight = element.plane.horizontal and (friction is None or friction.angle is None)
        self.overflows = False
        """Whether some number of the last step is too large for a float64."""

    def may_overflow(self, points: Sequence[Sequence[float]], before: ContactState) -> bool:
        """Whether some number of a step is too large for a float64, or is after the rounding of a gap."""
        found = False
        for self._deeper in range(2):
            self.compare(points, before, None, None)
            found |= self.overflows
        return found

    def compare(
        self,
        points: Sequence[Sequence[float]],
        before: ContactState,
        result: ContactResult | None,
        after: ContactState | None,
    ) -> None:
        """Compare a step behind the state `before`."""
        self.overflows = False
        element, plane = self._element, self._element.plane
        places = [vector(point) for point in points]
        gaps = [self._gap(place, None if result is None else result.gap[node]) for node, place in enumerate(places)]
        if result is not None and not self._steps:  # a plane has one normal, which stays
            for node in range(2):
                for axis in range(3):
                    exact = plane.normal[axis]
                    self._add("the normal", float(result.normal[node, axis]), exact, abs(exact))
        depth = self._add(
            "the depth",
            None if result is None else float(result.depth[0]),
            -(gaps[0] + gaps[1]) / 2,
            max(abs(gap) for gap in gaps),
        )
        exact_ratio = depth / Fraction(element.diameter)
        self._add("the ratio", None if result is None else float(result.ratio[0]), exact_ratio, abs(exact_ratio))
        force = self._normal_force(depth, before, result)
        loads = [self._load(force, gap, node, result) for node, gap in enumerate(gaps)]
        if element.friction is None and element.lateral is None:
            for node, load in enumerate(loads):
                self._reaction(node, [(load, plane.normal)], result)
            return
        along = plane.along(minus(places[1], places[0]))
        across = cross(plane.normal, along)
        push = self._lateral(places, across, depth, before)
        axes = self._turned(along, across)
        self._steps += result is not None
        for node, (place, load) in enumerate(zip(places, loads, strict=True)):
            if result is not None and (self._steps + node) % 2:
                continue  # the nodes in turn: both have the same laws
            slid = self._friction(node, place, axes, load, before, after)
            parts: list[tuple[Fraction, Vector]] = []
            for side, way in enumerate(axes):
                share = dot(times(push[0], across), way)
                held, term, floor = slid[side]
                found = None if result is None or result.friction is None else float(result.friction[node, side])
                what = f"the force along u{side + 1}"
                terms = max(term, push[1] * (abs(dot(across, way)) if self._straight else 1))
                parts.append((self._add(what, found, share - held, terms, floor + push[2]), way))
            self._reaction(node, [(load, plane.normal), *parts], result)

    def _turned(self, along: Vector, across: Vector) -> tuple[Vector, Vector]:
        """u1 and u2: those of the line, or at an angle to +Y."""
        plane, friction = self._element.plane, self._element.friction
        if friction is None or friction.angle is None:
            return along, across
        sine, cosine = sine_and_cosine(friction.angle)
        ahead = plane.along((ZERO, ONE, ZERO))
        x, y, z = (cosine * a + sine * b for a, b in zip(ahead, cross(plane.normal, ahead), strict=True))
        return (x, y, z), cross(plane.normal, (x, y, z))

    # --------------------------------------------------------------------------------------------------- normal forces

    def _gap(self, place: Vector, found: float | None) -> Fraction:
        plane = self._element.plane
        away = minus(place, plane.point)
        terms = [
            largest_term(plane.normal, away),
            abs(plane.normal[0] * place[0]),
            abs(plane.normal[0] * plane.point[0]),
        ]
        exact = dot(plane.normal, away)
        if found is None:  # deeper by what rounding may be
            return exact - self._deeper * max(terms) * Fraction(self._bound) * ROUNDING
        return self._add("the gap", float(found), exact, max(terms))

    def _normal_force(self, depth: Fraction, before: ContactState, result: ContactResult | None) -> Fraction:
        """Force per unit length, slope and stiffness of the element."""
        element, size = self._element, Fraction(self._element.diameter)
        force, stiffness, term, by_depth, sharp = ZERO, ZERO, ZERO, ZERO, True
        ratio = depth / size if result is None else Fraction(float(result.ratio[0]))
        if element.unloading is not None and element.law is not None and before.unloading is not None:
            force, stiffness, term, by_depth, sharp = self._unloaded(depth, float(before.unloading.z_max[0]))
        elif element.law is not None and depth > onset(element.law):
            spring = element.law.spring(depth, ratio)
            force, stiffness, term = spring.force, spring.stiffness, spring.term
            by_depth = abs(stiffness) if spring.by_depth is None else spring.by_depth
        if element.uplift is not None:
            held, extent = (Fraction(value) for value in element.uplift)
            rise = self._onset - depth
            if 0 < rise <= extent:
                force, stiffness = force - held * rise, stiffness + held
                term, by_depth = max(term, abs(held * rise)), max(by_depth, held)
        given = None if result is None else float(result.force[0])
        force = self._add("the force", given, force, term)
        if sharp:
            given = None if result is None else float(result.stiffness[0])
            self._add("the stiffness", given, stiffness, by_depth)
            given = None if result is None else float(result.slope[0])
            self._add("the slope", given, stiffness * size, by_depth * size, 2 * max(size, ONE))
        return force

    def _unloaded(self, depth: Fraction, known: float) -> tuple[Fraction, Fraction, Fraction, Fraction, bool]:
        """Force, stiffness and their largest terms at or behind the deepest point; whether the stiffness is certain."""
        element, z = self._element, max(depth, ZERO)
        law = element.law
        if law is None or element.unloading is None:
            raise ValueError("an unloading line needs a law to return from")
        if z > Fraction(known):
            # the ratio is a quotient of floats, and rounded before the curve is asked
            spring = law.spring(
                z, Fraction(float(z) / element.diameter) if isfinite(float(z) / element.diameter) else z
            )
            return spring.force, spring.stiffness, spring.term, abs(spring.stiffness), True
        deepest = Fraction(known)
        if not deepest:
            return ZERO, ZERO, ZERO, ZERO, True
        ratio = Fraction(known / element.diameter)
        top = law.spring(deepest, ratio)
        largest = max(top.force, ZERO)
        line = max(Fraction(element.unloading), law.steepest(ratio), largest / deepest)
        bottom = deepest - largest / line
        sharp = abs(z - bottom) > _CLOSE * deepest and largest > _CLOSE * line * deepest
        if z <= bottom:
            return ZERO, ZERO, max(top.term, line * deepest * _CLOSE), ZERO, sharp
        fall = line * (deepest - z)
        return max(largest - fall, ZERO), line, max(top.term, fall), line, sharp

    def _load(self, force: Fraction, gap: Fraction, node: int, result: ContactResult | None) -> Fraction:
        """The normal force of a node."""
        element = self._element
        load = force * element.length / 2
        term = abs(load)
        if element.nodal is not None and -gap > onset(element.nodal):
            spring = element.nodal.spring(-gap, ZERO)
            load, term = load + spring.force, max(term, spring.term)
        found = None if result is None else float(result.normal_force[node])
        # the length is known to the smallest float64
        return self._add("the normal force", found, load, term, 2 + abs(force))

    def _reaction(self, node: int, parts: Sequence[tuple[Fraction, Vector]], result: ContactResult | None) -> None:
        for axis in range(3):
            terms = [product(size, way[axis]) for size, way in parts]
            found = None if result is None else float(result.reaction[node, axis])
            # a direction is known to the rounding of 1, or of its component where that is the only one
            largest = [
                abs(size) * (abs(way[axis]) if at == 0 or self._straight else 1) for at, (size, way) in enumerate(parts)
            ]
            floor = 2 + 2 * sum((abs(size) + 1 for size, _ in parts), ZERO)
            self._add("the reaction", found, sum(terms, ZERO), max(largest), floor)

    # ------------------------------------------------------------------------------------------------ sideways, history

    def _lateral(
        self, places: Sequence[Vector], across: Vector, depth: Fraction, before: ContactState
    ) -> tuple[Fraction, Fraction, Fraction]:
        """The push on each node along n x t, its largest term, and what it cannot be known closer to."""
        element = self._element
        if element.lateral is None or before.touchdown is None:
            return ZERO, ZERO, ZERO
        half = Fraction(element.lateral) * element.length / 2
        self.overflows |= half > _LARGEST
        kept = before.touchdown[0].tolist()
        starts = self._onset
        if not isfinite(kept[0]) or depth <= starts:
            return ZERO, ZERO, ZERO
        x, y, z = ((a + b) / 2 for a, b in zip(*places, strict=True))
        arm = minus((x, y, z), vector(kept))
        coordinates = max(self._term(place, across) for place in (*places, vector(kept)))
        # half of the length is known to the smallest float64
        floor = 4 * (half + Fraction(element.lateral) * coordinates)
        return -half * dot(arm, across), half * coordinates, floor

    def _friction(
        self,
        node: int,
        place: Vector,
        axes: tuple[Vector, Vector],
        normal_force: Fraction,
        before: ContactState,
        after: ContactState | None,
    ) -> list[tuple[Fraction, Fraction, Fraction]]:
        """Force in each spring, its largest term and floor; the stick point behind the step is compared."""
        law, history = self._element.friction, before.friction
        if law is None or history is None or normal_force <= 0:
            return [(ZERO, ZERO, _TWO)] * 2
        touched = history.states[node, 0] > 0
        stick = vector(history.stick_points[node]) if touched else place
        away = minus(place, stick)
        trials = []
        for side, axis in enumerate(axes):
            spring, elongation = law.spring(side, normal_force), dot(away, axis)
            force = spring * elongation
            trials.append(_Trial(elongation, self._term(away, axis), spring, force, law.limit(side, normal_force)))
        forces, terms = _held(trials, ellipse=law.ellipse)
        found, moved, known = [], [], Fraction(8)
        for trial, force, term in zip(trials, forces, terms, strict=True):
            slips = force != trial.force
            # the spring of a mobilisation length is known to the smallest float64, for each unit of the normal force
            coarse = 2 + 2 * normal_force if law.springs is None else ZERO
            small = 2 + 4 * trial.spring + 2 * product(coarse, abs(trial.elongation))
            if law.ellipse:  # so is a limit, which both forces are divided by
                small += 2 * abs(force) * sum(1 / one.limit for one in trials if one.limit)
            found.append((force, term, small))
            slid = force / trial.spring if slips and trial.spring else ZERO
            moved.append(trial.elongation - slid if slips and trial.spring else ZERO)
            if trial.spring:
                known += 2 * (product(coarse, max(abs(slid), abs(trial.elongation))) + 1) / trial.spring
            if law.springs is None or law.ellipse:
                # limits and springs are then numbers of the law, which have to be float64s themselves
                self.overflows |= max(trial.limit, trial.spring) > _LARGEST
            if law.ellipse:
                rounded = self._deeper * trial.term * trial.spring * Fraction(self._bound) * ROUNDING
                self.overflows |= abs(trial.force) + rounded > _LARGEST
        if after is not None and after.friction is not None:
            kept = after.friction.stick_points[node].tolist()
            reaches = [
                max(trial.term, abs(trial.elongation), term / trial.spring if trial.spring else ZERO)
                for trial, term in zip(trials, terms, strict=True)
            ]
            self._stick_point(kept, place, stick, list(zip(axes, moved, reaches, strict=True)), known)
        return found

    def _term(self, away: Vector, axis: Vector) -> Fraction:
        """The largest term of a displacement along an axis; an oblique axis is known to a rounding of 1."""
        if self._straight:
            return largest_term(away, axis)
        return max(map(abs, away[1:] if self._element.plane.horizontal else away))

    def _stick_point(
        self,
        kept: Sequence[float],
        place: Vector,
        stick: Vector,
        moves: Sequence[tuple[Vector, Fraction, Fraction]],
        floor: Fraction,
    ) -> None:
        """Compare where the stick point has gone to, by how far along each axis, with the largest term of that."""
        for axis in range(3):
            exact = stick[axis] + sum((product(step, way[axis]) for way, step, _ in moves), ZERO)
            reaches = (abs(product(way[axis], reach)) for way, _, reach in moves)
            term = max(abs(stick[axis]), abs(place[axis]), *reaches)
            self._add("the stick point", kept[axis], exact, term, floor)

    def _add(self, what: str, found: float | None, exact: Fraction, term: Fraction, floor: Fraction = _TWO) -> Fraction:
        """Compare one number, and return what the next link begins with; `floor` in units of the smallest float64."""
        if found is None:
            self.overflows |= abs(exact) > _LARGEST
            return exact
        here = Fraction(found) if isfinite(found) else exact
        term = term if here == exact else max(term, abs(exact))
        self._tally.add(what, Compared(found, exact, term), self._bound, ZERO if here == exact else floor * SMALLEST)
        return here


def onset(law: NormalLaw) -> Fraction:
    """The penetration from which on a law acts."""
    return law.onset if isinstance(law, ExactSmoothed) else ZERO


def _held(trials: Sequence[_Trial], *, ellipse: bool) -> tuple[list[Fraction], list[Fraction]]:
    """Forces within their limits, and the largest term of each."""
    if not ellipse:
        forces = [max(min(trial.force, trial.limit), -trial.limit) for trial in trials]
        terms = []
        for trial in trials:
            term = trial.term * trial.spring
            beyond = abs(trial.force) - trial.limit > _CLOSE * term
            terms.append(trial.limit if beyond else max(term, abs(trial.force)))
        return forces, terms
    # a limit below the smallest float64 is none
    able = [trial.limit > SMALLEST / 2 for trial in trials]
    shares = [trial.force / trial.limit if can else ZERO for trial, can in zip(trials, able, strict=True)]
    size = root(shares[0] ** 2 + shares[1] ** 2) if any(shares) else ZERO
    scale = max(size, Fraction(1))
    forces = [trial.force / scale if can else ZERO for trial, can in zip(trials, able, strict=True)]
    # terms in the norm, relative to it
    loose = sum((one.term * one.spring / one.limit for one, can in zip(trials, able, strict=True) if can), ZERO) / scale
    if loose * ROUNDING > Fraction(1, 100):
        # the rounding of one direction alone takes up the limit: all that is known is that none is passed
        return forces, [trial.limit / ROUNDING for trial in trials]
    if scale == 1 and size + loose * _CLOSE < 1:
        loose = ZERO
    return forces, [
        trial.term * trial.spring / scale + abs(force) * loose if can else ZERO
        for trial, force, can in zip(trials, forces, able, strict=True)
    ]
