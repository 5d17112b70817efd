"""OrcaFlex: a text data file (YAML). One normal stiffness, or one nonlinear soil, applies to the whole seabed.

`docs/export.md` has the source of the name of each data item. Units are those of the program's SI system: metre, tonne,
kilonewton. The penetration is that of the invert of the pipe, so the seabed lies half a diameter below that of the
deck.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from math import atan2, cos, degrees, hypot, radians

import numpy as np

from mudline.basics.quantities import shown
from mudline.model.contact.input import LawKind
from mudline.model.contact.laws.soil import SOIL
from mudline.model.scene.seabed import SeabedKind
from mudline.tools.exporting.line_model import LineModel, LineStretch, report_ends, report_sections
from mudline.tools.exporting.report import Outcome, TargetNames, one_line, short_name
from mudline.tools.exporting.soil import (
    distance,
    kilo,
    report_friction,
    report_governing,
    report_resistance,
    report_stiffness,
)

TITLE = "OrcaFlex text data"
_CONNECTION = (
    "Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionDeclination, ConnectionGamma, "
    "ConnectionReleaseStage"
)
_BENDING = "ConnectionxBendingStiffness, ConnectionyBendingStiffness"
_SECTIONS = "LineType, Length, TargetSegmentLength"
_PROFILE = "SeabedProfileDistanceFromSeabedOrigin, SeabedProfileDepth"
_POINTS, _STEEPEST = 201, 45.0
_CARRIED = ("strength", "gradient", "buoyancy")
"""Parameters of `*SEABED SOIL` that are written; the defaults of the others are those of OrcaFlex."""
_BUOYANCY = 1.5
"""Default factor of the weight of displaced soil."""

Items = dict[str, object]


def pieces(model: LineModel) -> list[list[LineStretch]]:
    """Return the sections of OrcaFlex along each line of the model: friction belongs to the line type."""
    return [list(line.stretches(line.kinds)) for line in model.lines]


def segments(piece: LineStretch) -> int:
    """Return the number of segments of a section: its length over the target segment length, the shortest element."""
    return max(1, round(float(piece.length / piece.lengths.min())))


def write(model: LineModel, name: str) -> dict[str, str]:
    """Return the text of the file by its name. Raises DeckError for lines joined at a free node and slopes above 45."""
    for end in model.ends:
        if end.joins:
            message = "lines join at this node, which takes a buoy in OrcaFlex: hold it, or export one line only"
            raise model.scene.refusal(message, model.scene.nodes.where(end.node))
    keys = dict.fromkeys(_key(model, piece) for parts in pieces(model) for piece in parts)
    taken = TargetNames(model.report, "A-Za-z0-9_. ()", 50, [line.name for line in model.lines])
    names = {key: taken.take(model.sections[key[0]].name, model.sections[key[0]].where) for key in keys}
    environment = _environment(model)
    lines = [_line(model, at, names) for at in range(len(model.lines))]
    _report(model, names)
    text = ["%YAML 1.1", *(f"# {line}" for line in model.report.comments(TITLE)), "---"]
    text += ["General:", "  UnitsSystem: SI", "Environment:", *_rows(environment, "  ")]
    types = [_line_type(model, key, each) for key, each in names.items()]
    for title, objects in (("LineTypes", types), ("Lines", lines)):
        text.append(f"{title}:")
        for items in objects:
            first, *others = _rows(items, "    ")
            text += [f"  - {first.strip()}", *others]
    return {name: "".join(f"{row}\n" for row in text)}


def _rows(items: Items, margin: str) -> Iterator[str]:
    """Yield items as lines; a list of lists is a table, with a line for each of its rows."""
    for key, value in items.items():
        if key == "#":
            yield f"{margin}# {one_line(str(value))}"
        elif isinstance(value, list) and value and isinstance(value[0], list):
            yield from (f"{margin}{key}:", *(f"{margin}  - {_value(row)}" for row in value))
        else:
            yield f"{margin}{key}: {_value(value)}"


def _value(value: object) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, float):
        text = repr(value)
        return text if "e" not in text or "." in text else text.replace("e", ".0e")  # YAML 1.1 wants a point
    return "~" if value is None else json.dumps(value) if " " in str(value) else str(value)


# ------------------------------------------------------------------------------------------------------ line types

Key = tuple[int, float, float]
"""Key of a line type: section, and the coefficients of friction along and across."""


def _key(model: LineModel, piece: LineStretch) -> Key:
    soil = model.soils[piece.soil]
    return piece.section, soil.axial, soil.lateral


def _line_type(model: LineModel, key: Key, name: str) -> Items:
    section = model.sections[key[0]]
    return {
        "Name": name,
        "#": f"*GEOMETRIC SETS {short_name(section.name)}, line {model.scene.line_of(section.where)}",
        "Category": "General",
        "OD": section.buoyancy,
        "ID": section.inner,
        "MassPerUnitLength": section.mass / 1e3,
        "EI": [section.bending / 1e3, None],
        "EA": section.axial / 1e3,
        "GJ": section.torsion / 1e3,
        "OuterContactDiameter": section.diameter,
        "Ca": [section.added, None, section.axial_added],
        "Cd": [section.drag, None, section.axial_drag],
        "SeabedLateralFrictionCoefficient": key[2],
        "SeabedAxialFrictionCoefficient": key[1],
    }


def _line(model: LineModel, at: int, names: dict[Key, str]) -> Items:
    line, parts = model.lines[at], pieces(model)[at]
    ends = [_end(model, line.begin, parts[0]), _end(model, line.end, parts[-1])]
    both, scene = (model.ends[line.begin], model.ends[line.end]), model.scene
    nodes = (f"node {scene.node_ids[end.node]}, line {scene.line_of(scene.nodes.where(end.node))}" for end in both)
    sections = [[names[_key(model, each)], each.length, float(each.lengths.min())] for each in parts]
    return {
        "Name": line.name,
        "#": f"from {', to '.join(nodes)}",
        _CONNECTION: ends,
        _BENDING: [["Infinity" if end.held & {5, 6} else 0.0, None] for end in both],
        _SECTIONS: sections,
        "IncludedInStatics": "Yes",
    }


def _end(model: LineModel, index: int, piece: LineStretch) -> list[object]:
    """Return the place of an end, and the direction of the line there, from A to B."""
    first = piece.nodes[0] == model.ends[index].node
    inner = piece.nodes[1] if first else piece.nodes[-2]
    place = model.places[model.ends[index].node]
    x, y, z = ((model.places[inner] - place) * (1.0 if first else -1.0)).tolist()
    return ["Fixed", *place.tolist(), degrees(atan2(y, x)), degrees(atan2(hypot(x, y), z)), 0.0, None]


# ----------------------------------------------------------------------------------------------------- environment


def _environment(model: LineModel) -> Items:
    shape, soil = model.scene.seabed, model.soil
    half = 0.5 * soil.diameter
    law = soil.says() if soil.where is None else f"{soil.says()}, line {model.scene.line_of(soil.where)}"
    items: Items = {
        "#": f"seabed: {law}",
        "Density": model.density / 1e3,
        "SeabedType": "Flat",
        "SeabedOrigin": [0.0, 0.0],
    }
    if abs(shape.slope) > _STEEPEST:
        raise model.scene.refusal(f"OrcaFlex takes slopes up to {_STEEPEST:g} degrees: give a profile", shape.where)
    if shape.kind in (SeabedKind.FLAT, SeabedKind.SLOPING):
        slope, direction = abs(shape.slope), shape.direction + (180.0 if shape.slope < 0.0 else 0.0)
        depth = model.depth + half / cos(radians(slope))
        items |= {"WaterDepth": depth, "SeabedSlopeDirection": direction % 360.0, "SeabedSlope": slope}
        if shape.kind is SeabedKind.SLOPING:
            model.report.add(shape.where, Outcome.CARRIED, f"SeabedSlope {shown(slope)}")
    else:
        items |= {"SeabedType": "Profile"} | _profile(model, half)
    if soil.kind is not LawKind.SOIL:
        per_area = soil.stiffness / soil.diameter / 1e3
        shear = max(soil.axial_spring, soil.lateral_spring) / soil.diameter / 1e3
        stiffness = {"SeabedNormalStiffness": per_area, "SeabedShearStiffness": shear or None}
        return items | {"SeabedModel": "Elastic"} | stiffness
    numbers = dict(soil.parameters)
    weight = numbers["buoyancy"] / _BUOYANCY * model.units.force / model.units.length**3
    return items | {
        "SeabedModel": "Nonlinear soil model",
        "SoilShearStrengthAtMudline": numbers["strength"] * model.units.size("F/L2") / 1e3,
        "SoilShearStrengthGradient": numbers["gradient"] * model.units.force / model.units.length**3 / 1e3,
        "SoilDensity": (weight / model.gravity + model.density) / 1e3,
    }


def _profile(model: LineModel, half: float) -> Items:
    """Return the points of a profile; for any other seabed those below the first line, from end to end."""
    shape, line, size = model.scene.seabed, model.lines[0], model.units.length
    if shape.kind is SeabedKind.PROFILE:
        rows = np.column_stack([shape.points[:, 0] * size, model.depth - shape.points[:, 1] * size + half])
        effect = "between its points as OrcaFlex interpolates"
        model.report.add(shape.where, Outcome.APPROXIMATED, f"profile of {len(rows)} points", effect)
        return {"SeabedSlopeDirection": shape.direction % 360.0, _PROFILE: rows[np.argsort(rows[:, 0])].tolist()}
    first, last = (model.places[model.ends[index].node][:2] for index in (line.begin, line.end))
    length = float(np.hypot(*(last - first)))
    along = (last - first) / length if length else np.array([1.0, 0.0])
    distance = np.linspace(0.0, length or 1.0, _POINTS)
    level = model.levels(*(first[:, None] + along[:, None] * distance))
    places = model.places[model.line_nodes()]
    error = np.abs(np.interp((places[:, :2] - first) @ along, distance, level) - model.levels(*places[:, :2].T))
    off = shown(float(error.max()), 3)
    effect = f"the seabed below {line.name}, level across it: up to {off} m off below the nodes"
    model.report.add(shape.where, Outcome.APPROXIMATED, f"profile of {_POINTS} points", effect)
    return {
        "SeabedOrigin": first.tolist(),
        "SeabedSlopeDirection": degrees(atan2(along[1], along[0])) % 360.0,
        _PROFILE: np.column_stack([distance, half - level]).tolist(),
    }


# ---------------------------------------------------------------------------------------------------------- report


def _report(model: LineModel, names: dict[Key, str]) -> None:
    report, soil = model.report, model.soil
    listed = [", ".join(name for key, name in names.items() if key[0] == at) for at in range(len(model.sections))]
    report_sections(model, listed, torsion=True)
    report_ends(report, model.ends, "Fixed", clamps=True)
    if soil.kind is LawKind.SOIL:
        _report_soil(model)
    per_area = soil.stiffness / soil.diameter
    others = [each for each in model.soils if soil.kind is not LawKind.SOIL or each.kind is not LawKind.SOIL]
    report_governing(report, others, soil, at_touchdown=model.at_touchdown)
    report_stiffness(report, others, "SeabedNormalStiffness x D:", [per_area * each.diameter for each in others])
    report_friction(report, model.soils, "friction of line types", [(each.axial, each.lateral) for each in model.soils])
    if soil.kind is not LawKind.SOIL and soil.axial_spring != soil.lateral_spring:
        effect = f"the stiffer of {kilo(soil.axial_spring)} along and {kilo(soil.lateral_spring)} across"
        report.add(soil.friction_at, Outcome.APPROXIMATED, "one SeabedShearStiffness", effect, "spring")
    report_resistance(report)
    for section in model.sections:
        if off := 0.5 * (section.diameter - soil.diameter):
            effect = f"its axis touches {distance(off)} higher than in the deck, as the diameters differ"
            report.add(section.where, Outcome.APPROXIMATED, "one seabed", effect, "diameter")
    uneven = any(not part.is_even for parts in pieces(model) for part in parts)
    for where, _ in model.scene.deck.blocks("ELEMENT") if uneven else ():
        effect = "segments as long as the shortest of a section"
        report.add(where, Outcome.APPROXIMATED, "TargetSegmentLength", effect, "lengths")
    report.finish()


def _report_soil(model: LineModel) -> None:
    soil = model.soil
    numbers = dict(soil.parameters)
    others = (each for each in SOIL.parameters if each.name not in _CARRIED)
    changed = [f"{each.name} {shown(numbers[each.name])}" for each in others if numbers[each.name] != each.default]
    effect = "strength and density; the other parameters are the defaults of the program, which are those of the deck"
    model.report.add(soil.where, Outcome.CARRIED, "Nonlinear soil model", effect)
    if changed:
        model.report.add(soil.where, Outcome.LEFT_OUT, "defaults", f"set by hand: {', '.join(changed)}", "parameters")
    for each in model.soils:
        if each.kind is LawKind.SOIL and each.parameters != soil.parameters:
            effect = f"{each.says()}; here that of most of the pipe"
            model.report.add(each.where, Outcome.APPROXIMATED, "one soil", effect)
