"""What is wrong with the laws of a deck as a whole: types of seabed, curves, diameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import SBD001, SBD002, SBD004, SBD005, SBD009
from mudline.contact.input import LawKind
from mudline.diagnostics import Severity, Where
from mudline.keywords.text import shown
from mudline.scene.context import Context
from mudline.scene.extensions import Extension, with_nodal_stiffness
from mudline.scene.force_curves import SceneCurve
from mudline.scene.laws import LawTable, typed_blocks
from mudline.scene.numbering import Numbered
from mudline.scene.sections import SectionTable

if TYPE_CHECKING:
    from mudline.keywords.library.elastic_surface import ElasticSurface


def check_laws(context: Context, laws: LawTable) -> None:
    """One contact model in a deck, curves only on an elastic bed, and something that carries."""
    _two_types(context, laws)
    _no_stiffness(context, laws)
    _embedment(context, laws)
    _rigid(context)


def _two_types(context: Context, laws: LawTable) -> None:
    """The first line that contradicts an earlier one."""
    places = sorted((where, name) for name, found in laws.types.items() for where in found)
    for where, name in places:
        if name == places[0][1]:
            continue
        this, other = ("a rigid", "an elastic") if name == "RIGID" else ("an elastic", "a rigid")
        message = f"{this} seabed after {other} one: a model has one of them; remove the other"
        if where.section == places[0][0].section:
            context.tell(SBD002, message, where)
        else:
            message += " (inferred: the $MODEL sections of a file make one model)"
            context.tell(SBD002, message, where, Severity.WARNING)
        return


def _no_stiffness(context: Context, laws: LawTable) -> None:
    embedment = any(curve.embedment for curve in laws.curves) or "EMBEDMENT" in context.unread
    for where, block in context.deck.blocks("ELASTIC SURFACE"):
        properties = cast("ElasticSurface", block).properties
        lacking = getattr(properties, "stiffness", None) is None
        if lacking and not embedment and not context.disturbed(where._replace(path=("properties",))):
            message = "no stiffness here and no *EMBEDMENT in the model: nothing carries the elements; give a stiffness"
            context.tell_missing(SBD004, message, where, "EMBEDMENT")


def _embedment(context: Context, laws: LawTable) -> None:
    """Told once for each block, at its first curve."""
    rigid, elastic = laws.types.get("RIGID"), laws.types.get("ELASTIC")
    unread = "SEABED PROPERTIES" in context.deck.keywords() or context.astray("SEABED PROPERTIES")
    if not rigid and (elastic or unread):
        return  # of a type that could not be read enough has been said
    first: dict[tuple[int, int], SceneCurve] = {}
    for curve in laws.curves:
        if curve.embedment:
            first.setdefault((curve.where.section, curve.where.block), curve)
    for curve in first.values():
        if rigid:
            context.tell(SBD005, "*EMBEDMENT needs an elastic seabed: the seabed is rigid", curve.where)
        else:
            message = "*EMBEDMENT needs an elastic seabed: the model has no *ELASTIC SURFACE and no TYPE=ELASTIC"
            context.tell_missing(SBD005, message, curve.where, "ELASTIC SURFACE")


def _rigid(context: Context) -> None:
    """What only an elastic bed has, under TYPE=RIGID."""
    for where, properties, type_ in typed_blocks(context):
        for index, entry in enumerate(properties.sets if type_ == "RIGID" else ()):
            place = where._replace(path=("sets", index))
            suction = entry.suction and entry.suction.stiffness
            for name, value in (("stiffness", entry.stiffness), ("lateral", entry.lateral), ("suction", suction)):
                inner = place._replace(path=(*place.path, name))
                if isinstance(value, str):
                    message = f"curve {shown(value)} on a rigid seabed: a force-embedment curve needs TYPE=ELASTIC"
                    context.tell(SBD001, message, inner)
                elif value:
                    message = f"{name.upper()}= counts for nothing on a rigid seabed: it needs TYPE=ELASTIC"
                    context.tell(SBD001, message, inner, Severity.WARNING)


def check_diameters(
    context: Context, laws: LawTable, sections: SectionTable, elements: Numbered, contact: Extension | None
) -> None:
    """Elements on a curve need a diameter; told once for each place that gives the curve.

    Where `*SEABED CONTACT` (`contact`) gives the nodes a stiffness, the curve does not count.
    """
    on_curve = np.array([*(grant.kind is LawKind.CURVE for grant in laws.grants), False])[laws.of_element]
    if contact is not None:
        on_curve &= ~with_nodal_stiffness(contact)
    missing = np.flatnonzero(on_curve & np.isnan(sections.diameter) & ~sections.faulty)
    if not missing.size:
        return
    found = np.unique(laws.of_element[missing], return_index=True, return_counts=True)
    for index, first, count in zip(*(part.tolist() for part in found), strict=True):
        number = elements.ids[missing[first]]
        what = f"element {number} has" if count == 1 else f"{count} elements (first: {number}) have"
        message = f"{what} a curve and no external diameter: give Do (or Dd) in *GEOMETRIC SETS"
        _lacks_diameter(context, sections, message, laws.grants[index].where)


def _lacks_diameter(context: Context, sections: SectionTable, message: str, where: Where) -> None:
    if sections.open:
        message += "; a section belongs to a set whose elements this deck does not show"
        context.tell(SBD009, message, where, Severity.WARNING)
    else:
        context.tell_missing(SBD009, message, where, "GEOMETRIC SETS")
