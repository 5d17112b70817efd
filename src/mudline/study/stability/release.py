"""Release of suction: where a static solution is unique, and where the pipe snaps off.

On the release the suction falls with slope F_max / ((1 - xc2) Delta_B). A pipe suspended from a structure of
stiffness ks (per unit length), whose far end is raised slowly, has one equilibrium at each height of that end only for
a greater ks.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.input import AssignedLaw
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, breakout_uplift, maximum_force, step
from mudline.contact.stiffest import release_stiffness
from mudline.scene.model import Scene
from mudline.study.report import Layout, Omission, Section, StudyOptions
from mudline.study.stability.contacts import unit_words

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

    element: int
    velocity: float
    force: float
    depth: float
    needed: float
    equilibria: tuple[int, ...]


def _equilibria(index: int) -> Callable[[Release], int]:
    return lambda one: one.equilibria[index]


RELEASE = Layout[Release](
    "release",
    "Structural stiffness for one equilibrium during the release of suction",
    {
        "element": lambda one: one.element,
        "velocity [{length}/s]": lambda one: one.velocity,
        "largest suction [{force}/{length}]": lambda one: one.force,
        "breakout [{length}]": lambda one: one.depth,
        "needed stiffness [{force}/{length}2]": lambda one: one.needed,
        **{f"equilibria at {share:g} of it": _equilibria(index) for index, share in enumerate(SHARES)},
    },
)


def study_release(scene: Scene, options: StudyOptions) -> Section:
    """What suction asks of a structure during its release, on the laws of a scene."""
    options.progress("release of suction")
    suction = scene.contact_input().assigned.get("suction")
    omissions = [] if suction is not None else [Omission("release of suction", "no element has *SEABED SUCTION")]
    found = [] if suction is None else releases(scene, suction)
    return Section([RELEASE.table(found, **unit_words(scene.units))], omissions=omissions)


def releases(scene: Scene, suction: AssignedLaw) -> list[Release]:
    """The release of each law of a scene, at the velocity of its regularisation and at `VELOCITIES` above it.

    It is that of a first uplift: where the cyclic factor is applied once per cycle, none is completed yet.
    """
    laws = SuctionLaw(*suction.columns)
    laws = laws._replace(cyclic=laws.initial_factor, cyclic_floor=np.full(len(suction.rows), np.nan))
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
    """The most equilibria at any one height of the structure's end, in the uplift up to breakout and somewhat beyond.

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
