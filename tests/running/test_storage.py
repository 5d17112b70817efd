"""Files at URLs, in fsspec's memory and local file systems."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from mudline.running import storage
from mudline.running.storage import UrlError
from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.runner import run

fsspec = pytest.importorskip("fsspec", reason="fsspec is not installed")


@pytest.fixture
def store() -> Iterator[str]:
    """A folder of the memory file system, empty before and after the test."""
    yield "memory://store"
    fsspec.filesystem("memory").store.clear()


def test_a_file_url_is_a_path(tmp_path: Path) -> None:
    (tmp_path / "a b.keyxm").write_text(CLEAN, encoding="utf-8")
    assert storage.as_path(f"{tmp_path.as_uri()}/a%20b.keyxm") == str(tmp_path / "a b.keyxm")
    assert run("validate", tmp_path.as_uri()).out == run("validate", tmp_path).out


def test_files_are_written_whole_and_listed(tmp_path: Path, store: str) -> None:
    for folder in (store, f"local://{tmp_path.as_posix()}/new"):
        url = storage.join(folder, "deep/a.txt")
        assert not storage.exists(url)
        storage.write(url, b"one")
        storage.write(url, b"other")
        [found] = storage.files_below(folder)
        assert found.endswith("/deep/a.txt")
        assert storage.read(found) == b"other"
        assert storage.read(found, 2) == b"ot"
        assert storage.exists(found)
        assert storage.is_folder(folder)
        assert storage.size_and_date(found)[0] == 5
        with pytest.raises(UrlError, match="nothing is at this URL"):
            storage.read(f"{folder}/b.txt")
    assert [path.name for path in (tmp_path / "new" / "deep").iterdir()] == ["a.txt"]


def test_decks_are_read_from_urls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, store: str) -> None:
    monkeypatch.chdir(tmp_path)
    Path("decks").mkdir()
    texts = {
        "a.keyxm": CLEAN,
        "b.keyxm": BAD_NUMBER,
        "deck.json": '{"format": "mudline-deck/1", "sections": 1}',
        "other.json": "{}",
    }
    for name, text in texts.items():
        Path("decks", name).write_text(text, encoding="utf-8")
        storage.write(f"{store}/decks/{name}", text.encode())
    for command in ("lint", "validate"):
        words = ("--output-format", "json")
        near, far = run(command, "decks", *words), run(command, f"{store}/decks", *words)
        assert far.code == near.code == 1
        assert far.out.replace(f"{store}/", "") == near.out


@pytest.mark.parametrize(
    ("url", "why"),
    [
        ("nosuch://decks", "cannot be reached: protocol not known: nosuch"),
        ("file://host/decks", "a file:// url has three slashes, as in file:///folder/deck.keyxm"),
        ("memory://nowhere/decks", "nothing is at this url"),
    ],
)
def test_urls_that_cannot_be_read_are_named(url: str, why: str) -> None:
    done = run("lint", url)
    assert done.code == 2
    assert f"mudline: {url}: {why}" in done.err


def test_a_url_without_its_library(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(_: str) -> None:
        raise ImportError("Install s3fs to access S3")

    monkeypatch.setattr("fsspec.core.url_to_fs", missing)
    assert "s3://decks: cannot be reached: install s3fs to access s3" in run("lint", "s3://decks").err
