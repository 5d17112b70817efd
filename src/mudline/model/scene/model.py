"""Scene of a deck: its arrays, its faults, and its evaluator."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from itertools import chain
from typing import TYPE_CHECKING, Literal

from mudline.basics.resources import modules_of
from mudline.basics.short_repr import counted, cut, outline
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import evaluated
from mudline.language.diagnostics import Blocks, DeckError, Problem, Severity
from mudline.language.rules import RULES, Rule, findings
from mudline.model.scene.boundary import HeldNodes, check_boundaries, held_nodes
from mudline.model.scene.context import Context
from mudline.model.scene.curves import read_curves
from mudline.model.scene.laws import read_extensions, read_laws, read_resistance
from mudline.model.scene.mesh import read_elements, read_nodes
from mudline.model.scene.references import check_chains, check_idents, check_lines, check_unread_lines
from mudline.model.scene.resolved import ResolvedDeck
from mudline.model.scene.seabed import read_seabed
from mudline.model.scene.sections import read_sections
from mudline.model.scene.sets import check_references, read_sets

if TYPE_CHECKING:
    from mudline.model.contact.input import ContactInput
    from mudline.model.contact.model import ContactModel
    from mudline.model.contact.plan import Backend
    from mudline.model.scene.csv_file import ExternalElements


@dataclass(repr=False)
class Scene(ResolvedDeck):
    """Resolved deck with its faults and its evaluator: the part of `mudline.Scene` that the packages use."""

    def __repr__(self) -> str:
        counts = [
            counted(len(self.node_ids), "node"),
            counted(len(self.element_ids), "element"),
            counted(len(self.set_table.named), "set"),
            counted(len(self.curves), "curve"),
        ]
        if errors := len(self.errors()):
            counts.append(counted(errors, "error"))
        return outline(f"Scene of {cut(self.deck.file, 80)!r}", ", ".join([self.units, *counts]))

    @cached_property
    def held(self) -> list[HeldNodes]:
        """Nodes that each line of `*BOUNDARY` in the deck itself holds."""
        return list(held_nodes(self.deck, self.nodes))

    @cached_property
    def findings(self) -> list[Problem]:
        """All faults of the deck that concern its evaluation."""
        return [*self.context.of_deck(), *self.problems]

    @cached_property
    def problems(self) -> list[Problem]:
        """Problems from resolving the deck and from the rules that block."""
        return [*self.noticed, *chain.from_iterable(findings(_rules(), self))]

    def blocking(self, tension: Literal["keep", "cut"] = "keep") -> list[Problem]:
        """Return the findings that keep the scene from being evaluated; `tension` is that of `contact`."""
        blocks = (Blocks.ALWAYS, Blocks.WITH_TENSION) if tension == "keep" else (Blocks.ALWAYS,)
        return [problem for problem in self.findings if problem.blocking in blocks]

    def errors(self) -> list[Problem]:
        """Return the faults of the deck itself, so that the scene cannot be used.

        A warning may keep the scene from being evaluated too: a missing definition may be in an unread line.
        """
        return [problem for problem in self.blocking("cut") if problem.weight is Severity.ERROR]

    def require_evaluable(self, tension: Literal["keep", "cut"] = "keep") -> Scene:
        """Return the scene itself; raises DeckError for the findings that keep it from being evaluated."""
        if problems := self.blocking(tension):
            raise DeckError(self.deck.diagnose(problems))
        return self

    def require(self) -> Scene:
        """Return the scene itself; raises DeckError for errors on which a result depends."""
        if errors := self.errors():
            raise DeckError(self.deck.diagnose(errors))
        return self

    def contact(self, tension: Literal["keep", "cut"] = "keep", *, backend: Backend = "auto") -> ContactModel:
        """Return the evaluator of this scene, as `mudline.Scene.contact` does."""
        from mudline.model.contact.model import ContactModel  # noqa: PLC0415 - as below

        return ContactModel(self.contact_input(tension), backend=backend)

    def contact_input(self, tension: Literal["keep", "cut"] = "keep") -> ContactInput:
        """Return the arrays that the evaluator is made from; raises DeckError as `contact` does."""
        from mudline.model.scene.contact_input import contact_input  # noqa: PLC0415 - checking a deck does without it

        self.require_evaluable(tension)
        return contact_input(self, tension)


@cache
def _rules() -> tuple[Rule, ...]:
    """Return the rules that find causes that block evaluation."""
    modules_of("mudline.model.scene.rules")
    return tuple(rule for rule in RULES.values() if rule.blocks)


def resolve(deck: Deck, external: ExternalElements | None = None) -> Scene:
    """Return the scene of a deck, as far as it can be resolved; its faults are in `problems`.

    `external` adds elements that the deck does not show, or replaces its own. The models of the decks that it continues
    belong to the scene, if they are found next to it; their faults are in `problems` too.
    """
    problems: list[Problem] = []
    if "RESTART" in deck.keywords("LOAD CASE"):
        from mudline.model.scene.restart import continued  # noqa: PLC0415 - most decks continue none

        deck, problems = continued(deck)
    ready, problems_of_values = evaluated(deck)
    context = Context(ready, deck, [*problems, *problems_of_values])
    if external is not None:
        context.external_definers = []
    nodes = read_nodes(context, external)
    elements = read_elements(context, nodes, external)
    count = len(elements.numbered)
    sets = read_sets(context, elements.numbered, external)
    sections = read_sections(context, sets, elements.numbered, elements.length, external)
    named, by_set, other_curves = read_curves(context)
    laws = read_laws(context, sets, named, by_set, count)
    resistance = read_resistance(context, laws)
    extensions = read_extensions(context, sets, count)
    seabed = read_seabed(context)
    check_chains(context)
    check_lines(context)
    check_references(context, sets, with_soil=external is None)
    check_unread_lines(context, sets, nodes if external is None else None)
    if external is None:  # a file of elements does not define every node and set
        check_boundaries(context, nodes)
        check_idents(context, nodes, elements.numbered)
    context.report_out_of_sight()
    return Scene(
        ready, nodes, elements, sets, sections, laws, other_curves, resistance, extensions, seabed, context.problems
    )
