"""What a scene loads: modules and time, each in a fresh interpreter."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import fields
from typing import NamedTuple

from mudline.contact.input import ContactInput
from mudline.study.pruning.scenes import CURVE, Variant
from mudline.study.report import Layout, Omission, Section, StudyOptions

NODES = 11
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
    rows = list(imports(variants, CURVE, options, omissions))
    modules = [(row.scene, module) for row in rows for module in row.beyond]
    return Section((IMPORTS.table(rows), MODULES.table(modules)), omissions=omissions)


def imports(
    found: Sequence[Variant], plain: str, options: StudyOptions, omissions: list[Omission]
) -> Iterator[ImportRow]:
    """A row for each scene; `plain` names the one that the others are compared with."""
    loads = {}
    for variant in found:
        options.progress(f"imports: {variant.name}")
        try:
            loads[variant.name] = _loaded(variant.make(NODES))
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
    data = pickle.dumps({field.name: getattr(inputs, field.name) for field in fields(inputs) if field.init})
    rows = [_asked(data)]
    while len(rows) < _RUNS and rows[0][0] < _SLOW:
        rows.append(_asked(data))
    return min(rows, key=lambda row: row[0])


def _asked(data: bytes) -> tuple[float, list[str], int]:
    command = [sys.executable, "-c", _PROGRAM]
    run = subprocess.run(command, input=data, capture_output=True, check=True, timeout=_PATIENCE)  # noqa: S603 - ours
    seconds, modules, others = json.loads(run.stdout)
    return float(seconds), list(modules), int(others)
