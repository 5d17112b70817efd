"""Central difference, as explicit programs step it: velocities live at half steps.

x(n+1) - 2 x(n) + x(n-1) = dt^2 a(n). A force that depends on the velocity sees that of the half step before, which
costs one order of accuracy. Stable for omega dt < 2.
"""

from __future__ import annotations

from mudline.study.schemes.kick_drift import KickDrift

CENTRAL_DIFFERENCE = KickDrift("central-difference", "central difference", before=0.5, after=0.5, ahead=0.0, limit=2.0)
