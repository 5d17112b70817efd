"""MoorDyn v2: the input file, and the file of a seabed that is not flat.

One stiffness (kBot, per area of the projected pipe) and one friction coefficient apply to the whole seabed. A line type
begins where the section changes. There, lines are joined by points, which transmit no moment.
"""

from __future__ import annotations

import re
from itertools import chain
from math import ceil, sqrt

import numpy as np

from mudline.basics.quantities import shown
from mudline.model.scene.numbering import Floats
from mudline.model.scene.seabed import SeabedKind
from mudline.tools.exporting.line_model import LineModel, LineStretch, PipeSection, report_ends, report_sections
from mudline.tools.exporting.report import Outcome, TargetNames
from mudline.tools.exporting.soil import (
    distance,
    report_friction,
    report_governing,
    report_resistance,
    report_stiffness,
)

TITLE = "MoorDyn v2"
_FINEST = 2
"""Largest ratio of segments to elements."""
_GRID = 200


def pieces(model: LineModel) -> list[list[LineStretch]]:
    """Return the lines of MoorDyn along each line of the model: sections with the same numbers are one line type."""
    first = np.array(_alike(model))
    return [list(line.stretches(first[line.kinds[:, :1]])) for line in model.lines]


def _alike(model: LineModel) -> list[int]:
    """Return for each section the first with the same numbers, as far as MoorDyn has them."""
    numbers = [_numbers(each) for each in model.sections]
    return [numbers.index(each) for each in numbers]


def segments(piece: LineStretch) -> int:
    """Return the number of equal segments of a line of MoorDyn: as short as its shortest element, up to a limit."""
    elements = len(piece.lengths)
    if piece.is_even:
        return elements
    return min(_FINEST * elements, max(elements, ceil(float(piece.length / piece.lengths.min()) - 1e-6)))


def write(model: LineModel, name: str) -> dict[str, str]:
    """Return the text of each file by its name; `name` is that of the input file."""
    names = TargetNames(model.report, "A-Za-z0-9_", 32)
    first = _alike(model)
    taken = {at: names.take(model.sections[at].name, model.sections[at].where) for at in dict.fromkeys(first)}
    types = [taken[at] for at in first]
    bed = model.levels(*model.places[:, :2].T)
    points, lines = _joined(model, types, bed)
    soil = model.soil
    stretches = chain.from_iterable(line.stretches(line.kinds) for line in model.lines)
    width = {each.soil: model.sections[each.section].buoyancy for each in stretches}
    own, heaviest = width[model.soils.index(soil)], max(each.mass for each in model.sections)
    stiffness, friction = soil.stiffness / own, soil.axial
    floor = re.sub("[^A-Za-z0-9]", "_", name.rpartition(".")[0] or name)
    files = {} if model.seabed is None else {f"{floor}-seabed.txt": _grid(model)}
    options = [
        (f"{_time_step(model):.2g}", "dtM"),
        (repr(stiffness), "kBot"),
        (repr(2.0 * sqrt(soil.stiffness * heaviest) / own), "cBot"),
        (repr(friction), "FrictionCoefficient"),
        (repr(model.density), "WtrDnsty"),
        (repr(model.depth), "WtrDpth"),
        *[(each, "SeafloorFile") for each in files],
        (repr(model.gravity), "g"),
        ("2.0", "dtIC"),
        ("100.0", "TmaxIC"),
        ("1e-5", "threshIC"),
    ]
    _report(model, types, stiffness, width, bed)
    text = [
        *model.report.comments(TITLE),
        "--- LINE TYPES ---",
        "TypeName Diam MassDen EA BA/-zeta EI Cd Ca CdAx CaAx",
        "(-) (m) (kg/m) (N) (N-s/-) (N-m2) (-) (-) (-) (-)",
        *[" ".join([each, *map(repr, _numbers(model.sections[at]))]) for at, each in taken.items()],
        "--- POINTS ---",
        "ID Type X Y Z Mass Volume CdA Ca",
        "(-) (-) (m) (m) (m) (kg) (m3) (m2) (-)",
        *points,
        "--- LINES ---",
        "ID LineType AttachA AttachB UnstrLen NumSegs Outputs",
        "(-) (-) (-) (-) (m) (-) (-)",
        *lines,
        "--- OPTIONS ---",
        *[f"{value} {option}" for value, option in options],
        "--- end ---",
    ]
    return {name: "".join(f"{line}\n" for line in text), **files}


def _numbers(section: PipeSection) -> tuple[float, ...]:
    """Return the numbers of a section for MoorDyn: diameter, mass, EA, damping, EI, Cd, Ca, CdAx, CaAx."""
    water = (section.drag, section.added, section.axial_drag, section.axial_added)
    return (section.buoyancy, section.mass, section.axial, -1.0, section.bending, *water)


def _joined(model: LineModel, types: list[str], bed: Floats) -> tuple[list[str], list[str]]:
    """Return the rows of points, ends first and joints second, and the rows of lines; `bed` (n,) is below the nodes."""
    rows: list[str] = []

    def add_point(node: int, kind: str) -> None:
        x, y, z = model.places[node].tolist()
        # MoorDyn lowers the whole seabed to a point below it.
        rows.append(f"{len(rows) + 1} {kind} {x!r} {y!r} {max(z, float(bed[node]))!r} 0 0 0 0")

    for end in model.ends:
        add_point(end.node, "Coupled" if end.vessel else "Free" if end.joins else "Fixed")
    lines: list[str] = []
    for line, parts in zip(model.lines, pieces(model), strict=True):
        at = line.begin + 1
        for part in parts:
            to = line.end + 1
            if part is not parts[-1]:
                add_point(int(part.nodes[-1]), "Free")
                to = len(rows)
            lines.append(f"{len(lines) + 1} {types[part.section]} {at} {to} {part.length!r} {segments(part)} p")
            at = to
    return rows, lines


def _time_step(model: LineModel) -> float:
    """Return two fifths of the time of the fastest wave along a segment, or of bending between nodes."""
    steps = []
    for part in chain.from_iterable(pieces(model)):
        section, size = model.sections[part.section], part.length / segments(part)
        steps.append(size / sqrt(section.axial / section.mass))
        if section.bending:
            steps.append(0.5 * size * size * sqrt(section.mass / section.bending))
    return 0.4 * min(steps)


# --------------------------------------------------------------------------------------------------------- seabed


def _grid(model: LineModel) -> str:
    """Return the file of the seabed: numbers of columns and rows, their x and y, and x, y and z of each point."""
    x, y = (_axis(model, axis) for axis in (0, 1))
    corners = np.meshgrid(x, y, indexing="ij")
    level = model.levels(*(each.ravel() for each in corners)).reshape(len(x), len(y))
    places = model.places[model.line_nodes()]
    worst = float(np.abs(_bilinear(x, y, level, places) - model.levels(places[:, 0], places[:, 1])).max())
    status = Outcome.CARRIED if worst < 1e-6 else Outcome.APPROXIMATED
    effect = f"largest difference below the nodes {shown(worst, 3)} m"
    model.report.add(model.scene.seabed.where, status, f"a grid of {len(x)} x {len(y)} points", effect)
    rows = [
        f"{a!r} {b!r} {c!r}"
        for a, line in zip(x.tolist(), level.tolist(), strict=True)
        for b, c in zip(y.tolist(), line, strict=True)
    ]
    head = [f"{len(x)} {len(y)}", " ".join(map(repr, x.tolist())), " ".join(map(repr, y.tolist()))]
    return "".join(f"{row}\n" for row in (*head, *rows))


def _axis(model: LineModel, axis: int) -> Floats:
    """Return the columns of the grid: ends of a plane, points of a profile along the axis, else evenly spaced."""
    shape = model.scene.seabed
    along = model.places[model.line_nodes()]
    low, high = along.min(axis=0), along.max(axis=0)
    margin = 10.0 + 0.1 * float((high - low)[:2].max())
    ends: Floats = np.array([low[axis] - margin, high[axis] + margin])
    straight = shape.kind is SeabedKind.PROFILE and shape.interpolation == "LINEAR" and not shape.direction % 360.0
    if shape.kind is SeabedKind.SLOPING or (straight and axis == 1):
        return ends
    if straight:
        points = shape.points[:, 0] * model.units.length
        return np.unique([*ends, *points[(points > ends[0]) & (points < ends[1])]])
    size = float((high - low)[:2].max() + 2.0 * margin) / _GRID
    return np.linspace(float(ends[0]), float(ends[1]), max(2, ceil((ends[1] - ends[0]) / size) + 1))


def _bilinear(x: Floats, y: Floats, level: Floats, places: Floats) -> Floats:
    i = np.clip(np.searchsorted(x, places[:, 0]) - 1, 0, len(x) - 2)
    j = np.clip(np.searchsorted(y, places[:, 1]) - 1, 0, len(y) - 2)
    u, v = (places[:, 0] - x[i]) / (x[i + 1] - x[i]), (places[:, 1] - y[j]) / (y[j + 1] - y[j])
    low, high = ((1 - v) * level[at, j] + v * level[at, j + 1] for at in (i, i + 1))
    return (1 - u) * low + u * high


# --------------------------------------------------------------------------------------------------------- report


def _report(model: LineModel, types: list[str], stiffness: float, width: dict[int, float], bed: Floats) -> None:
    report, soil = model.report, model.soil
    report_sections(model, types, torsion=False)
    report_ends(report, model.ends, "Coupled")
    report_governing(report, model.soils, soil, at_touchdown=model.at_touchdown)
    used = [stiffness * width[at] for at in range(len(model.soils))]
    report_stiffness(report, model.soils, f"kBot {shown(stiffness, 4)} Pa/m, here", used)
    target = "FrictionCoefficient, regularised by velocity"
    report_friction(report, model.soils, target, [(soil.axial, soil.axial)] * len(model.soils))
    report_resistance(report)
    for end in model.ends:
        if (below := float(bed[end.node] - model.places[end.node, 2])) > 0.0 and not end.vessel:
            effect = "MoorDyn lowers its seabed to a point that is below it"
            place = model.scene.nodes.where(end.node)
            report.add(place, Outcome.APPROXIMATED, f"{distance(below)} higher, on the mudline", effect, "end")
    blocks = [where for where, _ in model.scene.deck.blocks("ELEMENT")]
    for part in chain.from_iterable(pieces(model)):
        lengths, count = part.lengths, segments(part)
        if not part.is_even:
            least, most, own = (shown(float(each), 3) for each in (lengths.min(), lengths.max(), part.length / count))
            effect = f"{len(lengths)} elements of {least} to {most} m: {count} segments of {own} m"
            report.add(blocks[-1], Outcome.APPROXIMATED, "equal segments", effect, "lengths")
    joints = sum(len(parts) - 1 for parts in pieces(model))
    if joints and any(section.bending for section in model.sections):
        where, effect = model.sections[0].where, "no moment where the section changes"
        report.add(where, Outcome.APPROXIMATED, f"{joints} Free points", effect, "joints")
    report.finish()
