"""Decks exported to MoorDyn and brought to rest there, and mudline's evaluation of the same shapes.

`python -m tests.tools.exporting.at_rest [DECK ...]` prints the table of docs/export.md; it needs the
Python package of MoorDyn.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias, cast

import numpy as np

from mudline.language.deck.loading import load_path
from mudline.model.contact import ContactModel
from mudline.model.contact.input import LawAssignment
from mudline.model.contact.touchdown import line_summaries
from mudline.model.scene.model import resolve
from mudline.model.scene.numbering import Floats
from mudline.tools.exporting import moordyn
from mudline.tools.exporting.line_model import LineModel, build
from mudline.tools.exporting.returned import _positions

Json: TypeAlias = Any

ROOT = Path(__file__).parents[3]
DECKS = ("legacy-flowline.keyxm", "imperial-riser.keyxi", "scr-touchdown.keyxm")
SECONDS = 3.0


@dataclass(frozen=True, slots=True)
class Rest:
    """A shape at rest, in SI units: reactions N, arc lengths and penetrations m, by MoorDyn and by mudline.

    `same_law` is the reaction by mudline with the stiffness that was exported, `deck_law` with the laws of the deck.
    `explained` is the difference of the two laws, from the penetrations of MoorDyn's nodes alone.
    """

    deck: str
    change: float
    reaction: float
    same_law: float
    deck_law: float
    explained: float
    touchdown: tuple[float, float]
    penetration: tuple[float, float]


def at_rest(deck: Path, folder: Path, statics: float = 100.0) -> Rest:
    """Export a deck, run it with so many seconds of statics at most, and evaluate the shape."""
    scene = resolve(load_path(deck)).require_evaluable()
    model = build(scene)
    found = run(model, folder, statics)
    parts = [part for each in moordyn.pieces(model) for part in each]
    places = [np.array(line["places"])[np.newaxis] for line in found["lines"]]
    arcs = [
        np.linspace(0.0, float(part.lengths.sum()), each.shape[1]) for part, each in zip(parts, places, strict=True)
    ]
    returned = _positions(model, list(zip(parts, arcs, places, strict=True)), None)
    position = cast("Floats", returned.values)[0]
    option = next(line for line in (folder / "model.txt").read_text().splitlines() if line.endswith(" kBot"))
    stiffness = float(option.split()[0]) * model.sections[parts[0].section].buoyancy
    force, length = model.units.force, model.units.length
    deck_law = scene.contact().evaluate(position)
    same = _linear(model, stiffness).evaluate(position)
    depth = np.concatenate([-model.depth - each[0, :, 2] for each in places])
    return Rest(
        deck.name,
        found["change"],
        sum(sum(line["forces"]) for line in found["lines"]),
        float(same.reaction[..., 0].sum()) * force,
        float(deck_law.reaction[..., 0].sum()) * force,
        _difference(model, position, stiffness),
        (_touchdown(parts_arcs(arcs), depth), float(line_summaries(deck_law)[0].touchdown[-1].arc_length) * length),
        (float(depth.max()), float(np.max(deck_law.depth)) * length),
    )


def run(model: LineModel, folder: Path, statics: float, *, seconds: float = SECONDS, moved: float = 0.0) -> Json:
    """What MoorDyn has at rest: places and forces of the nodes of each line; its top may be `moved` so many metres."""
    for name, text in moordyn.write(model, "model.txt").items():
        (folder / name).write_text(text.replace("100.0 TmaxIC", f"{statics} TmaxIC"), encoding="ascii")
    child = [sys.executable, str(Path(__file__).with_name("resting.py")), str(folder / "model.txt"), str(seconds)]
    output = subprocess.run([*child, str(moved)], check=True, capture_output=True, text=True, timeout=280).stdout
    return json.loads(output.strip().splitlines()[-1])


def parts_arcs(arcs: list[Floats]) -> Floats:
    """Arc lengths of lines one behind the other as those of one line."""
    starts = np.append(0.0, np.cumsum([each[-1] for each in arcs]))
    return np.concatenate([start + each for start, each in zip(starts, arcs, strict=False)])


def _linear(model: LineModel, stiffness: float) -> ContactModel:
    """The lines of a deck on the stiffness per length that was exported."""
    given = model.scene.contact_input()
    rows = np.arange(len(model.scene.element_ids))
    law = LawAssignment("linear", rows, {"stiffness": np.full(len(rows), stiffness / model.units.size("F/L2"))})
    return ContactModel(replace(given, laws=(law,)))


def _difference(model: LineModel, position: Floats, stiffness: float) -> float:
    """Reaction by the deck's laws less that by the stiffness, element by element at the mean depth of its nodes."""
    scene = model.scene
    depth = -position[scene.element_nodes, 0].mean(axis=1)
    arrays, total = scene.law_arrays(), 0.0
    for at, z in enumerate(depth.tolist()):
        if z <= 0.0:
            continue
        curve = int(arrays.curve_index[at])
        if curve >= 0:
            own = float(arrays.curves[curve].evaluate(z / float(scene.diameter[at]))[0])
        else:
            own = float(np.nan_to_num(arrays.linear_stiffness[at])) * z
        total += (own - stiffness / model.units.size("F/L2") * z) * float(scene.length[at])
    return total * model.units.force


def _touchdown(arc: Floats, depth: Floats) -> float:
    """Where the last node below the mudline rises above it."""
    last = int(np.flatnonzero(depth > 0.0)[-1])
    if last + 1 == len(arc):
        return float(arc[last])
    share = depth[last] / (depth[last] - depth[last + 1])
    return float(arc[last] + share * (arc[last + 1] - arc[last]))


def table(rests: list[Rest]) -> str:
    """The figures as a Markdown table."""
    head = (
        "deck",
        "MoorDyn, kN",
        "mudline, same stiffness, kN",
        "mudline, deck's laws, kN",
        "explained by the laws, kN",
        "touchdown, MoorDyn / mudline, m",
        "penetration, MoorDyn / mudline, mm",
    )
    rows = [f"| {' | '.join(head)} |", f"|{' --- |' * len(head)}"]
    for each in rests:
        forces = (each.reaction, each.same_law, each.deck_law, each.explained)
        cells = [f"`{each.deck}`", *(f"{force / 1e3:.2f}" for force in forces)]
        cells.append(" / ".join(f"{value:.2f}" for value in each.touchdown))
        cells.append(" / ".join(f"{1e3 * value:.2f}" for value in each.penetration))
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


def main(given: list[str]) -> None:
    """Print the table."""
    rests = []
    for deck in [Path(each) for each in given] or [ROOT / "samples" / name for name in DECKS]:
        with tempfile.TemporaryDirectory() as folder:
            rests.append(at_rest(deck, Path(folder)))
    sys.stdout.write(f"{table(rests)}\n")
    changes = ", ".join(f"{each.change:.1e}" for each in rests)
    sys.stdout.write(f"\nChange of the reaction in the last second: {changes}\n")


if __name__ == "__main__":
    main(sys.argv[1:])
