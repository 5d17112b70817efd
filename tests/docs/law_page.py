"""The page of the contact laws, from their declarations."""

from __future__ import annotations

from itertools import groupby
from math import isnan

from mudline.model.contact.laws import BUILT_IN, Law, Parameter, law_named

_HEAD = """\
# The contact laws

Every law that the evaluator knows, with its parameters as `LawAssignment` takes them: one number for each row, or an
array (rows,). Brackets hold the unit, as powers of force F, length L and time T, the range and the default. The meaning
of the laws, and the lines of a deck for them, are in [contact.md](contact.md).
"""


_PICTURES = {
    "soil": (
        "![Force against penetration of an element that is pressed into the soil and lifted again: loops that "
        "go below zero on the way up](images/soil-loop.svg)"
    )
}
"""By the name of the law."""


def law_page() -> str:
    """The page."""
    return "\n".join([_HEAD, *(_section(law_named(name)) for name in BUILT_IN)])


def _section(law: Law) -> str:
    facts = [f"acts on {law.acts_on}"]
    facts += ["needs a diameter"] * law.needs_diameter + ["has a history"] * law.history
    equation = f"    {law.equation}\n\n" if law.equation else ""
    source = f"Source: {law.source}.\n" if law.source else ""
    alike = groupby(law.parameters, key=_facts)
    rows = "".join(f"* {', '.join(f'`{each.name}`' for each in group)}{facts}\n" for facts, group in alike)
    parameters = f"{rows}\n" if rows else ""
    what = law.summary[0].upper() + law.summary[1:]
    picture = f"\n{_PICTURES[law.name]}\n" if law.name in _PICTURES else ""
    return f"## {law.name}\n\n{what}; {', '.join(facts)}.\n\n{equation}{parameters}{source}{picture}"


def _facts(parameter: Parameter) -> str:
    """Return unit, range, default and meaning in words: neighbours with the same share a line."""
    default = parameter.default
    without = () if default is None else ("may be left out",) if isnan(default) else (f"default {default:g}",)
    unit = () if parameter.unit == "1" else (parameter.unit,)
    return f" ({', '.join([*unit, parameter.valid_range, *without])}): {parameter.meaning}"
