"""Warnings for an engineer about the results of a deck: zeros for want of a law, no contact, no equilibrium.

The warnings of an evaluated deck follow from its scene and its results. Of a long series only the necessary data are
kept: a flag for each element, and the smallest clearance.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mudline.basics.arguments import as_array
from mudline.basics.quantities import shown
from mudline.basics.short_repr import counted, cut
from mudline.basics.units import UNITS
from mudline.language.codes.contact import GEO005, GEO017, RUN003, RUN004, RUN005, SBD006
from mudline.language.codes.lines import SYN009
from mudline.language.diagnostics import Code, DeckError, Diagnostic, Problem, Severity, Where
from mudline.language.keywords.catalogue import hold_in_soil
from mudline.model.contact import ContactModel, ContactResult, LawKind
from mudline.model.contact.columns import kept
from mudline.model.contact.result import ResultPart
from mudline.model.results.evaluation import Evaluation, PositionSource, evaluate_scene
from mudline.model.results.extremes import Best, largest_of_steps
from mudline.model.scene.given_positions import Doubt, height_along_z, position_doubts
from mudline.model.scene.laws_in_use import UnknownKeyword, missing_laws, unknown_keywords, unused_curves
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, distinct, first_of
from mudline.model.scene.seabed import survey_of
from mudline.model.scene.weights import (
    PipeContents,
    contents,
    contents_case,
    left_out,
    operating_weight,
)

BALANCED = (1.0 / 3.0, 3.0)
"""Range of total reaction over submerged weight outside of which positions are far from equilibrium."""

NEAR = (0.9, 1.1)
"""Range of the same ratio outside of which a resting shape is suggested."""

_TOUCHING = 1e-3
"""Clearance over diameter up to which a line touches the seabed: its datum is right."""
_CAPTION = 90


@dataclass(frozen=True, slots=True)
class ContactWarning:
    """A doubt about the results of a deck.

    Attributes:
        diagnostic: code, message and place, as in lint.
        elements: number of elements concerned; 0 for a doubt about none, as a curve without effect.
        first: number of the first of them, or None.
        brief: the message in a few words, for the caption of a plot; "" if the plot shows it.
    """

    diagnostic: Diagnostic
    elements: int
    first: int | None
    brief: str

    def __str__(self) -> str:
        diagnostic = self.diagnostic
        return f"{diagnostic.file}:{diagnostic.line}: {diagnostic.code} {diagnostic.message}"

    def row(self) -> dict[str, object]:
        """Return the warning as JSON."""
        diagnostic = self.diagnostic
        return {
            "code": diagnostic.code,
            "message": diagnostic.message,
            "line": diagnostic.line,
            "elements": self.elements,
            "first": self.first,
        }


def contact_warnings(scene: Scene, result: ContactResult, positions: Floats | None = None) -> list[ContactWarning]:
    """Return the warnings about a result of `scene.contact().evaluate(positions)`, in the order of the deck.

    `positions` are the evaluated positions, (nodes, 3) or (steps, nodes, 3); None: the deck's own coordinates. Raises
    ValueError for positions of another shape or kind.
    """
    places = as_array(scene.coordinates if positions is None else positions, "positions")
    if places.dtype.kind not in "iuf" or places.ndim not in {2, 3} or places.shape[-2:] != (len(scene.node_ids), 3):
        raise ValueError(f"positions must be numbers (nodes, 3) or (steps, nodes, 3), not of shape {places.shape}")
    if not len(places):
        raise ValueError("positions must have one step or more")
    source: PositionSource = "deck" if positions is None else "file"
    steps = places.reshape(-1, *places.shape[-2:])
    model = ContactModel(result.known, backend="numpy")
    watch = ContactWatch(Evaluation(scene, model, steps, result.present, source=source))
    watch.take(ResultPart(0, result.as_series()))
    return watch.warnings()


def seabed_warnings(scene: Scene) -> list[ContactWarning]:
    """Return the warnings about the seabed under the deck's own coordinates, valid for any solved shape.

    They are about elements in contact without a law, and Z as the height of a line that touches nothing. A deck that
    cannot be evaluated has none.
    """
    if (scene.element_nodes < 0).any():
        return []
    codes = {SBD006.code, SYN009.code}
    if height_along_z(scene, np.arange(len(scene.element_ids)), scene.coordinates):
        codes.add(GEO005.code)
    elif not (scene.law == LawKind.NONE).any():
        return []
    try:
        evaluation = evaluate_scene(scene)
        watch = ContactWatch(evaluation)
        evaluation.run([watch])
    except DeckError:
        return []
    return [warning for warning in watch.warnings() if warning.diagnostic.code in codes]


def caption(warnings: Sequence[ContactWarning]) -> str:
    """Return the line of a plot about its warnings, "" without warnings."""
    briefs = [warning.brief for warning in warnings if warning.brief]
    return cut(f"{counted(len(briefs), 'warning')}: {'; '.join(briefs)}", _CAPTION) if briefs else ""


@dataclass
class _Balance:
    """Total reaction and submerged weight (NaN if unknown) of the elements (indices) in contact with a law.

    `empty` is the weight without contents. Over several steps they are sums; `elements` are then in
    contact at one of the steps.
    """

    reaction: float = 0.0
    weight: float = 0.0
    empty: float = 0.0
    elements: Indices = field(default_factory=lambda: np.zeros(0, np.intp))
    steps: int = 0

    @property
    def ratio(self) -> float:
        """Reaction over weight; NaN if the weight is not above 0."""
        return self.reaction / self.weight if self.weight > 0.0 else math.nan


class ContactWatch:
    """Consumer of the results of a few steps at a time that keeps the data of the warnings of an evaluation.

    Positions of a file are judged by the last step; those of a resting shape are in equilibrium.
    """

    def __init__(self, evaluation: Evaluation) -> None:
        scene, given, positions = evaluation.scene, evaluation.model.input, evaluation.positions
        self._scene, self._source, self._times = scene, evaluation.source, evaluation.time
        self._positions, self._places = positions, np.asarray(positions[0], dtype=np.float64)
        self._own = evaluation.source == "deck"
        self._weight = operating_weight(scene) if given.weight is None else given.weight
        self._empty = operating_weight(scene, filled=False)
        self._elements = evaluation.elements
        self._nodes = distinct(scene.element_nodes[self._elements])
        self._lightest, self._case = self._least_weight()
        self._touched = np.zeros(len(scene.element_ids), dtype=np.bool_)
        self._restrained = np.zeros(len(scene.nodes), dtype=np.bool_)
        self._sprung = bool(scene.nodal.any()) or "SEABED SUCTION" in scene.extensions
        self._sprung |= bool((scene.resistance.column("suction") > 0.0).any())
        self._acts = False
        self._deepest = Best(1, -1.0)
        """The largest depth of a node below the seabed, at the index of the node."""
        self.balance = _Balance()
        self._survey = survey_of(scene.seabed)
        lawful = self._elements[scene.law[self._elements] != LawKind.NONE]
        self._lawful = distinct(scene.element_nodes[lawful])
        self._thickest = float(np.fmax.reduce(scene.diameter[lawful], initial=0.0))
        self._left, self._left_at = np.zeros(len(scene.nodes), dtype=np.bool_), -1
        self._doubts: list[Doubt] = []
        if self._source == "file":
            last = np.asarray(positions[evaluation.steps - 1], dtype=np.float64)
            self._doubts = position_doubts(given, scene, evaluation.present, last)

    def take(self, part: ResultPart) -> None:
        """Add some steps."""
        result = part.result
        self._touched |= result.contact.any(axis=0)
        if result.restrained is not None:
            self._restrained |= result.restrained.any(axis=0)
        if not self._acts:
            self._acts = bool(self._touched.any() or self._restrained.any())
            # a spring acts on a node without an element in contact
            self._acts |= self._sprung and bool(kept(result.normal_force, self._nodes).any())
            if not self._acts:
                depth = -kept(result.gap, self._nodes)
                self._deepest.take(part.start, largest_of_steps(depth, self._nodes))
        self._weigh(result)
        if self._survey is not None:
            for step, places in enumerate(self._positions[part.steps], part.start):
                left = self._survey.left(np.asarray(places, dtype=np.float64)[self._lawful], self._thickest)
                if left.any():
                    self._left_at = step if self._left_at < 0 else self._left_at
                    self._left[self._lawful[left]] = True

    def _least_weight(self) -> tuple[Floats, PipeContents | None]:
        """Return the least submerged weight per length (m,) over the load cases, and the first case that floats."""
        scene = self._scene
        with np.errstate(over="ignore", invalid="ignore"):
            cases = [(self._empty + case.mass * scene.surroundings.gravity, case) for case in contents(scene)]
        if not cases:
            return self._empty, None
        floating = next((case for weight, case in cases if (weight[self._elements] < 0.0).any()), None)
        return np.minimum.reduce([weight for weight, _ in cases]), floating

    def _weigh(self, result: ContactResult) -> None:
        """Add reaction and weights of some steps."""
        scene, balance = self._scene, self.balance
        law = scene.law[self._elements]
        held = kept(result.contact, self._elements) & (law != LawKind.NONE)
        times, here = held.sum(axis=0), self._elements[held.any(axis=0)]
        times = times[times > 0] * scene.length[here]
        with np.errstate(over="ignore", invalid="ignore"):
            rigid = (law == LawKind.RIGID).any()
            balance.reaction += math.nan if rigid else float(kept(result.normal_force, self._nodes).sum())
            balance.weight += float((times * self._weight[here]).sum())
            balance.empty += float((times * self._empty[here]).sum())
        balance.elements = distinct(np.concatenate([balance.elements, here]))
        balance.steps += len(held)

    # ----------------------------------------------------------------------------------------------- what it found

    def warnings(self) -> list[ContactWarning]:
        """Return the warnings in the order of the deck; call after all steps."""
        listed = [self._warning(*doubt) for doubt in self._doubts]
        free = np.flatnonzero(self._touched & (self._scene.law == LawKind.NONE))
        some, none = len(free) < len(self._elements), np.zeros(0, dtype=np.intp)
        listed += [self._warning(*each) for each in missing_laws(self._scene, free, self._unknown, some=some)]
        listed += [*self._on_rigid(), *self._beyond(), *self._apart(), *self._unbalanced(), *self._floating()]
        for each in () if self._unknown else unused_curves(self._scene):  # an unknown keyword may use any curve
            listed.append(self._warning(each.code, each.message, each.where, none, "a curve without effect"))
        return sorted(listed, key=lambda warning: warning.diagnostic.sort_key)

    def note(self) -> str:
        """Return the note that the positions are the deck's own, with the weight they carry.

        Return "" for positions of a file, and together with RUN003.
        """
        balance = self.balance
        if not self._own or self._is_unbalanced():
            return ""
        note = "the positions are the deck's own coordinates, not a solved shape"
        if not balance.elements.size:
            return note
        near = NEAR[0] <= balance.ratio <= NEAR[1] or math.isnan(balance.ratio)
        advice = "" if near else "; --rest-shape gives a shape of the line's own weight"
        return f"{note}: {self._balanced()}{advice}"

    def _warning(self, code: Code, message: str, where: Where | None, elements: Indices, brief: str) -> ContactWarning:
        problem = Problem(code, message, None, Severity.WARNING, where)
        first = int(self._scene.element_ids[elements[0]]) if elements.size else None
        deck = self._scene.deck
        diagnostic = deck.diagnose([problem])[0]
        if diagnostic.file != deck.file:  # a place in a deck that this deck continues
            diagnostic = replace(diagnostic, message=f"{diagnostic.message} (in {diagnostic.file})")
        return ContactWarning(diagnostic, len(elements), first, brief)

    def _on_rigid(self) -> Iterator[ContactWarning]:
        """Yield a warning about elements that a rigid seabed holds at some step, as its force is not known."""
        ends = self._restrained[self._scene.element_nodes[self._elements]].any(axis=1)
        held = self._elements[ends & (self._scene.law[self._elements] == LawKind.RIGID)]
        if held.size:
            which = self._scene.describe(held, "is held", "are held")
            message = f"{which} by a rigid seabed, a constraint: its force is not known, nor is the total reaction"
            law = self._scene.set_law(int(held[0]))
            where = None if law is None else law.where
            yield self._warning(RUN005, message, where, held, "reaction of a rigid seabed not known")

    def _beyond(self) -> Iterator[ContactWarning]:
        """Yield a warning about nodes beyond the end of the surveyed seabed at some step."""
        left = np.flatnonzero(self._left)
        all_without = not self._acts and self._deepest.peak() is None  # GEO005 then says it of the whole line
        if self._survey is None or not left.size or all_without:
            return
        scene = self._scene
        which = first_of("node", scene.node_ids[left], "lies", "lie")
        at = "" if self._times is None else f", from time {shown(float(self._times[self._left_at]))} on"
        message = f"{which} {self._survey.end}{at}: {self._survey.consequence}"
        elements = self._elements[self._left[scene.element_nodes[self._elements]].any(axis=1)]
        yield self._warning(GEO017, message, scene.nodes.where(int(left[0])), elements, "beyond the survey")

    @cached_property
    def _unknown(self) -> list[UnknownKeyword]:
        return unknown_keywords(self._scene)

    def _apart(self) -> Iterator[ContactWarning]:
        """Yield a warning if nothing is in contact at any step."""
        scene, deepest = self._scene, self._deepest.peak()
        if self._acts or not self._elements.size:
            return
        if deepest is None:
            message = "nothing is in contact: the line lies outside the seabed; correct its bounds or the coordinates"
            yield self._warning(GEO005, message, None, self._elements, "line outside the seabed")
            return
        gap, node = -deepest.value, int(deepest.at)
        distance = f"{shown(abs(gap))}{UNITS[scene.units].behind('L')}"
        times = self._times
        at = "" if times is None else f" at time {shown(float(times[deepest.step]))}"
        number = scene.node_ids[node]
        message = f"nothing is in contact: the smallest clearance is {distance}, of node {number}{at}"
        if gap < 0.0:
            message = (
                f"no element is in contact in the mean of its nodes, though node {number} lies {distance} deep{at}"
            )
        solved = ", or give a solved shape with --positions, or try --rest-shape" if self._own else ""
        touches = 0.0 <= gap <= _TOUCHING * float(np.fmax.reduce(scene.diameter[self._elements], initial=0.0))
        lower = "lower the line until it penetrates" if touches else "correct the datum of X, which is 0 at the mudline"
        advice = self._turned() or f"; {lower}{solved}"
        where = scene.nodes.where(node)
        yield self._warning(GEO005, message + advice, where, self._elements, "nothing in contact")

    def _turned(self) -> str:
        """Return a hint for positions whose last coordinate seems to be the height, or ""."""
        hint = height_along_z(self._scene, self._elements, self._places)
        return f"; {hint}: X is up here, the height is the first coordinate" if hint else ""

    def _unbalanced(self) -> Iterator[ContactWarning]:
        """Yield a warning about positions far from equilibrium: the deck's own, or those of a file in the mean."""
        balance = self.balance
        if not self._is_unbalanced():
            return
        whose = "the deck's own, " if self._own else "" if balance.steps == 1 else "in the mean of all steps "
        message = f"the positions are {whose}far from equilibrium: {self._balanced()}"
        solved = "give a solved shape with --positions, or try --rest-shape"
        advice = self._turned() or (f"; {solved}" if self._own else "; check their datum and units, and the weights")
        brief = f"reaction / submerged weight {shown(balance.ratio, 3)}"
        yield self._warning(RUN003, message + advice, None, balance.elements, brief)

    def _is_unbalanced(self) -> bool:
        known, ratio = self._source != "rest shape" and not self._left_out, self.balance.ratio
        return known and (ratio < BALANCED[0] or ratio > BALANCED[1])

    @cached_property
    def _left_out(self) -> list[str]:
        return left_out(self._scene)

    def _balanced(self) -> str:
        balance = self.balance
        behind = UNITS[self._scene.units].behind("F")
        elements = counted(len(balance.elements), "element")
        reaction, weight, empty = (each / balance.steps for each in (balance.reaction, balance.weight, balance.empty))
        total = "not known" if math.isnan(reaction) else f"{shown(reaction)}{behind}"
        carried = f"total reaction {total} on {elements} in contact"
        if math.isnan(weight):
            return f"{carried}, whose submerged weight is not known"
        case, filled = contents_case(self._scene), weight != empty
        added = [f"contents{f' of load case {case}' if case else ''}"] * filled
        added += ["masses"] * ("MASS" in self._scene.deck.keywords())
        more = (f" with {' and '.join(added)}" if added else "") + (
            f" ({shown(empty)}{behind} empty)" if filled else ""
        )
        more += f" without {', '.join(self._left_out)}" if self._left_out else ""
        ratio = "" if math.isnan(balance.ratio) else f", ratio {shown(balance.ratio, 3)}"
        return f"{carried}, their submerged weight {shown(weight)}{behind}{more}{ratio}"

    def _floating(self) -> Iterator[ContactWarning]:
        """Yield a warning about elements in contact that float, or about all if nothing is in contact and all float."""
        scene = self._scene
        floats = self._lightest[self._elements] < 0.0
        if hold_in_soil(scene.deck.keywords()):  # springs of the soil hold elements without a seabed law
            floats &= scene.law[self._elements] != LawKind.NONE
        light = self._elements[floats & (self._touched[self._elements] | (not self._acts and bool(floats.all())))]
        if not light.size or self._left_out:
            return
        behind = UNITS[scene.units].behind("F/L") or " per length"
        least, how = float(self._lightest[light].min()), "without contents"
        if self._case is not None:
            line = scene.line_of(self._case.where)
            how = f"with the contents of load case {self._case.number} (line {line})"
        message = (
            f"{scene.describe(light, 'floats', 'float')}: submerged weight {shown(least)}{behind} {how}; "
            "check diameters and densities"
        )
        where = scene.section_table.sections[int(scene.section_table.of_element[light[0]])].where
        yield self._warning(RUN004, message, where, light, f"{counted(len(light), 'element')} floating")
