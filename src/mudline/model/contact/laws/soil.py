"""Hysteretic penetration of `*SEABED SOIL`, after Randolph and Quiggin (2009): the force follows a path.

With zeta = K_max z/D and the resistances P_u(z) = N_c s_u(z) D, against uplift P_s(z) = -f_suc P_u(z), the force P per
unit length is, without the weight of the displaced soil,

* at the largest penetration so far: P_i = P_u zeta/(1 + zeta);
* on an uplift from (z0, P0): P0 - H (P0 - P_s), H = (zeta0 - zeta)/(A + zeta0 - zeta), A = max(0, P0 - P_s)/P_u(z0).
  Its upper bound is T = P_i, or 0 after P fell to 0 on it and where P0 <= 0. Its lower bound is E P_s,
  E = exp((z - z_P)/(lambda_s z_max));
* on a re-penetration from (z0, P0): P0 + H (P_u - P0), H = (zeta - zeta0)/(A + zeta - zeta0), A = (P_u - P0)/P_u(z0),
  P_i from z0 = 0. Its upper bound is max(P0, E P_i), E = exp(-lambda_r + (z - z_P)/z_max). Beyond z_max it meets P_i at
  z_m, and continues as P_i.

Both E are at most 1, and 1 before there is a z_P, the penetration at which P last fell through 0. z_P and z_m follow
from the point where the uplift, or the re-penetration, began: forces depend on the path, and not on the steps along it.

N_c = a (z/D)^b, below z/D = 0.1 N_c(0.1) (10 z/D)^(1/2); s_u = s_u0 + gradient z. Contact begins at z = 0.
"""

from __future__ import annotations

import math

import numpy as np

from mudline.model.contact.laws import Parameter, PathLaw, Value, every, where

DOWN, UP, AGAIN = 0.0, 1.0, 2.0
"""Branches: largest penetration so far, uplift, re-penetration."""
Numbers = tuple[Value, ...]

_TRIALS, _HALF_OCTAVES = 60, 24
"""Largest number of steps to an event, and range of the search beyond z_max: 12 octaves of z."""
_CLOSE = 1e-15
_SHALLOW = 0.1
_UNKNOWN = -1.0


def ultimate(z: Value, diameter: Value, soil: Numbers) -> tuple[Value, Value]:
    """Return P_u and its slope at z >= 0; `soil` are the parameters."""
    su0, gradient, a, b = soil[0], soil[1], soil[2], soil[3]
    shallow = z < _SHALLOW * diameter
    ratio = where(shallow, _SHALLOW, z / diameter)
    factor = a * np.float_power(ratio, b) * where(shallow, np.sqrt(np.maximum(z, 0.0) / (_SHALLOW * diameter)), 1.0)
    strength = su0 + gradient * z
    by_factor = factor * where(shallow, 0.5, b) / where(z > 0.0, z, 1.0)
    return factor * strength * diameter, (by_factor * strength + factor * gradient) * diameter


def initial(z: Value, diameter: Value, soil: Numbers) -> tuple[Value, Value]:
    """Return P_i and its slope at z >= 0."""
    most, rise = ultimate(z, diameter, soil)
    return _first_loading(z, most, rise, soil[4] / diameter)


def _first_loading(z: Value, most: Value, rise: Value, pace: Value) -> tuple[Value, Value]:
    """Return P_i and its slope from P_u and its slope at z; `pace` is zeta / z."""
    share = 1.0 / (1.0 + pace * z)
    return most * (pace * z) * share, rise * (pace * z) * share + most * pace * share * share


def lift(z: Value, diameter: Value, weight: Value) -> tuple[Value, Value]:
    """Return the weight of the soil displaced by the circle of the pipe below the mudline, and its slope."""
    low = np.minimum(np.maximum(z / diameter, 0.0), 1.0)
    half_width = np.sqrt(low * (1.0 - low))  # half of the width at the mudline, over the diameter
    area = 0.5 * _arcsine(np.sqrt(low)) - 0.5 * (1.0 - 2.0 * low) * half_width
    return weight * diameter * diameter * area, weight * diameter * 2.0 * half_width


def _arcsine(sine: Value) -> Value:
    """Return the arcsine of 0 to 1: both backends have equal bits of square roots, not of arcs."""
    for _ in range(3):  # the sine of half of the angle
        sine = sine / np.sqrt(2.0 + 2.0 * np.sqrt(np.maximum(1.0 - sine * sine, 0.0)))
    square, total = sine * sine, 0.0 * sine
    for power in range(21, 0, -2):
        total = 1.0 / power + total * square * (power / (power + 1.0))
    return 8.0 * sine * total


def _exp(exponent: Value) -> Value:
    return np.float_power(math.e, np.minimum(exponent, 0.0))


def begin(z: Value, memory: Numbers) -> Numbers:
    """Return the memory, with a reversal if going to z is one.

    `memory` is z and P of the step before, branch, z_max, z_P, z0, P0, and the event of this branch, if known. The
    event of an uplift is the z where P falls through zero (0: nowhere above the mudline), that of a re-penetration the
    z where it meets P_i.
    """
    before, force, branch, deepest, fallen, z0, p0, event = memory
    rises, sinks = (z < before) & (branch != UP), (z > before) & (branch == UP)
    turns = rises | sinks
    branch = where(rises, UP, where(sinks, AGAIN, branch))
    return (
        before, force, branch, deepest, fallen,
        where(turns, before, z0), where(turns, force, p0), where(turns, _UNKNOWN, event),
    )  # fmt: skip


def pending(z: Value, memory: Numbers) -> Value:
    """Return the event of a branch to be known for going to z: 1 of an uplift, 2 of a re-penetration, 0 for none."""
    _, _, branch, deepest, _, z0, p0, event = memory
    unknown = event == _UNKNOWN
    falls = unknown & (branch == UP) & (p0 > 0.0) & (z < z0)
    return where(falls, 1, where(unknown & (branch == AGAIN) & (z > deepest), 2, 0))


def fall(diameter: Value, memory: Numbers, soil: Numbers) -> Value:
    """Return the z where the uplift falls through zero; 0 if nowhere above the mudline.

    It is the largest root of P_u(z) (z_a - z) = c, as P <= 0 where the left side is at least c.
    """
    strength, gradient, b, pace = soil[0], soil[1], soil[3], soil[4] / diameter
    z0, p0, suction = memory[5], memory[6], np.maximum(soil[5], 1e-300)
    steep = pace * ultimate(z0, diameter, soil)[0]
    top = z0 - p0 / steep
    enough = p0 * p0 / (steep * suction)
    # log P_u is concave: the product has one maximum, and the root lies below it
    edge = _SHALLOW * diameter
    deep = _peak(b, strength, gradient, top)
    low = np.maximum(where(deep > edge, deep, np.minimum(_peak(0.5, strength, gradient, top), edge)), 0.0)
    z = high = np.maximum(top, low)
    falls = (top > 0.0) & (ultimate(low, diameter, soil)[0] * (top - low) >= enough)
    low = where(falls, low, high)
    for _ in range(_TRIALS):
        most, rise = ultimate(z, diameter, soil)
        z, low, high, settled = _narrowed(z, low, high, most * (top - z) - enough, rise * (top - z) - most)
        if every(settled):
            break
    return where(falls, z, 0.0)


def _narrowed(z: Value, low: Value, high: Value, value: Value, slope: Value) -> tuple[Value, Value, Value, Value]:
    """Return z, low, high and whether z is final, after a Newton step or a halving towards a fall through 0.

    A final z is not moved by a further step: so single numbers may stop before others do.
    """
    before = value >= 0.0
    low, high = where(before, z, low), where(before, high, z)
    guess = z - value / where(slope < 0.0, slope, -1.0)
    settled = (np.abs(guess - z) <= _CLOSE * z) | (high - low <= _CLOSE * z)
    guess = where((guess > low) & (guess < high), guess, 0.5 * low + 0.5 * high)
    return where(settled, z, guess), low, high, settled


def _peak(exponent: Value, strength: Value, gradient: Value, top: Value) -> Value:
    """Return the z where (exponent/z + gradient/s_u) (top - z) = 1, for top > 0."""
    square, linear = (exponent + 2.0) * gradient, (exponent + 1.0) * (strength - gradient * top)
    product = exponent * strength * np.maximum(top, 0.0)
    root = np.sqrt(linear * linear + 4.0 * square * product)
    found = 2.0 * product / where(linear < 0.0, 1.0, linear + root)
    return where(linear < 0.0, (root - linear) / (2.0 * where(square > 0.0, square, 1.0)), found)


def _short(z: Value, diameter: Value, memory: Numbers, least: Value, soil: Numbers) -> tuple[Value, Value]:
    """Return the shortfall of the form of a re-penetration below P_i at z, > 0 before they meet, and its slope."""
    z0, p0, pace = memory[5], memory[6], soil[4] / diameter
    most, rise = ultimate(z, diameter, soil)
    rest, share = most - p0, 1.0 + pace * z
    lacks = rest * rest * share - most * rest - most * least * pace * (z - z0)
    slope = rest * (2.0 * rise * share + pace * rest) - rise * (rest + most) - least * pace * (rise * (z - z0) + most)
    return lacks, slope


def meeting(diameter: Value, memory: Numbers, soil: Numbers) -> Value:
    """Return the z where a re-penetration beyond z_max meets P_i; infinity for nowhere.

    The search begins where its bound is P_i. From P0 <= 0 they never meet, from z0 = 0 at once.
    """
    fallen, slow, z0, p0 = memory[4], soil[7], memory[5], memory[6]
    decayed = where(slow < 1.0, fallen / where(slow < 1.0, 1.0 - slow, 1.0), np.inf)
    first = np.maximum(memory[3], where(fallen < 0.0, 0.0, decayed))
    low = high = where(first < np.inf, first, memory[3])
    never = (first == np.inf) | ((p0 <= 0.0) & (z0 > 0.0))
    least = ultimate(z0, diameter, soil)[0]
    met = (z0 <= 0.0) | (_short(high, diameter, memory, least, soil)[0] <= 0.0)
    for _ in range(_HALF_OCTAVES):
        if every(met | never):
            break
        low, high = where(met, low, high), where(met, high, high * 2.0**0.5)
        met = met | (_short(high, diameter, memory, least, soil)[0] <= 0.0)
    low, z = where(met & np.logical_not(never) & (z0 > 0.0), low, high), high
    for _ in range(_TRIALS):
        lacks, slope = _short(z, diameter, memory, least, soil)
        z, low, high, settled = _narrowed(z, low, high, lacks, slope)
        if every(settled):
            break
    return where(met & np.logical_not(never), z, np.inf)


def advance(z: Value, diameter: Value, memory: Numbers, soil: Numbers) -> tuple[Value, Value, Numbers]:
    """Return force, stiffness and the next memory at z; the stiffness is that of continued motion."""
    _, _, branch, deepest, fallen, z0, p0, event = memory
    falls = (branch == UP) & (p0 > 0.0) & (event != _UNKNOWN) & (z <= event)
    fallen = where(falls, event, fallen)
    branch = where((branch == AGAIN) & (event != _UNKNOWN) & (z >= event), DOWN, branch)
    beyond = z > deepest
    deepest = np.maximum(deepest, z)
    most, rise = ultimate(z, diameter, soil)
    least = ultimate(z0, diameter, soil)[0]
    least = where(z0 > 0.0, least, 1.0)
    pace = soil[4] / diameter
    virgin, slope = _first_loading(z, most, rise, pace)
    size = where(deepest > 0.0, deepest, 1.0)

    below, drop = 0.0 - soil[5] * most, 0.0 - soil[5] * rise
    gap = np.maximum(p0 - below, 0.0)
    form, tangent = _form(pace * (z0 - z), gap, drop, least, pace)
    up, up_slope = p0 - form, tangent
    closed = falls | (p0 <= 0.0)
    top, top_slope = where(closed, 0.0, virgin), where(closed, 0.0, slope)
    up_slope, up = where(up > top, top_slope, up_slope), np.minimum(up, top)
    decays = (fallen >= 0.0) & (z < fallen)
    part = where(decays, _exp((z - fallen) / (soil[6] * size)), 1.0)
    low, low_slope = part * below, part * (drop + where(decays, below / (soil[6] * size), 0.0))
    up_slope, up = where(up < low, low_slope, up_slope), np.maximum(up, low)

    rest = most - p0
    form, tangent = _form(pace * (z - z0), rest, rise, least, pace)
    again, again_slope = where(z0 > 0.0, p0 + form, virgin), where(z0 > 0.0, tangent, slope)
    decay = where(fallen >= 0.0, (z - fallen) / size - soil[7], 0.0)
    part = _exp(decay)
    growth = where(decay < 0.0, where(beyond, fallen / size, 1.0) / size, 0.0)
    bound, bound_slope = part * virgin, part * (growth * virgin + slope)
    bound_slope, bound = where(bound < p0, 0.0, bound_slope), np.maximum(bound, p0)
    again_slope, again = where(again > bound, bound_slope, again_slope), np.minimum(again, bound)

    force = where(branch == DOWN, virgin, where(branch == UP, up, again))
    stiffness = where(branch == DOWN, slope, where(branch == UP, up_slope, again_slope))
    heavy, wide = lift(z, diameter, soil[8])
    after = (z, force, branch, deepest, fallen, z0, p0, event)
    return force + heavy, stiffness + wide, after


def _form(gone: Value, reach: Value, rise: Value, least: Value, pace: Value) -> tuple[Value, Value]:
    """Return H reach, and the slope by depth of the force P0 + H reach (re-penetration) or P0 - H reach (uplift).

    `gone` is |zeta - zeta0|, `reach` the distance to the resistance, `rise` the growth of the resistance with z.
    """
    softness = reach / least
    whole = where(gone > 0.0, softness + gone, where(softness > 0.0, softness, 1.0))
    share = gone / whole
    return share * reach, pace * softness / whole * (reach / whole) + rise * (share - share * (reach / least) / whole)


def steepest(z: Value, diameter: Value, *soil: Value) -> Value:
    """Return the stiffness K_max P_u/D after a reversal at z; an infinite z stands for one diameter.

    Near the mudline the initial path is steeper, by up to half.
    """
    held = where(z < np.inf, z, diameter)
    reversal = soil[4] / diameter * ultimate(held, diameter, soil)[0]
    wide = lift(np.minimum(held, 0.5 * diameter), diameter, soil[8])[1]
    return np.maximum(reversal, initial(held, diameter, soil)[1]) + wide


def virgin(z: Value, diameter: Value, *soil: Value) -> tuple[Value, Value]:
    """Return the initial path with the weight of the displaced soil."""
    depth = np.maximum(z, 0.0)
    force, slope = initial(depth, diameter, soil)
    heavy, wide = lift(depth, diameter, soil[8])
    return force + heavy, slope + wide


SOIL = PathLaw(
    name="soil",
    summary="hysteretic penetration after Randolph and Quiggin, z as that of the invert (inferred)",
    acts_on="elements",
    parameters=(
        Parameter("strength", "F/L2", "s_u0, undrained shear strength at the mudline", above=True),
        Parameter("gradient", "F/L3", "increase of the strength per depth", default=0.0),
        Parameter("factor", "1", "a of N_c = a (z/D)^b", above=True, default=6.0),
        Parameter("exponent", "1", "b of N_c", above=True, default=0.25),
        Parameter("stiffness", "1", "K_max, normalised largest stiffness", above=True, default=200.0),
        Parameter("suction", "1", "f_suc, resistance against uplift over that against penetration", default=0.6),
        Parameter("suction_decay", "1", "lambda_suc, decay of suction over z_max", above=True, default=1.0),
        Parameter("repenetration", "1", "lambda_rep, delay of re-penetration over z_max", default=0.3),
        Parameter("buoyancy", "F/L3", "factor times submerged weight of the soil", default=0.0),
    ),
    needs_diameter=True,
    history=True,
    reaction=virgin,
    steepest=steepest,
    start=(0.0, 0.0, DOWN, 0.0, -1.0, 0.0, 0.0, _UNKNOWN),
    begin=begin,
    pending=pending,
    locate=(fall, meeting),
    advance=advance,
    equation="P = P_u zeta/(1 + zeta), zeta = K_max z/D, at the largest z so far; hyperbolas from each reversal",
    source="Randolph and Quiggin (2009), OMAE2009-79259, from memory of its formulas; bounds and z_P inferred",
)
