"""Forward Euler: first order, and unstable on an undamped oscillator at any step. Here as a warning."""

from __future__ import annotations

from mudline.study.schemes.runge_kutta import RungeKutta

FORWARD_EULER = RungeKutta("forward-euler", "forward Euler", stages=(), weights=(1.0,), limit=0.0)
