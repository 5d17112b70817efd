"""What an input needs of the evaluator, and what is left out, with the reason."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mudline.contact.extras import Extras
from mudline.contact.inputs import ContactInput, LawKind


@dataclass(frozen=True, slots=True)
class Stage:
    """A part of the evaluation: its name, whether the input needs it, and why or why not."""

    stage: str
    active: bool
    why: str


@dataclass(frozen=True, slots=True)
class Plan:
    """The stages in the order in which they are evaluated.

    Attributes:
        stages: floor, normal law, smoothing, unloading, suction, friction, lateral, trench, assembly.
        history: whether a step's result depends on the steps before it.
    """

    stages: tuple[Stage, ...]
    history: bool

    @property
    def steps(self) -> str:
        """How time steps are taken."""
        return "one step after the other" if self.history else "all steps at once"

    def __iter__(self) -> Iterator[Stage]:
        return iter(self.stages)

    def __getitem__(self, name: str) -> Stage:
        """The stage of this name; KeyError when there is none."""
        for stage in self.stages:
            if stage.stage == name:
                return stage
        raise KeyError(name)

    def __str__(self) -> str:
        lines = [f"{stage.stage:<10} {'yes' if stage.active else 'no':<3} {stage.why}" for stage in self.stages]
        return "\n".join([*lines, f"{'history':<10} {'yes' if self.history else 'no':<3} {self.steps}"])


def make_plan(inputs: ContactInput) -> Plan:
    """Return the stages that `inputs` needs and those it does not."""
    extras = inputs.extras
    springs = bool(np.isin(inputs.law, (LawKind.CURVE, LawKind.LINEAR)).any())
    uplift = extras.suction is not None or extras.suction_springs is not None
    nodal = extras.nodal is not None
    forces = springs or uplift or nodal
    slides = extras.friction is not None
    stages = (
        Stage("floor", active=True, why=_floor(inputs)),
        Stage("normal law", springs or nodal, _normal_law(inputs)),
        Stage("smoothing", *_smoothing(extras)),
        Stage("unloading", *_unloading(extras)),
        Stage("suction", uplift, _suction(extras)),
        Stage("friction", slides, _friction(extras)),
        Stage("lateral", *_lateral(extras)),
        Stage("trench", *_trench(extras)),
        Stage("assembly", forces, _ASSEMBLED if forces else "there are no forces to assemble"),
    )
    return Plan(tuple(_with_reason(stage, inputs.left_out.get(stage.stage)) for stage in stages), extras.history)


_ASSEMBLED = "half of each element's force to each of its nodes, along the normal of the bed"


def _with_reason(stage: Stage, left_out: str | None) -> Stage:
    if left_out is None:
        return stage
    return Stage(stage.stage, stage.active, f"{stage.why}; {left_out}" if stage.active else left_out)


def _floor(inputs: ContactInput) -> str:
    if inputs.floor is None:
        return "one flat bed at X = 0"
    held = "" if inputs.floor.facetted else "; tangents hold the normal"
    return inputs.floor.describe() + held


def _normal_law(inputs: ContactInput) -> str:
    on_curves = inputs.with_law(LawKind.CURVE)
    parts = []
    if on_curves.size:
        used = np.unique(inputs.curve_index[on_curves]).size
        cut = ", pulling forces cut to 0" if inputs.tension == "cut" else ""
        parts.append(f"{_count(on_curves.size, 'element')} on {_count(used, 'force-embedment curve')}{cut}")
    if linear := inputs.with_law(LawKind.LINEAR).size:
        parts.append(f"{_count(linear, 'element')} with a linear stiffness")
    if inputs.extras.nodal is not None:
        springs = int((~np.isnan(inputs.extras.nodal.stiffness)).sum())
        parts.append(f"{_count(springs, 'node')} with a stiffness of {'its' if springs == 1 else 'their'} own")
    if not parts:
        parts.append("no element has a curve or a linear stiffness")
    if rigid := inputs.with_law(LawKind.RIGID).size:
        parts.append(f"{_count(rigid, 'element')} on a rigid bed: a constraint, told as restrained nodes")
    if none := inputs.with_law(LawKind.NONE).size:
        parts.append(f"{_count(none, 'element')} without a law")
    return "; ".join(parts)


def _smoothing(extras: Extras) -> tuple[bool, str]:
    widths = [part.half_width for part in (extras.smoothing, extras.nodal) if part is not None]
    smooth = sum(int((width > 0.0).sum()) for width in widths)
    if smooth:
        return True, f"a quadratic zone about the mudline for {smooth} of the linear laws"
    return False, "no linear law has a quadratic zone"


def _unloading(extras: Extras) -> tuple[bool, str]:
    if extras.unloading is None:
        return False, "no element has an unloading stiffness"
    count = int((~np.isnan(extras.unloading)).sum())
    return True, f"{_count(count, 'element')} on unloading lines, from the deepest point so far"


def _suction(extras: Extras) -> str:
    parts = []
    if extras.suction is not None:
        parts.append(f"{_count(len(extras.suction.elements), 'element')} after Bridge et al., with a state each")
    if extras.suction_springs is not None:
        count = int((extras.suction_springs.stiffness > 0.0).sum())
        parts.append(f"{_count(count, 'element')} with a spring up to an extent, without history (inferred)")
    return "; ".join(parts) or "no element has a suction law"


def _friction(extras: Extras) -> str:
    if extras.friction is None:
        return "no node has a friction law"
    law = extras.friction.law
    constant = law.active & law.constant.any(axis=1)
    lengths = int((law.active & ~constant).sum())
    parts = []
    if constant.any():
        ellipses = int((constant & law.ellipse).sum())
        criterion = f", {ellipses} of them with an ellipse" if ellipses else ""
        parts.append(f"{_count(int(constant.sum()), 'node')} with a constant spring{criterion}")
    if lengths:
        parts.append(f"{_count(lengths, 'node')} with a mobilisation length, Kt = mu N / length (inferred)")
    return "; ".join(parts)


def _lateral(extras: Extras) -> tuple[bool, str]:
    if extras.lateral is None:
        return False, "no element has a lateral spring"
    count = int((extras.lateral > 0.0).sum())
    return True, f"{_count(count, 'element')} with a spring to where it touched down (inferred), in place of friction"


def _trench(extras: Extras) -> tuple[bool, str]:
    if extras.trench is None:
        return False, "no node lies in a trench"
    if extras.friction is None:
        return False, "a trench adds to the limits of friction, and no node has a friction law"
    count = int((~np.isnan(extras.trench.law.peak)).sum())
    return True, f"{_count(count, 'node')} with a peak resistance of the walls (inferred); the bed is not lowered"


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"
