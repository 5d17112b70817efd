"""Pipe of a deck: weight, mass, added mass, drag, stiffness, contents, masses at nodes, keywords left out."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Where
from mudline.language.keywords.model import FEWEST_POINTS
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats, Mask, picked
from mudline.model.scene.sections import Section, format_of
from mudline.model.scene.sets import NamedSet, later_wins

if TYPE_CHECKING:
    from mudline.language.keywords.library.attachments import Masses, PointMass
    from mudline.model.scene.resolved import ResolvedDeck


class PipeContents(NamedTuple):
    """Contents of the elements (m,) in a load case, in the deck's units; 0 without contents.

    number: number of the load case in the file, from 1.
    where: place of the load case.
    density: density of the contents.
    mass: mass per length of pipe.

    Contents of an earlier load case stay until a later one gives them again.
    """

    number: int
    where: Where
    density: Floats
    mass: Floats


def contents(scene: ResolvedDeck) -> list[PipeContents]:
    """Return the contents in each load case of the deck itself; none if `*INTERNAL FLUID` fills no pipe.

    An element is full or empty: full if its middle is not above the level of the fluid.
    """
    if not any(True for _ in scene.deck.blocks("INTERNAL FLUID", "LOAD CASE")):
        return []
    inner = scene.section_table.values("di", default=0.0)
    area = np.nan_to_num(math.pi / 4.0 * inner * inner)
    middle = np.append(scene.coordinates[:, 0], np.nan)[scene.element_nodes].mean(axis=1)
    density = np.zeros(len(area))
    filled: list[PipeContents] = []
    for index, section in enumerate(scene.deck.own_sections):
        if section.name != "LOAD CASE":
            continue
        density = density.copy()
        fluids = (each for each in scene.deck.blocks("INTERNAL FLUID", "LOAD CASE") if each[0].section == index)
        for _, entry, _, holder in scene.set_table.entries(fluids):
            if holder is not None:
                above = middle[holder.elements] > number(entry, "level", math.inf)
                density[holder.elements] = np.where(above, 0.0, number(entry, "density", 0.0))
        with np.errstate(over="ignore"):
            filled.append(PipeContents(len(filled) + 1, Where(index), density, density * area))
    return filled


def contents_case(scene: ResolvedDeck) -> int | None:
    """Return the number of the load case whose contents the weights have; None if all load cases have the same."""
    filled = contents(scene)
    return filled[-1].number if any((case.density != filled[-1].density).any() for case in filled) else None


class Attached(NamedTuple):
    """Masses of `*MASS` at the nodes of elements (m,), per length; `weighing` excludes those without weight."""

    weighing: Floats
    mass: Floats


def attached(scene: ResolvedDeck) -> Attached:
    """Return the masses at nodes, shared equally by the elements that end there; rotary inertia is left out."""
    at_nodes = np.zeros((2, len(scene.node_ids) + 1))
    for point_mass, node in _masses(scene):
        if node is not None:
            at_nodes[point_mass.type_ == "NO WEIGHT MASS" :, node] += number(point_mass, "mass", 0.0)
    ends = np.where(scene.element_nodes < 0, len(scene.node_ids), scene.element_nodes)
    with np.errstate(all="ignore"):
        shares = at_nodes / np.bincount(ends.ravel(), minlength=at_nodes.shape[1])
        per_length = np.where(scene.length > 0.0, shares[:, ends].sum(axis=2) / scene.length, 0.0)
    return Attached(*np.nan_to_num(per_length, posinf=0.0))


def _masses(scene: ResolvedDeck) -> Iterator[tuple[PointMass, int | None]]:
    """Yield each mass that is not rotary inertia, with the index of its node; None if that is not known."""
    for _, block in scene.deck.blocks("MASS"):
        for mass in cast("Masses", block).masses:
            if mass.type_ != "ROTARY INERTIA":
                known = scene.nodes.indices(np.array([mass.node]))[0] if isinstance(mass.node, int) else -1
                yield mass, int(known) if known >= 0 else None


def operating_weight(scene: ResolvedDeck, *, filled: bool = True) -> Floats:
    """Return submerged weight per length (m,) with the contents of the last load case and with masses at nodes.

    Without contents if not `filled`: a valve stays on an empty line. It is in the deck's units; NaN where it is not
    known.
    """
    mass = attached(scene).weighing
    for case in contents(scene)[-1:] if filled else ():
        mass = mass + case.mass
    with np.errstate(over="ignore", invalid="ignore"):
        return scene.submerged_weight + mass * scene.surroundings.gravity if mass.any() else scene.submerged_weight


_WEIGHING = ("COATINGS", "POINT BUOY", "DRAG CHAIN", "PIP SECTION", "DRILLING MUD", "SLUGS", "STIFFENER")
"""Keywords whose weight or lift is left out; the lines of most of them have no public form."""


NOT_READ = ("*DRILLING MUD", "*SLUGS", "*INTERNAL FLUID (in part)", "*INTERNAL FLUID of the deck that it continues")
"""Parts of `left_out` that are contents."""


def left_out(scene: ResolvedDeck, *, with_masses: bool = True) -> list[str]:
    """Return parts of the deck that weigh or lift, but are not in `operating_weight`, as `*NAME`.

    `with_masses` is False for weights without the masses at nodes.
    """
    deck, unread = scene.deck, scene.context.unread
    keywords = deck.keywords() | deck.keywords("LOAD CASE")
    names = [f"*{name}" for name in _WEIGHING if name in keywords]
    names += [f"*{name} (in part)" for name in ("MASS", "INTERNAL FLUID") if name in unread]
    if "*MASS (in part)" not in names and any(node is None for _, node in _masses(scene)):
        names.append("*MASS (in part)")
    if not with_masses and "MASS" in keywords:
        names = [*(one for one in names if one != "*MASS (in part)"), "*MASS"]
    before = {base.deck.file for base in deck.bases if "INTERNAL FLUID" in base.deck.keywords("LOAD CASE")}
    if before and "INTERNAL FLUID" not in keywords:
        names.append("*INTERNAL FLUID of the deck that it continues")
    return names


# ----------------------------------------------------------------------------------------------------------------- pipe


class Stiffnesses(NamedTuple):
    """Axial, bending and torsional stiffness of a section in the deck's units; NaN where the deck gives none."""

    axial: float
    bending: float
    torsion: float


def stiffnesses(scene: ResolvedDeck, section: Section) -> Stiffnesses:
    """Return the stiffness of a section; for curves it is the slope at 0."""
    row = section.entry.section
    if format_of(section.entry) != "rigid":
        return Stiffnesses(
            _modulus(scene, section, number(row, "ea"), "ea_curve"),
            _modulus(scene, section, number(row, "eiyy"), "eiyy_curve", "ei_curve"),
            _modulus(scene, section, number(row, "gj"), "gj_curve"),
        )
    outer, inner = np.float64(number(row, "do")), np.float64(number(row, "di", 0.0))
    with np.errstate(over="ignore", invalid="ignore"):  # a float would raise where a power is infinite
        area = number(row, "area", float(math.pi / 4 * (outer**2 - inner**2)))
        second = number(row, "second_moment", float(math.pi / 64 * (outer**4 - inner**4)))
    young = _modulus(scene, section, number(row, "e"), "e_curve")
    return Stiffnesses(young * area, young * second, number(row, "g") * number(row, "polar_moment", 2.0 * second))


STIFFNESS_CURVES = {"ea_curve": "FORCE-STRAIN", "e_curve": "STRESS/STRAIN DIRECT", "gj_curve": "TORQUE-TWIST"}
BENDING_CURVES = "MOMENT-CURVATURE"
"""Keyword of bending curves; STIFFNESS_CURVES has those of other stiffnesses by the setting that names them."""


def _modulus(scene: ResolvedDeck, section: Section, given: float, *settings: str) -> float:
    """Return a stiffness: the number, else the slope at 0 of the curve that replaces it; NaN without both."""
    name = next(filter(None, (getattr(section.entry, setting, None) for setting in settings)), None)
    if not math.isnan(given) or name is None:
        return given
    keyword = STIFFNESS_CURVES.get(settings[0], BENDING_CURVES)
    curves = (each for each in scene.other_curves if each.keyword == keyword and folded(each.name) == folded(name))
    curve = next(curves, None)
    if curve is None or len(curve.points) < FEWEST_POINTS or (curve.curve is not None and not curve.whole):
        return math.nan  # unknown also if a row cannot be read, which may be the one next to 0
    order = np.argsort(curve.points[:, 0], kind="stable")  # also of a curve with two loads at a strain
    strains, loads = curve.points[order].T
    at = int(np.clip(np.searchsorted(strains, 0.0, side="right"), 1, len(strains) - 1))
    rise, run = float(loads[at] - loads[at - 1]), float(strains[at] - strains[at - 1])
    return rise / run if run > 0.0 else math.nan


_DRAG, _INERTIA, _ADDED_MASS = 1.0, 2.0, 1.0
"""Coefficients of an element without any in the deck, and defaults of fields that a line may omit."""


class Pipe(NamedTuple):
    """Elements (m,) of a deck, per unit length and in its units; NaN where a value is not known.

    weight: submerged weight with contents.
    mass: mass of the pipe alone.
    contents: mass of the contents in the last load case.
    added_mass: Ca rho pi D^2 / 4.
    drag: Cd rho D / 2, the transverse force of water at a velocity of 1.
    drag_coefficient, added_mass_coefficient: Cd and Ca.
    has_coefficients: False where these are assumed.
    bending, axial: EI and EA, for curves their slope at 0.
    axial_drag_coefficient, axial_added_mass: values along the pipe, 0 if not given.
    """

    weight: Floats
    mass: Floats
    contents: Floats
    added_mass: Floats
    drag: Floats
    drag_coefficient: Floats
    added_mass_coefficient: Floats
    has_coefficients: Mask
    bending: Floats
    axial: Floats
    axial_drag_coefficient: Floats
    axial_added_mass: Floats


def pipe_of(scene: ResolvedDeck) -> Pipe:
    """Return the elements of a scene with the contents of its load case and its hydrodynamic coefficients."""
    table, around = scene.section_table, scene.surroundings
    filled = contents(scene)
    inside = filled[-1].mass if filled else np.zeros(len(scene.element_ids))
    added, drag, from_deck, with_buoyancy, along = _coefficients(scene)
    drag_diameter = table.values("dd", "do")
    size = np.where(with_buoyancy, table.values("db", "do"), drag_diameter)
    size = np.where(size > 0.0, size, table.values("do", "dd"))
    with np.errstate(all="ignore"):
        displaced = around.density * math.pi / 4.0 * size * size
        of_sections = [stiffnesses(scene, section) for section in table.sections]
        return Pipe(
            weight=scene.submerged_weight + inside * around.gravity,
            mass=scene.mass_per_length,
            contents=inside,
            added_mass=added * displaced,
            drag=0.5 * drag * around.density * drag_diameter,
            drag_coefficient=drag,
            added_mass_coefficient=added,
            has_coefficients=from_deck,
            bending=picked((each.bending for each in of_sections), table.of_element),
            axial=picked((each.axial for each in of_sections), table.of_element),
            axial_drag_coefficient=along[:, 0],
            axial_added_mass=along[:, 1] * displaced,
        )


def _coefficients(scene: ResolvedDeck) -> tuple[Floats, Floats, Mask, Mask, Floats]:
    """Return Ca (m,), Cd (m,), two masks (m,), and Cd and Ca along the pipe (m, 2).

    The masks are the elements with coefficients in the deck, and those whose inertia uses the buoyancy diameter.
    """
    holders: list[NamedSet | None] = []
    values: list[tuple[float, ...]] = []
    for where, block in scene.deck.blocks("HYDRODYNAMIC SETS"):
        for _, entry, _, holder in scene.set_table.entries([(where, block)]):
            if holder is None or (row := entry.constant) is None:
                continue
            holders.append(holder)
            added = number(row, "normal_added_mass", max(number(row, "normal_inertia", _INERTIA) - 1.0, 0.0))
            along = (number(row, f"tangential_{name}", 0.0) for name in ("drag", "added_mass"))
            values.append((added, number(row, "normal_drag", _DRAG), block.diameter == "BUOYANCY", *along))
    of_element = later_wins(holders, len(scene.element_ids))
    table = np.array([*values, (_ADDED_MASS, _DRAG, 0.0, 0.0, 0.0)])[of_element]
    return table[:, 0], table[:, 1], of_element >= 0, table[:, 2] > 0.0, table[:, 3:]
