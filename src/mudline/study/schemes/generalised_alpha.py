"""The generalised-alpha scheme (Chung and Hulbert): second order, with chosen damping of what is not resolved.

With the spectral radius rho at infinite omega dt:
alpha_f = rho / (rho + 1), alpha_m = (2 rho - 1) / (rho + 1), gamma = 1/2 - alpha_m + alpha_f,
beta = (1 - alpha_m + alpha_f)^2 / 4. The alphas are the shares of the old force and of the old acceleration.
"""

from __future__ import annotations

from mudline.study.schemes.one_step import OneStep


def generalised_alpha(rho: float) -> OneStep:
    """The scheme of this spectral radius, 0 to 1; 1 does not damp."""
    of_force, of_mass = rho / (rho + 1.0), (2.0 * rho - 1.0) / (rho + 1.0)
    beta, gamma = (1.0 - of_mass + of_force) ** 2 / 4.0, 0.5 - of_mass + of_force
    return OneStep(
        f"generalised-alpha-{rho:g}",
        f"generalised-alpha ({rho:g})",
        position=(0.5 - beta, beta),
        velocity=(1.0 - gamma, gamma),
        inertia=(of_mass, 1.0 - of_mass),
        load=(of_force, 1.0 - of_force),
    )


GENERALISED_ALPHA_1 = generalised_alpha(1.0)
GENERALISED_ALPHA_05 = generalised_alpha(0.5)
GENERALISED_ALPHA_0 = generalised_alpha(0.0)
