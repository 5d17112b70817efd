"""The steps of a series, one after the other, in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple


from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.elements import press
from mudline.contact.compiled.floor import begin, gaps, velocities
from mudline.contact.compiled.memory import Memory, Out, Work
from mudline.contact.compiled.nodes import react
from mudline.contact.compiled.sideways import add_tangents, spring_back
from mudline.contact.compiled.tables import SmallIndexArray, Tables


class Ground(NamedTuple):
    """The bed: 0 where a floor wrote the gaps, 1 for a flat bed, 2 for a plane through the origin; and the line on it.

    `elements_at` (n, 2) are the first two elements at each node.
    """

    plain: int
    elements_at: SmallIndexArray


class Path(NamedTuple):
    """Where the nodes are: all read only.

    points: (steps, n, 3).
    rates: (steps, n, 3) velocities, or the points again where these are differences over `dt`.
    dt: (steps,) 0 for velocities that are given.
    earlier: (n, 3) points of the step before the first.
    laid: (n, 3) points of the first step of the series.
    normals: (steps, n, 3), or (1, 1, 3) where all points share it.
    """

    points: FloatArray
    rates: FloatArray
    dt: FloatArray
    earlier: FloatArray
    laid: FloatArray
    normals: FloatArray


Walk = Callable[[Path, Ground, Tables, tuple[Memory, Memory], Work, Out], int]


def walk_for(edition: int) -> Walk:
    """Make the function; a new `edition` of what it calls makes a compiled one that was kept useless."""

    def walk(path: Path, ground: Ground, tables: Tables, memory: tuple[Memory, Memory], work: Work, out: Out) -> int:
        """Write all steps of `out`, and what is remembered behind them; return the first that is not finite, or -1.

        A new step's memory is written to the second one; only the first step looks into the first.
        """
        steps = len(path.points)
        has, elements = tables.has, tables.elements
        before, after = memory
        fine = edition >= 0
        for step in range(steps):
            points, normals = path.points[step], path.normals[step if len(path.normals) > 1 else 0]
            fine &= gaps(points, normals, out.gap[step], ground.plain)
            if has.suction:
                earlier = path.earlier if step == 0 else path.points[step - 1]
                fine &= velocities(path.rates[step], earlier, path.dt[step], normals, out.gap[step], work.along)
            begin(work, out.normal_force[step])
            fine &= press(tables, step, work.along, before, after, out)
            if has.friction or has.lateral:
                add_tangents(elements, points, work.tangent)
            if has.lateral:
                touchdown = (before.touchdown, after.touchdown)
                spring_back(elements, points, normals, out.contact[step], touchdown, work.sideways)
            fine &= react(tables, step, (points, normals, path.laid), ground.elements_at, (before, after), work, out)
            if not fine:
                return step
            before = after
        return -1

    return walk
