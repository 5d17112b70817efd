"""All schemes, by name."""

from __future__ import annotations

from mudline.study.schemes.backward_euler import BACKWARD_EULER
from mudline.study.schemes.central_difference import CENTRAL_DIFFERENCE
from mudline.study.schemes.forward_euler import FORWARD_EULER
from mudline.study.schemes.generalised_alpha import GENERALISED_ALPHA_0, GENERALISED_ALPHA_05, GENERALISED_ALPHA_1
from mudline.study.schemes.hht import HHT
from mudline.study.schemes.newmark import NEWMARK
from mudline.study.schemes.rk2 import RK2
from mudline.study.schemes.rk4 import RK4
from mudline.study.schemes.system import Scheme
from mudline.study.schemes.velocity_verlet import VELOCITY_VERLET

_ALL: tuple[Scheme, ...] = (
    CENTRAL_DIFFERENCE,
    VELOCITY_VERLET,
    RK4,
    NEWMARK,
    HHT,
    GENERALISED_ALPHA_1,
    GENERALISED_ALPHA_05,
    GENERALISED_ALPHA_0,
    BACKWARD_EULER,
    RK2,
    FORWARD_EULER,
)

SCHEMES: dict[str, Scheme] = {scheme.name: scheme for scheme in _ALL}
"""In the order in which studies show them; the last two are unstable on every undamped oscillator."""
