"""What each feature of a scene costs, and that a scene does not pay for those it has not.

Here stands what a scene loads: modules and time, each in a fresh interpreter.
"""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import NamedTuple

from mudline.contact.input import ContactInput
from mudline.scene.model import Scene
from mudline.study import sample_scene
from mudline.study.pruning import cost
from mudline.study.pruning.growth import study_growth
from mudline.study.pruning.scenes import CURVE, Pipe, Variant, pipe_of, variants
from mudline.study.report import Layout, Omission, Section, StudyOptions, paragraphs
from mudline.study.running import Part, Study

_NODES = 11
_RUNS = 3
_SLOW = 0.5
"""Seconds of a run after which it is not made again."""
_PATIENCE = 60.0
_PROGRAM = """
import json, pickle, sys, time
import numpy
data, before = sys.stdin.buffer.read(), set(sys.modules)
start = time.process_time()
from mudline.contact.input import ContactInput
from mudline.contact.model import ContactModel
model = ContactModel(ContactInput(**pickle.loads(data)))
model.evaluate()
seconds = time.process_time() - start
loaded = sorted(name for name in set(sys.modules) - before if name.startswith("mudline"))
others = sum(not name.startswith("mudline") for name in set(sys.modules) - before)
print(json.dumps([seconds, loaded, others]))
"""


class ImportRow(NamedTuple):
    """What the evaluator of a scene loads.

    seconds: the best processor time to load, prepare and evaluate a few nodes; numpy is there before.
    modules: number of modules of mudline.
    others: number of modules that are not its own.
    beyond: its own modules that the scene with a curve does not load, without the common beginning of their names.
    """

    scene: str
    seconds: float
    modules: int
    others: int
    beyond: tuple[str, ...]


def _parts(row: ImportRow) -> str:
    """The laws, else the packages, that the modules are of."""
    return ", ".join(dict.fromkeys(module.removeprefix("laws.").partition(".")[0] for module in row.beyond))


IMPORTS = Layout[ImportRow](
    "imports",
    "What a scene loads, in a fresh interpreter",
    {
        "scene": lambda row: row.scene,
        "time [ms]": lambda row: 1e3 * row.seconds,
        "modules of mudline": lambda row: row.modules,
        "other modules": lambda row: row.others,
        "beyond those of the curve": _parts,
    },
)
MODULES = Layout[tuple[str, str]](
    "modules",
    "Modules that a scene loads beyond those of a curve",
    {"scene": lambda pair: pair[0], "module beyond those of the curve": lambda pair: pair[1]},
    brief=False,
)


def study_imports(variants: Sequence[Variant], options: StudyOptions) -> Section:
    """What every scene loads, each in a fresh interpreter."""
    omissions: list[Omission] = []
    rows = list(import_rows(variants, CURVE, options, omissions))
    modules = [(row.scene, module) for row in rows for module in row.beyond]
    return Section((IMPORTS.table(rows), MODULES.table(modules)), omissions=omissions)


def import_rows(
    found: Sequence[Variant], plain: str, options: StudyOptions, omissions: list[Omission]
) -> Iterator[ImportRow]:
    """A row for each scene; `plain` names the one that the others are compared with."""
    loads = {}
    for variant in found:
        options.progress(f"imports: {variant.name}")
        try:
            loads[variant.name] = _loaded(variant.make(_NODES))
        except (OSError, subprocess.SubprocessError) as error:
            omissions.append(Omission(f"imports of {variant.name}", str(error).splitlines()[0]))
    common = set(loads[plain][1]) if plain in loads else set()
    for name, (seconds, modules, others) in loads.items():
        beyond = [
            module.removeprefix("mudline.").removeprefix("contact.") for module in modules if module not in common
        ]
        yield ImportRow(name, seconds, len(modules), others, tuple(beyond))


def _loaded(inputs: ContactInput) -> tuple[float, list[str], int]:
    """Seconds, modules of mudline, number of others; the quickest of a few interpreters."""
    data = pickle.dumps(
        {field.name: getattr(inputs, field.name) for field in fields(inputs) if field.init and field.name != "names"}
    )
    rows = [_asked(data)]
    while len(rows) < _RUNS and rows[0][0] < _SLOW:
        rows.append(_asked(data))
    return min(rows, key=lambda row: row[0])


def _asked(data: bytes) -> tuple[float, list[str], int]:
    command = [sys.executable, "-c", _PROGRAM]
    run = subprocess.run(command, input=data, capture_output=True, check=True, timeout=_PATIENCE)  # noqa: S603 - ours
    seconds, modules, others = json.loads(run.stdout)
    return float(seconds), list(modules), int(others)


_NOTES = """
Times are those of the processor, the best of repeated runs, so that other programs hardly count; per node and step of a
series of three steps (laid, lifted in waves, dragged aside), whose results are thrown away. Apart from the scene as it
is, which lies where the deck has it, all nodes are embedded in the seabed, so that every element touches it: the worst
case.

The scene as it is: the deck's elements, repeated up to the number of nodes, with its own seabed and laws. The others:
a straight line with the curve that most of the deck's elements have, and the median of its diameters and lengths;
stages are switched on with typical values, on every element or node.

Memory: the most that one evaluation of one step had at a time, beyond the input, its result included.

Imports: each scene in a fresh interpreter that has loaded numpy; the time is for loading, preparing and evaluating
eleven nodes.

Exponents: slopes of straight lines through the logarithms. Sets: from reading the deck to its evaluator, with a
constant number of elements. Points, curves, planes: one evaluation of one step, with a constant number of nodes.
"""


def _pipe(scene: Scene) -> Pipe:
    """What the forced laws are made for; raises DeckError where the scene cannot be evaluated."""
    return pipe_of(scene.contact_input(), next(iter(sample_scene().curves.values())))


def _imports(scene: Scene, options: StudyOptions) -> Section:
    return study_imports(variants(scene.contact_input(), _pipe(scene)), options)


def _growth(scene: Scene, options: StudyOptions) -> Section:
    return study_growth(_pipe(scene), options)


def _stages(scene: Scene, options: StudyOptions) -> Section:
    inputs, pipe = scene.contact_input(), _pipe(scene)
    found = cost.study_cost(variants(inputs, pipe), pipe, cost.study_curve(pipe, options), options)
    notes = paragraphs(_NOTES)
    if not inputs.has("curve"):
        notes.append("The deck's elements have no curve: that of the built-in sample is used.")
    left = [] if options.full else [Omission(f"{cost.MOST} nodes with stages on", "only with --full")]
    return found._replace(notes=notes, omissions=left)


STUDY = Study(
    "pruning",
    "Pruning: {deck}",
    (Part("stages", _stages, 30.0), Part("imports", _imports, 10.0), Part("growth", _growth, 20.0)),
    order=("curve", "stages", "imports", "growth", "nodes", "sizes", "modules"),
)
run = STUDY.run
