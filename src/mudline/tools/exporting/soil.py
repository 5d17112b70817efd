"""Seabed below the elements of a deck as other programs take it: a stiffness, and friction along and across.

A stiffness is per length of pipe and of penetration. That of a curve is its secant at the static penetration, where the
law carries the submerged weight W of the pipe with its contents. Only there the reaction equals that of the deck. If W
is not above 0, it is the secant at the curve's first point with a force.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.basics.quantities import shown
from mudline.basics.units import UnitSystem
from mudline.language.diagnostics import Where
from mudline.model.contact.input import LawKind
from mudline.model.contact.laws.soil import SOIL
from mudline.model.scene.assignments import nodal_stiffness, soil_parameters
from mudline.model.scene.deck_values import LARGEST_MOBILISATION
from mudline.model.scene.laws import Extension, SeabedResistance
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.resolved import LawArrays, ResolvedDeck
from mudline.model.scene.sheet import friction_coefficients
from mudline.model.scene.weights import pipe_of
from mudline.tools.exporting.report import ExportReport, Outcome, short_name

_RIGID_SHARE = 1e-3
"""Penetration, as a share of the diameter, of a pipe on a rigid seabed."""
_HALVINGS = 80
_SAME = 1e-3
"""Share by which equal stiffnesses may differ."""
_KNOWN = frozenset({LawKind.NONE, *(LawKind.CURVE, LawKind.LINEAR, LawKind.RIGID, LawKind.NODAL, LawKind.SOIL)})
"""Kinds of laws with a stiffness here, 0 without a law; others are left out."""
_SETTINGS = {
    "SEABED CONTACT": {"smoothing": "no effect at rest beyond its zone", "damping": "no effect at rest"},
    "SEABED FRICTION": {
        "directions": "along and across the line instead",
        "criterion": "each direction by itself, or both on a circle, as the target has it",
        "lateral": "the coefficient across, before and after breakout",
    },
}
_PLAIN = ("AXIAL", "BOX", "COULOMB", "NONE")


class ExportSoil(NamedTuple):
    """Seabed of some elements, in SI units; the stiffness is 0 where nothing carries them.

    `axial` and `lateral` are friction coefficients. `axial_spring` and `lateral_spring` are the stiffnesses per length
    of pipe below the friction limit at the submerged weight. `parameters` are those of `*SEABED SOIL`.
    """

    law: str
    kind: LawKind
    where: Where | None
    diameter: float
    weight: float
    stiffness: float
    tangent: float
    penetration: float
    axial: float = 0.0
    lateral: float = 0.0
    axial_spring: float = 0.0
    lateral_spring: float = 0.0
    friction_at: Where | None = None
    parameters: tuple[tuple[str, float], ...] = ()

    def says(self) -> str:
        """Return its law with secant and tangent, for a report."""
        kind, _, name = self.law.partition(":")
        law = f"{kind} {short_name(name)}" if name else self.law
        if self.kind is LawKind.LINEAR:
            return f"{law}: {kilo(self.stiffness)}"
        at = f"at W ({distance(self.penetration)})"
        at = at if self.weight > 0.0 else "of its first point, as W is not above 0"
        return f"{law}: secant {kilo(self.stiffness)} {at}, tangent there {kilo(self.tangent)}"


def distance(metres: float) -> str:
    """Return a distance in mm, or in m from 1 m on."""
    return f"{shown(metres, 3)} m" if abs(metres) >= 1.0 else f"{shown(1e3 * metres, 3)} mm"


def kilo(stiffness: float) -> str:
    """Return a stiffness in kN/m2."""
    return f"{shown(stiffness / 1e3, 4)} kN/m2"


def soils_of(scene: ResolvedDeck, units: UnitSystem) -> tuple[list[ExportSoil], Indices]:
    """Return the different seabeds of the elements, and the index of that of each element (m,)."""
    weight = np.nan_to_num(pipe_of(scene).weight)
    size = np.nan_to_num(scene.diameter)
    friction = _friction(scene, weight)
    blocks = [np.asarray(extension.of_element) for extension in scene.extensions.values()]
    per_node = np.where(scene.law == LawKind.NODAL, scene.length, 0.0)
    own = (scene.laws.of_element, scene.law, scene.resistance.of_element)
    keys = np.column_stack([*own, *blocks, weight, size, per_node, friction])
    _, firsts, of_element = np.unique(np.round(keys, 9), axis=0, return_index=True, return_inverse=True)
    arrays = scene.law_arrays()
    soils = [_soil(scene, units, arrays, int(at), float(weight[at]), friction[at].tolist()) for at in firsts]
    return soils, of_element.ravel()


def _friction(scene: ResolvedDeck, weight: Floats) -> Floats:
    """Return coefficients of friction along and across, and the springs below the limit, of each element (m, 4).

    Below the limit a spring is that of the mobilisation length, or that of a node over the length of an element.
    """
    table, coefficient = scene.resistance, np.nan_to_num(friction_coefficients(scene))
    mobilisation = table.column("mobilisation")
    longest = np.fmin(table.column("characteristic"), LARGEST_MOBILISATION.get(scene.units, np.inf))
    length = np.where(mobilisation > 0.0, mobilisation, np.fmin(scene.length[:, None], longest))
    with np.errstate(all="ignore"):
        spring = np.nan_to_num(coefficient * weight[:, None] / length)
    held = table.column("lateral") > 0.0
    if (keyword := scene.extensions.get("SEABED FRICTION")) is not None:
        at = keyword.of_element
        along, across = (keyword.values(at, "stiffness", name) for name in ("first", "second"))
        springs = np.column_stack([along, np.where(np.isnan(across), along, across)])
        spring = np.where(at[:, None] >= 0, springs / scene.length[:, None], spring)
        held &= at < 0
    coefficient[held, 1] = 0.0
    return np.column_stack([coefficient, spring])


def _soil(
    scene: ResolvedDeck, units: UnitSystem, arrays: LawArrays, at: int, weight: float, friction: list[float]
) -> ExportSoil:
    kind, diameter = LawKind(int(scene.law[at])), float(np.nan_to_num(scene.diameter[at]))
    parameters = {}
    if kind is LawKind.SOIL:
        named = soil_parameters(scene.extensions["SEABED SOIL"], np.array([at]))
        parameters = {name: float(values[0]) for name, values in named.items()}
        stiffness, tangent = _of_soil(parameters, weight, diameter)
    else:
        stiffness, tangent = _stiffness(scene, arrays, at, kind, weight)

    def place_in(table: Extension | SeabedResistance | None) -> Where | None:
        own = -1 if table is None else int(table.of_element[at])
        return None if table is None or own < 0 else table.places[own]

    extensions = {replaced.kind: replaced.extension for replaced in scene.replaced}
    law = scene.set_law(at)
    return ExportSoil(
        scene.law_names[at],
        kind,
        place_in(extensions.get(kind)) or (law.where if law else None),
        diameter * units.length,
        weight * units.force / units.length,
        stiffness * units.size("F/L2"),
        tangent * units.size("F/L2"),
        (weight / stiffness if stiffness > 0.0 else 0.0) * units.length,
        friction[0],
        friction[1],
        friction[2] * units.size("F/L2"),
        friction[3] * units.size("F/L2"),
        place_in(scene.extensions.get("SEABED FRICTION")) or place_in(scene.resistance),
        tuple(parameters.items()),
    )


def _stiffness(scene: ResolvedDeck, arrays: LawArrays, at: int, kind: LawKind, weight: float) -> tuple[float, float]:
    """Return secant and tangent at the static penetration, in the deck's units."""
    diameter, stiffness = float(np.nan_to_num(scene.diameter[at])), 0.0
    if kind is LawKind.LINEAR:
        stiffness = float(arrays.linear_stiffness[at])
    elif kind is LawKind.RIGID and diameter:
        stiffness = max(weight, 1.0) / (_RIGID_SHARE * diameter)
    elif kind is LawKind.NODAL:
        springs = nodal_stiffness(scene, scene.extensions["SEABED CONTACT"])
        stiffness = float(np.nanmean(springs[scene.element_nodes[at]])) / float(scene.length[at])
    elif kind is LawKind.CURVE:
        curve = arrays.curves[int(arrays.curve_index[at])]
        ratio = next((each for each in curve.ratios_at_force(weight) if each > 0.0), 0.0) if weight > 0.0 else 0.0
        loaded = (curve.ratios > 0.0) & (curve.forces > 0.0)
        ratio = ratio or float(np.min(curve.ratios, initial=np.inf, where=loaded))
        force, slope = (float(value) for value in curve.evaluate(ratio if np.isfinite(ratio) else 1.0))
        return max(force, 0.0) / (ratio * diameter), slope / diameter
    return stiffness, stiffness


def _of_soil(parameters: dict[str, float], weight: float, diameter: float) -> tuple[float, float]:
    """Return secant and tangent of a soil at the static penetration."""
    soil = tuple(parameters[each.name] for each in SOIL.parameters)
    low, high = 0.0, 10.0 * diameter
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if SOIL.reaction(middle, diameter, *soil)[0] < max(weight, 1e-6) else (low, middle)
    force, slope = map(float, SOIL.reaction(high, diameter, *soil))
    return force / high, slope


def report_governing(report: ExportReport, soils: list[ExportSoil], main: ExportSoil, *, at_touchdown: bool) -> None:
    """Report the stiffness in a target with one seabed, and the range over the line if stiffnesses differ."""
    carrying = [each.stiffness for each in soils if each.stiffness > 0.0]
    if carrying and max(carrying) > (1.0 + _SAME) * min(carrying):
        span = f"over the line {shown(min(carrying) / 1e3, 4)} to {kilo(max(carrying))}"
        effect = f"that of the elements {'around touchdown' if at_touchdown else 'most of the pipe rests on'}; {span}"
        report.add(main.where, Outcome.APPROXIMATED, f"one stiffness, {kilo(main.stiffness)}", effect, "range")


def report_stiffness(report: ExportReport, soils: list[ExportSoil], name: str, used: list[float]) -> None:
    """Report the normal law of each seabed with the stiffness in the target."""
    for soil, stiffness in zip(soils, used, strict=True):
        if soil.kind not in _KNOWN:
            report.add(soil.where, Outcome.LEFT_OUT, "none", f"no stiffness is known of the law {soil.law}")
            continue
        same = abs(stiffness - soil.stiffness) <= 1e-6 * stiffness
        target, effect = f"{name} {kilo(stiffness)}", soil.says()
        status = Outcome.CARRIED if same and soil.kind is LawKind.LINEAR else Outcome.APPROXIMATED
        if soil.stiffness <= 0.0 and same:
            continue
        if soil.stiffness <= 0.0:
            effect = "no law in the deck: the one seabed of the target acts here too"
        elif not same and soil.weight > 0.0 and stiffness > 0.0:
            effect += f"; sinks {distance(soil.weight / stiffness)} here, as the target has one stiffness"
        report.add(soil.where, status, target, effect)
        curve = soil.law.partition(":")[2]
        for entry in report.scene.laws.curves if curve else ():
            if entry.name == curve:
                report.add(entry.where, status, target, effect)
    reported, laws = {soil.where for soil in soils}, report.scene.laws
    for law in laws.set_laws:
        if law.where not in reported:
            report.add(law.where, Outcome.LEFT_OUT, "none", "no element follows this law")
    followed = {law.curve for law in laws.set_laws if law.where in reported}
    for number, entry in enumerate(laws.curves):
        if number not in followed:
            report.add(entry.where, Outcome.LEFT_OUT, "none", "no element follows this curve")


def report_friction(
    report: ExportReport, soils: list[ExportSoil], target: str, used: list[tuple[float, float]]
) -> None:
    """Report the friction of each seabed with the coefficients along and across in the target."""
    for soil, (axial, lateral) in zip(soils, used, strict=True):
        own = f"{shown(soil.axial)} along, {shown(soil.lateral)} across"
        same = (axial, lateral) == (soil.axial, soil.lateral)
        effect = own if same else f"{own} in the deck; here {shown(axial)} along, {shown(lateral)} across"
        report.add(soil.friction_at, Outcome.CARRIED if same else Outcome.APPROXIMATED, target, effect, "friction")


def report_resistance(report: ExportReport) -> None:
    """Report the settings next to stiffness and friction that no target has."""
    table = report.scene.resistance
    for values, where in zip(table.values, table.places, strict=True):
        for setting, value, effect in (
            ("LATERAL=", values.lateral, "no spring to where it touched down: friction alone holds the pipe sideways"),
            ("SUCTION=", values.suction, "nothing holds the pipe back on the way up: no effect under its own weight"),
            ("constant friction", values.constant, "as in mudline, which does not evaluate it"),
        ):
            if value > 0.0:
                report.add(where, Outcome.LEFT_OUT, "none", effect, setting)
    for keyword, names in _SETTINGS.items():
        extension = report.scene.extensions.get(keyword)
        for entry, where in zip(extension.entries, extension.places, strict=True) if extension else ():
            for name, effect in names.items():
                if (choice := getattr(entry, name, None)) is not None and choice not in _PLAIN:
                    report.add(where, Outcome.LEFT_OUT, "none", effect, f"{name.upper()}=")
