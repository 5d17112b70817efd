"""The cache of `mudline lint`: what it spares, and that it never tells what is not so."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from hashlib import blake2b
from pathlib import Path

import pytest
from mudline.linting.cache import packed, program, unpacked

from mudline import cache_folder
from mudline.cli import lint_run
from mudline.diagnostics import Diagnostic, Severity
from mudline.linting import cache
from mudline.linting.engine import LintSettings
from mudline.linting.fixing import FileReport, lint_one
from mudline.linting.registry import rules
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.conftest import Place
from tests.cli.runner import run

Linted = list[str]


@pytest.fixture
def linted(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Linted:
    """The files that were really linted; the cache stands in the folder."""
    names: Linted = []

    def lint(name: str, data: bytes, settings: LintSettings, place: Path | None = None) -> FileReport:
        names.append(name)
        return lint_one(name, data, settings, place)

    monkeypatch.setenv(cache_folder.PLACE, str(folder / "cache"))
    monkeypatch.setattr(cache, "_COARSE", 0.0)  # files of a test are as young as its runs
    monkeypatch.setattr(lint_run, "lint_one", lint)
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


def test_a_base_of_a_configuration_counts(place: Place, linted: Linted) -> None:
    place("extend = 'base.toml'\n", "mudline.toml")
    place("fail-on = 'error'\n", "base.toml")
    assert run("lint", place(UNSORTED)).code == 0
    place("severity = { CRV002 = 'error' }\n", "base.toml")
    assert run("lint", "deck.keyxm").code == 1
    assert len(linted) == 2


def test_changed_content_is_linted_again_though_size_and_time_stay(place: Place, linted: Linted) -> None:
    run("lint", place(CLEAN))
    assert run("lint", place(CLEAN.replace("10.0\n", "1x.0\n"))).code == 1
    assert len(linted) == 2


def test_another_program_knows_nothing(
    place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    run("lint", place())
    monkeypatch.setattr("sys.version", "4.0")
    run("lint", "deck.keyxm")
    assert len(linted) == 2
    library = tmp_path / "numpy-9.9.dist-info"
    library.mkdir()
    monkeypatch.syspath_prepend(tmp_path)
    run("lint", "deck.keyxm")
    assert len(linted) == 3
    (library / "entry_points.txt").write_text("[mudline.rules]\n", encoding="utf-8")
    run("lint", "deck.keyxm")
    run("lint", "deck.keyxm")
    assert len(linted) == 4


def test_what_a_run_compiles_is_no_part_of_the_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "mudline"
    compiled = package / "contact" / "__pycache__"
    compiled.mkdir(parents=True)
    (package / "api.py").write_text("one = 1\n", encoding="utf-8")
    monkeypatch.setattr("mudline.linting.cache.__file__", str(package / "linting" / "cache.py"))
    before = program()
    (compiled / "loops.nbi").write_bytes(b"compiled loops")
    assert program() == before
    (package / "contact" / "laws.py").write_text("two = 2\n", encoding="utf-8")
    assert program() != before


# ------------------------------------------------------------------------------------------------ what a deck names

RESTART = "$LOAD CASE\n*RESTART\n LAST=static\n*TIME\n STEP=FIXED\n 0.0, 120.0, 0.05\n"


def test_a_deck_is_linted_again_when_a_file_that_it_lacked_is_there(folder: Path, place: Place, linted: Linted) -> None:
    (folder / "cache").mkdir()
    words = ("lint", place(RESTART, "wave.keyxm"), "--output-format", "concise")
    first = run(*words)
    assert "REF015" in first.out
    assert run(*words) == first
    assert len(linted) == 1
    place(name="STATIC.keyxm")
    assert "REF015" not in run(*words).out
    assert len(linted) == 2


def test_a_deck_is_linted_again_when_a_file_that_it_names_has_changed_or_gone(
    folder: Path, place: Place, linted: Linted
) -> None:
    place(name="static.keyxm")
    words = ("lint", place(RESTART, "wave.keyxm"))
    assert run(*words) == run(*words)
    assert len(linted) == 1
    place("C nothing\n", "static.keyxm")
    assert run(*words).code == 1
    assert run(*words).code == 1
    assert len(linted) == 2
    (folder / "static.keyxm").unlink()
    assert "REF015" in run(*words, "--output-format", "concise").out
    assert len(linted) == 3


def test_a_deck_is_linted_again_when_its_profile_has_changed(folder: Path, place: Place, linted: Linted) -> None:
    (folder / "bed.txt").write_text("-1000.0, 0.0\n1000.0, 0.0\n", encoding="utf-8")
    deck = CLEAN + "*SEABED PROFILE\n TYPE=PROFILE\n FILE=bed.txt\n"
    first = run("lint", place(deck), "--output-format", "concise")
    assert run("lint", "deck.keyxm", "--output-format", "concise") == first
    assert len(linted) == 1
    (folder / "bed.txt").write_text("-1000.0, O.0\n1000.0, 0.0\n", encoding="utf-8")
    assert run("lint", "deck.keyxm", "--output-format", "concise") != first
    assert len(linted) == 2


def test_what_changes_while_it_is_linted_is_not_kept(
    place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "_COARSE", 1000.0)
    place(name="static.keyxm")
    run("lint", place(RESTART, "wave.keyxm"))
    run("lint", "wave.keyxm")
    assert len(linted) == 2


def test_what_is_at_a_path(tmp_path: Path) -> None:
    file, inner = tmp_path / "a.txt", tmp_path / "b"
    assert cache.state(str(file)) == cache.state("a\0b") == ""
    file.write_text("one", encoding="utf-8")
    first, listed = cache.state(str(file)), cache.state(str(tmp_path))
    file.write_text("two", encoding="utf-8")
    assert cache.state(str(file)) not in ("", first)
    assert cache.state(str(tmp_path)) == listed
    inner.mkdir()
    assert cache.state(str(tmp_path)) != listed


def test_a_large_file_goes_by_size_and_date(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "LARGEST_READ", 3)
    file = tmp_path / "a.txt"
    file.write_text("long", encoding="utf-8")
    first = cache.state(str(file))
    os.utime(file, (1.0, 1.0))
    assert cache.state(str(file)) not in ("", first)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are of POSIX")
def test_a_deck_that_names_a_pipe_does_not_wait_for_it(folder: Path, place: Place, linted: Linted) -> None:
    os.mkfifo(folder / "static.keyxm")
    words = ("lint", place(RESTART, "wave.keyxm"), "--output-format", "concise")
    first = run(*words)
    assert "REF015" in first.out
    assert run(*words) == first
    assert linted


# -------------------------------------------------------------------------------------------- decks without findings


LIBRARIES = """
import sys
from mudline.__main__ import main
from mudline.linting import cache

cache._COARSE = 0.0
print(main(["lint", *sys.argv[1:]]), sorted({"lark", "numpy", "pydantic"} & sys.modules.keys()))
"""


def test_decks_without_findings_are_answered_without_what_reads_decks(folder: Path, place: Place) -> None:
    place("[tool.mudline]\nignore = ['STB']\n", "pyproject.toml")
    place(name="static.keyxm")
    words = [sys.executable, "-c", LIBRARIES, place(), place(RESTART, "wave.keyxm")]
    environment = {**os.environ, cache_folder.PLACE: str(folder / "cache")}
    done = [subprocess.run(words, env=environment, capture_output=True, text=True, check=True) for _ in range(2)]
    assert done[0].stdout == "No findings in 2 files.\n0 ['numpy', 'pydantic']\n"
    assert done[1].stdout == "No findings in 2 files.\n0 []\n"


@pytest.mark.parametrize("form", ["json", "concise", "sarif", "junit", "gitlab", "github", "jsonl"])
def test_every_form_is_the_same_from_the_cache(place: Place, linted: Linted, form: str) -> None:
    words = ("lint", place(), place(name="b.keyxm"), "-v", "--output-format", form)
    assert run(*words) == run(*words)
    assert len(linted) == 2


def test_known_decks_are_not_read_again_beside_one_that_changed(place: Place, linted: Linted) -> None:
    words = ("lint", place(), place(name="b.keyxm"), place(UNSORTED, "c.keyxm"))
    first = run(*words)
    place(BAD_NUMBER, "b.keyxm")
    assert run(*words, "--output-format", "concise").out.count("SYN002") == 1
    assert linted == ["deck.keyxm", "b.keyxm", "c.keyxm", "b.keyxm"]
    place(name="b.keyxm")
    assert run(*words) == first


def test_a_wrong_code_is_reported_though_the_decks_are_known(place: Place, linted: Linted) -> None:
    run("lint", place())
    assert run("lint", "deck.keyxm", "--ignore", "REF999").code == 2
    place("ignore = ['REF999']\n", "mudline.toml")
    assert run("lint", "deck.keyxm").code == 2
    assert len(linted) == 1


def damaged(change: Callable[[bytes], bytes]) -> Callable[[Path], None]:
    return lambda path: (path.write_bytes(change(path.read_bytes())), None)[1]


def resigned(path: Path) -> None:
    """Findings of another shape under a digest that is right."""
    body = path.read_bytes().partition(b"\n")[2].replace(b'"error"', b'"awful"')
    digest = blake2b(body, digest_size=20).hexdigest().encode()
    path.write_bytes(b"mudline-lint-cache/2 " + digest + b"\n" + body)


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


def test_a_file_that_is_missing_is_reported_beside_known_ones(place: Place, linted: Linted) -> None:
    words = ("lint", place(), "missing.keyxm")
    first = run(*words)
    assert first.code == 2
    assert run(*words) == first
    assert len(linted) == 1


def test_no_place_at_all(place: Place, linted: Linted, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.linting.cache.cache_folder", lambda: None)
    assert run("lint", place()).code == 0
    assert linted


def test_entries_come_back_whole() -> None:
    found = lint_one("a.keyxm", UNSORTED.encode() + BAD_NUMBER.encode(), LintSettings(rules())).found
    assert any(one.fix for one in found)
    states = {"/a/b c": "", "d": "0f"}
    assert unpacked(packed(found, states), "a.keyxm") == (found, states)
    assert unpacked(packed((), {}), "a.keyxm") == ((), {})


@pytest.mark.parametrize(
    "text",
    [
        "{}",
        "[1]",
        "[[]]",
        "nonsense",
        "[" * 100_000,
        "[[],[]]",
        '[[],{"a":1}]',
        '[[["a","b","error","m",0,1,1,1,null,true,[]]],{}]',
        '[[["a","b","error","m",1,1,1,1,null,1,[]]],{}]',
        '[[["a","b","error","m",1,1,1,1,null,true,{}]],{}]',
        '[[["a","b","error","m",1,1,1,1,null,true,[["a"]]]],{}]',
        '[[["a","b","error","m",1,1,1,1,null,true,[["a","b","info","m",1,1,1,1,null,true,[[]]]]]],{}]',
    ],
)
def test_entries_of_another_shape(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - of whatever kind
        unpacked(text, "a.keyxm")


def test_fix_of_another_kind() -> None:
    text = '[[["a","b","error","m",1,1,1,1,["sure","x",[]],true,[]]],{}]'
    with pytest.raises(ValueError, match="no fix"):
        unpacked(text, "a")
    assert unpacked(text.replace("sure", "safe"), "a").found[0].fix is not None
    assert isinstance(unpacked(text.replace("sure", "safe"), "a").found[0], Diagnostic)


def test_what_follows_from_a_finding_is_kept() -> None:
    follows = Diagnostic("a", "REF006", "undefined-node", Severity.WARNING, "m", 2, 1, 2, 2)
    cause = Diagnostic("a", "SYN009", "unknown-keyword", Severity.ERROR, "m", 1, 1, 1, 2, None, True, (follows,))
    assert unpacked(packed([cause], {}), "a").found == (cause,)


def test_number_and_size_are_bounded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    keys = [f"{i:040}" for i in range(9)]
    monkeypatch.setattr(cache, "MOST_ENTRIES", 5)
    monkeypatch.setattr(cache, "MOST_FILES", 2)
    for name in "abc":
        cache.write_entries(tmp_path / f"lint-{name}.txt", dict.fromkeys(keys, ""))
    assert len(list(tmp_path.iterdir())) == 2
    assert list(cache.read_entries(tmp_path / "lint-c.txt")) == keys[-5:]
    lines = b"".join(cache.line_of(key, "") for key in keys[3:])
    cache.write_entries(tmp_path / "lint-c.txt", {}, lines)
    assert list(cache.read_entries(tmp_path / "lint-c.txt")) == keys[-5:]
    cache.write_entries(tmp_path / "lint-c.txt", {keys[0]: "[]", keys[1]: ""}, lines[: 4 * len(lines) // 6])
    assert list(cache.read_entries(tmp_path / "lint-c.txt")) == [keys[1], *keys[3:7]]
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
