"""Static solutions: several of them during the release of suction, and Newton's method on friction that finds none.

On the release the suction falls with slope F_max / ((1 - xc2) Delta_B). A pipe suspended from a structure of
stiffness ks (per unit length), whose far end is raised slowly, has one equilibrium at each height of that end only for
a greater ks.

A structure of stiffness kb, held by a friction spring kt up to mu N, is pulled with a force F:

    r(u) = kb u + clip(kt u, -mu N, mu N) - F.

From where it slips, with 0 <= F < mu N, the next iterate is (F - mu N) / kb, which slips the other way where
kt (mu N - F) / kb > mu N, that is

    kt / kb > 1 / (1 - F / (mu N));

from there it is (F + mu N) / kb, which slips too: the iterates alternate between the two without end. Two remedies:

* corrections that are halved until the residual falls. Beside the limit, at u = mu N / kt, the correction is
  about (mu N - F) / kb, and the residual falls only within 2 (mu N - F) / (kb + kt) of it: about log2(kt / kb) - 1
  halvings are needed, and with a lower cap some starts do not converge;
* a bracket, which keeps the two nearest points between which the residual changes its sign, and is halved where
  Newton's method would leave it.

The friction is that of the evaluator.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.input import AssignedLaw
from mudline.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, breakout_uplift, maximum_force, step
from mudline.contact.stiffest import release_stiffness
from mudline.scene.model import Scene
from mudline.study.newton import Newton
from mudline.study.report import Layout, Omission, Section, StudyOptions, columns_of

VELOCITIES = (1e-3, 1e-2, 1e-1, 1.0)
SHARES = (0.5, 0.99, 1.01, 2.0)
"""Structural stiffness over the one that is needed."""
_POINTS = 4001


class Release(NamedTuple):
    """Suction of an element at a pull-out velocity (length unit per second), per unit length.

    element: number of the element.
    force: largest suction.
    depth: uplift at breakout.
    needed: stiffness that a structure must have for one equilibrium.
    equilibria: the most equilibria at any one height, for each of `SHARES` of the needed stiffness.
    """

    element: Annotated[int, "element"]
    velocity: Annotated[float, "velocity [{length}/s]"]
    force: Annotated[float, "largest suction [{force}/{length}]"]
    depth: Annotated[float, "breakout [{length}]"]
    needed: Annotated[float, "needed stiffness [{force}/{length}2]"]
    equilibria: tuple[int, ...]


def _equilibria(index: int) -> Callable[[Release], int]:
    return lambda one: one.equilibria[index]


RELEASE = Layout[Release](
    "release",
    "Structural stiffness for one equilibrium during the release of suction",
    {
        **columns_of(Release),
        **{f"equilibria at {share:g} of it": _equilibria(index) for index, share in enumerate(SHARES)},
    },
)


def study_release(scene: Scene, options: StudyOptions) -> Section:
    """The stiffness that a structure needs during the release of suction, on the laws of a scene."""
    options.progress("release of suction")
    suction = scene.contact_input().assigned.get("suction")
    omissions = [] if suction is not None else [Omission("release of suction", "no element has *SEABED SUCTION")]
    found = [] if suction is None else releases(scene, suction)
    return Section([RELEASE.table(found, scene.units)], omissions=omissions)


def releases(scene: Scene, suction: AssignedLaw) -> list[Release]:
    """The release of each law of a scene, at the velocity of its regularisation and at `VELOCITIES` above it.

    It is that with the largest cyclic factor that can be: where the factor is applied once per cycle and below 1, that
    of a first uplift.
    """
    laws = SuctionLaw(*suction.columns)
    laws = laws._replace(cyclic=laws.largest_factor, cyclic_floor=np.full(len(suction.rows), np.nan))
    _, first = np.unique(np.column_stack(laws[:-1]), axis=0, return_index=True)
    found = []
    for row in np.sort(first).tolist():
        law = laws.rows(slice(row, row + 1))
        if law.force_factor[0] * law.cyclic[0] == 0.0:
            continue
        slowest = float(law.regularisation[0])
        element = int(scene.element_ids[suction.rows[row]])
        velocities = sorted({slowest, *(v for v in VELOCITIES if v > slowest)} - {0.0})
        found += [_release(element, law, velocity) for velocity in velocities]
    return found


def _release(element: int, law: SuctionLaw, velocity: float) -> Release:
    v = np.array([velocity])
    needed = float(release_stiffness(law, v)[0])
    counts = tuple(equilibria(law, velocity, share * needed) for share in SHARES)
    with np.errstate(all="ignore"):
        force, _ = maximum_force(v, law.force_factor * law.cyclic, law.force_exponent, law.regularisation)
    return Release(element, velocity, float(force[0]), _breakout(law, velocity), needed, counts)


def equilibria(law: SuctionLaw, velocity: float, structure: float) -> int:
    """The largest number of equilibria at one height of the structure's end, up to 1.5 times the uplift at breakout.

    At uplift x the end stands at x + suction / ks: where that falls as x grows, a height belongs to several uplifts.
    """
    uplift = np.linspace(0.0, 1.5 * _breakout(law, velocity), _POINTS)[1:]
    height = uplift + pull(law, velocity, uplift) / structure
    levels = 0.5 * (np.sort(height)[1:] + np.sort(height)[:-1])
    low, high = np.minimum(height[1:], height[:-1]), np.maximum(height[1:], height[:-1])
    starts, ends = np.searchsorted(np.sort(low), levels, "left"), np.searchsorted(np.sort(high), levels, "right")
    return int((starts - ends).max())


def _breakout(law: SuctionLaw, velocity: float) -> float:
    """Uplift at breakout of an element."""
    with np.errstate(all="ignore"):
        return float(breakout_uplift(velocity, law.depth_factor, law.depth_exponent, law.regularisation)[0])


def pull(law: SuctionLaw, velocity: float, uplift: FloatArray) -> FloatArray:
    """Amount of the suction at uplifts (k,) of an armed element that rises with a steady velocity."""
    count = len(uplift)
    rows = SuctionLaw(*(np.repeat(values, count) for values in law))
    none = np.zeros(count)
    _, armed = step(rows, SuctionHistory.initial(rows), none, none, np.ones(count, np.bool_))
    suction, _ = step(rows, armed, uplift, np.full(count, velocity), np.zeros(count, np.bool_))
    return -suction.force


STARTS = np.linspace(-20.0, 20.0, 101)
MOST = 50
RATIOS = (1.0, 9.0, 99.0, 1e4, 1e6)
FORCES = (0.1, 0.5, 0.9, 1.5)


SPRING_OVER_STRUCTURE, FORCE_OVER_LIMIT = "spring / structure [-]", "force / limit [-]"
"""Headings of the tables: kt / kb and F / mu N."""


class FrictionProblem(NamedTuple):
    """kb, kt, mu N and F, in any one system of units."""

    structure: float
    spring: float
    limit: float
    force: float


EXAMPLE = FrictionProblem(1.0, 99.0, 10.0, 5.0)


class NewtonPath(NamedTuple):
    """Iterates of one solution, and whether it converged."""

    iterates: list[float]
    iterations: int
    converged: bool


def newton_path(problem: FrictionProblem, start: float, newton: Newton) -> NewtonPath:
    """Follow Newton's method from one start: the points that it took, the start first."""
    points = [start]
    for most in range(1, newton.most + 1):
        solution = Newton(newton.tolerance, most, newton.halving).solve(
            lambda u: residual(problem, u), np.array([start])
        )
        if int(solution.iterations[0]) < most:
            break
        points.append(float(solution.root[0]))
        if solution.residual[0] == 0.0:
            break
    return NewtonPath(points, len(points) - 1, bool(solution.residual[0] == 0.0))


def newton_failures(problem: FrictionProblem, newton: Newton) -> int:
    """From how many of `STARTS` a solution does not converge."""
    return int((newton.solve(lambda u: residual(problem, u), STARTS).residual != 0.0).sum())


def residual(problem: FrictionProblem, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Residuals at displacements (k,), their derivatives, and their largest terms."""
    count = len(u)
    law = FrictionLaw(
        np.ones((count, 2)),
        np.full((count, 2), problem.spring),
        np.full((count, 2), np.nan),
        np.zeros(count, np.bool_),
        np.ones(count, np.bool_),
    )
    stuck = FrictionHistory(np.zeros((count, 3)), np.ones((count, 2), np.int8))
    points = np.zeros((count, 3))
    points[:, 1] = u
    along, across = np.tile([0.0, 1.0, 0.0], (count, 1)), np.tile([0.0, 0.0, 1.0], (count, 1))
    held = slide(law, stuck, points, (along, across), np.full(count, problem.limit))
    friction, own = held.force[:, 0], problem.structure * u
    size = np.maximum(np.maximum(np.abs(own), np.abs(friction)), abs(problem.force))
    return own - friction - problem.force, problem.structure - held.by_position[:, 0, 0], size


class CycleCount(NamedTuple):
    """Ensembles of one case.

    ratio, share: kt / kb and F / mu N.
    threshold: kt / kb above which Newton's method alone cycles; inf where the pipe slides.
    plain, halved, bracketed: from how many of the starts the three methods do not converge.
    most: iterations of the slowest start.
    """

    ratio: Annotated[float, SPRING_OVER_STRUCTURE]
    share: Annotated[float, FORCE_OVER_LIMIT]
    starts: Annotated[int, "starts"]
    plain: Annotated[int, "lost: plain"]
    halved: Annotated[int, "lost: halved corrections"]
    bracketed: Annotated[int, "lost: bracketed"]
    most: Annotated[int, "most iterations, bracketed"]
    threshold: Annotated[float, "cycles above spring / structure [-]"]


CYCLES = Layout("newton-cycles", "Newton's method on friction that slips", columns_of(CycleCount))


def study_cycles(_: Scene, options: StudyOptions) -> Section:
    """From how many starts each method fails, and the iterates of the example."""
    options.progress("Newton's method on friction")
    plain, halved = (
        newton_path(EXAMPLE, 1.0, Newton(most=most, halving=halving)) for most, halving in ((6, False), (50, True))
    )
    note = (
        "Newton's method on friction (kb = 1, kt = 99, mu N = 10, F = 5, from 1) has the iterates "
        f"{_points(plain.iterates)}, ... without end; with halved corrections {_points(halved.iterates)}: "
        f"{halved.iterations} iterations."
    )
    path = [
        PathPoint(EXAMPLE, method, point)
        for method, found in (("plain", plain), ("halved", halved))
        for point in found.iterates
    ]
    tables = CYCLES.table(cycle_counts()), HALVINGS.table(halving_counts()), PATH.table(path)
    return Section(tables, notes=[note])


class PathPoint(NamedTuple):
    """An iterate of the example."""

    problem: FrictionProblem
    method: Annotated[str, "method"]
    iterate: Annotated[float, "iterate [-]"]


PATH = Layout[PathPoint](
    "newton-path",
    "Iterates of the example",
    {
        **columns_of(PathPoint),
        "kb": lambda one: one.problem.structure,
        "kt": lambda one: one.problem.spring,
        "mu N": lambda one: one.problem.limit,
        "F": lambda one: one.problem.force,
    },
    brief=False,
)


def _points(iterates: Sequence[float]) -> str:
    return ", ".join(f"{point:.4g}" for point in iterates)


def cycle_counts() -> list[CycleCount]:
    """Springs from as stiff as the structure to 10^6 times as stiff, forces below and above the limit."""
    return [_cycle_count(ratio, share) for ratio in RATIOS for share in FORCES]


def cycle_threshold(share: float) -> float:
    """The kt / kb above which Newton's method cycles from where friction slips, at F = share mu N."""
    return 1.0 / (1.0 - share) if share < 1.0 else math.inf


def _cycle_count(ratio: float, share: float) -> CycleCount:
    problem = FrictionProblem(1.0, ratio, 10.0, 10.0 * share)
    plain, halved = (newton_failures(problem, Newton(most=MOST, halving=halving)) for halving in (False, True))
    iterations = bracketed(problem, STARTS)
    lost, most = int((iterations < 0).sum()), int(iterations.max())
    return CycleCount(ratio, share, len(STARTS), plain, halved, lost, most, cycle_threshold(share))


HALVED_RATIOS = (1e2, 2e3, 1e4, 1e6)
CAPS = (5, 10, 15, 20, 25)


class HalvingCount(NamedTuple):
    """The effect of a cap on the halvings of a correction.

    lost: from how many starts no solution is found, for each of `CAPS`.
    needed: halvings that suffice by the closed form.
    least: the smallest cap from which on, up to `needed`, none of the starts is lost.
    """

    ratio: Annotated[float, SPRING_OVER_STRUCTURE]
    share: Annotated[float, FORCE_OVER_LIMIT]
    starts: Annotated[int, "starts"]
    lost: tuple[int, ...]
    needed: int
    least: int


def _lost(index: int) -> Callable[[HalvingCount], int]:
    return lambda one: one.lost[index]


HALVINGS = Layout[HalvingCount](
    "newton-halvings",
    "Newton's method with halved corrections: starts that do not converge with a cap on the halvings",
    {
        **columns_of(HalvingCount),
        **{f"lost: at most {cap} halvings": _lost(index) for index, cap in enumerate(CAPS)},
        "halvings needed": lambda one: one.needed,
        "none lost from a cap of": lambda one: one.least,
    },
)


def halving_counts() -> list[HalvingCount]:
    """Springs that cycle, forces below the limit."""
    return [_halving_count(ratio, share) for ratio in HALVED_RATIOS for share in FORCES if share < 1.0]


def _halving_count(ratio: float, share: float) -> HalvingCount:
    problem = FrictionProblem(1.0, ratio, 10.0, 10.0 * share)
    lost = tuple(halved_failures(problem, cap) for cap in CAPS)
    least = needed = math.ceil(math.log2(ratio)) - 1
    while least and not halved_failures(problem, least - 1):
        least -= 1
    return HalvingCount(ratio, share, len(STARTS), lost, needed, least)


def halved_failures(problem: FrictionProblem, cap: int) -> int:
    """From how many of `STARTS` Newton's method fails whose corrections are halved at most `cap` times."""
    return newton_failures(problem, Newton(most=MOST, halving=True, halvings=cap))


def bracketed(problem: FrictionProblem, starts: FloatArray) -> IndexArray:
    """Iterations (k,) of Newton's method with a bracket from `starts` (k,); -1 where it does not converge."""
    solution = Newton(most=MOST, bracketed=True).solve(partial(residual, problem), starts)
    return np.where(solution.residual == 0.0, solution.iterations, -1)
