"""The scheme of Hilber, Hughes and Taylor: second order, damps what is not resolved.

gamma = 1/2 - alpha, beta = (1 - alpha)^2 / 4, -1/3 <= alpha <= 0; the force is (1 + alpha) f1 - alpha f0.
"""

from __future__ import annotations

from mudline.study.schemes.one_step import OneStep


def hht(alpha: float) -> OneStep:
    """The scheme of this parameter; 0 is Newmark's."""
    beta, gamma = (1.0 - alpha) ** 2 / 4.0, 0.5 - alpha
    return OneStep(
        f"hht{alpha:g}",
        f"HHT ({alpha:g})",
        position=(0.5 - beta, beta),
        velocity=(1.0 - gamma, gamma),
        load=(-alpha, 1.0 + alpha),
    )


HHT = hht(-0.3)
