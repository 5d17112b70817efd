"""The hysteretic soil law once more, for one element in plain Python, from its formulas alone.

It walks a path in small steps and looks at every one of them: where the force has fallen through zero, where a
re-penetration meets the initial curve. Nothing is solved for, so it is right to the length of a step only.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, exp, sin, sqrt


@dataclass
class Clay:
    diameter: float = 0.3
    su0: float = 5000.0
    gradient: float = 1500.0
    a: float = 6.0
    b: float = 0.25
    k_max: float = 200.0
    f_suc: float = 0.6
    lambda_suc: float = 1.0
    lambda_rep: float = 0.3
    buoyancy: float = 0.0

    def ultimate(self, z: float) -> float:
        ratio = z / self.diameter
        factor = self.a * max(ratio, 0.1) ** self.b * sqrt(min(10.0 * ratio, 1.0))
        return float(factor) * (self.su0 + self.gradient * z) * self.diameter

    def initial(self, z: float) -> float:
        zeta = self.k_max * z / self.diameter
        return self.ultimate(z) * zeta / (1.0 + zeta)

    def lift(self, z: float) -> float:
        """Weight of the soil displaced by the part of the circle below the mudline."""
        radius = 0.5 * self.diameter
        height = min(max(z, 0.0), self.diameter)
        half_angle = acos((radius - height) / radius)
        return self.buoyancy * radius**2 * (half_angle - 0.5 * sin(2.0 * half_angle))


class Walker:
    """One element on its way."""

    def __init__(self, clay: Clay) -> None:
        self.clay = clay
        self.z = self.force = 0.0
        self.z_max = 0.0
        self.z_zero: float | None = None
        self.way = "initial"
        self.start = (0.0, 0.0)
        self.fallen = False

    def go(self, depth: float, pieces: int = 1) -> float:
        """Move in equal steps to a depth; returns the force there, buoyancy included."""
        begin = self.z
        end = max(depth, 0.0)
        for piece in range(1, pieces + 1):
            self._step(end if piece == pieces else begin + (end - begin) * piece / pieces)
        return self.force + (self.clay.lift(end) if end > 0.0 else 0.0)

    def _step(self, z: float) -> None:
        if z == self.z:
            return
        if z > self.z and self.way == "uplift":
            self.way, self.start = "again", (self.z, self.force)
        elif z < self.z and self.way != "uplift":
            self.way, self.start, self.fallen = "uplift", (self.z, self.force), False
        beyond = z > self.z_max
        self.z_max = max(self.z_max, z)
        if self.way == "uplift":
            force = self._uplift(z)
        elif self.way == "again":
            force = self._again(z)
            if beyond and force >= self.clay.initial(z) * (1.0 - 1e-12):
                self.way = "initial"
        if self.way == "initial":
            force = self.clay.initial(z)
        self.z, self.force = z, force

    def _uplift(self, z: float) -> float:
        clay, (z0, p0) = self.clay, self.start
        if z <= 0.0:
            if p0 > 0.0 and not self.fallen:
                self.z_zero = 0.0
            return 0.0
        suction = -clay.f_suc * clay.ultimate(z)
        gone = clay.k_max * (z0 - z) / clay.diameter
        softness = max(0.0, p0 - suction) / clay.ultimate(z0)
        form = p0 - gone / (softness + gone) * (p0 - suction)
        if p0 > 0.0 and not self.fallen and form <= 0.0:
            self.fallen, self.z_zero = True, z
        top = 0.0 if self.fallen or p0 <= 0.0 else clay.initial(z)
        share = 1.0 if self.z_zero is None else exp(min(0.0, (z - self.z_zero) / (clay.lambda_suc * self.z_max)))
        return max(min(form, top), share * suction)

    def _again(self, z: float) -> float:
        clay, (z0, p0) = self.clay, self.start
        form = clay.initial(z)
        if z0 > 0.0:
            come = clay.k_max * (z - z0) / clay.diameter
            softness = (clay.ultimate(z) - p0) / clay.ultimate(z0)
            form = p0 + come / (softness + come) * (clay.ultimate(z) - p0)
        share = 1.0
        if self.z_zero is not None:
            share = exp(min(0.0, -clay.lambda_rep + (z - self.z_zero) / self.z_max))
        return min(form, max(p0, share * clay.initial(z)), clay.initial(z) if z > 0.0 else 0.0)
