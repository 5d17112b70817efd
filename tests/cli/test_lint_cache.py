"""The cache of `mudline lint`: what it spares, and that it never tells what is not so."""

from __future__ import annotations

from collections.abc import Callable
from hashlib import blake2b
from pathlib import Path

import pytest

from mudline import cache_folder
from mudline.cli import lint_jobs
from mudline.diagnostics import Diagnostic
from mudline.linting import cache
from mudline.linting.cache import packed, unpacked
from mudline.linting.engine import LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import rules
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.conftest import Place
from tests.cli.runner import run

Linted = list[str]


@pytest.fixture
def linted(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Linted:
    """The files that were really linted; the smallest run asks the cache, which stands in the folder."""
    names: Linted = []

    def lint(name: str, data: bytes, settings: LintSettings, place: Path | None = None) -> FileReport:
        names.append(name)
        return lint_one(name, data, settings, place)

    monkeypatch.setenv(cache_folder.PLACE, str(folder / "cache"))
    monkeypatch.setattr(lint_jobs, "CACHED_FILES", 1)
    monkeypatch.setattr(lint_jobs, "lint_one", lint)
    return names


def stored(folder: Path) -> Path:
    [path] = (folder / "cache").iterdir()
    return path


def test_second_run_lints_nothing_and_says_the_same(place: Place, linted: Linted) -> None:
    words = ("lint", place(), place(BAD_NUMBER, "bad.keyxm"), place(UNSORTED, "c.keyxm"), "--output-format", "json")
    first = run(*words)
    assert len(linted) == 3
    assert {row["code"] for row in first.json()} == {"SYN002", "CRV002"}
    assert run(*words) == first
    assert len(linted) == 3


@pytest.mark.parametrize(
    "words", [["--ignore", "SYN"], ["--units", "imperial"], ["--dialect", "flexcom"], ["--no-cache"], ["--fix"]]
)
def test_other_settings_are_other_runs(place: Place, linted: Linted, words: list[str]) -> None:
    run("lint", place(BAD_NUMBER))
    run("lint", "deck.keyxm", *words)
    assert linted == ["deck.keyxm"] * 2


def test_severity_of_a_configuration_counts(place: Place, linted: Linted) -> None:
    assert run("lint", place(UNSORTED)).code == 0
    place("severity = { CRV002 = 'error' }\n", "mudline.toml")
    assert run("lint", "deck.keyxm").code == 1
    assert len(linted) == 2


def test_changed_content_is_linted_again_though_size_and_time_stay(place: Place, linted: Linted) -> None:
    run("lint", place(CLEAN))
    assert run("lint", place(CLEAN.replace("10.0\n", "1x.0\n"))).code == 1
    assert len(linted) == 2


@pytest.mark.parametrize(
    ("path", "change"),
    [("version", lambda name: f"{name} 9.9"), ("_PACKAGES", ("click", "none-such"))],
    ids=["version", "libraries"],
)
def test_another_program_knows_nothing(
    place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch, path: str, change: object
) -> None:
    run("lint", place())
    monkeypatch.setattr(cache, path, change)
    run("lint", "deck.keyxm")
    assert len(linted) == 2


def test_deck_that_names_a_file_is_linted_each_time(place: Place, linted: Linted) -> None:
    restart = "$LOAD CASE\n*RESTART\n LAST=static\n*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05\n"
    assert "REF015" in run("lint", place(restart, "wave.keyxm"), "--output-format", "concise").out
    place(name="static.keyxm")
    assert "REF015" not in run("lint", "wave.keyxm", "--output-format", "concise").out
    assert len(linted) == 2


@pytest.mark.parametrize(
    ("name", "data", "alone"),
    [
        ("a.keyxm", b" TYPE=ELASTIC\nC the last file\n", True),
        ("a.keyxm", b" file = x\n", False),
        ("a.keyxm", b"*restart\n", False),
        ("a.keyxm", " f\u0131le=x\n".encode(), False),
        ("a.keyxm", " FILE=x\n".encode("utf-16"), False),
        ("a.json", b'{"f\\u0069le": 1}', False),
        ("a.yaml", b"depth: 1", True),
    ],
)
def test_decks_that_stand_alone(name: str, data: bytes, alone: bool) -> None:
    assert cache.stands_alone(name, data) is alone


def damaged(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
    return lambda path: (path.write_bytes(change(path.read_bytes())), None)[1]


def resigned(path: Path) -> None:
    """Findings of another shape under a digest that is right."""
    body = path.read_bytes().partition(b"\n")[2].replace(b'"error"', b'"awful"')
    digest = blake2b(body, digest_size=20).hexdigest().encode()
    path.write_bytes(b"mudline-lint-cache/1 " + digest + b"\n" + body)


@pytest.mark.parametrize(
    "harm",
    [damaged(lambda data: data[:-9] + b"\n"), damaged(lambda _: b""), damaged(lambda data: data + b"\xff"), resigned],
    ids=["cut", "empty", "longer", "resigned"],
)
def test_damaged_cache_is_ignored_and_written_anew(
    folder: Path, place: Place, linted: Linted, harm: Callable[[Path], None]
) -> None:
    first = run("lint", place(BAD_NUMBER))
    good = stored(folder).read_bytes()
    harm(stored(folder))
    assert run("lint", "deck.keyxm") == first
    assert len(linted) == 2
    assert stored(folder).read_bytes() == good


def test_place_that_cannot_be_written(place: Place, linted: Linted) -> None:
    place("a file", "cache")
    first = run("lint", place())
    assert (first.code, first.err) == (0, "")
    assert run("lint", "deck.keyxm") == first
    assert len(linted) == 2


def test_standard_input_asks_nothing(folder: Path, linted: Linted) -> None:
    run("lint", "-", stdin=CLEAN.encode())
    assert linted
    assert not (folder / "cache").exists()


def test_small_runs_ask_nothing(folder: Path, place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lint_jobs, "CACHED_FILES", 50)
    run("lint", place(), "missing.keyxm")
    assert linted
    assert not (folder / "cache").exists()


def test_no_place_at_all(place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.linting.cache.cache_folder", lambda: None)
    assert run("lint", place()).code == 0
    assert linted


def test_entries_come_back_whole() -> None:
    found = lint_one("a.keyxm", UNSORTED.encode() + BAD_NUMBER.encode(), LintSettings(rules())).found
    assert any(one.fix for one in found)
    assert unpacked(packed(found), "a.keyxm") == found


@pytest.mark.parametrize(
    "text",
    [
        "{}",
        "[1]",
        "[[]]",
        "nonsense",
        "[" * 100_000,
        '[["a","b","error","m",0,1,1,1,null,true]]',
        '[["a","b","error","m",1,1,1,1,null,1]]',
    ],
)
def test_entries_of_another_shape(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - of whatever kind
        unpacked(text, "a.keyxm")


def test_fix_of_another_kind() -> None:
    text = '[["a","b","error","m",1,1,1,1,["sure","x",[]],true]]'
    with pytest.raises(ValueError, match="no fix"):
        unpacked(text, "a")
    assert unpacked(text.replace("sure", "safe"), "a")[0].fix is not None
    assert isinstance(unpacked(text.replace("sure", "safe"), "a")[0], Diagnostic)


def test_number_and_size_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    keys = [f"{i:040}" for i in range(9)]
    monkeypatch.setattr(cache, "MOST_ENTRIES", 5)
    monkeypatch.setattr(cache, "MOST_FILES", 2)
    for name in "abc":
        cache.write_entries(tmp_path / f"lint-{name}.txt", dict.fromkeys(keys, ""))
    assert len(list(tmp_path.iterdir())) == 2
    assert list(cache.read_entries(tmp_path / "lint-c.txt")) == keys[-5:]
    monkeypatch.setattr(cache, "MOST_BYTES", 1100)
    cache.write_entries(tmp_path / "lint-c.txt", dict.fromkeys(keys, ""))
    assert list(cache.read_entries(tmp_path / "lint-c.txt")) == keys[-2:]
    monkeypatch.setattr(cache, "MOST_BYTES", 10)
    assert cache.read_entries(tmp_path / "lint-c.txt") == {}


def test_places_of_the_systems(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv(cache_folder.PLACE, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder.cache_folder() == tmp_path / "mudline"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    monkeypatch.setattr("sys.platform", "linux")
    assert cache_folder.cache_folder() == tmp_path / ".cache" / "mudline"
    monkeypatch.setattr("sys.platform", "darwin")
    assert cache_folder.cache_folder() == tmp_path / "Library" / "Caches" / "mudline"
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    assert cache_folder.cache_folder() == tmp_path / "mudline" / "Cache"
