"""Help on what is under the cursor: keywords, fields, values, and the things that they name."""

from __future__ import annotations

from collections.abc import Iterator

from lsprotocol import types

from mudline.language.diagnostics import Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.format import TAKES, format_lines, range_text, unit_text, usual_text
from mudline.language.keywords.model import FieldSpec
from mudline.language.keywords.values import Equation, Names
from mudline.language.syntax.fields import trimmed
from mudline.tools.lsp import things
from mudline.tools.lsp.decks import Analysis
from mudline.tools.lsp.names import at
from mudline.tools.lsp.sites import Site, Spot, site, spot


def hover(analysis: Analysis, offset: int) -> types.Hover | None:
    """Help on an offset, in Markdown; None where there is nothing to say."""
    origin = analysis.origin
    if origin is None:
        return None
    found = spot(origin.tree, offset)
    leaf = found.leaf
    if leaf is not None and leaf.span.start <= offset < leaf.span.end:
        return _hover(analysis, _head_help(found), trimmed(origin.source.unified, *leaf.span))
    named = at(analysis.names, offset)
    if named is not None and named.thing.kind is Names.PARAMETER:
        return _hover(analysis, things.parameter_help(analysis, named), named.span)
    value = site(analysis, offset)
    return _hover(analysis, "\n\n".join(filter(None, _value_help(analysis, value))), value.span) if value else None


def _hover(analysis: Analysis, text: str, span: Span) -> types.Hover | None:
    content = types.MarkupContent(types.MarkupKind.Markdown, text)
    return types.Hover(content, analysis.document.range(span)) if text else None


# ---------------------------------------------------------------------------------------------- keywords and sections


def _head_help(found: Spot) -> str:
    if found.raw is None:
        return section_help(found.raw_section.name) if found.raw_section else ""
    return keyword_help(found.raw.name, found.raw_section.name if found.raw_section else "")


def section_help(name: str) -> str:
    """What belongs in a section."""
    if name not in catalogue.SECTIONS:
        return ""
    own = [f"`*{keyword}`" for keyword in catalogue.keywords() if name in (catalogue.sections_of(keyword) or ())]
    return f"**${name}**" + (f"\n\nKeywords: {', '.join(own)}" if own else "")


def keyword_help(name: str, section: str) -> str:
    """What a keyword is for and how its lines are written."""
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
    """What a field means, its unit, default, range and usual values."""
    about = slot.about
    facts = [
        f"takes {', '.join(slot.choices)}" if slot.choices else f"takes a {TAKES[slot.kind]}" if slot.kind else "",
        f"unit {unit_text(about.unit, units)}" if about.unit and about.unit != "-" else "",
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


def _value_help(analysis: Analysis, found: Site) -> Iterator[str]:
    yield field_help(found.slot, analysis.units)
    value = found.value
    if isinstance(value, Equation):
        yield f"`{value}` = {analysis.evaluated(value)}"
    elif isinstance(value, str):
        yield things.named_help(analysis, found, value)
    elif isinstance(value, int | float):
        yield things.number_help(analysis, found, value)
    if row := things.segment_help(analysis, found):
        yield row
