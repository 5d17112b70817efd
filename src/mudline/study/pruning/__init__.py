"""What each feature of a scene costs, and that a scene does not pay for those it has not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mudline.scene.model import Scene
from mudline.study.pruning import cost
from mudline.study.pruning.growth import study_growth
from mudline.study.pruning.imports import study_imports
from mudline.study.pruning.scenes import pipe_of, variants
from mudline.study.report import Omission, Section, StudyOptions, StudyReport, paragraphs
from mudline.study.sample import sample_scene

__all__ = ["run"]

_ORDER = ("curve", "stages", "imports", "growth", "nodes", "sizes", "modules")
"""Of the tables: what is short first."""
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


@np.errstate(all="ignore")
def run(scene: Scene, options: StudyOptions) -> StudyReport:
    """Study what the stages cost on the line of a scene.

    Raises DeckError where the scene cannot be evaluated, and ImportError without scipy.
    """
    inputs = scene.contact_input()
    notes = paragraphs(_NOTES)
    pipe = pipe_of(inputs, next(iter(sample_scene().curves.values())))
    if not inputs.has("curve"):
        notes.append("The deck's elements have no curve: that of the built-in sample is used.")
    found = variants(inputs, pipe)
    alone = cost.study_curve(pipe, options)
    imports, growth = study_imports(found, options), study_growth(pipe, options)
    costs = cost.study_cost(found, pipe, alone, options)
    left = [] if options.full else [Omission(f"{cost.MOST} nodes with stages on", "only with --full")]
    sections = (imports, costs, growth, Section(notes=notes, omissions=left))
    report = StudyReport.of("pruning", f"Pruning: {scene.deck.file}", sections)
    return replace(report, tables=tuple(sorted(report.tables, key=lambda table: _ORDER.index(table.name))))
