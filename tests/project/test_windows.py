"""What Windows has and this system need not: drives, and consoles of a byte a character. They run everywhere."""

from __future__ import annotations

import ntpath
from collections import Counter
from types import SimpleNamespace

import pytest

from tests.cli.runner import ROOT, run

PROMISED = ("cp1252", "cp850", "cp437")
"""The consoles of western Europe and America."""


@pytest.fixture
def windows(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """Paths as they are there: an `os` for modules that make some, where only D:/here/there.keyxm exists."""
    path = SimpleNamespace(**vars(ntpath))
    path.lexists = lambda name: name == r"D:\here\there.keyxm"
    names = SimpleNamespace(path=path, sep="\\", curdir=".", fspath=str)
    monkeypatch.setattr("mudline.basics.paths.os", names)
    return names


def test_an_archive_holds_decks_of_another_drive(windows: SimpleNamespace, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("duckdb")
    from mudline.tools.archive import updating  # noqa: PLC0415 - needs DuckDB

    monkeypatch.setattr(updating, "os", windows)
    archive = updating.Archive.__new__(updating.Archive)
    archive._root = r"C:\project"
    archive._gone = []
    archive.counts = Counter()
    there, gone = archive.place(r"D:\here\there.keyxm"), archive.place(r"D:\here\gone.keyxm")
    assert (there, archive.place(r"C:\project\a.keyxm")) == ("D:/here/there.keyxm", "a.keyxm")
    archive._known = {there: "", gone: ""}
    archive.remove_gone(set(), [], everywhere=True)
    assert archive._gone == [gone]


@pytest.mark.alike
@pytest.mark.parametrize("encoding", PROMISED)
@pytest.mark.parametrize(
    "words",
    [
        ("lint", "samples/broken.keyxm"),
        ("validate", "samples/legacy-flowline.keyxm", "samples/broken.keyxm"),
        ("show", "samples/scr-touchdown.keyxm"),
        ("curves", "samples/scr-touchdown.keyxm", "--weight", "300"),
        ("evaluate", "samples/scr-touchdown.keyxm"),
        ("rules", "CRV003"),
        ("diff", "samples/parametric.keyxm", "samples/variations.keyxm"),
        ("backbone", "--help"),
    ],
    ids=lambda words: words[0],
)
def test_a_console_of_one_byte_a_character_shows_everything(
    words: tuple[str, ...], encoding: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    outcome = run(*words, terminal=True, encoding=encoding)
    assert outcome.code in {0, 1}
    assert outcome.output
    assert b"\\u" not in outcome.output + outcome.errors
    assert b"\\x" not in outcome.output + outcome.errors
