"""The study from the scene to its report."""

from __future__ import annotations

import numpy as np

from mudline.scene.model import Scene
from mudline.study.pruning.cost import costs, curve_alone
from mudline.study.pruning.growth import fits, growth
from mudline.study.pruning.imports import imports
from mudline.study.pruning.pictures import growth_picture, node_picture, stage_picture
from mudline.study.pruning.pipe import pipe_of
from mudline.study.pruning.tables import (
    cost_table,
    curve_table,
    fit_table,
    growth_table,
    import_table,
    module_table,
    stage_table,
)
from mudline.study.pruning.variants import CURVE, variants
from mudline.study.report import Omission, StudyOptions, StudyReport
from mudline.study.sample import sample_scene

LADDER = (100, 1000, 10_000, 100_000)
MOST = 1_000_000
_NOTES = (
    """Times are those of the processor, the best of repeated runs, so that other programs hardly count; per node and
    step of a series of three steps (laid, lifted in waves, dragged aside), whose results are thrown away. Apart from
    the scene as it is, which lies where the deck has it, all nodes are pressed into the bed, so that every element
    touches it: that is the dearest case.""",
    """The scene as it is: the deck's elements over and over up to the number of nodes, with its own bed and laws. The
    others: a straight line with the curve that most of the deck's elements have, and the middle one of its diameters
    and lengths; stages are forced on with usual numbers, on every element or node.""",
    """Memory: the most that one evaluation of one step had at a time, beyond the input, its result included.""",
    """Imports: each scene in a fresh interpreter that has loaded numpy; the time is for loading, preparing and
    evaluating eleven nodes.""",
    """Exponents: slopes of straight lines through the logarithms. Sets: reading the deck until its evaluator stands,
    the number of elements kept. Points, curves, planes: one evaluation of one step, the number of nodes kept.""",
)


def run(scene: Scene | None, options: StudyOptions) -> StudyReport:
    """Study what the stages cost on the line of a scene, of the built-in sample where there is none.

    Raises DeckError where the scene cannot be evaluated, and ImportError without scipy.
    """
    studied = sample_scene() if scene is None else scene
    with np.errstate(all="ignore"):
        return _studied(studied, options)


def _studied(scene: Scene, options: StudyOptions) -> StudyReport:
    omissions: list[Omission] = []
    inputs = scene.contact_input()
    notes = [" ".join(note.split()) for note in _NOTES]
    pipe = pipe_of(inputs, next(iter(sample_scene().curves.values())))
    if not inputs.has("curve"):
        notes.append("The deck's elements have no curve: that of the built-in sample stands for one.")
    found = variants(inputs, pipe)
    ladder = (*LADDER, MOST) if options.full else LADDER
    alone = []
    for nodes in (*LADDER, MOST):
        options.progress(f"{nodes} nodes: the curve alone, and the scene that has nothing else")
        alone.append(curve_alone(pipe, nodes))
    loads = list(imports(found, CURVE, options, omissions))
    grown = list(growth(pipe, options))
    rows = list(costs(found, pipe, ladder, options))
    slopes = list(fits(grown))
    if not options.full:
        omissions.append(Omission(f"{MOST} nodes with stages on", "only with --full"))
    tables = (
        curve_table(alone),
        stage_table(rows),
        import_table(loads),
        fit_table(slopes),
        cost_table(rows),
        growth_table(grown),
        module_table(loads),
    )
    pictures = (node_picture(rows, alone), stage_picture(rows), growth_picture(grown, slopes))
    return StudyReport("pruning", f"Pruning: {scene.deck.file}", tables, pictures, tuple(notes), tuple(omissions))
