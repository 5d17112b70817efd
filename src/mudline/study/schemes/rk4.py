"""The classical Runge-Kutta scheme of fourth order. Stable on an undamped oscillator for omega dt < 2 sqrt(2)."""

from __future__ import annotations

import math

from mudline.study.schemes.runge_kutta import RungeKutta

RK4 = RungeKutta(
    "rk4",
    "RK4",
    stages=((0.5,), (0.0, 0.5), (0.0, 0.0, 1.0)),
    weights=(1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0),
    limit=2.0 * math.sqrt(2.0),
)
