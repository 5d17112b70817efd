"""The laws of a deck where they are most likely to break, against the same laws with fifty digits.

Each law is evaluated by the evaluator on separate elements of unit length: at the mudline, far above and far below it,
with stiffnesses, velocities, displacements, lengths and time steps many powers of ten from usual ones. A case holds
where every number is finite and right to 1e-12 of its largest term, and exact where the deck or the law gives it: at
the points of a curve, and 0 off the seabed.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Context, Decimal, localcontext
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import law_named
from mudline.model.curves import ForceCurve
from mudline.tools.study.stability import Contact

PROBED = 8
"""Contacts that are evaluated, those with the smallest critical steps."""
FACTOR, FAR, TINY_LENGTH, FAST = 1e12, 1e6, 1e-12, 1e3
STEPS = (1e-9, 1e3)
_TOLERANCE = Decimal("1e-12")
_DIGITS = Context(prec=50)
_FINITE = Decimal(float(np.finfo(np.float64).max))
_CLIPPED = 1e290
"""Forces of a scaled curve that would be larger are this large."""
_TINY = Decimal("1e-307")
"""Numbers below have fewer digits."""
_DIAMETER = 0.3
_SLOW = 1e-9
_PRESSED = 0.01
"""Depth on the seabed below friction and suction."""
_NORMAL = ("curve", "linear", "smoothed")

Parameters = Mapping[str, float]


class Failure(NamedTuple):
    """A case that does not hold: the contact and what is extreme, where its law stands, and what came out."""

    case: str
    file: str
    deck_line: int
    message: str


class Extremes(NamedTuple):
    """How many cases were tried and held, and those that did not; `cases` has the names of all."""

    tried: int
    held: int
    failed: list[Failure]
    cases: list[str]


class _Number(NamedTuple):
    """A number of the evaluator, the exact one, and the largest term of its sum; None: it has to be the same bits."""

    found: float
    exact: Decimal
    scale: Decimal | None


_Case = tuple[str, Callable[[], Iterator[_Number]]]


def extremes(given: ContactInput, contacts: Sequence[Contact]) -> Extremes:
    """Try all cases on the first contacts of a deck."""
    tried, failed = 0, list[Failure]()
    names: dict[str, None] = {}
    for contact in contacts[:PROBED]:
        for name, numbers in _cases(given, contact):
            tried += 1
            names[name] = None
            if fault := _fault(numbers):
                row = contact.row
                failed.append(Failure(f"{row.contact}, {name}", row.file, row.deck_line, fault))
    return Extremes(tried, tried - len(failed), failed, list(names))


def _fault(numbers: Callable[[], Iterator[_Number]]) -> str:
    """What does not hold in a case; empty where all does. An error of the evaluator holds only where it must refuse."""
    exact: list[Decimal] = []
    try:
        with localcontext(_DIGITS):
            for found, right, scale in numbers():
                exact.append(right)
                if not math.isfinite(found):
                    if abs(right) <= _FINITE:
                        return f"gives {found}, exact is {float(right)!r}"
                elif abs(Decimal(found) - right) > (0 if scale is None else _TOLERANCE * scale + _TINY):
                    return f"gives {found!r}, exact is {float(right)!r}"
    except OverflowError:  # no float64 can hold it: there is nothing to compare
        return ""
    except ValueError as error:
        return f"refused: {error}"
    return ""


def _cases(given: ContactInput, contact: Contact) -> Iterator[_Case]:
    kind, one = contact.row.kind, contact.oscillation
    if kind in {"curve", "linear"}:
        law = next(name for name in _NORMAL if name in given.assigned and one.element in given.assigned[name].rows)
        yield from _Normal(given, law, _parameters(given, law, one.element), one.element).cases()
    elif kind == "nodal":
        yield from _Normal(given, "nodal", _parameters(given, "nodal", one.node), one.element).cases()
    elif kind == "unloading":
        law = next(name for name in _NORMAL if name in given.assigned and one.element in given.assigned[name].rows)
        normal = _Normal(given, law, _parameters(given, law, one.element), one.element)
        yield from _Unloading(normal, _parameters(given, "unloading", one.element)).cases()
    elif kind in {"lateral", "suction spring"}:
        yield from _Spring(given, kind, _parameters(given, kind, one.element), one.element).cases()
    elif kind == "friction":
        yield from _Friction(given, _parameters(given, "friction", one.node), contact).cases()
    elif kind == "suction" and one.stiffness == 0.0:
        yield from _Suction(given, _parameters(given, "suction", one.element), one.element).cases()


def _power(number: float) -> str:
    """A power of ten."""
    return f"1e{round(math.log10(number))}"


def _parameters(given: ContactInput, law: str, row: int) -> Parameters:
    """The parameters of an element or a node in a law."""
    assigned = given.assigned[law]
    at = int(np.searchsorted(assigned.rows, row))
    return {name: float(values[at]) for name, values in assigned.parameters.items()}


def _probes(
    given: ContactInput, element: int, laws: Mapping[str, Parameters], count: int, length: float = 1.0
) -> ContactModel:
    """An evaluator of separate elements on a flat seabed, all with the same laws."""
    diameter = float(given.diameter[element])
    assigned = [
        LawAssignment(name, np.arange(count * (1 + (law_named(name).acts_on == "nodes"))), parameters)
        for name, parameters in laws.items()
    ]
    probes = ContactInput(
        node_ids=np.arange(1, 2 * count + 1),
        coordinates=np.zeros((2 * count, 3)),
        element_ids=np.arange(1, count + 1),
        element_nodes=np.arange(2 * count).reshape(count, 2),
        length=np.full(count, length),
        diameter=np.full(count, diameter),
        laws=tuple(assigned),
        curves=given.curves,
        tension=given.tension,
    )
    return ContactModel(probes, backend="numpy")


def _at(depths: Sequence[float] | FloatArray, length: float = 1.0, moved: float = 0.0, side: int = 1) -> FloatArray:
    """Positions of the probes (2 k, 3) at depths (k,), along Y, moved along an axis."""
    points = np.zeros((2 * len(depths), 3))
    points[:, 0] = -np.repeat(np.asarray(depths, np.float64), 2)
    points[1::2, 1] = length
    points[:, side] += moved
    return points


# -------------------------------------------------------------------------------------------------------------- normal


@dataclass(frozen=True)
class _Normal:
    """A curve, a linear or a smoothed law of an element, or nodal springs."""

    given: ContactInput
    law: str
    numbers: Parameters
    element: int

    @property
    def size(self) -> float:
        """The diameter, or a usual one where there is none."""
        diameter = float(self.given.diameter[self.element])
        return diameter if math.isfinite(diameter) else _DIAMETER

    @property
    def _curve(self) -> ForceCurve | None:
        return self.given.curves[int(self.numbers["curve"])] if self.law == "curve" else None

    @property
    def _onset(self) -> float:
        """The depth at which contact begins."""
        half_width = self.numbers.get("half_width", 0.0)
        return -half_width if half_width and not self.numbers.get("one_sided", 0.0) else 0.0

    def cases(self) -> Iterator[_Case]:
        inside, size = self.inside(), self.size
        yield "at the mudline to the bit", partial(self._forces, [self._onset, float(np.nextafter(self._onset, -1.0))])
        if (curve := self._curve) is not None:
            yield "at its given points to the bit", partial(_at_points, curve)
        yield f"{_power(FAR)} diameters deep", partial(self._forces, [FAR * size])
        yield f"{_power(FAR)} diameters above", partial(self._forces, [-FAR * size])
        for factor in (FACTOR, 1.0 / FACTOR):
            yield f"stiffness x {_power(factor)}", partial(_Normal._forces, self._scaled(factor), inside)
        for length in (TINY_LENGTH, FAR):
            yield f"elements of length {_power(length)}", partial(self._forces, inside, length)

    def inside(self) -> list[float]:
        """Depths between the points of the law."""
        if (curve := self._curve) is not None:
            below = np.append(0.0, curve.ratios[curve.ratios > 0.0])
            return (self.size * (0.37 * below[:-1] + 0.63 * below[1:])).tolist() or [0.1 * self.size]
        width = self.numbers.get("half_width", 0.0)
        return [0.37 * self.size, *([0.4 * width, 1.7 * width] if width else [])]

    def _scaled(self, factor: float) -> _Normal:
        if (curve := self._curve) is None:
            return replace(self, numbers={**self.numbers, "stiffness": factor * self.numbers["stiffness"]})
        with np.errstate(over="ignore"):
            forces = np.clip(factor * curve.forces, -_CLIPPED, _CLIPPED)
        scaled = ForceCurve(np.column_stack([curve.ratios, forces]))
        return replace(self, given=replace(self.given, laws=(), curves=(scaled,)), numbers={"curve": 0.0})

    def _forces(self, depths: Sequence[float], length: float = 1.0) -> Iterator[_Number]:
        """Forces of elements at depths, and the reactions of their nodes."""
        exacts = [self.exact(depth) for depth in depths]
        if max(abs(term) for exact in exacts for term in exact) * Decimal(max(length, 1.0)) > _FINITE:
            raise OverflowError
        model = _probes(self.given, self.element, {self.law: self.numbers}, len(depths), length)
        result = model.evaluate(_at(depths, length))
        reactions = result.reaction[:, 0].reshape(-1, 2).sum(axis=1)
        for index, (exact, scale) in enumerate(exacts):
            if self.law == "nodal":
                yield _Number(float(reactions[index]), 2 * exact, 2 * scale or None)
                continue
            yield _Number(float(result.force[index]), exact, scale or None)
            yield _Number(float(reactions[index]), exact * Decimal(length), scale * Decimal(length) or None)

    def steepest(self, depth: float) -> Decimal:
        """The steepest stiffness between the mudline and a depth below the zone of smoothing."""
        curve = self._curve
        if curve is None:
            return Decimal(self.numbers["stiffness"])
        points = [(Decimal(r), Decimal(f)) for r, f in zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True)]
        size, last = Decimal(self.size), len(points) - 2
        return max(
            (f1 - f0) / (r1 - r0) / size
            for i, ((r0, f0), (r1, f1)) in enumerate(pairwise(points))
            if r0 * size < Decimal(depth) and (r1 > 0 or i == last)
        )

    def exact(self, depth: float) -> tuple[Decimal, Decimal]:
        """The force at a depth and the largest term of its sum, 0 off the seabed."""
        z, zero = Decimal(depth), Decimal(0)
        if depth <= self._onset:
            return zero, zero
        curve = self._curve
        if curve is not None:
            ratio = z / Decimal(self.size)
            points = [
                (Decimal(r), Decimal(f)) for r, f in zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True)
            ]
            at = max((i for i, point in enumerate(points[:-1]) if point[0] <= ratio), default=0)
            (r0, f0), (r1, f1) = points[at : at + 2]
            rise = (f1 - f0) / (r1 - r0) * (ratio - r0)
            force = f0 + rise
            pulls = self.given.tension == "cut" and force < 0
            return zero if pulls else force, max(abs(f0), abs(f1), abs(rise), abs((f1 - f0) / (r1 - r0) * ratio))
        k, h = Decimal(self.numbers["stiffness"]), Decimal(self.numbers.get("half_width", 0.0))
        into = z - Decimal(self._onset)
        force = k * into * into / (4 * h) if h and into < 2 * h else k * (into - h)
        return force, k * max(abs(into), h)


def _at_points(curve: ForceCurve) -> Iterator[_Number]:
    """The forces of a curve at its points."""
    found = curve.evaluate(curve.ratios)[0]
    for force, exact in zip(found.tolist(), curve.forces.tolist(), strict=True):
        yield _Number(force, Decimal(exact), None)


@dataclass(frozen=True)
class _Unloading:
    """The line on which an element with a normal law is unloaded."""

    normal: _Normal
    numbers: Parameters

    def cases(self) -> Iterator[_Case]:
        usual, size = self.normal.inside()[-1], self.normal.size
        yield "unloaded to the mudline", partial(self._forces, usual, 0.0)
        for deepest in (usual, FAR * size):
            yield f"unloaded from {_power(deepest / size)} diameters", partial(self._forces, deepest, 1.0 - 1e-6)
        steeper = replace(self, numbers={"stiffness": FACTOR * self.numbers["stiffness"]})
        yield f"unloading stiffness x {_power(FACTOR)}", partial(_Unloading._forces, steeper, usual, 1.0 - 1e-13)

    def _forces(self, deepest: float, share: float) -> Iterator[_Number]:
        """The force at a share of the largest penetration: F_max - ku' (z_max - z), and not below 0."""
        given, element, law = self.normal.given, self.normal.element, self.normal.law
        model = _probes(given, element, {law: self.normal.numbers, "unloading": self.numbers}, 1)
        points, after = _at([deepest]), _at([share * deepest])
        _, state = model.step(points, np.zeros_like(points), model.initial_state())
        result, _ = model.step(after, np.zeros_like(points), state)
        most, _ = self.normal.exact(deepest)
        steepest = max(Decimal(self.numbers["stiffness"]), self.normal.steepest(deepest), most / Decimal(deepest))
        line = most - steepest * (Decimal(deepest) - Decimal(share * deepest))
        yield _Number(float(result.force[0]), max(Decimal(0), line), most)


@dataclass(frozen=True)
class _Spring:
    """Springs against uplift or to the side, of an element on a linear seabed."""

    given: ContactInput
    law: str
    numbers: Parameters
    element: int

    def cases(self) -> Iterator[_Case]:
        scaled = replace(self, numbers={**self.numbers, "stiffness": FACTOR * self.numbers["stiffness"]})
        extent = self.numbers.get("extent", FAR)
        yield f"displaced by {_power(TINY_LENGTH)}", partial(self._forces, TINY_LENGTH)
        yield "displaced to its end", partial(self._forces, extent)
        yield f"displaced by {_power(FAR)}", partial(self._forces, max(FAR, 2.0 * extent))
        yield f"stiffness x {_power(FACTOR)}", partial(_Spring._forces, scaled, 0.5 * extent)

    def _forces(self, moved: float) -> Iterator[_Number]:
        laws = {"linear": {"stiffness": 1.0}, self.law: self.numbers}
        model, points = _probes(self.given, self.element, laws, 1), _at([_PRESSED])
        _, state = model.step(points, np.zeros_like(points), model.initial_state())
        side = self.law == "lateral"
        after = _at([_PRESSED], moved=moved, side=2) if side else _at([-moved])
        result, _ = model.step(after, np.zeros_like(points), state)
        exact = -Decimal(self.numbers["stiffness"]) * Decimal(moved)
        if not side and moved > self.numbers["extent"]:
            exact = Decimal(0)
        yield _Number(float(result.reaction[:, 2 if side else 0].sum()), exact, abs(exact) or None)


# ------------------------------------------------------------------------------------------------------------- friction


@dataclass(frozen=True)
class _Friction:
    """Friction of a node on a linear seabed, along the direction with the stiffer spring."""

    given: ContactInput
    numbers: Parameters
    contact: Contact

    def cases(self) -> Iterator[_Case]:
        for far in (TINY_LENGTH, FAR):
            yield f"displaced by {_power(far)}", partial(self._forces, far)
        yield f"stiffness x {_power(FACTOR)}", partial(self._forces, _PRESSED, press=FACTOR)
        for dt in STEPS:
            yield f"steps of {_power(dt)} s", partial(self._forces, _PRESSED, dt=dt)

    def _forces(self, moved: float, press: float = 1.0, dt: float | None = None) -> Iterator[_Number]:
        numbers = {**self.numbers, "angle": math.nan}
        laws = {"linear": {"stiffness": press * max(self.contact.row.stiffness, 1e-300)}, "friction": numbers}
        model = _probes(self.given, self.contact.oscillation.element, laws, 1)
        for axis, side in enumerate(("axial", "lateral"), start=1):
            points = _at([_PRESSED])
            _, state = model.step(points, np.zeros_like(points), model.initial_state())
            after = _at([_PRESSED], moved=moved, side=axis)
            result, _ = model.step(after, None if dt else np.zeros_like(after), state, dt)
            for node in range(2):
                normal = Decimal(float(result.normal_force[node]))
                limit = Decimal(numbers[f"{side}_coefficient"]) * normal
                constant, way = (
                    numbers[f"{side}_stiffness"],
                    Decimal(float(after[node, axis])) - Decimal(float(points[node, axis])),
                )
                spring = limit / Decimal(numbers[f"{side}_mobilisation"]) if math.isnan(constant) else Decimal(constant)
                exact = min(spring * way, limit)
                yield _Number(-float(result.reaction[node, axis]), exact, max(exact, limit / 1000))


# -------------------------------------------------------------------------------------------------------------- suction


@dataclass(frozen=True)
class _Suction:
    """Suction after Bridge et al. of an element on a linear seabed."""

    given: ContactInput
    numbers: Parameters
    element: int

    def cases(self) -> Iterator[_Case]:
        for velocity in (FAST, _SLOW):
            yield f"velocity {_power(velocity)}", partial(self._forces, velocity)
        yield f"suction x {_power(FACTOR)}", partial(_Suction._forces, self._scaled(FACTOR), 1.0)
        for dt in STEPS:
            yield f"steps of {_power(dt)} s", partial(self._forces, None, dt)

    def _scaled(self, factor: float) -> _Suction:
        return replace(self, numbers={**self.numbers, "force_factor": factor * self.numbers["force_factor"]})

    def _forces(self, velocity: float | None, dt: float | None = None) -> Iterator[_Number]:
        """Forces on the rise, on the plateau and on the release, after a step in compression."""
        laws = {"linear": {"stiffness": 1.0}, "suction": self.numbers}
        first, second = self.numbers["first_corner"], self.numbers["second_corner"]
        for share in (0.5 * first, 0.5 * (first + second), 0.5 * (1.0 + second)):
            uplift = share * float(self._depth(Decimal(velocity or 1.0)))
            model, points = _probes(self.given, self.element, laws, 1), _at([_PRESSED])
            _, state = model.step(points, np.zeros_like(points), model.initial_state())
            after, rates = _at([-uplift]), np.zeros_like(points)
            rates[:, 0] = velocity or 0.0
            result, _ = model.step(after, None if dt else rates, state, dt)
            speed = Decimal(velocity) if velocity else (Decimal(uplift) + Decimal(_PRESSED)) / Decimal(dt or 1.0)
            exact, scale = self._exact(Decimal(uplift), speed)
            yield _Number(float(result.force[0]), exact, scale)

    def _depth(self, v: Decimal) -> Decimal:
        """Uplift at breakout."""
        factor, exponent = Decimal(self.numbers["depth_factor"]), Decimal(self.numbers["depth_exponent"])
        fastest = max(v, Decimal(self.numbers["regularisation"]))
        return factor * fastest**exponent

    def _exact(self, x: Decimal, v: Decimal) -> tuple[Decimal, Decimal]:
        """The force at an uplift, <= 0, and the largest suction at this velocity."""
        n, slow = Decimal(self.numbers["force_exponent"]), Decimal(self.numbers["regularisation"])
        cyclic = self.numbers["cyclic"] if math.isnan(self.numbers["cyclic_floor"]) else 1.0
        pace = max(v, slow) if n < 2 else v
        r = v / pace
        most = Decimal(self.numbers["force_factor"]) * Decimal(cyclic) * pace**n * r * (2 - n + (n - 1) * r)
        share = x / self._depth(v)
        first, second = (Decimal(self.numbers[f"{name}_corner"]) for name in ("first", "second"))
        part = max(Decimal(0), min(share / first, Decimal(1), (1 - share) / (1 - second)))
        return -most * part, most
