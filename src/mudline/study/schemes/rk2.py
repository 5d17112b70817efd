"""Runge-Kutta of second order (midpoint): it grows on an undamped oscillator at any step, slowly at small ones."""

from __future__ import annotations

from mudline.study.schemes.runge_kutta import RungeKutta

RK2 = RungeKutta("rk2", "RK2 (midpoint)", stages=((0.5,),), weights=(0.0, 1.0), limit=0.0)
