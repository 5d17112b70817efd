"""Velocity Verlet: the positions of the central difference, but forces see a velocity predicted to the whole step.

Without velocity in the forces the two are one. Stable for omega dt < 2.
"""

from __future__ import annotations

from mudline.study.schemes.kick_drift import KickDrift

VELOCITY_VERLET = KickDrift("velocity-verlet", "velocity Verlet", before=0.5, after=0.5, ahead=0.5, limit=2.0)
