"""Names of sets and curves that fields give, against those of the deck; which fields do is declared with them."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import REF002
from mudline.deck.parameters import folded
from mudline.diagnostics import Where
from mudline.keywords.kept import Names
from mudline.keywords.model import Block, names_given
from mudline.keywords.remarks import advice_on
from mudline.keywords.text import shown
from mudline.scene.context import Context
from mudline.scene.laws import LawTable
from mudline.scene.sets import Sets


def check_references(context: Context, sets: Sets, laws: LawTable, *, with_soil: bool) -> None:
    """Every name of a set or a curve; those of soil springs on demand."""
    for block, where, name in _given(context, Names.SET):
        if with_soil or not block.facts.soil_springs:
            sets.check(name, where)
    curves = {folded(curve.name): curve.name for curve in laws.curves if curve.named and not curve.embedment}
    for _, where, name in _given(context, Names.CURVE):
        laws.referenced.add(folded(name))
        if folded(name) not in curves:
            near = context.near(name, curves)
            hint = f" (did you mean {curves[near]}?)" if near else ""
            advice = advice_on(name) or "*SEABED STIFFNESS has no such curve"
            message = f"curve {shown(name)} is not defined{hint}: {advice}"
            context.tell_missing(REF002, message, where, "SEABED STIFFNESS")


def _given(context: Context, what: Names) -> Iterator[tuple[type[Block], Where, str]]:
    for i, section in enumerate(context.deck.sections):
        for j, block in enumerate(section.blocks):
            if isinstance(block, Block):
                for path, name in names_given(block, what):
                    yield type(block), Where(i, j, path), name
