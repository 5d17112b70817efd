"""From a deck to a scene, step by step."""

from __future__ import annotations

from mudline.deck.evaluation import evaluated
from mudline.deck.model import Deck
from mudline.scene.bed import read_bed
from mudline.scene.boundaries import check_boundaries
from mudline.scene.context import Context
from mudline.scene.elements import read_elements
from mudline.scene.extensions import read_extensions
from mudline.scene.external import ExternalElements
from mudline.scene.floor import read_floor
from mudline.scene.force_curves import read_curves
from mudline.scene.laws import read_laws
from mudline.scene.line_checks import check_lines
from mudline.scene.model import Scene
from mudline.scene.nodes import read_nodes
from mudline.scene.references import check_references
from mudline.scene.restart import continued
from mudline.scene.sections import read_sections
from mudline.scene.sets import read_sets
from mudline.scene.soil import check_soil


def resolve(deck: Deck, external: ExternalElements | None = None) -> Scene:
    """The scene of a deck, as far as it can be resolved; what went wrong is in its `problems`.

    `external` adds elements that the deck does not show, or replaces its own. The models of the decks that it continues
    belong to the scene, if they are found beside it; what lies in them is among the problems too.
    """
    whole, found = continued(deck)
    ready, problems = evaluated(whole)
    context = Context(ready, whole, [*found, *problems])
    if external is not None:
        context.definers = []
    nodes = read_nodes(context, external)
    elements = read_elements(context, nodes, external)
    count = len(elements.numbered)
    sets = read_sets(context, elements.numbered, external)
    sections = read_sections(context, sets, elements.numbered, external)
    named, by_set = read_curves(context)
    laws = read_laws(context, sets, named, by_set, count)
    bed = read_bed(context, laws)
    extensions = read_extensions(context, sets, count)
    floor = read_floor(context)
    check_lines(context)
    check_references(context, sets, laws, with_soil=external is None)
    if external is None:  # a file of elements does not tell of every node and set
        check_soil(context, nodes)
        check_boundaries(context, nodes)
    return Scene(ready, nodes, elements, sets, sections, laws, bed, extensions, floor, context.problems)
