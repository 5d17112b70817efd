"""Decks of catenary risers: a lying part, then a bulge of the right length up to the vessel."""

from __future__ import annotations

import math
from dataclasses import dataclass

STEEL = " OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3239, 0.2827, 7850.0\n"
CHAIN = " OPTION=MOORING\n SET=ALL\n 480.0E6, 120.0, 0.15\n"
CURVE = "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.05, 700.0\n 0.1, 1000.0\n 0.5, 1900.0\n"
JUMP = CURVE.replace(" 0.0, 0.0\n", " 0.0, 600.0\n")
SNAP = "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.05, 1700.0\n 0.055, 900.0\n 0.5, 2900.0\n"
FALL = "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.05, 1700.0\n 0.1, 1500.0\n 0.5, 2900.0\n"
WAVES = "*TIME\n STEP=FIXED\n 0.0, 100.0, 0.2, 20.0\n*WAVE-REGULAR\n 2.0, 11.0, 180.0\n"
BUOYS = "*ELEMENT SETS\n SET=Bare\n GEN=1, 150\n GEN=191, 250\n SET=Buoy\n GEN=151, 190\n"
FLEXIBLE = (
    " OPTION=FLEXIBLE\n SET=Bare\n 50.0E3, 50.0E3, 3.0E6, 4.2E8, 118.0, 1.0, 0.2032, 0.302, 0.302\n"
    " SET=Buoy\n 50.0E3, 50.0E3, 3.0E6, 4.2E8, 290.0, 12.0, 0.2032, 0.92, {buoyancy}, 0.302\n"
)


@dataclass(frozen=True)
class Riser:
    """A riser, in the deck's units: `laid` of `length` straight on the seabed, the top at `height` and `far`."""

    height: float = 500.0
    far: float = 740.0
    length: float = 1000.0
    laid: float = 300.0
    elements: int = 250
    section: str = STEEL
    sets: str = ""
    ocean: str = " 500.0, 1025.0, 9.81\n"
    law: str = " TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
    soil: str = CURVE
    model: str = ""
    loads: str = WAVES
    top_first: bool = False
    along: tuple[float, float] = (1.0, 0.0)
    slope: float = 0.0
    held: bool = True

    def text(self) -> str:
        """The deck."""
        points = self.points()
        last = len(points)
        points = points[::-1] if self.top_first else points
        rows = (f" {i}, {x!r}, {y * self.along[0]!r}, {y * self.along[1]!r}\n" for i, (x, y) in enumerate(points, 1))
        low, top = (last, 1) if self.top_first else (1, last)
        ends = f"*BOUNDARY\n TYPE=CONSTANT\n {low}, 2\n {low}, 3\n TYPE=VESSEL\n {top}, Semi\n" if self.held else ""
        return (
            f"$MODEL\n*OCEAN\n{self.ocean}*NODE\n{''.join(rows)}*ELEMENT\n 1, 1, 2\n GEN=1, {last - 1}\n{self.sets}"
            f"*GEOMETRIC SETS\n{self.section}*SEABED PROPERTIES\n{self.law}{self.soil}{self.model}"
            "*VESSEL\n VESSEL=Semi\n INITIAL POSITION=500.0, 0.0, 0.0, 0.0\n"
            f"$LOAD CASE\n{ends}{self.loads}"
        )

    def points(self) -> list[tuple[float, float]]:
        """Heights and distances: their polygon has the length of the line."""
        lying = round(self.elements * self.laid / self.length)
        sine, cosine = math.sin(math.radians(self.slope)), math.cos(math.radians(self.slope))
        start = self.laid * sine, self.laid * cosine
        rise, run = self.height - start[0], self.far - start[1]
        chord, count = math.hypot(rise, run), self.elements - lying

        def hanging(bulge: float) -> list[tuple[float, float]]:
            shares = [(j / count, bulge * math.sin(math.pi * j / count) / chord) for j in range(count + 1)]
            return [(start[0] + rise * f - b * run, start[1] + run * f + b * rise) for f, b in shares]

        low, high = 0.0, self.length
        for _ in range(80):
            middle = 0.5 * (low + high)
            found = hanging(middle)
            short = sum(map(math.dist, found[:-1], found[1:])) < self.length - self.laid
            low, high = (middle, high) if short else (low, middle)
        step = self.laid / lying
        return [(j * step * sine, j * step * cosine) for j in range(lying)] + hanging(low)


IMPERIAL = Riser(
    1640.0, 2428.0, 3280.0, 984.0,
    section=" OPTION=RIGID\n SET=ALL\n 4.323E9, 1.66E9, 1.0627, 0.9275, 15.23\n",
    ocean=" 1640.0, 1.9888, 32.185\n",
    soil="*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.05, 48.0\n 0.1, 68.5\n 0.5, 130.2\n",
)  # fmt: skip
