"""A rigid seabed: a constraint on the nodes of its elements and no force."""

from __future__ import annotations

from mudline.contact.laws.base import Law

RIGID = Law(
    name="rigid",
    summary="rigid seabed, a constraint",
    acts_on="elements",
    parameters=(),
    equation="gap >= 0",
    source="definition of TYPE=RIGID",
)
