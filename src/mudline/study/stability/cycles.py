"""Newton's method on friction that holds up to a limit: iterates that go round for ever, and the cure.

A structure of stiffness kb, held by a friction spring kt up to mu N, is pulled with a force F:

    r(u) = kb u + clip(kt u, -mu N, mu N) - F.

From where it slips, the iterates jump between (F - mu N) / kb and (F + mu N) / kb while both slip and |F| < mu N. Two
cures: corrections that are halved, up to ten times, until the residual falls; and a bracket, which keeps the two
nearest points between which the residual changes its sign, and is halved where Newton's method would leave it. The
friction is that of the evaluator.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.study.newton import ROUND_OFF, TOLERANCE, Newton
from mudline.study.report import Layout, Section

STARTS = np.linspace(-20.0, 20.0, 101)
MOST = 50
RATIOS = (1.0, 9.0, 99.0, 1e4, 1e6)
FORCES = (0.1, 0.5, 0.9, 1.5)


class FrictionProblem(NamedTuple):
    """kb, kt, mu N and F, in any one system of units."""

    structure: float
    spring: float
    limit: float
    force: float


EXAMPLE = FrictionProblem(1.0, 99.0, 10.0, 5.0)


class Path(NamedTuple):
    """Iterates of one solution, and whether it converged."""

    iterates: list[float]
    iterations: int
    converged: bool


class Ensemble(NamedTuple):
    """Solutions from many starts.

    starts: how many.
    converged: how many converged.
    mean: iterations of these; NaN without any.
    most: iterations of the slowest of these.
    """

    starts: int
    converged: int
    mean: float
    most: int

    @property
    def failed(self) -> int:
        """How many did not."""
        return self.starts - self.converged


def path(pulled: FrictionProblem, start: float, newton: Newton) -> Path:
    """Follow Newton's method from one start: the points that it took, the start first."""
    points = [start]
    for most in range(1, newton.most + 1):
        solution = Newton(newton.tolerance, most, newton.halving).solve(
            lambda u: residual(pulled, u), np.array([start])
        )
        if int(solution.iterations[0]) < most:
            break
        points.append(float(solution.root[0]))
        if solution.residual[0] == 0.0:
            break
    return Path(points, len(points) - 1, bool(solution.residual[0] == 0.0))


def ensemble(pulled: FrictionProblem, newton: Newton) -> Ensemble:
    """Solve from all of `STARTS`."""
    solution = newton.solve(lambda u: residual(pulled, u), STARTS)
    good = solution.residual == 0.0
    done = solution.iterations[good]
    mean = float(done.mean()) if done.size else float("nan")
    return Ensemble(len(STARTS), int(good.sum()), mean, int(done.max(initial=0)))


def residual(pulled: FrictionProblem, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Residuals at displacements (k,), their derivatives, and their largest terms."""
    count = len(u)
    law = FrictionLaw(
        np.ones((count, 2)),
        np.full((count, 2), pulled.spring),
        np.full((count, 2), np.nan),
        np.zeros(count, np.bool_),
        np.ones(count, np.bool_),
    )
    stuck = FrictionHistory(np.zeros((count, 3)), np.ones((count, 2), np.int8))
    points = np.zeros((count, 3))
    points[:, 1] = u
    along, across = np.tile([0.0, 1.0, 0.0], (count, 1)), np.tile([0.0, 0.0, 1.0], (count, 1))
    held = slide(law, stuck, points, (along, across), np.full(count, pulled.limit))
    friction, own = held.force[:, 0], pulled.structure * u
    size = np.maximum(np.maximum(np.abs(own), np.abs(friction)), abs(pulled.force))
    return own - friction - pulled.force, pulled.structure - held.by_position[:, 0, 0], size


class CycleCount(NamedTuple):
    """Ensembles of one case.

    ratio: spring over structure, kt / kb.
    share: force over limit, F / mu N.
    starts: how many.
    plain, halved, bracketed: from how many of them the three methods do not converge.
    most: iterations of the slowest with the bracket.
    """

    ratio: float
    share: float
    starts: int
    plain: int
    halved: int
    bracketed: int
    most: int


CYCLES = Layout[CycleCount](
    "newton-cycles",
    "Newton's method on friction that slips",
    {
        "spring / structure [-]": lambda one: one.ratio,
        "force / limit [-]": lambda one: one.share,
        "starts": lambda one: one.starts,
        "lost: plain": lambda one: one.plain,
        "lost: halved corrections": lambda one: one.halved,
        "lost: bracketed": lambda one: one.bracketed,
        "most iterations, bracketed": lambda one: one.most,
    },
)


def study_cycles() -> Section:
    """From how many starts each method fails, and the iterates of the example."""
    plain, halved = (
        path(EXAMPLE, 1.0, Newton(most=most, halving=halving)) for most, halving in ((6, False), (50, True))
    )
    note = (
        "Newton's method on friction (kb = 1, kt = 99, mu N = 10, F = 5, from 1) goes "
        f"{_points(plain.iterates)}, ... without end; with halved corrections {_points(halved.iterates)}: "
        f"{halved.iterations} iterations."
    )
    return Section([CYCLES.table(cycle_counts())], notes=[note])


def _points(iterates: Sequence[float]) -> str:
    return ", ".join(f"{point:.4g}" for point in iterates)


def cycle_counts() -> list[CycleCount]:
    """Springs from as stiff as the structure to 10^6 times as stiff, forces below and above the limit."""
    return [_cycle_count(ratio, share) for ratio in RATIOS for share in FORCES]


def _cycle_count(ratio: float, share: float) -> CycleCount:
    pulled = FrictionProblem(1.0, ratio, 10.0, 10.0 * share)
    plain, halved = (ensemble(pulled, Newton(most=MOST, halving=halving)) for halving in (False, True))
    safe = bracketed(pulled, STARTS)
    failed = int((safe < 0).sum())
    return CycleCount(ratio, share, len(STARTS), plain.failed, halved.failed, failed, int(safe.max()))


def bracketed(pulled: FrictionProblem, starts: FloatArray) -> IndexArray:
    """Iterations (k,) of Newton's method with a bracket from `starts` (k,); -1 where it does not converge."""
    u = np.array(starts)
    low, high = np.full(u.shape, -np.inf), np.full(u.shape, np.inf)
    taken = np.full(u.shape, -1, np.intp)
    for iteration in range(MOST + 1):
        value, slope, size = residual(pulled, u)
        done = np.abs(value) <= np.maximum(TOLERANCE, ROUND_OFF * size)
        taken = np.where(done & (taken < 0), iteration, taken)
        if done.all():
            break
        low, high = np.where(value < 0.0, u, low), np.where(value > 0.0, u, high)
        trial = u - value / slope
        known = np.isfinite(low) & np.isfinite(high)
        middle = 0.5 * (np.where(known, low, 0.0) + np.where(known, high, 0.0))
        trial = np.where(known & ((trial <= low) | (trial >= high)), middle, trial)
        u = np.where(done, u, trial)
    return taken
