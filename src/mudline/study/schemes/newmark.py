"""Newmark's scheme; with beta = 1/4, gamma = 1/2 the average acceleration rule: second order, undamped."""

from __future__ import annotations

from mudline.study.schemes.one_step import OneStep


def newmark(beta: float = 0.25, gamma: float = 0.5) -> OneStep:
    """The scheme of these two parameters."""
    return OneStep("newmark", "Newmark", position=(0.5 - beta, beta), velocity=(1.0 - gamma, gamma))


NEWMARK = newmark()
