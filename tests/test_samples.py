"""The samples are what they say they are: read without loss, found clean or faulty, and physically sensible."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import NamedTuple, cast

import numpy as np
import pytest
from numpy.typing import NDArray

from mudline.contact import ContactResult
from mudline.deck.loading import load_bytes, load_path
from mudline.deck.model import Deck, Opaque
from mudline.deck.parameters import Parameters
from mudline.diagnostics import Severity
from mudline.keywords.library.geometric_sets import FlexibleSection, GeometricSets, RigidSection
from mudline.keywords.library.ocean import Ocean
from mudline.lint.engine import lint_bytes
from mudline.lint.selection import select
from mudline.scene.build import resolve
from mudline.scene.external import read_external
from mudline.scene.model import Scene
from mudline.scene.positions import read_positions
from mudline.syntax.source import Source
from mudline.syntax.tree import parse

SAMPLES = Path(__file__).parents[1] / "samples"
DECKS = sorted(path.name for path in SAMPLES.glob("*.keyx?"))
CLEAN = [name for name in DECKS if name != "broken.keyxm"]

INFO = {
    "imperial-riser.keyxi": {"GEO003"},
    "legacy-flowline.keyxm": {"LEG001", "CRV002"},
}
"""What a clean deck may be told, all of it info; the others are told nothing."""

FAULTS = [
    (9, "SYN011"),
    (12, "SYN007"),
    (20, "REF013"),
    (23, "REF014"),
    (25, "SYN017"),
    (30, "SYN002"),
    (36, "SYN003"),
    (38, "SYN002"),
    (43, "REF007"),
    (46, "REF010"),
    (53, "REF006"),
    (59, "REF009"),
    (66, "REF005"),
    (70, "SYN016"),
    (75, "REF008"),
    (77, "REF010"),
    (82, "SYN005"),
    (86, "SYN006"),
    (89, "SBD010"),
    (92, "SYN008"),
    (97, "SYN009"),
    (106, "SYN001"),
    (108, "SBD010"),
    (110, "REF001"),
    (114, "REF002"),
    (116, "SYN004"),
    (120, "SBD006"),
    (128, "SYN003"),
    (128, "SYN015"),
    (131, "CRV003"),
    (134, "CRV004"),
    (136, "CRV002"),
    (141, "CRV005"),
    (143, "CRV001"),
    (143, "REF003"),
    (146, "REF004"),
    (147, "CRV006"),
    (151, "SYN013"),
    (154, "SYN010"),
    (161, "SBD002"),
    (167, "SYN014"),
]


class Evaluated(NamedTuple):
    """A sample's scene and its contact."""

    scene: Scene
    result: ContactResult

    def line_force(self, elements: slice) -> NDArray[np.float64]:
        """Force per unit length of a range of elements."""
        return self.result.force[elements]


def sample(name: str) -> Deck:
    return load_path(SAMPLES / name, name)


def evaluated(deck: Deck) -> Evaluated:
    scene = resolve(deck).require()
    return Evaluated(scene, scene.contact().evaluate())


def submerged_weight(scene: Scene, entry: int = 0) -> float:
    """Weight per unit length in water of an entry of *GEOMETRIC SETS, from the deck's own numbers."""
    _, ocean = next(scene.deck.blocks("OCEAN"))
    _, sections = next(scene.deck.blocks("GEOMETRIC SETS"))
    water = cast("Ocean", ocean)
    section = cast("GeometricSets", sections).sets[entry].section
    density, gravity = cast("float", water.density), cast("float", water.gravity)
    if isinstance(section, FlexibleSection):
        mass, outer = cast("float", section.mass), cast("float", section.db)
    else:
        assert isinstance(section, RigidSection)
        outer, inner = cast("float", section.do), cast("float", section.di)
        mass = cast("float", section.density) * math.pi / 4 * (outer**2 - inner**2)
    return (mass - density * math.pi / 4 * outer**2) * gravity


def penetration(ratio: float, diameter: float, strength: float, gradient: float) -> float:
    """Force per unit length of undrained penetration (DNV-RP-F114, model 2, without its buoyancy term)."""
    factor: float = min(6 * ratio**0.25, 3.4 * math.sqrt(10 * ratio))
    return factor * (strength + gradient * ratio * diameter) * diameter


def found(name: str) -> list[tuple[int, str]]:
    return [(finding.line, finding.code) for finding in lint_bytes((SAMPLES / name).read_bytes(), name, select())]


# ---------------------------------------------------------------------------------------------------------- as text


def test_every_sample_is_there() -> None:
    assert DECKS == [
        "broken.keyxm",
        "flowline-gen.keyxm",
        "imperial-riser.keyxi",
        "legacy-flowline.keyxm",
        "lines-deck.keyxm",
        "parametric.keyxm",
        "scr-touchdown.keyxm",
    ]


@pytest.mark.parametrize("name", DECKS)
def test_the_leaves_of_the_tree_are_the_file(name: str) -> None:
    data = (SAMPLES / name).read_bytes()
    source = Source.from_bytes(data, name)
    text = "".join(source.text[slice(*leaf.span)] for leaf in parse(source).leaves())
    assert source.to_bytes(text) == data


@pytest.mark.parametrize("name", DECKS)
def test_a_sample_begins_with_what_it_shows_and_says_that_it_is_synthetic(name: str) -> None:
    text = (SAMPLES / name).read_text(encoding="utf-8")
    header = re.match(r"(?:C.*\n)+", text)
    assert header is not None
    assert "shows:" in header[0].lower()
    assert "synthetic" in header[0].lower()


@pytest.mark.parametrize("name", ["positions.csv", "elements.csv", "lines-positions.csv"])
def test_data_files_are_small(name: str) -> None:
    assert (SAMPLES / name).stat().st_size < 200_000


# --------------------------------------------------------------------------------------------------------- findings


@pytest.mark.parametrize("name", CLEAN)
def test_clean_samples_are_told_nothing_or_info(name: str) -> None:
    findings = lint_bytes((SAMPLES / name).read_bytes(), name, select())
    assert {finding.severity for finding in findings} <= {Severity.INFO}
    assert {finding.code for finding in findings} <= INFO.get(name, set())


def test_the_legacy_deck_is_told_of_its_keywords_and_of_its_unsorted_curve() -> None:
    assert found("legacy-flowline.keyxm") == [(54, "LEG001"), (58, "LEG001"), (78, "CRV002")]


def test_the_broken_deck_has_these_faults() -> None:
    assert found("broken.keyxm") == FAULTS


def test_every_fault_is_announced_by_the_nearest_comment_above_it() -> None:
    lines = (SAMPLES / "broken.keyxm").read_text(encoding="utf-8").split("\n")
    numbered = [int(match[1]) for line in lines if (match := re.match(r"C +(\d+) (?:SYN|REF|CRV|SBD)", line))]
    assert numbered == list(range(1, 39))
    for line, code in FAULTS:
        announced = next(text for text in reversed(lines[: line - 1]) if re.match(r"C +\d+ ", text))
        assert code in announced, (line, code)


def test_bad_lines_do_not_hide_the_good_ones_beside_them() -> None:
    scene = resolve(sample("broken.keyxm"))
    assert sorted(scene.node_ids.tolist()) == list(range(1, 22))
    assert scene.coordinates[np.argsort(scene.node_ids)][4:7, 1].tolist() == [20.0, 25.0, 30.5]
    assert scene.element_ids.tolist() == list(range(1, 21))
    sets = {name: ids.tolist() for name, ids in scene.sets.items()}
    assert sets["Line"] == [*range(1, 8), *range(11, 18)]
    assert sets["Crossing"] == [8, 9, 10]
    assert sets["Spool"] == [18, 19, 20]
    assert scene.diameter[:7].tolist() == [0.2191] * 7
    assert scene.curves["Soft Clay"].ratios.tolist() == [0.0, 0.02, 0.1, 0.2]
    assert scene.law_names[:8] == ["curve:Soft Clay"] * 7 + ["none"]


# ------------------------------------------------------------------------------------------- steel catenary riser


@pytest.fixture(scope="module")
def riser() -> Evaluated:
    return evaluated(sample("scr-touchdown.keyxm"))


def test_riser_has_its_elements_and_sets(riser: Evaluated) -> None:
    scene = riser.scene
    assert (len(scene.node_ids), len(scene.element_ids)) == (201, 200)
    sizes = {name: len(ids) for name, ids in scene.sets.items()}
    assert sizes == {
        "ALL": 200,
        "Flowline": 40,
        "Trench Zone": 100,
        "Lower Riser": 20,
        "Upper Riser": 40,
        "Bare Riser": 120,
        "Fatigue Hot Spot": 20,
    }
    assert set(scene.diameter.tolist()) == {0.27305}
    assert scene.length == pytest.approx(np.repeat([5.0, 2.0, 5.0, 26.0], [40, 100, 20, 40]), rel=2e-3)


@pytest.mark.parametrize(
    ("curve", "strength", "gradient"), [("Trench Clay", 900.0, 1200.0), ("Flowline Clay", 1800.0, 1500.0)]
)
def test_clays_are_sampled_from_the_formula_that_their_comment_names(
    riser: Evaluated, curve: str, strength: float, gradient: float
) -> None:
    clay = riser.scene.curves[curve]
    expected = [round(penetration(ratio, 0.27305, strength, gradient)) for ratio in clay.ratios.tolist()]
    assert clay.forces.tolist() == expected


def test_riser_weight_in_water() -> None:
    scene = resolve(sample("scr-touchdown.keyxm"))
    # pi/4 (0.27305^2 - 0.22225^2) 7850 = 155.1285 kg/m of steel, pi/4 0.27305^2 1025 = 60.0203 kg/m of water
    assert submerged_weight(scene) == pytest.approx((155.1285 - 60.0203) * 9.81, rel=1e-5)


def test_flat_flowline_is_carried(riser: Evaluated) -> None:
    weight = submerged_weight(riser.scene)
    flat = slice(0, 31)
    reaction = riser.result.reaction[flat].sum(axis=0)
    # 30 elements and the half of the 31st that its first node carries
    carried = riser.scene.length[:30].sum() + 0.5 * riser.scene.length[30]
    assert reaction[0] == pytest.approx(weight * carried, rel=3e-3)
    assert reaction[1:].tolist() == [0.0, 0.0]


def test_riser_hangs_in_equilibrium(riser: Evaluated) -> None:
    """The bed carries what lies on it and the shear of the bend behind the touchdown point."""
    weight, contact = submerged_weight(riser.scene), riser.result.contact
    assert np.flatnonzero(contact).tolist() == list(range(97))
    on_bed = weight * riser.scene.length[contact].sum()
    total = riser.result.normal_force.sum()
    assert total == pytest.approx((riser.result.force * riser.scene.length).sum(), rel=1e-12)
    assert 1.0 < total / on_bed < 1.02
    in_trench = riser.line_force(slice(50, 97))
    assert int(in_trench.argmax()) + 51 == 91
    assert 1.1 < in_trench.max() / weight < 1.2


def test_riser_by_hand(riser: Evaluated) -> None:
    """Element 1: depth 0.0088. Element 91: depth (0.0597 + 0.0596)/2, on the segment (0.20, 1058) to (0.30, 1210)."""
    ratio = 0.0088 / 0.27305
    assert riser.result.ratio[0] == pytest.approx(ratio, rel=1e-12)
    assert riser.result.force[0] == pytest.approx(751 + (1195 - 751) / 0.03 * (ratio - 0.02), rel=1e-12)
    ratio = 0.05965 / 0.27305
    assert riser.result.ratio[90] == pytest.approx(ratio, rel=1e-12)
    assert riser.result.force[90] == pytest.approx(1058 + 1520 * (ratio - 0.2), rel=1e-12)
    assert riser.result.slope[90] == pytest.approx(1520, rel=1e-12)
    assert riser.result.stiffness[90] == pytest.approx(1520 / 0.27305, rel=1e-12)
    assert riser.scene.law_names[39:41] == ["curve:Flowline Clay", "curve:Trench Clay"]
    assert riser.scene.law_names[160] == "none"


def test_touchdown_moves_with_heave(riser: Evaluated) -> None:
    scene = riser.scene
    positions = read_positions(SAMPLES / "positions.csv", scene.nodes)
    assert positions.time is not None
    assert positions.time.tolist() == [1.5 * step for step in range(8)]
    assert scene.node_ids[positions.present].tolist() == list(range(71, 132))
    result = scene.contact().evaluate(positions.values, present=positions.present)
    assert int(result.evaluated.sum()) == 60
    last = [int(scene.element_ids[np.flatnonzero(step)[-1]]) for step in result.contact]
    assert last == [97, 95, 94, 95, 97, 99, 100, 99]
    total = np.nansum(result.normal_force, axis=1)
    assert np.argsort(total)[[0, -1]].tolist() == [2, 6]
    still = riser.result.force[result.evaluated]
    assert result.force[0, result.evaluated] == pytest.approx(still, rel=1e-12)
    assert result.force[4, result.evaluated] == pytest.approx(still, abs=5.0)


# ----------------------------------------------------------------------------------------------- the other decks


def test_legacy_line_is_carried_by_each_soil() -> None:
    line = evaluated(sample("legacy-flowline.keyxm"))
    weight = submerged_weight(line.scene)
    zones = {"curve:CLAY WEST": (0, 20), "curve:SAND": (21, 35), "linear": (36, 45), "curve:CLAY EAST": (46, 60)}
    for law, (start, stop) in zones.items():
        assert set(line.scene.law_names[start:stop]) == {law}
        assert line.line_force(slice(start, stop)) == pytest.approx(weight, rel=0.011)
    assert line.line_force(slice(40, 41)) == pytest.approx(40000.0 * 0.0082, rel=1e-12)
    ratio = 0.0055 / 0.2191
    assert line.line_force(slice(5, 6)) == pytest.approx(300 + 6000 * (ratio - 0.02), rel=1e-12)
    assert line.result.normal_force.sum() == pytest.approx(weight * 300.0, rel=0.02)


def test_legacy_curve_is_sorted() -> None:
    scene = resolve(sample("legacy-flowline.keyxm"))
    assert set(scene.curves) == {"CLAY WEST", "SAND", "CLAY EAST"}
    assert scene.curves["CLAY EAST"].ratios.tolist() == [0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5]
    for name, strength in (("CLAY WEST", 900.0), ("CLAY EAST", 1600.0)):
        curve = scene.curves[name]
        expected = [round(penetration(ratio, 0.2191, strength, 1500.0), -1) for ratio in curve.ratios.tolist()]
        assert curve.forces.tolist() == expected
    sand = scene.curves["SAND"]
    assert sand.forces.tolist() == [round(9000.0 * 0.2191**2 * (ratio / 0.037) ** 1.5, -1) for ratio in sand.ratios]


def test_imperial_riser() -> None:
    riser = evaluated(sample("imperial-riser.keyxi"))
    scene = riser.scene
    assert scene.units == "imperial"
    assert (len(scene.node_ids), len(scene.element_ids)) == (94, 93)
    assert scene.diameter.tolist() == [1.05] * 82 + [1.9] * 11
    assert [section.source for section in scene.section_table.sections] == ["Dd", "Do"]
    weight = submerged_weight(scene)  # (3.6 - 1.9888 pi/4 1.05^2) 32.174 lbf/ft
    assert weight == pytest.approx(60.419, abs=1e-3)
    assert np.flatnonzero(riser.result.contact).tolist() == list(range(30))
    ratio = 0.048 / 1.05
    assert riser.line_force(slice(0, 30)) == pytest.approx(40.2 + 800.0 * (ratio - 0.02), rel=1e-12)
    assert riser.result.normal_force.sum() == pytest.approx(weight * 300.0, rel=0.01)
    _, sections = next(scene.deck.blocks("GEOMETRIC SETS"))
    bare = cast("GeometricSets", sections).sets[0]
    assert (bare.ei_curve, bare.compression_check) == ("Bending", "YES")
    assert isinstance(bare.section, FlexibleSection)
    assert (bare.section.eiyy, bare.section.eizz, bare.section.gj) == (None, None, 2.6e6)


def test_parametric_values() -> None:
    deck = sample("parametric.keyxm")
    parameters = Parameters(deck)
    outer, wall = 10.75 * 0.0254, 0.719 * 0.0254
    inner = outer - 2 * wall
    area = math.pi / 4 * (outer**2 - inner**2)
    weight = (7850.0 * area - 1025.0 * math.pi / 4 * outer**2) * 9.81
    force = penetration(0.02, outer, 2000.0, 1400.0)
    expected = {
        "od": outer,
        "id": inner,
        "contents": 0.0,
        "weight": weight,
        "su_high": 3.2,
        "su0": 2.0,
        "f02": force,
        "ratio": 0.02 * weight / force,
        "embedded": 0.02 * weight / force * outer,
        "friction_axial": 0.4,
        "friction_lateral": 0.75,
        "mobilisation_1": 0.01 * outer,
        "mobilisation_2": 0.5 * outer,
    }
    values = {name: parameters.values[name] for name in expected}
    assert values == pytest.approx(expected, rel=1e-12)
    assert parameters.values["case folder"] == "Clay Cases"
    scene = resolve(deck)
    assert scene.diameter == pytest.approx(outer, rel=1e-15)
    assert scene.curves["Clay"].forces[[1, -1]] == pytest.approx(
        [force, penetration(0.5, outer, 2000.0, 1400.0)], rel=1e-12
    )
    assert scene.coordinates[-1].tolist()[1:] == [360.0 + 9 * 4.0, 0.0]


def test_parametric_deck_keeps_its_variations() -> None:
    deck = sample("parametric.keyxm")
    opaque = {block.keyword: block.lines for block in deck.sections[0].blocks if isinstance(block, Opaque)}
    assert set(opaque) == {"VARIATION", "COMBINATIONS"}
    assert opaque["VARIATION"][:2] == [" NAME=Low Clay", " PARA=Soil Case, VALUE=1"]


@pytest.mark.parametrize("soil", [1, 2, 3])
@pytest.mark.parametrize("flooded", [0, 1])
def test_every_case_of_the_parametric_deck_is_in_equilibrium(soil: int, flooded: int) -> None:
    name = "parametric.keyxm"
    text = (SAMPLES / name).read_text(encoding="utf-8")
    text = text.replace(" Soil Case, 2\n", f" Soil Case, {soil}\n").replace(" Flooded, 0\n", f" Flooded, {flooded}\n")
    deck = load_bytes(text.encode(), name)
    line = evaluated(deck)
    weight = cast("float", Parameters(deck).values["weight"])
    assert line.scene.law_names == ["curve:Clay"] * 90 + ["linear"] * 10
    assert line.line_force(slice(0, 90)) == pytest.approx(weight, rel=1e-9)
    mattress = 220e3 if soil == 3 else 150e3
    assert line.result.stiffness[90:] == pytest.approx(mattress, rel=1e-15)
    assert line.result.gap[line.scene.node_ids == 101] == pytest.approx(-weight / mattress, rel=1e-12)
    on_the_second_segment = [(1, 0), (1, 1), (2, 1)]
    assert (line.result.ratio[0] > 0.02) == ((soil, flooded) in on_the_second_segment)


def test_generated_flowline() -> None:
    line = evaluated(sample("flowline-gen.keyxm"))
    assert (len(line.scene.node_ids), len(line.scene.element_ids)) == (501, 500)
    assert line.scene.length == pytest.approx(4.0, rel=1e-12)
    assert line.line_force(slice(None)) == pytest.approx(485.0, rel=1e-12)
    assert line.result.normal_force.sum() == pytest.approx(submerged_weight(line.scene) * 2000.0, rel=1e-3)


def test_lines_deck_gets_its_elements_from_a_file() -> None:
    deck = sample("lines-deck.keyxm")
    assert len(resolve(deck).element_ids) == 0
    scene = resolve(deck, read_external(SAMPLES / "elements.csv")).require()
    assert (len(scene.node_ids), len(scene.element_ids)) == (81, 80)
    assert {name: len(ids) for name, ids in scene.sets.items()} == {
        "ALL": 80,
        "Umbilical": 80,
        "Static Section": 40,
        "Dynamic Section": 40,
    }
    positions = read_positions(SAMPLES / "lines-positions.csv", scene.nodes)
    assert positions.present.all()
    result = scene.contact().evaluate(positions.values[0])
    assert np.flatnonzero(result.contact).tolist() == list(range(42))
    weight = submerged_weight(scene)
    assert result.force[:42] == pytest.approx(weight, rel=5e-3)
    on_bed = 200.0 + 2 * 9.14
    assert result.normal_force.sum() == pytest.approx(weight * on_bed, rel=5e-3)
