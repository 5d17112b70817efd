"""Decks that continue others: what is found, what holds, what is told, and of which file."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules, select
from mudline.language.deck.loading import load_bytes, load_path
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError
from mudline.model.scene import restart
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.weights import stiffnesses
from tests.checks.findings import CLAY, CURVES, PIPE, PROPERTIES

STATIC = PIPE + "*ELEMENT SETS\n SET=Buried\n GEN=1, 4\n" + PROPERTIES + " STIFFNESS=Clay\n*SEABED STIFFNESS\n" + CLAY
RESTART = "$LOAD CASE\n*RESTART\n LAST={}\n"
DYNAMIC = RESTART.format("static")
USES = "$MODEL\n*ELEMENT SETS\n SET=More\n SUBSET=Buried\n 9\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "static.keyxm").write_text(STATIC)
    return tmp_path


def deck(folder: Path, text: str = DYNAMIC, name: str = "dynamic.keyxm") -> Deck:
    (folder / name).write_text(text)
    return load_path(folder / name)


def scene(folder: Path, text: str = DYNAMIC, name: str = "dynamic.keyxm") -> Scene:
    return resolve(deck(folder, text, name))


def lint(folder: Path, text: str, *codes: str, name: str = "dynamic.keyxm") -> list[str]:
    """Line, column, code and message of each finding."""
    (folder / name).write_text(text)
    chosen = select(codes) if codes else rules()
    found = lint_bytes(text.encode(), (folder / name).as_posix(), chosen, folder=folder)
    assert {Path(one.file).name for one in found} <= {name}
    return [f"{one.line}:{one.column} {one.severity.value} {one.code} {one.message}" for one in found]


def same_model(one: Scene, other: Scene) -> None:
    assert one.element_ids.tolist() == other.element_ids.tolist()
    assert np.array_equal(one.coordinates, other.coordinates)
    assert np.array_equal(one.diameter, other.diameter)
    assert one.law_names == other.law_names
    assert one.law_sets == other.law_sets


# ------------------------------------------------------------------------------------------------------ what it knows


def test_a_dynamic_deck_has_the_model_of_its_static_one(folder: Path) -> None:
    found = scene(folder, DYNAMIC + USES)
    same_model(found, resolve(load_path(folder / "static.keyxm")))
    assert found.sets["More"].tolist() == [1, 2, 3, 4, 9]
    assert found.set_table.everything.open is False
    assert found.problems == []
    before = resolve(load_path(folder / "static.keyxm")).contact().evaluate()
    assert np.array_equal(found.contact().evaluate().force, before.force)


def test_a_name_that_no_deck_defines_is_an_error(folder: Path) -> None:
    assert lint(folder, DYNAMIC + USES.replace("Buried", "Buryed"), "REF008") == [
        "7:9 error REF008 SUBSET= names no set: 'Buryed' is not defined (did you mean Buried?); define it"
    ]


def test_what_the_deck_says_itself_holds(folder: Path) -> None:
    own = "$MODEL\n" + PROPERTIES + " STIFFNESS=700.0\n"
    found = scene(folder, own + DYNAMIC)
    assert set(found.law_names) == {"linear"}
    assert [section.name for section in found.deck.own_sections] == ["MODEL", "LOAD CASE"]


def test_of_two_legacy_surfaces_that_of_the_deck_itself_holds(folder: Path) -> None:
    def surface(stiffness: float, friction: float, slope: float) -> str:
        return f"$MODEL\n*ELASTIC SURFACE\n {stiffness}, {friction}, {friction}\n {slope}\n"

    (folder / "static.keyxm").write_text(STATIC + surface(50000.0, 0.3, 1.0))
    found = scene(folder, DYNAMIC + surface(70000.0, 0.1, 5.0))
    surfaces = [law for law in found.laws.set_laws if law.family == "legacy" and law.stiffness > 0.0]
    assert surfaces[-1].stiffness == 70000.0
    assert found.resistance.values[0].friction == (0.3, 0.3)
    assert found.resistance.values[1].friction == (0.1, 0.1)
    assert found.seabed.slope == 5.0


def test_a_stiffness_curve_of_the_deck_itself_holds(folder: Path) -> None:
    curve = "*MOMENT-CURVATURE\n CURVE=K\n 0.0, 0.0\n {}, 0.1\n"
    section = "*GEOMETRIC SETS\n OPTION=FLEXIBLE\n SET=ALL, EI=K\n , , 1.0E5, 1.0E8, 50.0, 0.1, 0.2, 0.3, 0.3\n"
    (folder / "static.keyxm").write_text(PIPE + section + curve.format(100.0))
    for own, expected in (("", 1000.0), ("$MODEL\n" + curve.format(900.0), 9000.0)):
        found = scene(folder, own + DYNAMIC)
        assert stiffnesses(found, found.section_table.sections[-1]).bending == pytest.approx(expected)


def test_each_deck_has_its_own_parameters(folder: Path) -> None:
    head = "$PREPROCESSOR\n*PARAMETERS\n k, {}\n"
    model = PIPE + "*ELEMENT SETS\n SET=A\n 1, 2\n" + PROPERTIES + " STIFFNESS==[k]\n"
    (folder / "static.keyxm").write_text(head.format(500.0) + model)
    own = "$MODEL\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=A\n STIFFNESS==[k]\n"
    found = scene(folder, head.format(900.0) + DYNAMIC + own)
    assert found.contact_input().assigned["linear"]["stiffness"].tolist() == [900.0] * 2 + [500.0] * 8
    assert any("parameter k is not defined" in line for line in lint(folder, DYNAMIC + own))


def test_units_come_from_the_deck_before(folder: Path) -> None:
    assert scene(folder, name="dynamic.keyx").units == "metric"
    assert scene(folder, name="dynamic.keyxi").units == "imperial"
    assert deck(folder, name="dynamic.keyx").units == "user"


def test_a_profile_is_looked_for_beside_the_deck_that_names_it(folder: Path) -> None:
    (folder / "base").mkdir()
    (folder / "base" / "bed.txt").write_text("0, -1\n10, -2\n")
    (folder / "base" / "static.keyxm").write_text(STATIC + "*SEABED PROFILE\n TYPE=2D\n FILE=bed.txt\n")
    found = scene(folder, RESTART.format("base\\static"))
    assert found.seabed.points.tolist() == [[0.0, -1.0], [10.0, -2.0]]


# ------------------------------------------------------------------------------------------------------ which file


@pytest.mark.parametrize(
    ("written", "file"),
    [
        ("run.out", "run.out"),
        ("run", "run.keyxi"),
        ("run", "run.keyx"),
        ("run", "run.das"),
        ("run", "run.keyxm"),
        ('"my run"', "my run.keyxm"),
        ("RUN", "run.KEYXM"),
        ("other/run", "other/run.keyxm"),
        ("other\\Run", "other/run.keyxm"),
        ("run_%Hs%_%n%", "run_Far_8.keyxm"),
        ("run.v2", "run.v2.keyxm"),
    ],
)
def test_names(tmp_path: Path, written: str, file: str) -> None:
    path = tmp_path / file
    path.parent.mkdir(exist_ok=True)
    path.write_text(STATIC)
    text = "$PREPROCESSOR\n*PARAMETERS\n Hs, Far\n N, =[4*2]\n" + RESTART.format(written)
    found = scene(tmp_path, text)
    assert len(found.element_ids) == 10
    assert [base.deck.file for base in found.deck.bases] == [path.as_posix()]


def test_the_suffix_of_the_deck_itself_comes_first(folder: Path) -> None:
    (folder / "static.keyx").write_text("$MODEL\n*NODE\n 1, 2, 3\n")
    assert len(scene(folder, name="dynamic.keyx").element_ids) == 0
    assert len(scene(folder, name="dynamic.das").element_ids) == 10
    (folder / "static").write_text("$MODEL\n*NODE\n 1, 2, 3\n 2, 3, 4\n")
    assert len(scene(folder).node_ids) == 2


def test_text_and_bytes_do_not_touch_the_disk(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    with patch("mudline.model.scene.restart.find_deck", side_effect=AssertionError):
        found = resolve(load_bytes(DYNAMIC.encode(), "dynamic.keyxm"))
    assert len(found.element_ids) == 0
    assert found.problems == []


# ------------------------------------------------------------------------------------------------------ chains, faults


def test_the_last_of_several_holds(folder: Path) -> None:
    (folder / "other.keyxm").write_text("$MODEL\n*NODE\n 1, 2, 3\n")
    text = DYNAMIC + RESTART.format("gone") + RESTART.format("other")
    assert scene(folder, text).node_ids.tolist() == [1]
    (line,) = lint(folder, text, "REF015")
    assert line.startswith("6:7 warning REF015 the deck 'gone' was not found")


def test_a_chain_is_followed(folder: Path) -> None:
    (folder / "second.keyxm").write_text(DYNAMIC + USES)
    third = RESTART.format("second") + "$MODEL\n*ELEMENT SETS\n SET=Last\n SUBSET=More\n"
    found = scene(folder, third)
    assert found.sets["Last"].tolist() == [1, 2, 3, 4, 9]
    assert found.problems == []


def test_a_missing_deck_is_told_with_the_names_that_were_tried(folder: Path) -> None:
    (folder / "static.keyxm").unlink()
    first, second = lint(folder, DYNAMIC + USES, "REF015", "REF008")
    tried = "static, static.keyxm, static.keyxi, static.keyx, static.das"
    assert first == (
        f"3:7 warning REF015 the deck 'static' was not found (looked in {folder.as_posix()} for {tried}): "
        "correct the name, or put the deck there"
    )
    assert second.startswith("7:9 warning REF008")
    assert second.endswith("the deck that *RESTART continues may define it")


def test_a_chain_that_breaks_behind_the_first_deck_is_told_there(folder: Path) -> None:
    second = RESTART.format("gone") + "$MODEL\n*NODE\n 1, 2, 3\n"
    (folder / "static.keyxm").write_text(second)
    found = lint(folder, DYNAMIC + USES)
    assert [line.split()[:3] for line in found] == [["7:9", "warning", "REF008"], ["8:2", "warning", "REF005"]]
    assert all(line.endswith("the deck that *RESTART continues may define it") for line in found)
    assert [one.split()[2] for one in lint(folder, second, "REF015", name="static.keyxm")] == ["REF015"]


def test_a_restart_that_was_not_understood_hides_what_is_before_it(folder: Path) -> None:
    (folder / "static.keyxm").write_text("$LOAD CASE\n*RESTART\n FROM=first\n")
    found = lint(folder, DYNAMIC + USES)
    assert [line.split()[:3] for line in found] == [["7:9", "warning", "REF008"], ["8:2", "warning", "REF005"]]
    assert all(line.endswith("the deck that *RESTART continues may define it") for line in found)


def test_a_circle_ends(folder: Path) -> None:
    (folder / "static.keyxm").write_text(RESTART.format("DYNAMIC") + STATIC)
    (line,) = lint(folder, DYNAMIC)
    assert line == (
        "3:7 warning REF015 LAST= leads back to a deck that is open already "
        "(dynamic.keyxm -> static.keyxm -> dynamic.keyxm): choose the deck of the run before"
    )
    assert lint(folder, RESTART.format("static"), name="third.keyxm") == []
    (line,) = lint(folder, RESTART.format("own"), name="own.keyxm")
    assert "(own.keyxm -> own.keyxm)" in line


def test_a_very_long_chain_ends(tmp_path: Path) -> None:
    for number in range(30):
        (tmp_path / f"run{number}.keyxm").write_text(RESTART.format(f"run{number + 1}"))
    found = resolve(load_path(tmp_path / "run0.keyxm"))
    assert len(found.deck.bases) == 20
    assert found.context.restart is True
    assert found.problems == []


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "has no section: it is not a deck"),
        (b"\x00\x01\x02" * 50, "has no section: it is not a deck"),
        (b"x" * 5000, "has more than 0 million bytes"),
    ],
)
def test_a_file_that_is_no_deck(folder: Path, content: bytes, reason: str) -> None:
    (folder / "static.keyxm").write_bytes(content)
    with patch.object(restart, "LARGEST_FILE", 4000):
        (line,) = lint(folder, DYNAMIC, "REF015")
    assert line.startswith("3:7 warning REF015 the deck that LAST= continues is not read: ")
    assert reason in line


# ---------------------------------------------------------------------------------------------- whose finding it is


def test_a_file_that_may_not_be_read(folder: Path) -> None:
    (folder / "dynamic.keyxm").write_text(DYNAMIC)
    with patch.object(restart, "load_path", side_effect=PermissionError(13, "Permission denied")):
        found = resolve(load_path(folder / "dynamic.keyxm"))
    (problem,) = found.problems
    assert problem.message.startswith("the deck that LAST= continues is not read: ")
    assert "static.keyxm: Permission denied" in problem.message


def test_what_is_wrong_in_the_deck_before_is_told_there(folder: Path) -> None:
    broken = STATIC.replace("STIFFNESS=Clay", "STIFFNESS=Cly").replace("0.25, 0.22", "0.25, x")
    (folder / "static.keyxm").write_text(broken)
    assert lint(folder, DYNAMIC) == []
    with pytest.raises(DeckError) as raised:
        scene(folder).require()
    places = {(Path(one.file).name, one.line, one.code) for one in raised.value.diagnostics}
    lines = broken.split("\n")
    stiffness = next(number for number, line in enumerate(lines, 1) if "Cly" in line)
    section = next(number for number, line in enumerate(lines, 1) if "0.25, x" in line)
    assert {("static.keyxm", stiffness, "REF002"), ("static.keyxm", section, "SYN002")} <= places


def test_a_lost_line_of_the_deck_itself_leaves_the_deck_before_alone(folder: Path) -> None:
    curves = CURVES + " CURVE=Sand\n 0, 0\n 1, 5\n DEPTH=3\n"
    found = scene(folder, DYNAMIC + curves)
    assert found.law_names == ["curve:Clay"] * 10
    assert [line.split()[2] for line in lint(folder, DYNAMIC + curves, "SYN")] == ["SYN004"]


_PIECES = st.lists(
    st.sampled_from(["$MODEL", *STATIC.split("\n"), *USES.split("\n"), " 1, x", " GEN=1,", "$X", ""]), max_size=40
)


@given(_PIECES, _PIECES)
def test_whatever_the_decks_hold_findings_lie_in_the_deck_itself(base: list[str], own: list[str]) -> None:
    with TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "static.keyxm").write_text("\n".join(base))
        text = "\n".join([*own, DYNAMIC])
        for line in lint(folder, text):
            assert int(line.partition(":")[0]) <= text.count("\n") + 1
        found = scene(folder, text)
        assert len(found.deck.diagnose(found.problems)) == len(found.problems)
