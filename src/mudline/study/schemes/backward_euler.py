"""Backward Euler: first order, damps strongly, never gains energy in contact. v1 = v0 + dt a1, x1 = x0 + dt v1."""

from __future__ import annotations

from mudline.study.schemes.one_step import OneStep

BACKWARD_EULER = OneStep("backward-euler", "backward Euler", position=(0.0, 1.0), velocity=(0.0, 1.0))
