"""Loops over the elements of a step: depth, normal laws, springs against uplift, and the sums at the nodes."""

from __future__ import annotations

import math

from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Out, Work
from mudline.contact.compiled.springs import passed, zone
from mudline.contact.compiled.tables import Curves, Elements


@jitted
def embed(elements: Elements, step: int, work: Work, out: Out) -> None:
    """Write depth, ratio and contact, and no force."""
    ends, numbers = elements.ends, elements.numbers
    gap, depth, ratio, contact = out.gap[step], out.depth[step], out.ratio[step], out.contact[step]
    force, slope, stiffness, height = out.force[step], out.slope[step], out.stiffness[step], work.height
    for e in range(len(ends)):
        deep = 0.0 - (0.5 * gap[ends[e, 0]] + 0.5 * gap[ends[e, 1]])
        diameter, onset = numbers[e, 1], numbers[e, 3]
        depth[e], ratio[e], contact[e], height[e] = deep, deep / diameter, deep > onset, onset - deep
        force[e] = stiffness[e] = 0.0
        slope[e] = 0.0 * diameter  # NaN without a diameter
    work.compressed[:] = contact


@jitted
def follow_curves(elements: Elements, curves: Curves, cuts: bool, step: int, out: Out) -> None:  # noqa: FBT001 - compiled calls name no arguments
    """Write the forces of elements on curves."""
    held, curve, numbers = elements.on_curve, elements.curve, elements.numbers
    first, last, ratios, forces, tails = curves.first, curves.last, curves.ratios, curves.forces, curves.tails
    ratio, contact, force = out.ratio[step], out.contact[step], out.force[step]
    slope, stiffness, cut = out.slope[step], out.stiffness[step], out.cut[step]
    for e in held:
        if contact[e]:
            i = passed(ratios, first[curve[e]], last[curve[e]], ratio[e])
            value, rise = forces[i] + tails[i] * (ratio[e] - ratios[i]), tails[i]
            cut[e] = cuts and value < 0.0
            if cut[e]:
                value, rise = 0.0, 0.0
            force[e], slope[e], stiffness[e] = value, rise, rise / numbers[e, 1]


@jitted
def follow_lines(elements: Elements, step: int, out: Out) -> None:
    """Write the forces of elements with linear laws."""
    held, numbers, one_sided = elements.on_line, elements.numbers, elements.one_sided
    depth, contact, force = out.depth[step], out.contact[step], out.force[step]
    slope, stiffness = out.slope[step], out.stiffness[step]
    for e in held:
        if contact[e]:
            force[e], stiffness[e] = zone(depth[e], numbers[e, 2], numbers[e, 4], one_sided[e])
            slope[e] = stiffness[e] * numbers[e, 1]


@jitted
def hold_back(elements: Elements, step: int, work: Work, out: Out) -> None:
    """Add the springs against uplift."""
    held, numbers, height = elements.sprung, elements.numbers, work.height
    force, slope, stiffness = out.force[step], out.slope[step], out.stiffness[step]
    for e in held:
        if 0.0 < height[e] <= numbers[e, 6]:
            force[e] -= numbers[e, 5] * height[e]
            stiffness[e] += numbers[e, 5]
            slope[e] += numbers[e, 5] * numbers[e, 1]


@jitted
def gather(elements: Elements, step: int, out: Out) -> bool:
    """Add the forces up at the nodes; return whether everything is finite."""
    ends, numbers, total = elements.ends, elements.numbers, out.normal_force[step]
    force, slope, stiffness, ratio = out.force[step], out.slope[step], out.stiffness[step], out.ratio[step]
    depth, wrong = out.depth[step], 0
    for e in range(len(ends)):
        load = force[e] * numbers[e, 0]
        total[ends[e, 0]] += load
        total[ends[e, 1]] += load
        wrong += not math.isfinite(load + stiffness[e])
        wrong += (abs(slope[e]) == math.inf) | (abs(ratio[e]) == math.inf) | (abs(depth[e]) == math.inf)
    return wrong == 0
