"""The steps of a series, one after the other, in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.elements import embed, follow_curves, follow_lines, gather, hold_back
from mudline.contact.compiled.floor import begin, gaps, velocities
from mudline.contact.compiled.friction import rub
from mudline.contact.compiled.history import suck, unload
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out, Work
from mudline.contact.compiled.nodes import bend, lift, point, sound
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


@jitted
def press(tables: Tables, step: int, memory: tuple[Memory, Memory], work: Work, out: Out) -> bool:
    """Write the elements of a step; return whether everything is finite."""
    elements, curves = tables.elements, tables.curves
    embed(elements, step, work, out)
    follow_curves(elements, curves, tables.has.cuts, step, out)
    follow_lines(elements, step, out)
    hold_back(elements, step, work, out)
    unload(elements, curves, step, memory, work, out)
    if tables.has.suction:
        suck(elements, tables.laws, step, memory, work, out)
    return gather(elements, step, out)


@jitted
def react(  # noqa: PLR0913, PLR0917 - all that a step is made of
    path: Path, ground: Ground, tables: Tables, step: int, memory: tuple[Memory, Memory], work: Work, out: Out
) -> bool:
    """Write the nodes of a step; return whether everything is finite."""
    elements, nodes, has = tables.elements, tables.nodes, tables.has
    points, normals = path.points[step], path.normals[step if len(path.normals) > 1 else 0]
    fine = True
    lift(nodes, normals, step, out)
    if has.friction or has.lateral:
        add_tangents(elements, points, work.tangent)
        point(normals, work.tangent)
    if has.friction:
        line = (path.laid, elements.ends, ground.elements_at)
        fine = rub(nodes, step, (points, normals, work.tangent), line, memory, out)
    if has.lateral:
        touchdown = (memory[0].touchdown, memory[1].touchdown)
        spring_back(elements, points, normals, out.contact[step], touchdown, work.sideways)
        bend(normals, step, work, out)
    return fine and sound(out.reaction[step])


def walk_for(edition: int) -> Walk:
    """Make the function; a new `edition` of what it calls makes a compiled one that was kept useless."""

    def walk(path: Path, ground: Ground, tables: Tables, memory: tuple[Memory, Memory], work: Work, out: Out) -> int:
        """Write all steps of `out`, and what is remembered behind them; return the first that is not finite, or -1.

        A new step's memory is written to the second one; only the first step looks into the first.
        """
        before, after = memory
        fine = edition >= 0
        for step in range(len(path.points)):
            points, normals, gap = path.points[step], path.normals[step if len(path.normals) > 1 else 0], out.gap[step]
            fine &= gaps(points, normals, gap, ground.plain)
            if tables.has.suction:
                earlier = path.earlier if step == 0 else path.points[step - 1]
                fine &= velocities(path.rates[step], earlier, path.dt[step], normals, gap, work.along)
            begin(work, out.normal_force[step])
            fine &= press(tables, step, (before, after), work, out)
            fine &= react(path, ground, tables, step, (before, after), work, out)
            if not fine:
                return step
            before = after
        return -1

    return walk
