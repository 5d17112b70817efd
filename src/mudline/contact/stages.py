"""Makes the stages an input needs, and runs them; a stage or a law that nothing needs is not even imported."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.errors import refuse_elements, refuse_nodes
from mudline.contact.floors.flat import FlatFloor
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.result import ContactResult
from mudline.contact.state import ContactState

if TYPE_CHECKING:
    from mudline.contact.assembly import Assembly
    from mudline.contact.floors.base import Floor
    from mudline.contact.friction.directions import Line
    from mudline.contact.lateral import LateralSprings, LateralStage
    from mudline.contact.laws.spring import Springs
    from mudline.contact.laws.unloading import UnloadingReaction
    from mudline.contact.nodal import NodalLaw
    from mudline.contact.normal import NormalLaw
    from mudline.contact.sliding import FrictionStage, Sliding
    from mudline.contact.suction import Suction
    from mudline.contact.trenches import TrenchStage
    from mudline.contact.unloading import Unloading
    from mudline.contact.uplift import SuctionStage, UpliftSprings


class StepDetail(NamedTuple):
    """The derivatives of one step that its result does not hold; None for stages that are not there."""

    suction: tuple[IndexArray, Suction] | None = None
    nodal: FloatArray | None = None
    lateral: LateralSprings | None = None
    sliding: Sliding | None = None


class Stages:
    """The stages of an input. Attributes of stages that nothing needs are None.

    Attributes:
        floor: the bed.
        onset: depth from which on an element is in contact: 0, or (m,) with the beginnings of centred zones.
    """

    def __init__(self, inputs: ContactInput) -> None:
        extras = inputs.extras
        self.floor: Floor = inputs.floor or FlatFloor()
        self.onset: FloatArray = np.zeros(len(inputs.element_ids))
        if extras.smoothing is not None:
            centred = ~extras.smoothing.one_sided & (inputs.law == LawKind.LINEAR)
            self.onset = np.where(centred, 0.0 - extras.smoothing.half_width, 0.0)
        self.normal = _normal_law(inputs)
        self.unloading = _unloading(inputs)
        self.springs = _uplift_springs(inputs, self.onset)
        self.suction = _suction(inputs, self.onset)
        self.nodal = _nodal(inputs)
        self.assembly = _assembly(inputs, [self.normal, self.springs, self.suction])
        self.friction = _friction(inputs)
        self.lateral = _lateral(inputs)
        self._line = _line(inputs)
        self._inputs = inputs
        self._bends = any(stage is not None for stage in (self.unloading, self.springs, self.suction))
        self._at_nodes = any(stage is not None for stage in (self.nodal, self.friction, self.lateral))

    def initial_state(self) -> ContactState:
        """The state before the first step."""
        return ContactState(
            unloading=None if self.unloading is None else self.unloading.initial(),
            suction=None if self.suction is None else self.suction.initial(),
            friction=None if self.friction is None else self.friction.initial(),
            touchdown=None if self.lateral is None else self.lateral.initial(),
        )

    def press(self, part: ContactResult, first_step: int) -> None:
        """Normal reactions of elements that know no history."""
        if self.normal is not None:
            self.normal.apply(part, first_step)
        if self.springs is not None:
            self.springs.apply(part)

    def look_back(
        self, part: ContactResult, points: FloatArray, moving: FloatArray, state: ContactState, number: int
    ) -> tuple[StepDetail, ContactState]:
        """Unloading and suction of the step `number`, and the state behind it as far as they are concerned."""
        unloading, suction = state.unloading, state.suction
        unloaded: UnloadingReaction | None = None
        detail = StepDetail()
        if self.unloading is not None and unloading is not None:
            unloaded, unloading = self.unloading.apply(part, unloading)
        if self.suction is not None and suction is not None:
            pulls, suction = self.suction.apply(part, moving, suction, unloaded, number)
            detail = StepDetail(suction=pulls)
        laid = points if state.laid is None else state.laid
        return detail, replace(state, positions=points, laid=laid, unloading=unloading, suction=suction)

    def gather(self, part: ContactResult, first_step: int) -> FloatArray | None:
        """Normal forces and reactions of nodes; the stiffness (steps, n) of nodal springs, if there are any."""
        if self.assembly is not None:
            self.assembly.apply(part, first_step)
        stiffness = None if self.nodal is None else self.nodal.apply(part)
        if self.assembly is not None or self.nodal is not None:
            same = self.floor.same_normal
            for axis in range(3):
                if same is None or same[axis]:
                    target = part.reaction[..., axis]
                    np.multiply(part.normal_force, part.normal[..., axis], out=target)
                    # a negative force times a zero component is -0, which is no reaction of its own
                    np.add(target, 0.0, out=target)
        return stiffness

    def slide(
        self,
        part: ContactResult,
        points: FloatArray,
        detail: StepDetail,
        state: ContactState,
        *,
        detailed: bool = True,
    ) -> tuple[StepDetail, ContactState]:
        """Friction and lateral springs of one step; without `detailed` some derivatives are left out."""
        if self._line is None:
            return detail, state
        points = np.asfortranarray(points)
        along = self._line.axial(points, part.normal[0])
        friction, touchdown = state.friction, state.touchdown
        if self.friction is not None and friction is not None and state.laid is not None:
            sliding, friction = self.friction.apply(part, points, along, friction, state.laid, detailed=detailed)
            detail = detail._replace(sliding=sliding)
        if self.lateral is not None and touchdown is not None:
            springs, touchdown = self.lateral.apply(part, points, along, touchdown)
            detail = detail._replace(lateral=springs)
        return detail, replace(state, friction=friction, touchdown=touchdown)

    def check(self, part: ContactResult, first_step: int) -> None:
        """Refuse what overflowed, of the stages that do not see to it themselves.

        Raises:
            ElementError: a slope or a stiffness is infinite.
            PositionError: the reaction at a node is not finite.
        """
        if self._bends:
            for what, values in (("slope", part.slope), ("stiffness", part.stiffness)):
                refuse_elements(np.isinf(values), self._inputs.element_ids, first_step, f"its {what} overflows")
        if self._at_nodes:
            finite = np.isfinite(part.reaction)
            if not finite.all():
                wrong: BoolArray = np.logical_or.reduce(~finite, axis=2)
                refuse_nodes(wrong, self._inputs.node_ids, first_step, "the reaction there overflows")


def _normal_law(inputs: ContactInput) -> NormalLaw | None:
    springs: list[Springs] = []
    if (inputs.law == LawKind.CURVE).any():
        from mudline.contact.laws.curve import curve_springs  # noqa: PLC0415 - only now is it needed

        springs.extend(curve_springs(inputs))
    if (inputs.law == LawKind.LINEAR).any():
        from mudline.contact.laws.linear import linear_springs  # noqa: PLC0415 - only now is it needed

        springs.extend(linear_springs(inputs))
    if not springs:
        return None
    from mudline.contact.normal import NormalLaw  # noqa: PLC0415 - only now is it needed

    return NormalLaw(inputs, springs)


def _unloading(inputs: ContactInput) -> Unloading | None:
    if inputs.extras.unloading is None:
        return None
    from mudline.contact.unloading import Unloading  # noqa: PLC0415 - only now is it needed

    return Unloading(inputs, inputs.extras.unloading)


def _uplift_springs(inputs: ContactInput, onset: FloatArray) -> UpliftSprings | None:
    if inputs.extras.suction_springs is None:
        return None
    from mudline.contact.uplift import UpliftSprings  # noqa: PLC0415 - only now is it needed

    return UpliftSprings(inputs, inputs.extras.suction_springs, onset)


def _suction(inputs: ContactInput, onset: FloatArray) -> SuctionStage | None:
    if inputs.extras.suction is None:
        return None
    from mudline.contact.uplift import SuctionStage  # noqa: PLC0415 - only now is it needed

    return SuctionStage(inputs, inputs.extras.suction, onset)


def _nodal(inputs: ContactInput) -> NodalLaw | None:
    if inputs.extras.nodal is None:
        return None
    from mudline.contact.nodal import NodalLaw  # noqa: PLC0415 - only now is it needed

    return NodalLaw(inputs.extras.nodal)


def _assembly(inputs: ContactInput, sources: list[NormalLaw | UpliftSprings | SuctionStage | None]) -> Assembly | None:
    """What adds element forces up at the nodes, or None when there are none."""
    loaded = [source.elements for source in sources if source is not None]
    if not loaded:
        return None
    from mudline.contact.assembly import Assembly  # noqa: PLC0415 - only now is it needed

    return Assembly(inputs, np.unique(np.concatenate(loaded)))


def _friction(inputs: ContactInput) -> FrictionStage | None:
    if inputs.extras.friction is None:
        return None
    from mudline.contact.sliding import FrictionStage  # noqa: PLC0415 - only now is it needed

    same_normal = FlatFloor.same_normal if inputs.floor is None else inputs.floor.same_normal
    return FrictionStage(inputs.extras.friction, _trench(inputs), same_normal)


def _trench(inputs: ContactInput) -> TrenchStage | None:
    if inputs.extras.trench is None:
        return None
    from mudline.contact.trenches import TrenchStage  # noqa: PLC0415 - only now is it needed

    return TrenchStage(inputs, inputs.extras.trench)


def _lateral(inputs: ContactInput) -> LateralStage | None:
    if inputs.extras.lateral is None:
        return None
    from mudline.contact.lateral import LateralStage  # noqa: PLC0415 - only now is it needed

    return LateralStage(inputs, inputs.extras.lateral)


def _line(inputs: ContactInput) -> Line | None:
    if inputs.extras.friction is None and inputs.extras.lateral is None:
        return None
    from mudline.contact.friction.directions import Line  # noqa: PLC0415 - only now is it needed

    return Line(inputs.element_nodes, len(inputs.node_ids))
