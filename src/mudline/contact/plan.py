"""What an input needs of the evaluator, and what is left out, with the reason."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

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
        stages: floor, normal law, suction, friction, trench, assembly.
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
    springs = bool(np.isin(inputs.law, (LawKind.CURVE, LawKind.LINEAR)).any())
    stages = (
        Stage("floor", active=True, why="one flat bed at X = 0"),
        Stage("normal law", springs, _normal_law(inputs)),
        Stage("suction", active=False, why="no element has a suction law"),
        Stage("friction", active=False, why="no node has a friction law"),
        Stage("trench", active=False, why="no node lies in a trench"),
        Stage("assembly", springs, _ASSEMBLED if springs else "there are no forces to assemble"),
    )
    return Plan(tuple(_with_reason(stage, inputs.left_out.get(stage.stage)) for stage in stages), history=False)


_ASSEMBLED = "half of each element's force to each of its nodes, along the normal of the bed"


def _with_reason(stage: Stage, left_out: str | None) -> Stage:
    if left_out is None:
        return stage
    return Stage(stage.stage, stage.active, f"{stage.why}; {left_out}" if stage.active else left_out)


def _normal_law(inputs: ContactInput) -> str:
    on_curves = inputs.with_law(LawKind.CURVE)
    parts = []
    if on_curves.size:
        used = np.unique(inputs.curve_index[on_curves]).size
        cut = ", pulling forces cut to 0" if inputs.tension == "cut" else ""
        parts.append(f"{_count(on_curves.size, 'element')} on {_count(used, 'force-embedment curve')}{cut}")
    if linear := inputs.with_law(LawKind.LINEAR).size:
        parts.append(f"{_count(linear, 'element')} with a linear stiffness")
    if not parts:
        parts.append("no element has a curve or a linear stiffness")
    if rigid := inputs.with_law(LawKind.RIGID).size:
        parts.append(f"{_count(rigid, 'element')} on a rigid bed, a constraint whose reaction this version leaves out")
    if none := inputs.with_law(LawKind.NONE).size:
        parts.append(f"{_count(none, 'element')} without a law")
    return "; ".join(parts)


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"
