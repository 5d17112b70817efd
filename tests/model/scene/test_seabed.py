"""The shape of the seabed: what the deck says, and what its files hold."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from mudline.language.deck.loading import load_path
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.seabed import SeabedKind, read_profile
from tests.helpers.builders.decks import PIPE
from tests.helpers.builders.scenes import scene_of

PROFILE = "*SEABED PROFILE\n TYPE=2D\n INTERPOLATION=CUBIC SPLINE, DIRECTION=30\n FILE={}\n"


def scene_in(folder: Path, text: str) -> Scene:
    path = folder / "deck.keyxm"
    path.write_text(text, encoding="utf-8")
    return resolve(load_path(path))


def reported(scene: Scene) -> list[tuple[str, int, int]]:
    found = scene.deck.diagnose([*scene.deck.problems, *scene.problems])
    return [(one.code, one.line, one.column) for one in found]


def test_slope() -> None:
    seabed = scene_of(PIPE + "*SEABED PROFILE\n TYPE=SLOPING\n DIRECTION=90\n SLOPE=-2.5\n").seabed
    assert (seabed.kind, seabed.slope, seabed.direction) == (SeabedKind.SLOPING, -2.5, 90.0)


@pytest.mark.parametrize("surface", ["*ELASTIC SURFACE\n 1e4\n", "*RIGID SURFACE\n 0.3\n"])
def test_slope_and_profile_of_a_surface(surface: str) -> None:
    seabed = scene_of(PIPE + surface + " 3.5\n").seabed
    assert (seabed.kind, seabed.slope) == (SeabedKind.SLOPING, 3.5)
    seabed = scene_of(PIPE + surface + " 100, 30\n 0, 0\n").seabed
    assert (seabed.kind, seabed.points.tolist()) == (SeabedKind.PROFILE, [[100.0, 30.0], [0.0, 0.0]])


def test_a_profile_comes_before_a_surface_and_planes_before_both() -> None:
    surface, profile = "*ELASTIC SURFACE\n 1e4\n 3.5\n", "*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=1\n"
    planes = "*SEABED PLANES\n PLANE=a\n POINT=1, 2, 3\n SLOPE=4, DIRECTION=5\n BOUNDS=, 7, 8\n PLANE=b\n"
    assert scene_of(PIPE + profile + surface).seabed.slope == 1.0
    seabed = scene_of(PIPE + planes + profile + surface).seabed
    assert seabed.kind is SeabedKind.PLANES
    first, second = seabed.planes
    assert (first.point, first.slope, first.direction) == ((1.0, 2.0, 3.0), 4.0, 5.0)
    assert first.bounds == (-math.inf, 7.0, 8.0, math.inf)
    assert math.isnan(second.slope)


def test_a_text_file_of_points(tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("C Y, elevation\n100.0, 30.0\n\n 0.0 0.0\n-5,1E1,\n", encoding="utf-8")
    scene = scene_in(tmp_path, PIPE + PROFILE.format('".\\bed.txt"'))
    seabed = scene.seabed
    assert seabed.points.tolist() == [[100.0, 30.0], [0.0, 0.0], [-5.0, 10.0]]
    assert (seabed.interpolation, seabed.direction, seabed.missing) == ("CUBIC SPLINE", 30.0, "")
    assert "SBD023" not in [code for code, _, _ in reported(scene)]


def test_three_columns_make_a_surface(tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("1, 2, 3\n4, 5, 6\n7, 8, 10\n", encoding="utf-8")
    seabed = scene_in(tmp_path, PIPE + "*SEABED PROFILE\n TYPE=3D\n FILE=bed.txt\n").seabed
    assert seabed.kind is SeabedKind.SURFACE
    assert seabed.points.tolist() == [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 10.0]]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"0, 0\n1, x\n", "line 2: 'x' is not a number"),
        (b"0, 0\n\n1\n", "line 3: expected 2 numbers (`Y, elevation`), found 1"),
        (b"0, 0\n1, 2, 3\n", "line 2: expected 2 numbers"),
        (b"C nothing\n0, 0\n", "the file has 1 point: a profile needs at least two"),
        (b"", "the file has 0 points"),
        (b"0, 0\n1, 1E999\n", "line 2: '1E999' is not a number"),
        (bytes(range(32)) * 50, "looks like binary data"),
    ],
)
def test_a_file_with_a_fault_is_told_at_file(tmp_path: Path, content: bytes, words: str) -> None:
    (tmp_path / "bed.txt").write_bytes(content)
    scene = scene_in(tmp_path, PIPE + PROFILE.format("bed.txt"))
    line = PIPE.count("\n") + 4
    assert ("SBD023", line, 7) in reported(scene)
    assert words in scene.seabed.missing
    assert scene.seabed.points.size == 0


def test_a_compiled_profile_is_kept_and_reported_unless_the_file_is_missing(tmp_path: Path) -> None:
    text = PIPE + PROFILE.format("Bed.FCSBD")
    for there in (False, True):
        if there:
            (tmp_path / "Bed.FCSBD").write_bytes(b"\x00\x01")
        scene = scene_in(tmp_path, text)
        place = PIPE.count("\n") + 4, 7
        assert {code for code, *at in reported(scene) if tuple(at) == place} == {"SBD023" if there else "REF015"}
        assert len(scene.blocking()) == 1
        assert "binary" in scene.seabed.missing
        assert scene.seabed.file == "Bed.FCSBD"


def test_a_deck_without_a_path_reads_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bed.txt").write_text("0, 0\n1, 1\n", encoding="utf-8")
    assert scene_of(PIPE + PROFILE.format("bed.txt")).seabed.missing == "'bed.txt' was not found"


@pytest.mark.parametrize("name", ["nothing.txt", "folder", "a\0b", "n" * 5000, "=[x]", '""'])
def test_a_file_that_is_not_there_is_no_fault_of_the_profile(tmp_path: Path, name: str) -> None:
    (tmp_path / "folder").mkdir()
    scene = scene_in(tmp_path, PIPE + PROFILE.format(name))
    assert scene.seabed.missing.endswith("was not found")


def test_a_file_that_may_not_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "bed.txt").write_text("0, 0\n1, 1\n", encoding="utf-8")

    def refuse(path: Path) -> bytes:
        raise PermissionError(13, "Permission denied", str(path))

    path = tmp_path / "deck.keyxm"
    path.write_text(PIPE + PROFILE.format("bed.txt"), encoding="utf-8")
    deck = load_path(path)
    monkeypatch.setattr(Path, "read_bytes", refuse)
    scene = resolve(deck)
    assert scene.seabed.missing == "Permission denied"
    assert ("SBD023", PIPE.count("\n") + 4, 7) in reported(scene)


def test_a_file_of_enormous_size_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.model.scene.seabed.LARGEST_FILE", 3)
    (tmp_path / "bed.txt").write_text("0, 0\n1, 1\n", encoding="utf-8")
    with pytest.raises(ValueError, match="is it a profile"):
        read_profile(tmp_path / "bed.txt", 2)
