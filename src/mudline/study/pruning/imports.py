"""Modules that a scene loads, and the time for it, each in a fresh interpreter."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import NamedTuple, TypeAlias

from mudline.contact.input import ContactInput
from mudline.study import timing
from mudline.study.pruning.scenes import CURVE, Variant
from mudline.study.report import Layout, Omission, Section, StudyOptions
from mudline.study.timing import Spread

NODES = 11
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


_Asked: TypeAlias = tuple[float, list[str], int]
"""Seconds, modules of mudline, number of others."""


class ImportRow(NamedTuple):
    """What the evaluator of a scene loads.

    seconds: the processor time to load, prepare and evaluate a few nodes; numpy is there before.
    modules: number of modules of mudline.
    others: number of modules that are not its own.
    beyond: its own modules that the scene with a curve does not load, without the common beginning of their names.
    """

    scene: str
    seconds: Spread
    modules: int
    others: int
    beyond: tuple[str, ...]


def _parts(row: ImportRow) -> str:
    """The laws, else the packages, of the modules."""
    return ", ".join(dict.fromkeys(module.removeprefix("laws.").partition(".")[0] for module in row.beyond))


IMPORTS = Layout[ImportRow](
    "imports",
    "What a scene loads, in a fresh interpreter",
    {
        "scene": lambda row: row.scene,
        "time [ms]": lambda row: 1e3 * row.seconds.least,
        "modules of mudline": lambda row: row.modules,
        "other modules": lambda row: row.others,
        "beyond those of the curve": _parts,
        "lower quartile [ms]": lambda row: 1e3 * row.seconds.lower,
        "median [ms]": lambda row: 1e3 * row.seconds.median,
        "upper quartile [ms]": lambda row: 1e3 * row.seconds.upper,
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
    """A row for each scene, turn by turn; `plain` names the one that the others are compared with."""
    inputs = {variant.name: _pickled(variant.make(NODES)) for variant in found}
    asked: dict[str, list[_Asked]] = {}
    turns = [(repeat, name) for repeat in range(timing.REPEATS) for name in inputs]
    for _, name in options.each(turns, lambda turn: f"imports: {turn[1]}, {turn[0] + 1} of {timing.REPEATS}"):
        if name in inputs:
            try:
                asked.setdefault(name, []).append(_asked(inputs[name]))
            except (OSError, subprocess.SubprocessError) as error:
                omissions.append(Omission(f"imports of {name}", str(error).splitlines()[0]))
                del inputs[name]
    common = set(asked[plain][0][1]) if plain in inputs else set()
    for name in inputs:
        _, modules, others = asked[name][0]
        beyond = [
            module.removeprefix("mudline.").removeprefix("contact.") for module in modules if module not in common
        ]
        seconds = Spread.of([run[0] for run in asked[name]])
        yield ImportRow(name, seconds, len(modules), others, tuple(beyond))


def _pickled(inputs: ContactInput) -> bytes:
    return pickle.dumps(
        {field.name: getattr(inputs, field.name) for field in fields(inputs) if field.init and field.name != "names"}
    )


def _asked(data: bytes) -> _Asked:
    command = [sys.executable, "-c", _PROGRAM]
    run = subprocess.run(command, input=data, capture_output=True, check=True, timeout=_PATIENCE)  # noqa: S603 - ours
    seconds, modules, others = json.loads(run.stdout)
    return float(seconds), list(modules), int(others)
