"""Help on keywords, fields, values and names, and values of equations as inlay hints."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np
from lsprotocol import types

from mudline.basics.limits import LISTED, MOST_HINTS
from mudline.basics.short_repr import counted, listed_numbers
from mudline.basics.units import UNITS
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import name_key
from mudline.language.diagnostics import Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.format import TAKES, format_lines, range_text, usual_text
from mudline.language.keywords.model import FieldSpec
from mudline.language.keywords.table import LARGEST_WHOLE
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Equation, Names
from mudline.language.syntax.fields import trimmed
from mudline.model.results.curve_rows import diameters_on
from mudline.model.scene.curves import ENDS, SceneCurve
from mudline.model.scene.deck_values import find_file
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats
from mudline.model.scene.references import CURVES
from mudline.model.scene.restart import find_deck
from mudline.tools.lsp.decks import Analysis, value_text
from mudline.tools.lsp.places import Occurrence, Site, at, equation_spans, site


def hover(analysis: Analysis, offset: int) -> types.Hover | None:
    """Return the help on an offset, in Markdown; None if there is none."""
    origin = analysis.origin
    where, section, block, _ = spot = origin.tree.at(offset)
    leaf = spot.part.head
    if leaf is not None and where.section >= 0 and leaf.span.start <= offset < leaf.span.end:
        head = keyword_help(block.name, section.name) if block else section_help(section.name)
        return _hover(analysis, head, trimmed(origin.source.unified, *leaf.span))
    named = at(analysis.names, offset)
    if named is not None and named.thing.kind is Names.PARAMETER:
        return _hover(analysis, parameter_help(analysis, named), named.span)
    value = site(analysis.deck, offset)
    return _hover(analysis, "\n\n".join(filter(None, _value_help(analysis, value))), value.span) if value else None


def _hover(analysis: Analysis, text: str, span: Span) -> types.Hover | None:
    content = types.MarkupContent(types.MarkupKind.Markdown, text)
    return types.Hover(content, analysis.document.range(span)) if text else None


# ---------------------------------------------------------------------------------------------- keywords and sections


def section_help(name: str) -> str:
    """Return the keywords that belong in a section."""
    if name not in catalogue.SECTIONS:
        return ""
    own = [f"`*{keyword}`" for keyword in catalogue.keywords() if name in (catalogue.sections_of(keyword) or ())]
    return f"**${name}**" + (f"\n\nKeywords: {', '.join(own)}" if own else "")


def keyword_help(name: str, section: str) -> str:
    """Return the purpose of a keyword and the form of its lines."""
    declared = catalogue.block_class(section, name)
    if declared is None:
        kept = catalogue.opaque_keyword(section, name)
        if kept is not None:
            return f"**\\*{name}**\n\n{kept.summary}\n\nIts lines are passed through unchanged."
        return f"**\\*{name}**\n\nKnown, and passed through unchanged." if name in catalogue.keywords() else ""
    facts = declared.facts
    notes = [declared.summary]
    if facts.superseded_by:
        notes.append(f"Superseded by {' and '.join(map(str, facts.superseded_by))}.")
    if facts.extension:
        notes.append("An extension of mudline.")
    if facts.later_wins:
        notes.append("An element follows the last record whose set holds it.")
    return "\n\n".join([f"**\\*{name}**", *notes, "```text\n" + "\n".join(format_lines(declared)) + "\n```"])


# -------------------------------------------------------------------------------------------------- fields and values


def field_help(slot: FieldSpec, units: str) -> str:
    """Return the meaning of a field, its unit, default, range and usual values."""
    about = slot.about
    facts = [
        f"takes {', '.join(slot.choices)}" if slot.choices else f"takes a {TAKES[slot.kind]}" if slot.kind else "",
        f"unit {UNITS[units].text(about.unit)}" if about.unit and about.unit != "-" else "",
        "dimensionless" if about.unit == "-" else "",
        "mandatory" if slot.required else "",
        f"default {about.default}" if about.default else "",
        f"range {range_text(about)}" if range_text(about) else "",
        f"usual {usual_text(about)}" if about.usuals else "",
    ]
    lines = [f"**{slot.label}** {about.meaning}", "; ".join(filter(None, facts))]
    if about.inferred:
        lines.append(f"*Inferred: {about.inferred}.*")
    return "\n\n".join(filter(None, lines))


def _value_help(analysis: Analysis, value_site: Site) -> Iterator[str]:
    yield field_help(value_site.slot, analysis.deck.units)
    value, kind = value_site.value, value_site.slot.about.names or value_site.slot.about.defines
    if isinstance(value, Equation):
        yield f"`{value}` = {analysis.evaluated(value)}"
    elif isinstance(value, str):
        yield named_help(analysis, kind, value)
    elif kind in (Names.NODE, Names.ELEMENT) and (index := index_of(analysis.scene, kind, value)) is not None:
        of_kind = _node if kind is Names.NODE else _element
        name = f"{kind.name.lower()} {value:.0f}"
        yield f"{name} is not defined here" if index < 0 else "\n\n".join(of_kind(analysis.scene, index))
    yield segment_help(analysis, value_site)


# --------------------------------------------------------------------------------------------------------- parameters


def parameter_help(analysis: Analysis, named: Occurrence) -> str:
    """Return the value of a parameter and its definition."""
    parameters = analysis.parameters
    key = named.thing.key
    definition = parameters.definitions.get(key)
    if definition is None:
        return f"parameter `{named.name}` is not defined"
    value = value_text(parameters.values[key]) if key in parameters.values else "no value"
    written = "" if isinstance(definition.value, float) else f"\n\n`{definition.value}`"
    return f"parameter **{definition.name}** = {value}{written}"


# ------------------------------------------------------------------------------------------------------ names in fields


def named_help(analysis: Analysis, kind: Names | None, name: str) -> str:
    """Return the help on a name in a field, of a kind."""
    scene = analysis.scene
    if kind in (Names.SET, Names.SUBSET):
        return set_help(scene, name)
    if kind is Names.CURVE:
        entry = next((each for each in scene.laws.curves if not each.embedment and _same(each.name, name)), None)
        return curve_help(scene, entry) if entry else ""
    if kind in CURVES:
        return "\n\n".join(other_curve_help(curve) for curve in scene.other_curves if _same(curve.name, name))
    if kind in (Names.FILE, Names.DECK):
        path = file_named(kind, analysis.deck, name)
        return path.as_posix() if path else "this file was not found"
    return ""


def file_named(kind: Names | None, deck: Deck, name: object) -> Path | None:
    """Return the existing file that a name of a kind in a deck stands for, or None."""
    if not isinstance(name, str):
        return None
    if kind is Names.DECK:
        return find_deck(deck, name)
    return find_file(deck.folder, name) if kind is Names.FILE else None


def _same(first: str, second: str) -> bool:
    return name_key(first) == name_key(second)


def set_help(scene: Scene, name: str) -> str:
    """Return the elements of a set, their number, length and diameters."""
    named_set = scene.set_table.find(name)
    if named_set is None:
        return ""
    words = [f"set **{named_set.name}**: {counted(len(named_set.elements), 'element')}"]
    if len(named_set.elements):
        words.append(listed_numbers(scene.element_ids[named_set.elements].tolist()))
        lengths = scene.length[named_set.elements]
        words.append(f"total length {np.nansum(lengths):g}{UNITS[scene.units].behind('L')}")
    if diameters := _diameters(scene, scene.diameter[named_set.elements]):
        words.append(diameters)
    if named_set.open:
        words.append("it may have more elements, which this deck does not show")
    return "\n\n".join(words)


def _diameters(scene: Scene, diameters: Floats) -> str:
    """Return the range of external diameters; "" if none is known."""
    sizes = np.unique(diameters[~np.isnan(diameters)])
    if not len(sizes):
        return ""
    least = f"{sizes[0]:g} to " if len(sizes) > 1 else ""
    return f"D = {least}{sizes[-1]:g}{UNITS[scene.units].behind('L')}"


# -------------------------------------------------------------------------------------------------------------- curves


def segment_help(analysis: Analysis, value_site: Site) -> str:
    """Return slope and stiffness of a curve on both sides of the point of a value."""
    path, scene = value_site.where.path, analysis.scene
    if len(path) < 4 or path[0] != "curves" or path[2] != "points":
        return ""
    where, curves = value_site.where._replace(path=path[:2]), scene.laws.curves
    index, entry = next(((at, curve) for at, curve in enumerate(curves) if curve.where == where), (-1, None))
    at = np.flatnonzero(entry.rows == int(path[3])) if entry else np.zeros(0)
    if entry is None or entry.curve is None or not at.size:
        return ""
    ratio = float(entry.points[int(at[0]), 0])
    ratios, slopes = entry.curve.ratios, entry.curve.slopes
    number = int(np.searchsorted(ratios, ratio))
    lines = [f"point {number + 1} of {len(ratios)} of {_title(entry)}, by ratio"]
    sizes = diameters_on(scene, index)
    for segment, words in ((number - 1, "up to here"), (number, "from here")):
        if 0 <= segment < len(slopes):
            lines.append(f"{words}: {_slope_text(scene, float(slopes[segment]), sizes)}")
    return "\n\n".join(lines)


def _slope_text(scene: Scene, slope: float, sizes: list[float]) -> str:
    """Return a slope, and the stiffness for the diameters of the elements that follow the curve."""
    names = UNITS[scene.units]
    text = f"slope {slope:g}{names.behind('F/L')}"
    if not sizes:
        return text
    low, high = slope / sizes[-1], slope / sizes[0]
    stiffness = f"{low:g}" if low == high else f"{low:g} to {high:g}"
    return f"{text}, stiffness {stiffness}{names.behind('F/L2')} ({_diameters(scene, np.array(sizes))})"


def _title(entry: SceneCurve) -> str:
    return f"the curve of set {entry.name}" if entry.embedment else f"curve {entry.name}"


def other_curve_help(entry: SceneCurve) -> str:
    """Return points and range of a curve that does not belong to a seabed."""
    curve = entry.curve
    head = f"{entry.kind} **{entry.name}** of `*{entry.keyword}`"
    if curve is None:
        return f"{head}: no curve, see its findings"
    (first, last), (over, value) = (curve.ratios[[0, -1]].tolist(), entry.axes)
    reach = f"{over} from {first:g} to {last:g}, {value} from {curve.forces[0]:g} to {curve.forces[-1]:g}"
    return f"{head}: {len(curve.ratios)} points, {reach}; {ENDS[entry.ends]}"


def curve_help(scene: Scene, entry: SceneCurve) -> str:
    """Return points, range and followers of a curve."""
    index = next(number for number, each in enumerate(scene.laws.curves) if each is entry)
    if entry.curve is None:
        return f"{_title(entry)} cannot be evaluated"
    ratios, forces = entry.curve.ratios, entry.curve.forces
    points = f"{counted(len(ratios), 'point')}, ratio {ratios[0]:g} to {ratios[-1]:g}"
    force = f"force {forces[0]:g} to {forces[-1]:g}{UNITS[scene.units].behind('F/L')}"
    followed = counted(len(scene.followers(index)), "element")
    return f"{_title(entry)}: {points}, {force}\n\nfollowed by {followed}"


# --------------------------------------------------------------------------------------------------- nodes and elements


def index_of(scene: Scene, kind: Names, value: object) -> int | None:
    """Return the index of the node or element of a number, -1 if it is not defined; None for anything but a number."""
    if not isinstance(value, int | float) or not float(value).is_integer() or abs(value) > LARGEST_WHOLE:
        return None
    table = scene.nodes if kind is Names.NODE else scene.table.numbered
    return int(table.indices(np.array([value], dtype=np.int64))[0])


def _node(scene: Scene, index: int) -> Iterator[str]:
    x, y, z = scene.coordinates[index].tolist()
    yield f"node **{scene.node_ids[index]}**: X {x:g}, Y {y:g}, Z {z:g}"
    ends = scene.element_ids[(scene.element_nodes == index).any(axis=1)].tolist()
    if ends:
        yield f"of {'element' if len(ends) == 1 else 'elements'} {listed_numbers(ends)}"


def _element(scene: Scene, index: int) -> Iterator[str]:
    nodes = [str(scene.node_ids[node]) if node >= 0 else "?" for node in scene.element_nodes[index].tolist()]
    unit = UNITS[scene.units].behind("L")
    facts = [f"nodes {' and '.join(nodes)}"]
    if not np.isnan(scene.length[index]):
        facts.append(f"length {scene.length[index]:g}{unit}")
    if not np.isnan(scene.diameter[index]):
        facts.append(f"D = {scene.diameter[index]:g}{unit}")
    yield f"element **{scene.element_ids[index]}**: {', '.join(facts)}"
    sets = [shown(each.name) for each in scene.set_table.named.values() if index in each.elements]
    yield f"in {', '.join(sets[:LISTED])}" + (" and more" if len(sets) > LISTED else "")


# ---------------------------------------------------------------------------------------------------- between the lines


def hints(analysis: Analysis, range_: types.Range) -> list[types.InlayHint]:
    """Return the values of the equations in a range."""
    document = analysis.document
    within = Span(document.offset(range_.start), document.offset(range_.end))
    spans = (span for span in equation_spans(analysis.origin) if within.start <= span.start and span.end <= within.end)
    values = ((span, analysis.evaluated(Equation(document.text[slice(*span)]))) for span in islice(spans, MOST_HINTS))
    return [types.InlayHint(document.position(span.end), f"= {value}", padding_left=True) for span, value in values]
