"""Files by URL: which are refused, and what is said of those that cannot be read."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.cluster import storage
from mudline.cluster.storage import UrlError
from tests.builders.decks import CLEAN
from tests.cli.runner import run

pytest.importorskip("fsspec", reason="fsspec is not installed")


def test_a_file_url_is_a_path(folder: Path) -> None:
    (folder / "a b.keyxm").write_text(CLEAN, encoding="utf-8")
    url = f"{folder.as_uri()}/a%20b.keyxm"
    assert storage.as_path(url) == str(folder / "a b.keyxm")
    assert run("lint", url) == run("lint", folder / "a b.keyxm")
    assert run("validate", folder.as_uri()).out == run("validate", folder).out


@pytest.mark.parametrize(
    ("url", "why"),
    [
        ("memory://decks", "memory:// is not supported: what one process has in memory no other can read"),
        ("simplecache::s3://decks", "urls in urls are not supported"),
        ("nosuch://decks", "cannot be reached: protocol not known: nosuch"),
        ("file://host/decks", "a file:// url has three slashes, as in file:///folder/deck.keyxm"),
        ("local:///nowhere/decks", "nothing is at this url"),
    ],
)
@pytest.mark.parametrize("command", ["lint", "validate", "evaluate"])
def test_urls_that_cannot_be_read_are_named(command: str, url: str, why: str) -> None:
    done = run(command, url)
    assert done.code == 2
    assert f"mudline: {url}: {why}" in done.err


def test_a_url_without_its_library(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(_: str) -> None:
        raise ImportError("Install s3fs to access S3")

    storage._system.cache_clear()
    monkeypatch.setattr("fsspec.filesystem", missing)
    done = run("lint", "s3://decks")
    assert "s3://decks: s3:// needs a library: install s3fs to access s3" in done.err


def test_files_are_written_whole_and_listed(folder: Path) -> None:
    url = f"local://{folder.as_posix()}"
    assert storage.names_in(storage.join(url, "new")) == []
    storage.write(storage.join(url, "new/a.txt"), b"one")
    storage.write(storage.join(url, "new/a.txt"), b"other")
    assert storage.names_in(storage.join(url, "new")) == ["a.txt"]
    assert [path.name for path in (folder / "new").iterdir()] == ["a.txt"]
    [found] = storage.files_below(f"{url}/new")
    listed = storage.mark(found)
    assert listed == storage.mark(found) != ""
    assert storage.read(found) == b"other"
    assert storage.exists(found)
    assert not storage.exists(f"{url}/b.txt")
    assert storage.mark(f"{url}/b.txt") == ""
    with storage.local_copy(found) as path:
        assert path is not None
        assert Path(path).read_bytes() == b"other"
    assert not Path(path).exists()
    with pytest.raises(UrlError):
        storage.read(f"{url}/b.txt")


def test_files_by_path() -> None:
    assert storage.names_in("nowhere") == []
    storage.write("out/a.txt", b"one")
    assert storage.names_in("out") == ["a.txt"]
    assert storage.mark("out/a.txt").startswith("3 ")
    assert storage.exists(storage.join("out", "a.txt"))
    with storage.local_copy("out/a.txt") as path:
        assert path == "out/a.txt"
