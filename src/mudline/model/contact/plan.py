"""Stages of the evaluation that an input needs, and why other stages are left out."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib import import_module
from importlib.util import find_spec
from types import NoneType
from typing import Literal

from mudline.basics.arguments import expect, expect_word
from mudline.basics.short_repr import UnknownNameError, counted, outline
from mudline.model.contact.input import ContactInput, LawKind
from mudline.model.contact.laws import NormalLaw, known_laws
from mudline.model.contact.seabed import FlatSeabed
from mudline.model.contact.tables import LawTables


@dataclass(frozen=True, slots=True)
class Stage:
    """A stage of the evaluation.

    Attributes:
        stage: name of the stage.
        active: whether the input needs it.
        why: reason for `active`.
    """

    stage: str
    active: bool
    why: str


@dataclass(frozen=True, slots=True, repr=False)
class Plan:
    """The stages in the order in which they are evaluated.

    Attributes:
        stages: seabed surface, normal law, smoothing, unloading, suction, friction, lateral, trench, assembly.
        history: whether the result of a step depends on earlier steps.
    """

    stages: tuple[Stage, ...]
    history: bool

    @property
    def steps(self) -> str:
        """Order in which time steps are evaluated."""
        return "one step after the other" if self.history else "all steps at once"

    def __repr__(self) -> str:
        left_out = ", ".join(stage.stage for stage in self.stages if not stage.active)
        return outline(
            "Plan",
            ", ".join(stage.stage for stage in self.stages if stage.active),
            f"without {left_out}" if left_out else "",
            self.steps,
        )

    def _repr_html_(self) -> str:
        """Return the stages with their reasons as HTML, for notebooks."""
        return self.html("Plan", "")

    def html(self, title: str, size: str) -> str:
        """Return the stages as an HTML table below a title."""
        from mudline.basics.html_repr import html_page, html_table  # noqa: PLC0415 - only notebooks ask for it

        rows = [(stage.stage, "yes" if stage.active else "no", stage.why) for stage in self.stages]
        summary = "; ".join(filter(None, [size, self.steps]))
        return html_page(title, summary, html_table(("stage", "active", "why"), rows, len(rows)))

    def __iter__(self) -> Iterator[Stage]:
        return iter(self.stages)

    def __getitem__(self, name: str) -> Stage:
        """Return the stage of this name; UnknownNameError, a KeyError, when there is none."""
        for stage in self.stages:
            if stage.stage == name:
                return stage
        raise UnknownNameError.among("stage", name, [stage.stage for stage in self.stages])

    def __str__(self) -> str:
        lines = [f"{stage.stage:<14} {'yes' if stage.active else 'no':<3} {stage.why}" for stage in self.stages]
        return "\n".join([*lines, f"{'history':<14} {'yes' if self.history else 'no':<3} {self.steps}"])


def make_plan(given: ContactInput, tables: LawTables, choice: BackendChoice) -> Plan:
    """Return all stages of the evaluation, active or not, with reasons."""
    forces = bool(tables.normal or tables.nodal or _beside(given, "suction"))
    stages = (
        Stage("seabed surface", active=True, why=_seabed(given)),
        Stage("normal law", bool(tables.normal or tables.nodal), _normal_law(given, tables, choice)),
        Stage("smoothing", *_smoothing(given)),
        _stage(given, "unloading", "no element has an unloading stiffness"),
        _stage(given, "suction", "no element has a suction law"),
        _stage(given, "friction", "no node has a friction law"),
        _stage(given, "lateral", "no element has a lateral spring"),
        _trench(given, tables),
        Stage("assembly", forces, _ASSEMBLED if forces else "there are no forces to assemble"),
    )
    return Plan(tuple(_with_reason(stage, given.left_out.get(stage.stage)) for stage in stages), tables.history)


_ASSEMBLED = "half of each element's force to each of its nodes, along the normal of the seabed"


def _with_reason(stage: Stage, left_out: str | None) -> Stage:
    if left_out is None:
        return stage
    return Stage(stage.stage, stage.active, f"{stage.why}; {left_out}" if stage.active else left_out)


def _seabed(given: ContactInput) -> str:
    seabed = given.seabed or FlatSeabed()
    return seabed.describe() + ("" if seabed.faceted else "; tangents hold the normal")


def _normal_law(given: ContactInput, tables: LawTables, choice: BackendChoice) -> str:
    parts = []
    curves = [rows for rows in tables.normal if rows.curve is not None]
    if curves:
        cut = ", pulling forces cut to 0" if given.tension == "cut" else ""
        elements = counted(sum(len(rows.rows) for rows in curves), "element")
        parts.append(f"{elements} on {counted(len(curves), 'force-embedment curve')}{cut}")
    of_plan: dict[str, int] = {}
    for rows in tables.normal:
        if rows.curve is None:
            plan, law = rows.law.plan, f"with the law {rows.law.name!r}: {rows.law.summary}"
            what = plan if isinstance(plan, str) and plan else law
            of_plan[what] = of_plan.get(what, 0) + len(rows.rows)
    parts += [f"{counted(count, 'element')} {what}" for what, count in of_plan.items()]
    parts += [
        assigned.planned if assigned.law.plan else f"{counted(len(assigned.rows), 'node')} with the law {name!r}"
        for name, assigned in given.assigned.items()
        if assigned in given.nodal_laws
    ]
    parts += _beside(given, "normal law")
    if not parts:
        parts.append("no element has a curve or a linear stiffness")
    if "rigid" in given.assigned:
        rigid = len(given.assigned["rigid"].rows)
        parts.append(f"{counted(rigid, 'element')} on a rigid seabed: a constraint, listed as restrained nodes")
    if none := int((given.law == LawKind.NONE).sum()):
        parts.append(f"{counted(none, 'element')} without a law")
    if choice.uncovered:
        parts.append(f"evaluated with numpy: {choice.uncovered}")
    return "; ".join(parts)


def _smoothing(given: ContactInput) -> tuple[bool, str]:
    widths = [law["half_width"] for law in given.assigned.values() if "half_width" in law.parameters]
    smooth = sum(int((width > 0.0).sum()) for width in widths)
    if smooth:
        return True, f"a quadratic zone about the mudline for {smooth} of the linear laws"
    return False, "no linear law has a quadratic zone"


def _beside(given: ContactInput, stage: str) -> list[str]:
    """Return the plan's text of each law of a stage next to the normal laws; a law without a force has none."""
    laws = (given.assigned[name] for name in known_laws() if name in given.assigned)
    return [
        assigned.planned
        for assigned in laws
        if assigned.law.stage == stage and assigned.law.plan is not None and not isinstance(assigned.law, NormalLaw)
    ]


def _stage(given: ContactInput, stage: str, otherwise: str) -> Stage:
    parts = _beside(given, stage)
    return Stage(stage, bool(parts), "; ".join(parts) or otherwise)


def _trench(given: ContactInput, tables: LawTables) -> Stage:
    stage = _stage(given, "trench", "no node lies in a trench")
    if not stage.active:
        return stage
    if tables.trench is None and tables.level is None:
        return replace(
            stage, active=False, why="a trench adds to the limits of friction, and no node has a friction law"
        )
    return stage if tables.level else replace(stage, why=f"{stage.why}; the seabed is not lowered")


Backend = Literal["auto", "numpy", "fast"]

MOST_PARAMETERS = 9
"""Largest number of parameters of a normal law that compiled loops support."""
_WORTH_COMPILING, _WORTH_COMPILING_PLAIN = 5_000_000, 50_000_000
"""Nodes times steps that make compiled loops worthwhile, first compilation included: with history, and without."""


class BackendChoice:
    """Choice between numpy and compiled loops for the series of a model.

    Attributes:
        threads: largest number of threads of compiled loops.
        uncovered: why the laws have no compiled loops; empty if they have.
    """

    def __init__(self, backend: Backend, threads: int | None, tables: LawTables) -> None:
        expect_word(backend, "backend", ("auto", "numpy", "fast"), "auto, numpy or fast")
        if backend == "fast":
            import_module("numba")
        expect(threads, "threads", (int, NoneType), "a whole number")
        if threads is not None and threads < 1:
            raise ValueError(f"threads must be 1 or more, not {threads}")
        self._backend, self._nodes = backend, len(tables.given.node_ids)
        self._worth = _WORTH_COMPILING if tables.history else _WORTH_COMPILING_PLAIN
        processors = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
        self.threads = threads or processors or 1
        rich = [rows.law for rows in (*tables.normal, *tables.nodal) if len(rows.columns) > MOST_PARAMETERS]
        self.uncovered = f"the law {rich[0].name!r} has more than {MOST_PARAMETERS} parameters" if rich else ""

    def compiles(self, steps: int) -> bool:
        """Return True if compiled loops evaluate a series of so many steps."""
        if self._backend == "numpy" or self.uncovered:
            return False
        if self._backend == "fast":
            return True
        return steps * self._nodes >= self._worth and find_spec("numba") is not None
