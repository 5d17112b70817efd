"""RIFLEX: text for the module INPMOD, an arbitrary system (AR) with seafloor contact by segment.

The groups, their lines and limits are those of the user guide; `docs/export.md` names its pages. Units: m, kg, N, s.
"""

from __future__ import annotations

from math import pi

import numpy as np

from mudline.export.held import report_ends
from mudline.export.line_model import LineModel, Stretch, report_sections
from mudline.export.report import Names, Status, one_line
from mudline.export.soil import report_friction, report_resistance, report_stiffness
from mudline.quantities import shown
from mudline.scene.seabed import SeabedKind

TITLE = "RIFLEX INPMOD"
_MOST = 500
_DRAG = "0.0 1.2 0.0 1.0 0.0 0.0 2"


def pieces(model: LineModel) -> list[list[Stretch]]:
    """The segments of RIFLEX along each line of the model."""
    return [line.pieces(lambda each: (each.section, each.soil)) for line in model.lines]


def segments(piece: Stretch) -> int:
    """How many equal elements a segment has."""
    return len(piece.lengths)


def write(model: LineModel, name: str) -> dict[str, str]:
    """The text of the file by its name. Raises DeckError: more of something than the program takes."""
    if max(len(model.lines), len(model.sections) + len(model.soils)) > _MOST:
        raise model.scene.refusal(f"RIFLEX takes {_MOST} line types and components: export a part of the deck")
    names = Names(model.report, "A-Za-z0-9_", 8, [f"SOIL{number}" for number in range(1, len(model.soils) + 1)])
    types = [names.take(section.name, section.where) for section in model.sections]
    level = _level(model)
    groups = [*_head(model), *_system(model, level), *_contacts(model), *_line_types(model, types)]
    for section, each in zip(model.sections, types, strict=True):
        area, radius = 0.25 * pi, 0.5 * section.diameter
        groups += [
            "NEW COMPONENT CRS1",
            f"{each} 0.0",
            " ".join(map(repr, (section.mass, area * section.buoyancy**2, area * section.inner**2, radius))),
            f"1 {int(section.bending > 0.0)} {int(section.bending > 0.0)} 0 0",
            repr(section.axial),
            *[repr(section.bending), repr(section.torsion or section.bending)] * (section.bending > 0.0),
            "HYDR",
            "MORI",
            _DRAG,
            "0.0 0.0",
        ]
    for number, soil in enumerate(model.soils, 1):
        if soil.stiffness > 0.0:
            groups += [
                "NEW COMPONENT SEAFLOOR",
                f"SOIL{number} SPRI",
                f"{soil.stiffness!r} 0.0",
                f"{soil.axial_spring!r} {soil.axial!r} 0.0",
                f"{soil.lateral_spring!r} {soil.lateral!r} 0.0 0",
            ]
    groups += ["ENVIRONMENT IDENTIFICATION", one_line(f"Sea of {model.scene.source}")[:60], "SEA1"]
    groups += [
        "WATERDEPTH AND WAVETYPE",
        f"{model.depth!r} 0 0 0 0",
        "ENVIRONMENT CONSTANTS",
        f"1.3 {model.density!r}",
        "END",
    ]
    _report(model, types)
    comments = [f"' {line}" for line in model.report.comments(TITLE)]
    return {name: "".join(f"{line}\n" for line in (*_folded(comments), *groups))}


def _folded(comments: list[str]) -> list[str]:
    """Comments in lines that the program can read: it takes 260 letters."""
    return ["'   " * (at > 0) + line[at : at + 250] for line in comments for at in range(0, len(line), 250)]


def _head(model: LineModel) -> list[str]:
    title = [one_line(f"Deck {model.scene.source}")[:60], "model only: no analysis", "written by mudline"]
    units = ["UNIT NAMES SPECIFICATION", f"s m kg N {model.gravity!r} 1.0"]
    return ["INPMOD IDENTIFICATION TEXT 4.8", *title, *units, "NEW SINGLE RISER", "AR RISER1"]


def _system(model: LineModel, level: float) -> list[str]:
    """Topology, seabed, lines between supernodes, and these: held ones with the place that statics moves them to."""
    held = [at for at, end in enumerate(model.ends) if not end.joins]
    rows = ["ARBITRARY SYSTEM AR", f"{len(model.ends)} {len(model.lines)} {len(held)} 0 0 0 0", f"3 {level!r} 0"]
    rows += [f"LINE{at} LTYPE{at} SN{line.begin + 1} SN{line.end + 1}" for at, line in enumerate(model.lines, 1)]
    straight = _straight(model)
    for at in held:
        codes = " ".join(str(int(freedom in model.ends[at].held or freedom < 4)) for freedom in (2, 3, 1, 5, 6, 4))
        start, place = straight[at], model.places[model.ends[at].node]
        rows += [f"SN{at + 1} 0 {codes} GLOBAL NO", " ".join(map(repr, (*start.tolist(), *place.tolist(), 0.0, 0.0)))]
    for at in range(len(model.ends)):
        if at not in held:
            rows.append(f"SN{at + 1} {' '.join(map(repr, straight[at].tolist()))}")
    return rows


def _straight(model: LineModel) -> dict[int, np.ndarray[tuple[int], np.dtype[np.float64]]]:
    """Places of the ends without stress: each line straight and level, in the direction that it has in plan."""
    found: dict[int, np.ndarray[tuple[int], np.dtype[np.float64]]] = {}
    for line in model.lines:
        first, last = (model.places[model.ends[index].node] for index in (line.begin, line.end))
        length = sum(float(each.lengths.sum()) for each in line.stretches)
        way = (last - first) * [1.0, 1.0, 0.0]
        way = np.array([1.0, 0.0, 0.0]) if not way.any() else way / np.hypot(*way[:2])
        if line.begin not in found and line.end in found:
            found[line.begin] = found[line.end] - length * way
        found.setdefault(line.begin, first)
        found.setdefault(line.end, found[line.begin] + length * way)
    return found


def _contacts(model: LineModel) -> list[str]:
    rows = [
        f"SOIL{part.soil + 1} LINE{at} {number}"
        for at, parts in enumerate(pieces(model), 1)
        for number, part in enumerate(parts, 1)
        if model.soils[part.soil].stiffness > 0.0
    ]
    return ["SEAFLOOR CONTACT SPECIFICATION", str(len(rows)), *rows]


def _line_types(model: LineModel, types: list[str]) -> list[str]:
    rows = []
    for at, parts in enumerate(pieces(model), 1):
        rows += ["NEW LINE DATA", f"LTYPE{at} {len(parts)} 0 0 0 0"]
        rows += [f"{types[part.section]} 0 0 {segments(part)} {float(part.lengths.sum())!r}" for part in parts]
    return rows


def _level(model: LineModel) -> float:
    """Elevation of the flat seabed: that of the deck, or the middle of what lies below the lines."""
    shape = model.scene.seabed
    if shape.kind is SeabedKind.FLAT:
        return -model.depth
    below = model.levels(*model.places[model.line_nodes()][:, :2].T)
    low, high = float(below.min()), float(below.max())
    middle = 0.5 * (low + high)
    effect = f"up to {shown(high - middle, 3)} m off below the lines: give a file of the seabed to STAMOD"
    model.report.add(shape.where, Status.APPROXIMATED, f"a flat seabed at {shown(middle)} m", effect)
    return middle


def _report(model: LineModel, types: list[str]) -> None:
    report = model.report
    report_sections(model, "CRS1", names=types, torsion=True)
    report_ends(report, model.ends, "fixed supernodes", "fixed supernodes", clamps=True)
    report_stiffness(report, model.soils, "STFBOT", [each.stiffness for each in model.soils])
    report_friction(report, model.soils, "springs and friction", [(each.axial, each.lateral) for each in model.soils])
    report_resistance(report, "none")
    for section in model.sections:
        if section.bending and not section.torsion:
            effect = "the guide wants torsion beside bending: EI stands in, no effect in plane"
            report.add(section.where, Status.APPROXIMATED, "GT", effect, "GJ")
    for where, _ in model.scene.deck.blocks("ELEMENT"):
        if any(np.ptp(each.lengths) > 1e-3 * each.lengths.max() for parts in pieces(model) for each in parts):
            report.add(
                where, Status.APPROXIMATED, "equal elements", "each segment has as many, of equal length", "lengths"
            )
    report.finish()
