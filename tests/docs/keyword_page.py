"""docs/keywords.md, from the declarations of the keywords."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from mudline.keywords import catalogue
from mudline.keywords.model import About, Block, Layout, ListRow, Part, Rows, Setting, Slot, layout, row_format
from mudline.keywords.values import Kind
from tests.docs.marking import MADE, anchor, marked

_TAKES = {
    Kind.REAL: "number",
    Kind.WHOLE: "whole number",
    Kind.IDENT: "number or {label}",
    Kind.REAL_OR_NAME: "number or name",
    Kind.NAME: "name",
}
_METRIC = {"F": "N", "L": "m", "M": "kg", "T": "s"}
_IMPERIAL = {"F": "lbf", "L": "ft", "M": "slug", "T": "s"}

_HEAD = """{made}

# Keywords

The keywords on this page have a model: mudline reads every field, checks it, and writes it back. All other keywords
pass through untouched; those known by name are listed [at the end](#keywords-that-pass-through). How lines, fields,
comments, names and equations are written is said in [language.md](language.md), what is evaluated in
[numerics.md](numerics.md).

| keyword | holds |
| --- | --- |
{contents}

In the formats `[ ]` may be left out, `|` stands between alternatives, and `...` says that a line, with the deeper lines
below it, may be repeated. Decks need no such indentation. Where a number belongs an equation `=[...]` may stand. The
ranges are checked by [SBD010](rules/SBD010.md). Units are metric / imperial; a deck in units of its own has its own.
"""

_PASSING = """## Keywords that pass through

These are known by name and kept line for line. In a section other than its own such a keyword is reported by
[SYN008](rules/SYN008.md). A keyword that is on this page neither here nor above is kept as well and reported by
[SYN009](rules/SYN009.md). `*SEABED PLANES`, `*SEABED CONTACT`, `*SEABED SUCTION`, `*SEABED UNLOADING`,
`*SEABED FRICTION` and `*SEABED TRENCH` are names set aside for laws of mudline's own, which this version does not read.

| section | keywords |
| --- | --- |
"""


def keyword_page() -> str:
    """The whole page."""
    blocks = [catalogue.load(module) for module in catalogue.modules()]
    rows = (f"| [`{_title(block)}`](#{anchor(_title(block))}) | {marked(block.summary)} |" for block in blocks)
    parts = [_HEAD.format(made=MADE, contents="\n".join(rows)), *(_section(block) for block in blocks)]
    return "\n".join([*parts, _PASSING + "\n".join(_passing(blocks)) + "\n"])


def _title(block: type[Block]) -> str:
    return f"*{block.names[0]}"


def _section(block: type[Block]) -> str:
    sections = " or ".join(f"`${name}`" for name in block.sections)
    lines = [f"## `{_title(block)}`", "", f"{marked(block.summary)} Section: {sections}.", ""]
    lines += ["```text", _title(block), *_format(block, 1), "```", ""]
    for caption, table in _tables([block], ""):
        lines += [*([caption, ""] if caption else []), *table, ""]
    lines += ["Example:", "", "```text", block.example.rstrip("\n"), "```", ""]
    return "\n".join(lines)


# ------------------------------------------------------------------------------------------------------------- format


def _format(part: type[Part], depth: int) -> list[str]:
    """The lines of a part in the order in which they are written."""
    lines: list[str] = []
    found = layout(part)
    for slot in found.slots:
        if isinstance(slot.about, Setting) and slot.about.inline:
            lines[-1] += f" [, {_setting(slot)}]"
        elif slot.record:
            for record in slot.record.values():
                first, *rest = _format(record, depth)
                lines += [f"{first.removesuffix(' ...')} ...", *(f"  {line}" for line in rest)]
        elif text := _line(slot, found):
            lines.append("  " * depth + text)
    return lines


def _line(slot: Slot, found: Layout) -> str:
    """The line of one field; "" for a field that another one's line holds."""
    if isinstance(slot.about, Rows) and slot.about.row:
        return _optional(slot, layout(slot.about.row).wanted) + " ..."
    if slot.key:
        return _optional(slot, _setting(slot))
    if slot.row:
        alternatives = [other for other in found.columns if other.row and not other.required]
        return layout(slot.row).wanted + (" |" if slot in alternatives[:-1] else "")
    if slot.many:
        return f"{slot.label} [, ...]"
    plain = [other for other in found.columns if not other.row]
    if len(plain) < len(found.columns):
        return _optional(slot, slot.label)
    whole = row_format([other.label for other in plain], [other.required for other in plain])
    return whole if slot is plain[0] else ""


def _optional(slot: Slot, text: str) -> str:
    return text if slot.required else f"[{text}]"


def _setting(slot: Slot) -> str:
    value = layout(slot.row).wanted if slot.row else "|".join(slot.choices) or _TAKES[slot.kind or Kind.REAL]
    return f"{slot.key}={value}"


# ------------------------------------------------------------------------------------------------------------- tables


def _tables(parts: Sequence[type[Part]], path: str) -> Iterator[tuple[str, list[str]]]:
    """A table of the fields of alternative records, then those of what is inside them, each with a caption."""
    slots = [slot for part in parts for slot in layout(part).slots]
    caption = f"In each of `{path}`{', one of' if len(parts) > 1 else ''}:" if path else ""
    if own := [slot for slot in slots if not slot.record]:
        yield caption, list(_fields(own))
    for slot in own:
        name = f"{slot.key}=" if slot.key else slot.json
        row = slot.about.row if isinstance(slot.about, Rows) else slot.row
        if row and isinstance(slot.about, Rows):
            yield f"A row of `{name}`, a list in JSON:", list(_fields(layout(row).slots, named=False))
        elif row and issubclass(row, ListRow):
            yield f"The values of `{name}`, a list in JSON:", list(_fields(layout(row).slots, named=False))
        elif row:
            yield f"The values of `{name}`:", list(_fields(layout(row).slots))
    for slot in slots:
        if slot.record:
            yield from _tables(list(slot.record.values()), slot.json)


def _fields(slots: Iterable[Slot], *, named: bool = True) -> Iterator[str]:
    columns = ("field", *(("in JSON",) if named else ()), "takes", "unit", "default", "range", "meaning")
    yield f"| {' | '.join(columns)} |"
    yield "|" + " --- |" * len(columns)
    for slot in slots:
        names = (f"`{slot.label}`", f"`{slot.json}`") if named else (f"`{slot.label}`",)
        default = "mandatory" if slot.required else slot.about.default
        cells = (*names, _takes(slot), _unit(slot.about.unit), default, _range(slot.about), _meaning(slot.about))
        yield f"| {' | '.join(cells)} |"


def _takes(slot: Slot) -> str:
    if isinstance(slot.about, Rows):
        return "rows, below"
    if slot.row:
        return "values, below"
    many = "one or more of " if slot.many else ""
    return many + (", ".join(slot.choices) or _TAKES[slot.kind or Kind.REAL])


def _meaning(about: About) -> str:
    return marked(f"{about.meaning} (inferred: {about.inferred})" if about.inferred else about.meaning)


def _range(about: About) -> str:
    if about.above is not None:
        return f"> {about.above:g}"
    return f">= {about.at_least:g}" if about.at_least is not None else ""


def _unit(unit: str) -> str:
    """F/L2 as `N/m2 / lbf/ft2`; what is no dimension as it is."""
    if not re.fullmatch(r"(?:[FLMT]\d?|/)+", unit):
        return unit
    return f"{_spelt(unit, _METRIC)} / {_spelt(unit, _IMPERIAL)}"


def _spelt(unit: str, names: dict[str, str]) -> str:
    sides = [re.findall(r"([FLMT])(\d?)", side) for side in unit.split("/")]
    return "/".join(" ".join(names[letter] + power for letter, power in side) for side in sides)


def _passing(blocks: Iterable[type[Block]]) -> Iterator[str]:
    """The keywords that are known by name only, by section."""
    modelled = {name for block in blocks for name in block.names}
    by_section: dict[str, list[str]] = {}
    for keyword in catalogue.keywords():
        if keyword not in modelled:
            for section in catalogue.sections_of(keyword) or ("",):
                by_section.setdefault(section, []).append(f"`*{keyword}`")
    for name in (*catalogue.SECTIONS, ""):
        if name in by_section:
            yield f"| {f'`${name}`' if name else 'not confirmed'} | {', '.join(by_section[name])} |"
