"""Legal decks, as offshore engineers write them: every one is right, and a colleague would find nothing to say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import radians, tan

from tests.faults import parts, styles
from tests.faults.parts import (
    IMPERIAL,
    KILO,
    METRIC,
    PLAIN,
    Flexible,
    Line,
    Model,
    Mooring,
    Rigid,
    Section,
    Units,
    number,
)

FLOWLINE = Rigid(0.2731, 0.0183)
SCR = Rigid(0.3239, 0.0254)
EXPORT = Rigid(0.6096, 0.0254)
SMALL = Rigid(0.1143, 0.0111)
CONCRETE = Rigid(0.5588, 0.0191, coated=0.6588)
TITANIUM = Rigid(0.2731, 0.0215, 114.0e9, 4430.0)
OUTFALL = Rigid(0.63, 0.0374, 0.9e9, 955.0, 0.4)
SPAR = Rigid(37.0, 0.06)
UMBILICAL = Flexible(12.0e3, 250.0e6, 36.5, 0.0, 0.168, 0.168)
RISER = Flexible(90.0e3, 550.0e6, 190.0, 0.2032, 0.35, 0.35)
JUMPER = Flexible(15.0e3, 180.0e6, 62.0, 0.1016, 0.19, 0.19)
BUOYED = Flexible(90.0e3, 550.0e6, 820.0, 0.2032, 1.3, 1.3)
CABLE = Flexible(6.0, 20.0e6, 0.55, 0.0, 0.017, 0.017)
CHAIN = Mooring(1.15e9, 330.0, 0.229)
POLYESTER = Mooring(1.7e8, 25.0, 0.2)
WIRE = Mooring(6.2e8, 42.0, 0.096, "TRUSS")


@dataclass(frozen=True)
class LegalDeck:
    """A deck with its name and suffix, and the files beside it that it names."""

    name: str
    suffix: str
    data: bytes
    files: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def units(self) -> str:
        """The family of its units: metric, imperial or user."""
        return {"keyxm": "metric", "keyxi": "imperial"}.get(self.suffix, "user")

    @property
    def text(self) -> str:
        return self.data.decode("cp1252" if b"\xb0" in self.data else "utf-8")


def flowline(
    u: Units,
    section: Rigid | Flexible,
    seabed: list[str],
    *,
    step: float = 5.0,
    generate: bool = True,
    slope: float = 0.0,
) -> Model:
    """Twenty elements on a seabed that rises by `slope` degrees, in two sets."""
    rise = tan(radians(slope))
    points = [parts.Point(rise * at.y + at.x, at.y) for at in parts.laid(20, step, 0.03 * section.outer)]
    line = Line(points, {"West": 12, "East": 8}, generate=generate)
    return Model(u, 350.0, [line], {"ALL": section}, seabed)


def riser(
    u: Units, section: Rigid | Flexible, seabed: list[str], *, depth: float = 1000.0, above: Section | None = None
) -> Model:
    """A flowline of eight elements, and a free hanging catenary above it, which may have a section of its own."""
    points = parts.laid(8, 10.0, 0.03 * section.outer)
    points += parts.catenary(24, 1.35 * depth, 0.42 * depth, 0.03 * section.outer, 80.0)
    sections: dict[str, Section] = {"ALL": section, **({"Riser": above} if above else {})}
    line = Line(points, {"Flowline": 8, "Riser": 24})
    return Model(u, depth, [line], sections, seabed)


def mooring(u: Units, seabed: list[str], top: Mooring = POLYESTER, *, first: int = 1, depth: float = 800.0) -> Model:
    """A ground chain of ten elements and an upper line of fourteen."""
    points = parts.laid(10, 20.0, 0.01)
    points += parts.catenary(14, 1.6 * depth, 0.7 * depth, 0.01, 200.0)
    line = Line(points, {"Ground Chain": 10, "Upper Line": 14}, first)
    return Model(u, depth, [line], {"Ground Chain": CHAIN, "Upper Line": top}, seabed)


def clay_bed(u: Units, diameter: float, *sets: str, friction: str = "0.35, 0.6") -> list[str]:
    """Each set on a curve of its own name's clay."""
    names = {f"Clay {name}": 1000.0 + 400.0 * i for i, name in enumerate(sets)}
    laws: dict[str, str | float] = {name: f"Clay {name}" for name in sets}
    return [*parts.properties(u, laws, friction), *parts.curves(u, diameter, names)]


def linear_bed(u: Units, stiffness: float = 60.0e3, friction: str = "0.35, 0.6", more: str = "") -> list[str]:
    """One stiffness for all elements."""
    return parts.properties(u, {"ALL": stiffness}, friction, more)


def mobilised(u: Units, axial: float = 0.005, lateral: float = 0.15) -> str:
    """FRICTION= with mobilisation lengths in m."""
    return f"0.35, 0.6, {number(u, axial, 1)}, {number(u, lateral, 1)}"


def _both() -> dict[str, tuple[Units, Model]]:
    """Structures in metric and in imperial units."""
    decks: dict[str, Model] = {}
    for system, u in {"metric": METRIC, "imperial": IMPERIAL}.items():
        made = {
            "flowline-linear": flowline(u, FLOWLINE, linear_bed(u)),
            "flowline-clay": flowline(u, FLOWLINE, clay_bed(u, 0.2731, "West", "East"), generate=False),
            "flowline-mobilisation": flowline(u, SMALL, linear_bed(u, 25.0e3, mobilised(u)), generate=False),
            "export-line": flowline(u, EXPORT, linear_bed(u, 250.0e3), step=12.0),
            "concrete-coated": flowline(u, CONCRETE, clay_bed(u, 0.5588, "West", "East"), step=12.2),
            "scr-clay": riser(u, SCR, clay_bed(u, 0.3239, "Flowline", "Riser")),
            "scr-linear": riser(u, SCR, linear_bed(u, 120.0e3, mobilised(u)), depth=1800.0),
            "deep-scr": riser(u, SMALL, clay_bed(u, 0.1143, "Flowline", "Riser"), depth=3000.0),
            "shallow-flexible": riser(u, RISER, linear_bed(u, 40.0e3), depth=50.0),
            "umbilical": riser(u, UMBILICAL, clay_bed(u, 0.168, "Flowline", "Riser"), depth=300.0),
            "chain-mooring": mooring(u, linear_bed(u, 100.0e3, "0.7, 0.9")),
            "wire-mooring": mooring(u, linear_bed(u, 100.0e3, "0.7, 0.9"), WIRE, depth=220.0),
            "thin-cable": flowline(u, CABLE, linear_bed(u, 2000.0), step=1.0),
            "old-linear": flowline(u, FLOWLINE, parts.surface(u, 45.0e3)),
            "old-curves": flowline(
                u, FLOWLINE, [*parts.surface(u, 45.0e3), *parts.embedment(u, 0.2731, {"West": 1200.0, "East": 2000.0})]
            ),
            "old-curves-alone": flowline(
                u, SMALL, [*parts.surface(u, None), *parts.embedment(u, 0.1143, {"ALL": 900.0})]
            ),
            "old-rigid": flowline(u, FLOWLINE, ["*RIGID SURFACE", "0.3, 0.5"], generate=False),
            "rigid-flat": flowline(u, FLOWLINE, ["*SEABED PROPERTIES", "TYPE=RIGID", "SET=ALL", "FRICTION=0.3, 0.5"]),
            "lateral-springs": flowline(
                u, EXPORT, linear_bed(u, 250.0e3, "0.4, 0.0", f"LATERAL={number(u, 20.0e3, -2, 1)}"), generate=False
            ),
            "suction-zone": riser(
                u, SCR, linear_bed(u, 120.0e3, more=f"SUCTION={number(u, 15.0e3, -2, 1)}, {number(u, 0.15, 1)}")
            ),
            "spar": _spar(u),
            "pipe-in-pipe": _pipe_in_pipe(u),
            "jumper": Model(u, 120.0, [Line(_saddle(), {"Jumper": 12})], {"ALL": JUMPER}, []),
            "lazy-wave": _lazy_wave(u),
            "curve-library": riser(u, SCR, _library(u)),
        }
        decks |= {f"{name}-{system}": model for name, model in made.items()}
    return {name: (model.units, model) for name, model in decks.items()}


def _spar(u: Units) -> Model:
    """A hull of 37 m with one of its moorings."""
    line = mooring(u, linear_bed(u, 100.0e3, "0.7, 0.9")).lines[0]
    hull = Line(parts.upright(750.0, 920.0, 10, 1200.0), {"Hull": 10}, 101)
    sections: dict[str, Section] = {"Ground Chain": CHAIN, "Upper Line": POLYESTER, "Hull": SPAR}
    laws: dict[str, str | float] = {"Ground Chain": 100.0e3, "Upper Line": 100.0e3}
    return Model(u, 900.0, [line, hull], sections, parts.properties(u, laws, "0.7, 0.9"))


def _pipe_in_pipe(u: Units) -> Model:
    """A carrier on the seabed and the pipe inside, which no seabed touches."""
    outer = Line(parts.laid(16, 6.0, 0.01), {"Outer Pipe": 16}, generate=True)
    inner = Line(parts.laid(16, 6.0, 0.01), {"Inner Pipe": 16}, 101, generate=True)
    sections: dict[str, Section] = {"Outer Pipe": Rigid(0.4064, 0.0159), "Inner Pipe": Rigid(0.2731, 0.0183)}
    bed = parts.properties(u, {"Outer Pipe": 90.0e3})
    return Model(u, 1400.0, [outer, inner], sections, bed, ["*PIP SECTION", "OUTER=Outer Pipe, INNER=Inner Pipe"])


def _saddle() -> list[parts.Point]:
    """Nodes of a jumper between a platform and a column, all well above the seabed."""
    return [parts.Point(80.0 + 0.9 * (i - 6) ** 2, 3.0 * i) for i in range(13)]


def _lazy_wave(u: Units) -> Model:
    points = parts.laid(8, 10.0, 0.01)
    heights = [4, 14, 28, 44, 57, 66, 68, 63, 56, 53, 56, 68, 90, 122, 165, 218]
    points += [parts.Point(float(height), 92.0 + 12.0 * i) for i, height in enumerate(heights)]
    sets = {"Flowline": 8, "Lower Riser": 4, "Buoyancy Section": 4, "Upper Riser": 8}
    sections: dict[str, Section] = {"ALL": RISER, "Buoyancy Section": BUOYED}
    return Model(
        u,
        220.0,
        [Line(points, sets)],
        sections,
        parts.properties(u, {"ALL": "Silt"}) + parts.curves(u, 0.35, {"Silt": 1500.0}),
    )


def _library(u: Units) -> list[str]:
    """The low, best and high estimate of one soil, of which the deck uses one."""
    names = {"Clay Low": 800.0, "Clay Best": 1200.0, "Clay High": 1700.0}
    return [*parts.properties(u, {"ALL": "Clay Best"}), *parts.curves(u, 0.3239, names)]


# ------------------------------------------------------------------------------------------------ one kind of deck each


def _single() -> dict[str, tuple[Units, Model]]:
    """Structures and seabeds in one system of units."""
    u = METRIC
    west_east = clay_bed(u, 0.2731, "West", "East")
    models = {
        "user-kilonewton": flowline(KILO, FLOWLINE, linear_bed(KILO)),
        "user-kilonewton-scr": riser(KILO, SCR, clay_bed(KILO, 0.3239, "Flowline", "Riser")),
        "user-newton": flowline(PLAIN, FLOWLINE, clay_bed(PLAIN, 0.2731, "West", "East"), generate=False),
        "user-kilonewton-chain": mooring(KILO, linear_bed(KILO, 100.0e3, "0.7, 0.9")),
        "user-kilonewton-old": flowline(
            KILO, RISER, [*parts.surface(KILO, 45.0e3), *parts.embedment(KILO, 0.35, {"West": 1200.0, "East": 2000.0})]
        ),
        "titanium-joint": riser(u, SCR, linear_bed(u), above=TITANIUM),
        "outfall": flowline(u, OUTFALL, linear_bed(u, 30.0e3)),
        "old-slope": flowline(u, FLOWLINE, ["*RIGID SURFACE", "0.3, 0.5", "1.5"], slope=1.5, generate=False),
        "old-profile": flowline(
            u, FLOWLINE, ["*RIGID SURFACE", "0.3, 0.5", "-10.0, 0.1", "30.0, 0.0", "70.0, -0.1", "120.0, 0.0"]
        ),
        "sloping": flowline(u, FLOWLINE, [*linear_bed(u), "*SEABED PROFILE", "TYPE=SLOPING", "SLOPE=2.5"], slope=2.5),
        "sloping-across": flowline(
            u, FLOWLINE, [*linear_bed(u), "*SEABED PROFILE", "TYPE=SLOPING", "DIRECTION=90.0", "SLOPE=4.0"]
        ),
        "rigid-sloping": flowline(
            u,
            FLOWLINE,
            [
                *("*SEABED PROPERTIES", "TYPE=RIGID", "SET=ALL", "FRICTION=0.3, 0.5", "*SEABED PROFILE"),
                *("TYPE=SLOPING", "SLOPE=0.5"),
            ],
            slope=0.5,
        ),
        "overlap-on-purpose": flowline(u, FLOWLINE, parts.properties(u, {"ALL": 60.0e3, "East": 150.0e3})),
        "along-z": Model(
            u,
            90.0,
            [Line([parts.Point(-0.01, 0.0, 6.0 * i) for i in range(19)], {"Line": 18})],
            {"ALL": FLOWLINE},
            linear_bed(u),
        ),
        "towards-negative": Model(
            u,
            90.0,
            [Line([parts.Point(-0.01, -6.0 * i) for i in range(19)], {"Line": 18})],
            {"ALL": FLOWLINE},
            linear_bed(u),
        ),
        "planes": flowline(
            u, FLOWLINE, [*linear_bed(u), "*SEABED PLANES", "PLANE=flat", "POINT=0.0, 0.0, 0.0", "SLOPE=0.0"]
        ),
        "suction-law": riser(
            u, SCR, [*clay_bed(u, 0.3239, "Flowline", "Riser"), "*SEABED SUCTION", "SET=Riser", "COHESION=3000.0"]
        ),
        "smoothed": flowline(u, FLOWLINE, [*linear_bed(u), "*SEABED CONTACT", "SET=ALL", "SMOOTHING=AUTO"]),
        "unloading": flowline(u, FLOWLINE, [*west_east, "*SEABED UNLOADING", "SET=ALL", "STIFFNESS=900000.0"]),
        "two-way-friction": flowline(
            u,
            FLOWLINE,
            [
                *linear_bed(u, friction=""),
                *["*SEABED FRICTION", "SET=ALL", "COEFFICIENTS=0.35, 0.7", "STIFFNESS=20000.0, 40000.0"],
            ],
        ),
        "trench": flowline(
            u,
            FLOWLINE,
            [
                *linear_bed(u, friction=""),
                *["*SEABED FRICTION", "SET=ALL", "COEFFICIENTS=0.35, 0.7", "STIFFNESS=20000.0, 40000.0"],
                *["*SEABED TRENCH", "SET=East", "GEOMETRY=0.5, 0.4, 1.2", "PEAK=2500.0"],
            ],
        ),
        "bending-curve": replace(
            riser(u, Flexible(90.0e3, 550.0e6, 190.0, 0.2032, 0.35, 0.35, "Bending"), linear_bed(u), depth=300.0),
            extra=["*MOMENT-CURVATURE", "CURVE=Bending", "0.0, 0.0", "2400.0, 0.01", "24000.0, 0.3"],
        ),
        "internal-fluid": replace(
            flowline(u, FLOWLINE, linear_bed(u)), extra=["*ELEMENT SETS", "SET=_InternalFluid", "GEN=1, 20"]
        ),
        "conductor": _conductor(u),
        "dynamic-three": replace(riser(u, SCR, linear_bed(u)), cases=_dynamic("0.0, 120.0, 0.05")),
        "dynamic-four": replace(riser(u, SCR, linear_bed(u)), cases=_dynamic("0.0, 120.0, 0.05, 24.0")),
        "many-load-cases": replace(flowline(u, FLOWLINE, west_east), cases=parts.static(1) + _currents() + _currents()),
        "modal": replace(
            flowline(u, FLOWLINE, linear_bed(u)), cases=[*parts.static(1), "$MODES", "*FRICTION", "4000.0, 8000.0"]
        ),
        "postprocessing": replace(
            riser(u, SCR, linear_bed(u)),
            cases=[
                *parts.static(1),
                *["$DATABASE POSTPROCESSING", "*ELEMENT SETS", "SET=Touchdown", "GEN=8, 14"],
                *["*STANDARD OUTPUT", "SET=Touchdown"],
            ],
        ),
    }
    return {name: (model.units, model) for name, model in models.items()}


def _conductor(u: Units) -> Model:
    """A conductor in the soil below the mudline and a riser above it: soil springs, and no seabed."""
    points = parts.upright(-60.0, 0.0, 30) + parts.upright(0.0, 210.0, 21)[1:]
    soil = ["*P-Y", "TYPE=USER", "SET=Conductor", "DEPTH=0.0", "0.0, 0.0", "6000.0, 0.009", "14000.0, 0.09"]
    soil += ["DEPTH=60.0", "0.0, 0.0", "380000.0, 0.009", "840000.0, 0.09"]
    sections: dict[str, Section] = {"Conductor": Rigid(0.9144, 0.0381), "Drilling Riser": Rigid(0.5334, 0.0254)}
    return Model(u, 200.0, [Line(points, {"Conductor": 30, "Drilling Riser": 21})], sections, soil)


def _dynamic(times: str) -> list[str]:
    head = ["$LOAD CASE", "*ANALYSIS TYPE", "TYPE=TIME DOMAIN", "*TIME", "STEP=FIXED", times]
    return [*head, "*BOUNDARY", "TYPE=CONSTANT", "1, 1", "1, 2", "1, 3", "*WAVE-REGULAR", "3.0, 11.0, 180.0"]


def _currents() -> list[str]:
    return ["$LOAD CASE", "*CURRENT", "TYPE=PIECEWISE LINEAR", "0.0, 0.1, 0.0", "350.0, 0.8, 0.0"]


# ------------------------------------------------------------------------------------------------------------ all decks


def legal_decks() -> list[LegalDeck]:
    """All of them, in one order; the models' texts first, then those written by hand or in another style."""
    models = _both() | _single()
    decks = [LegalDeck(name, u.suffix, model.text().encode()) for name, (u, model) in models.items()]
    return decks + [LegalDeck(*each) for each in styles.written_otherwise({deck.name: deck.text for deck in decks})]
