"""The page of the contact laws, from their declarations."""

from __future__ import annotations

from itertools import groupby
from math import isnan

from mudline.model.contact.laws import BUILT_IN, Law, Parameter, law_named

_HEAD = """\
# The contact laws

Every law that the evaluator knows, with its parameters as `LawAssignment` takes them: one number for each row, or an
array (rows,). Units are powers of force F, length L and time T. What the laws mean, and what a deck writes for them, is
in [contact.md](contact.md). This page is made from the program.
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
    alike = groupby(law.parameters, key=_cells)
    rows = "".join(_row([each.name for each in group], cells) for cells, group in alike)
    table = (
        f"| parameter | unit | range | default | meaning |\n| --- | --- | --- | --- | --- |\n{rows}\n" if rows else ""
    )
    what = law.summary[0].upper() + law.summary[1:]
    picture = f"\n{_PICTURES[law.name]}\n" if law.name in _PICTURES else ""
    return f"## {law.name}\n\n{what}; {', '.join(facts)}.\n\n{equation}{table}{source}{picture}"


def _cells(parameter: Parameter) -> tuple[str, ...]:
    """Unit, range, default and meaning: neighbours with the same share a row."""
    default = "" if parameter.default is None else "none" if isnan(parameter.default) else f"{parameter.default:g}"
    return parameter.unit, parameter.valid_range, default, parameter.meaning.replace("|", "\\|")


def _row(names: list[str], cells: tuple[str, ...]) -> str:
    return f"| {', '.join(f'`{name}`' for name in names)} | {' | '.join(cells)} |\n"
