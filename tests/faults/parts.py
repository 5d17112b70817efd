"""Parts of legal decks: units, sections, lines, seabeds, load cases. Values are SI; texts are in the deck's units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import asinh, cosh

from tests.helpers.builders.decks import IMPERIAL, METRIC, Units

KILO = Units(1.0, 1000.0, "keyx")
"""User units: metre, tonne, second, so that forces are in kN."""

PLAIN = Units(1.0, 1.0, "keyx")
"""User units that are the metric ones."""

__all__ = ["IMPERIAL", "KILO", "METRIC", "PLAIN", "Units"]


def number(units: Units, value: float, length: int = 0, force: int = 0) -> str:
    """A value of dimension length^i force^j as an engineer writes it: six digits, with a point."""
    text = f"{float(units.value(value, length, force)):.6g}".upper().replace("E+0", "E").replace("E+", "E")
    return text if any(mark in text for mark in ".E") else f"{text}.0"


# ------------------------------------------------------------------------------------------------------------ sections


@dataclass(frozen=True)
class Rigid:
    """A pipe of RIGID: diameter and wall thickness in m, moduli in Pa, density in kg/m3."""

    outer: float
    wall: float
    modulus: float = 207.0e9
    density: float = 7850.0
    poisson: float = 0.3
    coated: float = 0.0
    option = "RIGID"

    def row(self, u: Units) -> str:
        shear = self.modulus / (2 * (1 + self.poisson))
        sizes = number(u, self.outer, 1), number(u, self.outer - 2 * self.wall, 1)
        row = [number(u, self.modulus, -2, 1), number(u, shear, -2, 1), *sizes, number(u, self.density, -4, 1)]
        diameters = [number(u, self.coated, 1)] * 2
        return ", ".join(row + (["", "", "", *diameters] if self.coated else []))


@dataclass(frozen=True)
class Flexible:
    """A section of FLEXIBLE: bending stiffness N m2 (or a curve), axial N, mass kg/m, diameters m."""

    bending: float
    axial: float
    mass: float
    inner: float
    drag: float
    outer: float
    curve: str = ""
    option = "FLEXIBLE"

    def row(self, u: Units) -> str:
        bending = ["", ""] if self.curve else [number(u, self.bending, 2, 1)] * 2
        row = [*bending, number(u, 0.8 * self.bending, 2, 1), number(u, self.axial, 0, 1), number(u, self.mass, -2, 1)]
        row += [number(u, self.mass * self.drag**2 / 8, 0, 1), number(u, self.inner, 1), *[number(u, self.drag, 1)] * 2]
        return ", ".join([*row, number(u, self.outer, 1)])


@dataclass(frozen=True)
class Mooring:
    """A section of MOORING or TRUSS: axial stiffness N, mass kg/m, diameter m."""

    axial: float
    mass: float
    outer: float
    option: str = "MOORING"

    def row(self, u: Units) -> str:
        return f"{number(u, self.axial, 0, 1)}, {number(u, self.mass, -2, 1)}, {number(u, self.outer, 1)}"


Section = Rigid | Flexible | Mooring


# -------------------------------------------------------------------------------------------------------------- points


@dataclass(frozen=True)
class Point:
    """A node in m."""

    x: float
    y: float
    z: float = 0.0


def laid(count: int, step: float, depth: float, start: float = 0.0) -> list[Point]:
    """Nodes of `count` elements lying on the seabed, `depth` below it."""
    return [Point(-depth, start + step * i) for i in range(count + 1)]


def catenary(count: int, length: float, height_scale: float, depth: float, start: float) -> list[Point]:
    """Nodes along a catenary from its touchdown point at y = `start`, behind that point."""
    arcs = [length * (i + 1) / count for i in range(count)]
    horizontal = [height_scale * asinh(arc / height_scale) for arc in arcs]
    return [Point(height_scale * (cosh(y / height_scale) - 1) - depth, start + y) for y in horizontal]


def upright(low: float, high: float, count: int, y: float = 0.0) -> list[Point]:
    """Nodes of a vertical line."""
    return [Point(low + (high - low) * i / count, y) for i in range(count + 1)]


# --------------------------------------------------------------------------------------------------------------- lines


@dataclass(frozen=True)
class Line:
    """Nodes numbered from `first`, joined by elements numbered from the same number, in sets of so many elements."""

    points: list[Point]
    sets: Mapping[str, int]
    first: int = 1
    generate: bool = False

    @property
    def last(self) -> int:
        """The number of the last node."""
        return self.first + len(self.points) - 1

    def nodes(self, u: Units) -> list[str]:
        if self.generate:
            ends = [(self.first, self.points[0]), (self.last, self.points[-1])]
            return [*(_node(u, *end) for end in ends), f"GEN={self.first}, {self.last}"]
        return [_node(u, self.first + i, point) for i, point in enumerate(self.points)]

    def elements(self) -> list[str]:
        count = len(self.points) - 1
        if self.generate:
            return [f"{self.first}, {self.first}, {self.first + 1}", f"GEN={self.first}, {count}"]
        return [f"{n}, {n}, {n + 1}" for n in range(self.first, self.first + count)]

    def members(self) -> list[str]:
        texts: list[str] = []
        start = self.first
        for name, count in self.sets.items():
            texts += [f"SET={name}", f"GEN={start}, {start + count - 1}"]
            start += count
        return texts


def _node(u: Units, label: int, point: Point) -> str:
    row = f"{label}, {number(u, point.x, 1)}, {number(u, point.y, 1)}"
    return row + (f", {number(u, point.z, 1)}" if point.z else "")


# ------------------------------------------------------------------------------------------------------------- seabeds


def clay(u: Units, diameter: float, strength: float = 1200.0, gradient: float = 1500.0) -> list[str]:
    """Points of a curve of soft clay, forces by DNV-RP-F114 without its buoyancy term."""
    rows = ["0.0, 0.0"]
    for ratio in (0.02, 0.05, 0.1, 0.2, 0.3, 0.5):
        factor = min(6 * ratio**0.25, 3.4 * (10 * ratio) ** 0.5)
        rows.append(f"{ratio}, {number(u, factor * (strength + gradient * ratio * diameter) * diameter, -1, 1)}")
    return rows


def curves(u: Units, diameter: float, names: Mapping[str, float]) -> list[str]:
    """`*SEABED STIFFNESS` with a curve of clay of each strength (Pa)."""
    block = ["*SEABED STIFFNESS"]
    for name, strength in names.items():
        block += [f"CURVE={name}", *clay(u, diameter, strength)]
    return block


def properties(u: Units, laws: Mapping[str, str | float], friction: str = "0.35, 0.6", more: str = "") -> list[str]:
    """An elastic seabed: for each set the name of a curve or a stiffness in N/m/m."""
    block = ["*SEABED PROPERTIES", "TYPE=ELASTIC"]
    for name, law in laws.items():
        block += [f"SET={name}", f"STIFFNESS={law if isinstance(law, str) else number(u, law, -2, 1)}"]
        block += [f"FRICTION={friction}"] if friction else []
        block += [more] if more else []
    return block


def surface(u: Units, stiffness: float | None, rest: str = "0.35, 0.6") -> list[str]:
    """The legacy `*ELASTIC SURFACE`."""
    return ["*ELASTIC SURFACE", f"{'' if stiffness is None else number(u, stiffness, -2, 1)}, {rest}"]


def embedment(u: Units, diameter: float, sets: Mapping[str, float]) -> list[str]:
    """The legacy `*EMBEDMENT`, with a curve of clay of each strength (Pa) for its set."""
    block = ["*EMBEDMENT"]
    for name, strength in sets.items():
        block += [f"SET={name}", *clay(u, diameter, strength)]
    return block


# --------------------------------------------------------------------------------------------------------------- decks


@dataclass(frozen=True)
class Model:
    """What a deck says of a structure; `cases` are the lines behind the model, of a static load case if None."""

    units: Units
    depth: float
    lines: list[Line]
    sections: Mapping[str, Section]
    seabed: list[str]
    extra: list[str] = field(default_factory=list)
    cases: list[str] | None = None

    def text(self) -> str:
        u = self.units
        ocean = f"{number(u, self.depth, 1)}, {number(u, 1025.0, -4, 1)}, {number(u, 9.81, 1)}"
        rows = ["$MODEL", "*OCEAN", ocean, "*NODE"]
        rows += [row for line in self.lines for row in line.nodes(u)]
        rows += ["*ELEMENT", *(row for line in self.lines for row in line.elements())]
        members = [row for line in self.lines for row in line.members()]
        rows += ["*ELEMENT SETS", *members] if members else []
        rows += ["*GEOMETRIC SETS", *self._sections()]
        rows += ["*HYDRODYNAMIC SETS", "SET=ALL, TYPE=CONSTANT", "1.2, 0.05, 2.0, 1.0, 0.0"]
        rows += self.extra + self.seabed
        cases = static(self.lines[0].first) if self.cases is None else self.cases
        return laid_out([*rows, *cases])

    def _sections(self) -> list[str]:
        rows: list[str] = []
        option = ""
        for name, section in self.sections.items():
            rows += [] if section.option == option else [f"OPTION={section.option}"]
            option = section.option
            curve = f", EI={section.curve}" if isinstance(section, Flexible) and section.curve else ""
            rows += [f"SET={name}{curve}", section.row(self.units)]
        return rows


def static(node: int) -> list[str]:
    """A static load case that holds one node."""
    held = [f"{node}, {dof}" for dof in (1, 2, 3)]
    return ["$LOAD CASE", "*ANALYSIS TYPE", "TYPE=STATIC", "*BOUNDARY", "TYPE=CONSTANT", *held]


def laid_out(rows: list[str]) -> str:
    """Rows as the manual writes them: keywords, sections and comments in column 1, data one blank in."""
    return "".join(row + "\n" if row.startswith(("$", "*", "C ")) or not row else f" {row}\n" for row in rows)
