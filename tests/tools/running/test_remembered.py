"""Results that are remembered: only what still holds, nothing that is damaged, and not more than fits."""

from __future__ import annotations

import os
from collections.abc import Callable
from hashlib import blake2b
from pathlib import Path

import pytest

from mudline.tools.running import remembered
from mudline.tools.running.remembered import Memory, of_working_folder, program


@pytest.fixture(autouse=True)
def _young(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remembered, "_COARSE", 0.0)  # files of a test are as young as its runs


def kept(path: Path, *files: str, settings: str = "") -> str:
    """The key of a result that a memory now holds."""
    memory = Memory(path, settings)
    key = memory.key("a", b"content")
    memory.put(key, [1, "é", [None]], files)
    memory.save()
    return key


def test_results_come_back_for_the_same_key(tmp_path: Path) -> None:
    path = tmp_path / "new" / "memory.txt"
    key = kept(path)
    memory = Memory(path)
    assert memory.get(key) == [1, "é", [None]]
    assert memory.get(memory.key("ac", b"ontent")) is None
    assert Memory(path, "other").key("a", b"content") != key
    memory.put(key, [])
    memory.save()
    assert Memory(path).get(key) == []


def test_another_program_knows_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "mudline"
    compiled = package / "contact" / "__pycache__"
    compiled.mkdir(parents=True)
    monkeypatch.setattr(remembered, "__file__", str(package / "running" / "remembered.py"))
    before = program()
    (compiled / "loops.nbi").write_bytes(b"compiled loops")
    assert program() == before
    (package / "contact" / "laws.py").write_text("two = 2\n", encoding="utf-8")
    second = program()
    assert second != before
    library = tmp_path / "numpy-9.9.dist-info"
    library.mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    third = program()
    assert third != second
    (library / "entry_points.txt").write_text("[mudline.rules]\n", encoding="utf-8")
    assert program() != third


def test_a_result_holds_while_its_files_do(tmp_path: Path) -> None:
    path, file, folder = tmp_path / "memory.txt", tmp_path / "a.txt", tmp_path / "b"
    folder.mkdir()
    file.write_text("one", encoding="utf-8")
    os.utime(file, (1.0, 1.0))
    key = kept(path, str(file), str(folder), str(tmp_path / "missing"))
    assert Memory(path).get(key) is not None
    file.write_text("two", encoding="utf-8")
    assert Memory(path).get(key) is None
    file.write_text("one", encoding="utf-8")
    assert Memory(path).get(key) is not None
    (folder / "new.txt").touch()
    assert Memory(path).get(key) is None


def test_what_changes_while_it_is_read_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").touch()
    monkeypatch.setattr(remembered, "_COARSE", 1000.0)
    key = kept(tmp_path / "memory.txt", str(tmp_path / "a.txt"))
    assert Memory(tmp_path / "memory.txt").get(key) is None


def foreign(data: bytes) -> bytes:
    """Results of another shape under a digest that is right."""
    body = data.partition(b"\n")[2].replace(b"[[1,", b"[[1:")
    return remembered._MAGIC + blake2b(body, digest_size=20).hexdigest().encode() + b"\n" + body


@pytest.mark.parametrize(
    "harm",
    [lambda data: data[:-9] + b"\n", lambda _: b"", lambda data: data + b"\xff", foreign],
    ids=["cut", "empty", "longer", "foreign"],
)
def test_damage_is_a_miss_and_is_written_over(tmp_path: Path, harm: Callable[[bytes], bytes]) -> None:
    path = tmp_path / "memory.txt"
    key = kept(path)
    good = path.read_bytes()
    path.write_bytes(harm(good))
    assert Memory(path).get(key) is None
    kept(path)
    assert path.read_bytes() == good


def test_number_and_size_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def filled(count: int) -> list[int]:
        """The numbers of the results that are still there."""
        memory = Memory(tmp_path / "memory.txt")
        keys = [memory.key(str(number)) for number in range(count)]
        for key in keys:
            memory.put(key, ["result"])
        memory.save()
        left = Memory(tmp_path / "memory.txt")
        return [number for number, key in enumerate(keys) if left.get(key) is not None]

    monkeypatch.setattr(remembered, "MOST_REMEMBERED", 5)
    assert filled(9) == [4, 5, 6, 7, 8]
    monkeypatch.setattr(remembered, "LARGEST_MEMORY", 1000 + 2 * (len('[["result"],{}]') + 42) + 1)
    assert filled(9) == [7, 8]
    monkeypatch.setattr(remembered, "LARGEST_MEMORY", 10)
    assert filled(9) == []
    monkeypatch.undo()
    monkeypatch.setattr(remembered, "LONGEST_REMEMBERED", 5)
    assert filled(9) == []


def test_working_folders_have_memories_of_their_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(remembered.PLACE, str(tmp_path / "cache"))
    monkeypatch.setattr(remembered, "MOST_MEMORIES", 2)
    for name in "abc":
        (tmp_path / name).mkdir()
        monkeypatch.chdir(tmp_path / name)
        memory = of_working_folder("lint", "")
        assert memory is not None
        assert memory.get(memory.key("a")) is None
        memory.put(memory.key("a"), [])
        memory.save()
    assert len(list((tmp_path / "cache").iterdir())) == 2
    monkeypatch.setattr(remembered, "cache_folder", lambda: None)
    assert of_working_folder("lint", "") is None


def test_a_place_that_cannot_be_written_is_no_fault(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    key = kept(tmp_path / "file" / "memory.txt")
    assert Memory(tmp_path / "file" / "memory.txt").get(key) is None


def test_places_of_the_systems(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(remembered.PLACE, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert remembered.cache_folder() == tmp_path / "mudline"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    monkeypatch.setattr("sys.platform", "linux")
    assert remembered.cache_folder() == tmp_path / ".cache" / "mudline"
    monkeypatch.setattr("sys.platform", "darwin")
    assert remembered.cache_folder() == tmp_path / "Library" / "Caches" / "mudline"
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    assert remembered.cache_folder() == tmp_path / "mudline" / "Cache"
