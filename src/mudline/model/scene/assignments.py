"""Assignments of laws that few decks use: smoothing, nodal stiffness, unloading, suction, friction, trenches."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.units import UNITS
from mudline.model.contact.arrays import summed
from mudline.model.contact.input import LawAssignment, LawKind
from mudline.model.scene.deck_values import LARGEST_MOBILISATION, number
from mudline.model.scene.laws import Extension
from mudline.model.scene.numbering import Floats, Indices, Mask, at_nodes, marked, picked
from mudline.model.scene.resolved import ResolvedDeck

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_lateral import FrictionSet, TrenchSet
    from mudline.language.keywords.library.seabed_normal import SuctionSet
    from mudline.model.contact.laws.suction import SuctionLaw

_LINE = (("start_y", "y0"), ("start_z", "z0"), ("end_y", "y1"), ("end_z", "z1"))
_CORNERS = (0.2, 0.8)
_SLOWEST = 1e-3
"""Default of REGULARISATION=, m/s."""


def element_smoothing(scene: ResolvedDeck) -> LawAssignment:
    """Return the elements with a linear law and a quadratic zone (`SMOOTHING=` and `FORM=` of `*SEABED CONTACT`)."""
    extension = scene.extensions["SEABED CONTACT"]
    block = np.where(scene.law == LawKind.LINEAR, extension.of_element, -1)
    stiffness = scene.law_arrays().linear_stiffness
    with np.errstate(all="ignore"):
        penetration = scene.submerged_weight / stiffness
    zones = _zones(extension, block, stiffness, penetration, scene.diameter)
    rows = np.flatnonzero(zones["half_width"] > 0.0)
    return LawAssignment("smoothed", rows, {name: values[rows] for name, values in zones.items()})


def _zones(
    extension: Extension, block: Indices, stiffness: Floats, penetration: Floats, diameter: Floats
) -> dict[str, Floats | Mask]:
    """Return stiffness and quadratic zone at points that follow each `block` (-1: none), as parameters of a law.

    The half width of a zone is the given number, or that of AUTO, which depends on the static penetration Z alone if
    there is no diameter; 0 for NONE.
    """
    from mudline.model.contact.laws.linear import automatic_half_width  # noqa: PLC0415 - only now is it needed

    automatic = automatic_half_width(penetration, np.where(np.isnan(diameter), np.inf, diameter))
    automatic = np.where(np.isfinite(automatic), automatic, 0.0)
    explicit = extension.values(block, "smoothing", default=0.0)
    width = np.where(block >= 0, np.where(_is_auto(extension, block), automatic, explicit), 0.0)
    return {"stiffness": stiffness, "half_width": width, "one_sided": extension.says(block, "form", "ONE-SIDED")}


def _is_auto(extension: Extension, block: Indices) -> Mask:
    """Return a mask of blocks whose width follows from static penetration: the default, except with only DAMPING=."""

    def auto(entry: object) -> bool:
        names = ("form", "nodal_stiffness") if getattr(entry, "damping", None) is not None else ()
        smoothing: object = getattr(entry, "smoothing", None)
        asked = not names or any(getattr(entry, name, None) is not None for name in names)
        return smoothing == "AUTO" or (smoothing is None and asked)

    return marked(map(auto, extension.entries), block)


def damping(scene: ResolvedDeck) -> list[LawAssignment]:
    """Return the damping of elements with a law per unit length, and of nodes with nodal stiffness."""
    extension = scene.extensions["SEABED CONTACT"]
    values = np.nan_to_num(extension.values(extension.of_element, "damping"))
    rows = np.flatnonzero((values > 0.0) & ~np.isin(scene.law, (LawKind.NONE, LawKind.RIGID, LawKind.NODAL)))
    length = np.where(scene.nodal & np.isfinite(scene.length), scene.length, 0.0)
    of_nodes = summed(0.5 * values * length, scene.element_nodes, len(scene.node_ids))
    nodes = np.flatnonzero(of_nodes > 0.0)
    return [
        LawAssignment("damping", rows, {"damping": values[rows]}),
        LawAssignment("nodal damping", nodes, {"damping": of_nodes[nodes]}),
    ]


def weightless(scene: ResolvedDeck) -> int:
    """Return the number of elements that are not smoothed because their submerged weight is unknown or not above 0."""
    extension = scene.extensions["SEABED CONTACT"]
    auto = _is_auto(extension, extension.of_element) & np.isin(scene.law, (LawKind.LINEAR, LawKind.NODAL))
    return int((auto & ~(scene.submerged_weight > 0.0)).sum())


def nodal_springs(scene: ResolvedDeck) -> LawAssignment:
    """Return the springs of the nodes (`NODAL STIFFNESS=` of `*SEABED CONTACT`), with their quadratic zones."""
    extension = scene.extensions["SEABED CONTACT"]
    block = _nodal_blocks(scene, extension)
    stiffness, ends = nodal_stiffness(scene, extension), scene.element_nodes
    with np.errstate(all="ignore"):  # W L_t / Kn, of half of the total weight of a node's elements
        penetration = summed(0.5 * scene.submerged_weight * scene.length, ends, len(scene.node_ids)) / stiffness
    zones = _zones(extension, block, stiffness, penetration, _sizes(scene))
    rows = np.flatnonzero(~np.isnan(stiffness))
    return LawAssignment("nodal", rows, {name: values[rows] for name, values in zones.items()})


def nodal_stiffness(scene: ResolvedDeck, extension: Extension) -> Floats:
    """Return Kn of each node (n,), force per length; NaN for nodes without an element with a nodal law."""
    return extension.values(_nodal_blocks(scene, extension), "nodal_stiffness")


def _nodal_blocks(scene: ResolvedDeck, extension: Extension) -> Indices:
    """Return the block that gives each node (n,) its stiffness: the last one that its nodal elements follow, or -1."""
    of_element = np.where(scene.law == LawKind.NODAL, extension.of_element, -1)
    return at_nodes(of_element, scene.element_nodes, len(scene.node_ids))


def _sizes(scene: ResolvedDeck) -> Floats:
    """Return mean diameters (n,) of the elements at the nodes; NaN if none is known."""
    ends, count, known = scene.element_nodes, len(scene.node_ids), ~np.isnan(scene.diameter)
    with np.errstate(all="ignore"):
        sizes = summed(np.where(known, scene.diameter, 0.0), ends, count)
        return sizes / summed(known.astype(np.float64), ends, count)


def unloading_lines(scene: ResolvedDeck) -> LawAssignment:
    """Return the elements on a curve or a linear law with their own unloading stiffness (`*SEABED UNLOADING`)."""
    extension = scene.extensions["SEABED UNLOADING"]
    rows = np.flatnonzero((extension.of_element >= 0) & np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR)))
    return LawAssignment("unloading", rows, {"stiffness": extension.values(extension.of_element[rows], "stiffness")})


SOIL_FIELDS = {
    "strength": ("strength", "mudline"),
    "gradient": ("strength", "gradient"),
    "factor": ("bearing", "factor"),
    "exponent": ("bearing", "exponent"),
    "stiffness": ("stiffness",),
    "suction": ("suction", "ratio"),
    "suction_decay": ("suction", "decay"),
    "repenetration": ("repenetration",),
}
"""Fields of `*SEABED SOIL` by the parameters of the law."""


def soils(scene: ResolvedDeck) -> LawAssignment:
    """Return the hysteretic soil of the elements on an elastic seabed (`*SEABED SOIL`)."""
    rows = np.flatnonzero(scene.law == LawKind.SOIL)
    return LawAssignment("soil", rows, soil_parameters(scene.extensions["SEABED SOIL"], rows))


def soil_parameters(extension: Extension, elements: Indices) -> dict[str, Floats]:
    """Return the parameters of some elements (k,) with a soil, by name."""
    from mudline.model.contact.laws.soil import SOIL  # noqa: PLC0415 - only now is it needed

    block = extension.of_element[elements]
    default = {each.name: math.nan if each.default is None else each.default for each in SOIL.parameters}
    parameters = {name: extension.values(block, *path) for name, path in SOIL_FIELDS.items()}
    parameters = {name: np.where(np.isnan(values), default[name], values) for name, values in parameters.items()}
    factor, weight = (extension.values(block, "buoyancy", name) for name in ("factor", "weight"))
    return parameters | {"buoyancy": np.nan_to_num(factor * weight)}


def element_suction(scene: ResolvedDeck) -> LawAssignment:
    """Return the suction laws of the elements on an elastic seabed (`*SEABED SUCTION`)."""
    extension = scene.extensions["SEABED SUCTION"]
    elements = np.flatnonzero((extension.of_element >= 0) & (scene.law != LawKind.RIGID))
    return LawAssignment("suction", elements, suction_law(scene, extension, elements)._asdict())


def suction_law(scene: ResolvedDeck, extension: Extension, elements: Indices) -> SuctionLaw:
    """Return the suction law of the blocks that some elements (k,) follow, in the deck's units; NaN for missing values.

    The power laws are the explicit ones, or else those that follow from cohesion and diameter.
    """
    from mudline.model.contact.laws.suction import SuctionFactors, SuctionLaw, from_cohesion  # noqa: PLC0415 - only now is it needed

    block = extension.of_element[elements]
    cohesion = extension.values(block, "cohesion")
    diameter = np.where(np.isnan(cohesion), np.nan, scene.diameter[elements])
    units = UNITS[scene.units]
    computed = from_cohesion(cohesion, diameter, units.length, units.force)
    written = [extension.values(block, law, name) for law in ("force", "depth") for name in ("factor", "exponent")]
    factors = (np.where(np.isnan(own), default, own) for own, default in zip(written, computed, strict=True))
    first, second = (extension.values(block, "cutoff", name) for name in ("first", "second"))
    slowest = _SLOWEST / units.length if units.known else math.nan
    return SuctionLaw(
        *SuctionFactors(*factors),
        first_corner=np.where(np.isnan(first), _CORNERS[0], first),
        second_corner=np.where(np.isnan(second), _CORNERS[1], second),
        cyclic=picked((_cyclic(entry)[0] for entry in extension.entries), block),
        regularisation=extension.values(block, "regularisation", default=slowest),
        cyclic_floor=picked((_cyclic(entry)[1] for entry in extension.entries), block),
    )


def _cyclic(entry: object) -> tuple[float, float]:
    """Return factor and floor of CYCLIC=; the floor is NaN if it is not given."""
    cyclic = cast("SuctionSet", entry).cyclic
    return number(cyclic, "factor", number(entry, "cyclic", 1.0)), number(cyclic, "floor")


def node_friction(scene: ResolvedDeck, lateral: Indices) -> LawAssignment:
    """Return the friction of the nodes that have any; the lateral one up to the breakout, if they have one.

    Nodes of elements with a lateral spring (`lateral` (k,)) have no transverse coefficient. Nodes of a rigid seabed
    have no friction, as their normal reaction is that of a constraint.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    springs = _of_properties(scene)
    active = (springs[0] > 0.0).any(axis=1)
    ellipse, angle = np.zeros(count, dtype=np.bool_), np.full(count, np.nan)
    extension = scene.extensions.get("SEABED FRICTION")
    if extension is not None:
        block = _friction_blocks(scene, extension)
        here = block >= 0
        springs = np.where(here[:, None], _of_keyword(scene, extension, block), springs)
        active = active | here
        ellipse = extension.says(block, "criterion", "ELLIPSE")
        angle = extension.values(block, "directions")
    coefficients, stiffness, mobilisation = springs
    coefficients[ends[lateral], 1] = 0.0
    active[ends[scene.law == LawKind.RIGID].ravel()] = False
    rows = np.flatnonzero(active)
    with np.errstate(all="ignore"):
        rising = coefficients[rows] / mobilisation[rows]
    if (endless := np.isinf(rising).any(axis=1)).any():
        node = int(scene.node_ids[rows[np.argmax(endless)]])
        what = "its friction coefficient divided by its mobilisation length is too large for a double-precision number"
        raise scene.refusal(f"node {node}: {what}; this cannot be evaluated", node=node)
    parameters = {"elliptic": ellipse[rows], "angle": angle[rows]}
    for side, name in enumerate(("axial", "lateral")):
        parameters[f"{name}_coefficient"] = np.nan_to_num(coefficients[rows, side])
        parameters[f"{name}_stiffness"] = stiffness[rows, side]
        parameters[f"{name}_mobilisation"] = mobilisation[rows, side]
    return LawAssignment("friction", rows, parameters)


def _of_properties(scene: ResolvedDeck) -> Floats:
    """Return coefficients, constant springs and mobilisation lengths (3, n, 2) of `FRICTION=`; NaN if not given.

    The default length at a node is the smallest of its elements' lengths, up to a maximum.
    """
    ends, count = scene.element_nodes, len(scene.node_ids)
    block = at_nodes(scene.resistance.of_element, ends, count)
    by_name = {
        name: np.array([*(getattr(entry, name) for entry in scene.resistance.values), (np.nan, np.nan)])[block]
        for name in ("friction", "mobilisation", "characteristic")
    }
    largest = np.fmin(by_name["characteristic"], np.inf)
    largest = np.where(np.isinf(largest), LARGEST_MOBILISATION.get(scene.units, np.inf), largest)
    shortest = np.full(count, np.inf)  # of the elements of each node
    usable = np.isfinite(scene.length) & (scene.length > 0.0)
    for end in ends[usable].T:
        np.minimum.at(shortest, end, scene.length[usable])
    default = np.fmin(shortest[:, None], largest)
    length = np.where(by_name["mobilisation"] > 0.0, by_name["mobilisation"], default)
    return np.stack([by_name["friction"], np.full((count, 2), np.nan), np.where(np.isfinite(length), length, np.nan)])


def _of_keyword(scene: ResolvedDeck, extension: Extension, block: Indices) -> Floats:
    """Return the same as `_of_properties` for `*SEABED FRICTION`; it gives springs, and lengths only for a breakout."""
    coefficients, stiffness = (
        np.column_stack([extension.values(block, part, name) for name in ("first", "second")])
        for part in ("coefficients", "stiffness")
    )
    stiffness[:, 1] = np.where(np.isnan(stiffness[:, 1]), stiffness[:, 0], stiffness[:, 1])
    lengths, out = np.full(stiffness.shape, np.nan), marked(map(breaks_out, extension.entries), block)
    if out.any():
        coefficients[out, 1], stiffness[out, 1] = extension.values(block, "peak", "factor")[out], np.nan
        lengths[out, 1] = _breakouts(scene)["peak_displacement"][out]
    return np.stack([coefficients, stiffness, lengths])


def breaks_out(entry: object) -> bool:
    """Return True if a block of `*SEABED FRICTION` gives a breakout."""
    return getattr(entry, "lateral", None) in {"PEAK-RESIDUAL", "F114"}


def softens(entry: object) -> bool:
    """Return True if a block of `*SEABED FRICTION` gives a breakout whose residual is below its peak."""
    from mudline.model.contact.laws.breakout import F114_RESIDUAL  # noqa: PLC0415 - only now

    friction = cast("FrictionSet", entry)
    residual = F114_RESIDUAL[0] if friction.lateral == "F114" else number(friction.residual, "factor")
    return breaks_out(friction) and number(friction.peak, "factor") > residual


def node_breakouts(scene: ResolvedDeck, friction: LawAssignment) -> list[LawAssignment]:
    """Return the breakout of the nodes with friction that have one (`LATERAL=` of `*SEABED FRICTION`)."""
    extension = scene.extensions.get("SEABED FRICTION")
    if extension is None or not any(map(breaks_out, extension.entries)):
        return []
    out = marked(map(breaks_out, extension.entries), _friction_blocks(scene, extension))[friction.rows]
    rows = friction.rows[out & (np.asarray(friction.parameters["lateral_coefficient"]) > 0.0)]
    return [LawAssignment("breakout", rows, {name: values[rows] for name, values in _breakouts(scene).items()})]


def _friction_blocks(scene: ResolvedDeck, extension: Extension) -> Indices:
    """Return the block of `*SEABED FRICTION` that each node (n,) follows, -1 for none."""
    return at_nodes(extension.of_element, scene.element_nodes, len(scene.node_ids))


def _breakouts(scene: ResolvedDeck) -> dict[str, Floats]:
    """Return the parameters of the breakout of all nodes (n,); NaN if there is none."""
    from mudline.model.contact.laws.breakout import F114_DISPLACEMENTS, F114_RESIDUAL  # noqa: PLC0415 - only now

    extension = scene.extensions["SEABED FRICTION"]
    block = _friction_blocks(scene, extension)
    published = extension.says(block, "lateral", "F114")
    peak, residual, size = extension.values(block, "peak", "factor"), F114_RESIDUAL, _sizes(scene)
    parameters: dict[str, tuple[Floats | float, Floats]] = {
        "peak_displacement": (extension.values(block, "peak", "displacement"), F114_DISPLACEMENTS[0] * size),
        "peak_growth": (0.0, F114_DISPLACEMENTS[1] * size),
        "residual": (extension.values(block, "residual", "factor") / peak, residual[0] / peak),
        "residual_growth": (0.0, residual[1] / peak),
        "residual_displacement": (extension.values(block, "residual", "displacement"), F114_DISPLACEMENTS[2] * size),
    }
    return {name: np.where(published, theirs, ours) for name, (ours, theirs) in parameters.items()}


def trenches(scene: ResolvedDeck) -> list[LawAssignment]:
    """Return the elements in trenches by law: peak, tabulated resistance, sloped walls; and lowered levels."""
    extension = scene.extensions["SEABED TRENCH"]
    entries = _trench_sets(scene)
    if not (extension.of_element >= 0).any():
        return []
    walls = np.array([entry.model == "WALL" for entry in entries])
    lower = np.array([entry.level == "LOWERED" for entry in entries])
    tabulated = np.array([_has_table(entry) for entry in entries])
    table = np.cumsum(tabulated) - 1.0
    laws = []
    for law, blocks, name in (
        ("trench peak", ~walls & ~tabulated, "peak"),
        ("trench table", tabulated, "table"),
        ("trench wall", walls, "depth"),
        ("trench level", lower, "depth"),
    ):
        rows = np.flatnonzero((extension.of_element >= 0) & blocks[extension.of_element])
        block = extension.of_element[rows]
        path = ("geometry", "depth") if name == "depth" else ("peak",)
        parameters = {
            "bottom": extension.values(block, "geometry", "bottom_width"),
            "upper": extension.values(block, "geometry", "upper_width"),
            name: table[block] if name == "table" else extension.values(block, *path),
            **{ours: extension.values(block, "centreline", theirs) for ours, theirs in _LINE},
        }
        laws.append(LawAssignment(law, rows, parameters))
    return laws


def resistance_tables(scene: ResolvedDeck) -> list[Floats]:
    """Return the tables (k, 3) of the blocks that have one, in their order."""
    from mudline.model.contact.laws.trench import rounded  # noqa: PLC0415 - only now is it needed

    entries = [entry for entry in _trench_sets(scene) if _has_table(entry)]
    return [rounded(resistance_diagram(entry), number(entry, "smoothing", 0.0)) for entry in entries]


def resistance_diagram(entry: TrenchSet) -> Floats:
    """Return the corners (k, 2) of the resistance over the distance from the centreline."""
    from mudline.model.contact.laws.trench import diagram  # noqa: PLC0415 - only now is it needed

    if entry.peak == "TABLE" and entry.table is not None:
        return entry.table.values
    inner, outer = (0.5 * number(entry.geometry, name) for name in ("bottom_width", "upper_width"))
    held, has_residual = entry.residual, entry.residual is not None
    residual = (number(held, "resistance"), number(held, "displacement")) if has_residual else None
    return diagram(inner, outer, number(entry, "peak"), residual)


def _has_table(entry: TrenchSet) -> bool:
    """Return True if the resistance of a trench needs a table: neither a plain peak nor sloped walls."""
    rounds = entry.residual is not None or number(entry, "smoothing", 0.0) > 0.0
    return entry.model != "WALL" and (entry.peak == "TABLE" or rounds)


def _trench_sets(scene: ResolvedDeck) -> list[TrenchSet]:
    return cast("list[TrenchSet]", scene.extensions["SEABED TRENCH"].entries)
