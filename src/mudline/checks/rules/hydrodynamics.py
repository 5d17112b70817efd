"""Coefficients of hydrodynamics: elements that have none, and added masses whose order is not certain."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.checks.context import LintContext, entries_of_sets
from mudline.checks.rules.geometry import without_sections
from mudline.checks.rules.model_parts import lacks
from mudline.checks.rules.references import in_water
from mudline.checks.rules.seabed_position import first_of
from mudline.checks.rules.vertical_restraint import in_another_pipe
from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.rules import rule
from mudline.model.scene.deck_values import number

GEO008 = Code("GEO008", "missing-hydrodynamics", Severity.INFO)
GEO016 = Code("GEO016", "added-mass-order", Severity.INFO)


@rule(GEO008)
def missing_hydrodynamics(context: LintContext) -> Iterator[Problem]:
    """Elements have no hydrodynamic properties in a load case with waves or a current.

    No set of *HYDRODYNAMIC SETS holds them, so neither drag nor added mass acts on them. That is right in a moonpool,
    and a mistake elsewhere. Inner pipes of *PIP SECTION need no coefficients. Put the elements into a set with
    coefficients.

    Example on held:
         $MODEL
        |*OCEAN
        | 420.0, 1025.0, 9.81

          GEN=1, 2
        |*ELEMENT SETS
        | SET=Pipe
        - 1
        + 1, 2
        |*HYDRODYNAMIC SETS
        | SET=Pipe, TYPE=CONSTANT
        | 1.0, 0.0, 2.0
         $LOAD CASE
        |*CURRENT
        | TYPE=UNIFORM
        | 0.5

    Finds: 10:2
    """
    scene = context.scene
    blocks = context.blocks("HYDRODYNAMIC SETS")
    if not any(in_water(context.deck)) or not lacks(context, "elements", "hydrodynamics"):
        return
    covered = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, block in blocks:
        for entry in block.sets:
            set_ = scene.set_table.find(entry.set_name) if isinstance(entry.set_name, str) else None
            if set_ is None:
                return
            covered[set_.elements] = True
    bare = np.flatnonzero(~(covered | without_sections(scene) | in_another_pipe(scene)))
    if bare.size:
        what = first_of("element", scene.element_ids[bare[0]], bare.size)
        message = f"{what} without coefficients in *HYDRODYNAMIC SETS: give them, else neither drag nor added mass acts"
        yield Problem(GEO008, message, where=scene.table.numbered.where(int(bare[0])))


@rule(GEO016)
def added_mass_order(context: LintContext) -> Iterator[Problem]:
    """A line of `*HYDRODYNAMIC SETS` gives two different added mass coefficients, whose order is inferred.

    mudline reads the normal coefficient first, as in decks of the older program (.das). The manual's page on theory
    lists the tangential one first, and no public page shows the line itself. Nothing that mudline evaluates depends on
    the order, but it matters if the values are copied. If the coefficients are the defaults, the normal inertia minus 1
    and 0, leave both fields empty: then there is no doubt.

    Example on sets:
          GEN=3, 4
        |*HYDRODYNAMIC SETS
        | SET=ALL, TYPE=CONSTANT
        - 1.0, 0.0, 2.0, 1.0, 0.0
        + 1.0, 0.0, 2.0

    Finds: 16:17
    """
    if context.deck.file.lower().endswith(".das"):
        return
    lines = []
    for where, entry in entries_of_sets(context.blocks("HYDRODYNAMIC SETS")):
        normal, tangential, inertia = (
            number(entry.constant, name) for name in ("normal_added_mass", "tangential_added_mass", "normal_inertia")
        )
        if abs(normal - tangential) > 0.0:
            lines.append((where.inside("constant", "normal_added_mass"), normal, tangential, inertia))
    if lines:
        where, normal, tangential, inertia = lines[0]
        others = f"; so are those of {len(lines) - 1} more sets" * (len(lines) > 1)
        defaults = normal == inertia - 1.0 and tangential == 0.0
        advice = "these are the defaults, remove both" if defaults else "keep them if they are meant so"
        message = (
            f"the added masses are read as {normal:g} normal, {tangential:g} tangential (inferred){others}: {advice}"
        )
        yield Problem(GEO016, message, where=where)
