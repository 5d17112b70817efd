"""Decks and models for the tests of export."""

from __future__ import annotations

from pathlib import Path

from mudline.language.deck.loading import load_bytes, load_path
from mudline.model.scene.model import resolve
from mudline.tools.exporting.line_model import LineModel, build

SAMPLES = Path(__file__).parents[3] / "samples"
EXPORTABLE = (
    "flowline-gen.keyxm",
    "imperial-riser.keyxi",
    "legacy-flowline.keyxm",
    "parametric.keyxm",
    "scr-touchdown.keyxm",
    "scr-vessel.keyxm",
    "variations.keyxm",
)

DECK = """\
$MODEL
*OCEAN
 100.0, 1000.0, 10.0
*NODE
 1, 0.0, 0.0, 0.0
 11, 0.0, 50.0, 0.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
{sets}*GEOMETRIC SETS
{sections}{bed}$LOAD CASE
*BOUNDARY
 TYPE=CONSTANT
{held}"""
PIPE = " OPTION=MOORING\n SET=ALL\n 1.0E8, 50.0, 0.1\n"
"""Displaces 7.854 kg of water a metre: W = 10 (50 - 7.854) = 421.46 N/m."""
WEIGHT = 10.0 * (50.0 - 1000.0 * 3.141592653589793 / 4 * 0.01)
ELASTIC = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=20000.0\n FRICTION=0.3, 0.5, 0.01, 0.02\n"
BOTH = "".join(f" {node}, {freedom}\n" for node in (1, 11) for freedom in (1, 2, 3))


def text(*, sets: str = "", sections: str = PIPE, bed: str = ELASTIC, held: str = BOTH) -> str:
    return DECK.format(sets=sets, sections=sections, bed=bed, held=held)


def model_of(deck: str, name: str = "deck.keyxm", folder: Path | None = None) -> LineModel:
    return build(resolve(load_bytes(deck.encode(), name, folder=folder).require()).require_evaluable())


def sample(name: str) -> LineModel:
    return build(resolve(load_path(SAMPLES / name)).require_evaluable())
