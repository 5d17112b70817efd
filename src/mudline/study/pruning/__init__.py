"""What each feature of a scene costs, and that a scene does not pay for those that it does not have."""

from __future__ import annotations

from mudline.contact.input import ContactInput
from mudline.scene.model import Scene
from mudline.study import sample_scene
from mudline.study.pruning import calls, cost
from mudline.study.pruning.features import advice, study_features
from mudline.study.pruning.growth import study_growth
from mudline.study.pruning.imports import study_imports
from mudline.study.pruning.page import page
from mudline.study.pruning.scenes import Pipe, pipe_of, variants
from mudline.study.report import Omission, Section, StudyOptions, paragraphs
from mudline.study.running import Part, Study

_NOTES = """
Times are CPU times, which other programs hardly affect: medians and quartiles of five repeats, in which what is
compared takes turns. Scenes: per node and step of a series of three steps (laid, lifted in waves, dragged aside), whose
results are discarded. Apart from the scene as it is, which lies where the deck has it, all nodes are
embedded in the seabed, so that every element touches it at the first step.

The scene as it is: as many whole copies of the deck as needed, with its own order of nodes, seabed and laws. The
others: a straight line with the curve that most of the deck's elements have, and the median of its diameters and
lengths; stages are switched on with typical values, on every element or node.

Memory: the peak of one evaluation of one step beyond the input, its result included; of calls, the peak of the whole
call.

Plain numpy: a hand-written function for elements on one curve and a flat seabed, with the same results bit by bit.

Imports: each scene in a fresh interpreter that has loaded numpy; the time is for loading, preparing and evaluating
eleven nodes.

Exponents: slopes of straight lines through the logarithms. Sets: from reading the deck to its evaluator, with a
constant number of elements. Points, curves, planes: one evaluation of one step, with a constant number of nodes.
"""


def _given(scene: Scene) -> tuple[ContactInput, Pipe]:
    """The deck's own input, and what the forced laws are made for; raises DeckError where it cannot be evaluated."""
    inputs = scene.contact_input()
    return inputs, pipe_of(inputs, next(iter(sample_scene().curves.values())))


def _calls(scene: Scene, options: StudyOptions) -> Section:
    return calls.study_calls(*_given(scene), options)


def _imports(scene: Scene, options: StudyOptions) -> Section:
    return study_imports(variants(*_given(scene)), options)


def _growth(scene: Scene, options: StudyOptions) -> Section:
    return study_growth(_given(scene)[1], options)


def _stages(scene: Scene, options: StudyOptions) -> Section:
    inputs, pipe = _given(scene)
    found = cost.study_cost(variants(inputs, pipe), pipe, cost.study_curve(pipe, options), options)
    notes = paragraphs(_NOTES)
    if not inputs.has("curve"):
        notes.append("The deck's elements have no curve: that of the built-in sample is used.")
    left = [] if options.full else [Omission(f"{cost.MOST} nodes with stages on", "only with --full")]
    features = study_features(scene)
    return found._replace(tables=[*found.tables, *features.tables], notes=notes, omissions=left)


STUDY = Study(
    "pruning",
    "Pruning: {deck}",
    (
        Part("stages", _stages, 25.0),
        Part("calls", _calls, 20.0),
        Part("imports", _imports, 25.0),
        Part("growth", _growth, 10.0),
    ),
    page=page,
    advice=advice,
    order=("curve", "stages", "imports", "growth", "calls", "nodes", "sizes", "modules", "features"),
)
run = STUDY.run
