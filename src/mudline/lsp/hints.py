"""What an editor shows between the lines: values of equations, what sets hold, and curves to look at."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from lsprotocol import types

from mudline.diagnostics import Span
from mudline.keywords.values import Equation, Names
from mudline.lsp.decks import Analysis
from mudline.lsp.names import equation_spans
from mudline.lsp.things import diameters_of, slope_text
from mudline.quantities import labelled, unit_names
from mudline.results.summary import followers
from mudline.scene.force_curves import SceneCurve
from mudline.scene.model import Scene
from mudline.short_repr import counted

SHOW_CURVE = "mudline.showCurve"
_MOST = 2000
"""Hints of a range, and rows of a curve that are shown."""


def hints(analysis: Analysis, range_: types.Range) -> list[types.InlayHint]:
    """The values of equations in a range, and the elements and diameters of the sets that laws are given to."""
    document = analysis.document
    if analysis.origin is None or analysis.deck is None:
        return []
    within = Span(document.offset(range_.start), document.offset(range_.end))
    found = [*_equations(analysis, within), *_sets(analysis, within)]
    return [_hint(analysis, at, text) for at, text in sorted(found)[:_MOST]]


def _hint(analysis: Analysis, offset: int, text: str) -> types.InlayHint:
    return types.InlayHint(analysis.document.position(offset), text, padding_left=True)


def _equations(analysis: Analysis, within: Span) -> Iterator[tuple[int, str]]:
    text = analysis.document.text
    for start, end in equation_spans(analysis.origin) if analysis.origin else ():
        if within.start <= start and end <= within.end:
            yield end, f"= {analysis.evaluated(Equation(text[start:end]))}"


def _sets(analysis: Analysis, within: Span) -> Iterator[tuple[int, str]]:
    scene = analysis.scene
    for one in analysis.names if scene is not None else ():
        found = scene.set_table.find(one.name) if scene and one.thing.kind is Names.SET and not one.defines else None
        if scene is not None and found is not None and within.start <= one.span.start and one.span.end <= within.end:
            sizes = diameters_of(scene, found)
            yield one.span.end, ", ".join(filter(None, [counted(len(found.elements), "element"), sizes]))


# ------------------------------------------------------------------------------------------------------------ curves


def lenses(analysis: Analysis) -> list[types.CodeLens]:
    """A command at each curve that shows it."""
    scene, origin = analysis.scene, analysis.origin
    if scene is None or origin is None:
        return []
    found: list[types.CodeLens] = []
    for index, entry in _own(analysis, scene):
        span = origin.span(entry.title)
        if span is not None:
            used = counted(int(followers(scene, index).sum()), "element")
            title = f"show curve: {counted(len(entry.points), 'point')}, followed by {used}"
            command = types.Command(title, SHOW_CURVE, arguments=[analysis.document.uri, index])
            found.append(types.CodeLens(analysis.document.range(span), command))
    return found


def _own(analysis: Analysis, scene: Scene) -> Iterator[tuple[int, SceneCurve]]:
    """The curves of the deck itself that can be evaluated, with their index among all."""
    count = len(analysis.deck.sections) if analysis.deck else 0
    entries = enumerate(scene.laws.curves)
    return ((index, entry) for index, entry in entries if entry.curve is not None and entry.where.section < count)


def curve_text(scene: Scene, index: int) -> str:
    """A curve as a table of its segments; "" for one that there is not."""
    entry = scene.laws.curves[index] if 0 <= index < len(scene.laws.curves) else None
    if entry is None or entry.curve is None:
        return ""
    ratios, forces = entry.curve.ratios, entry.curve.forces
    sizes = scene.diameter[followers(scene, index)]
    force = labelled("force", unit_names(scene.units).line_force)
    rows = [f"{'set' if entry.embedment else 'curve'} {entry.name}", f"ratio, {force}"]
    for number, (ratio, value) in enumerate(zip(ratios.tolist(), forces.tolist(), strict=True)):
        rows.append(f"{ratio:g}, {value:g}")
        if number == _MOST:
            rows.append(f"... {len(ratios)} points in all")
            break
        if number < len(ratios) - 1:
            slope = float(np.diff(forces[number : number + 2])[0] / np.diff(ratios[number : number + 2])[0])
            rows.append(f"    {slope_text(scene, slope, sizes)}")
    return "\n".join(rows)


def draw_curve(scene: Scene, index: int, folder: Path) -> Path | None:
    """A picture of a curve as a new SVG file in a folder; None without matplotlib."""
    if find_spec("matplotlib") is None:
        return None
    from mudline.results.plots import draw_curves  # noqa: PLC0415 - needs the extra `plot`

    entry = scene.laws.curves[index]
    if entry.curve is None:
        return None
    ratios, forces = entry.curve.ratios, entry.curve.forces
    ends = zip(ratios[:-1].tolist(), ratios[1:].tolist(), (np.diff(forces) / np.diff(ratios)).tolist(), strict=True)
    segments = [{"from": first, "to": last, "slope": slope} for first, last, slope in ends]
    row = {"name": entry.name, "points": np.column_stack([ratios, forces]).tolist(), "segments": segments, "at": []}
    handle, name = tempfile.mkstemp(".svg", dir=folder)
    with open(handle, "wb") as stream:  # noqa: PTH123 - it is open already
        draw_curves([row], scene.units, "svg", stream)
    return Path(name)
