"""Linear normal law with a quadratic zone around the mudline: SMOOTHING= and FORM= of `*SEABED CONTACT`.

With the stiffness K and the half width h of the zone, over the penetration z:

* CENTRED:    F = K (z + h)^2 / (4 h) on -h < z < h, exactly K z beyond it, 0 below;
* ONE-SIDED:  F = K z^2 / (4 h) on 0 < z < 2 h, K (z - h) beyond it, 0 below;
* h = 0:      the kinked law K max(z, 0).

Force and slope dF/dz are continuous for h > 0.
"""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray

_WIDEST = 0.25 * np.finfo(np.float64).max
"""Half widths above this are halved in the sums, which would overflow."""
_SMALL_SHARE = 2.0**-960


def force_and_slope(
    z: FloatArray,
    stiffness: FloatArray,
    h: FloatArray,
    one_sided: BoolArray,
    out: tuple[FloatArray, FloatArray] | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Return force and slope dF/dz at the penetrations `z` (..., m), for rows (m,) of laws.

    `stiffness` >= 0 is force (per unit length or per node) over length, `h` >= 0 a length, all finite. The values go to
    `out` where it is given. They are infinite only where the force itself overflows.
    """
    force, slope = (np.empty(z.shape), np.empty(z.shape)) if out is None else out
    with np.errstate(all="ignore"):
        in_contact = z > zone_start(h, one_sided)
        past = z - np.where(one_sided, h, 0.0)
        np.multiply(stiffness, np.fmax(past, 0.0, out=past), out=force)
        np.multiply(stiffness, in_contact, out=slope)
        inside = np.flatnonzero(in_contact & (z < np.where(one_sided, 2.0 * h, h)))
        if inside.size:
            row = inside % z.shape[-1] if z.ndim > 1 else inside
            zone = _in_the_zone(z.reshape(-1)[inside], stiffness[row], h[row], one_sided[row])
            np.put(force, inside, zone[0])
            np.put(slope, inside, zone[1])
    return force, slope


def _in_the_zone(
    z: FloatArray, stiffness: FloatArray, h: FloatArray, one_sided: BoolArray
) -> tuple[FloatArray, FloatArray]:
    """Force K w s / 2 and slope K s, where w is the way into the zone and s = w / (2 h) lies between 0 and 1.

    The share s multiplies the larger of K and w first: so no intermediate value overflows or vanishes before the force
    does.
    """
    scale = np.where(h > _WIDEST, 0.5, 1.0)
    width = scale * h
    way = scale * z + np.where(one_sided, 0.0, width)
    # a share too small for all of its digits is reckoned larger by a power of two
    lift = np.where(way < _SMALL_SHARE * width, 2.0**60, 1.0)
    share = lift * way / np.where(h > 0.0, 2.0 * width, 1.0)
    large, small = np.maximum(stiffness, way), np.minimum(stiffness, way)
    return (large / lift * (share * (0.5 / scale))) * small, stiffness / lift * share


def zone_start(h: FloatArray, one_sided: BoolArray) -> FloatArray:
    """Return the penetration at which contact begins: -h for CENTRED smoothing, else 0."""
    return np.where(one_sided, 0.0, 0.0 - h)


def automatic_half_width(static_penetration: FloatArray, diameter: FloatArray) -> FloatArray:
    """Return h of SMOOTHING=AUTO, min(0.1 Z, 0.01 D), from the static penetration Z and the diameter D of each point.

    It is 0, no smoothing, where one of them is NaN (unknown) or not positive.
    """
    with np.errstate(all="ignore"):
        width = np.minimum(0.1 * static_penetration, 0.01 * diameter)
    return np.where(width > 0.0, width, 0.0)
