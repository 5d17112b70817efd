"""Patterns of paths: what they fit, as git says, and what matching costs."""

from __future__ import annotations

import os
import random
import shutil
import subprocess
from pathlib import Path

import pytest

from mudline.basics.patterns import matches
from mudline.cli.inputs import GivenDecks

PIECES = [
    *("a", "b", "*", "*", "?", "**", "/", "/", "[ab]", "[a-c]", "[]a]", r"\a", r"\*", "ab", ".x", " ", "!", "#"),
    *("[!a]", "./", "\\"),
]
FILES, PATHS = 300, 40
ALONE = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}


@pytest.mark.parametrize(
    ("path", "pattern", "expected"),
    [
        ("a/b", "b/", False),
        ("a", "/**", True),
        ("rev--.das", "rev-[a-].das", True),
        ("rev-[7.das", "rev-[7.das", False),
        ("a/b", "a[!x]b", False),
        ("a/b", "a?b", False),
        ("x\\", "x\\", False),
        ("#x", "#x", False),
        ("x", "!x", False),
        ("x ", "x ", False),
        ("x ", r"x\ ", True),
        ("x\\", r"x\\ ", True),
        ("x", "x\r\n", True),
        ("x", "", False),
        ("x", "/", False),
    ],
)
def test_what_a_pattern_fits(path: str, pattern: str, *, expected: bool) -> None:
    assert matches(path, [pattern]) is expected


def git(folder: Path, *words: str, given: str = "") -> set[str]:
    """Names that git prints."""
    program = shutil.which("git") or pytest.skip("needs git")
    done = subprocess.run(
        [program, "-C", folder, *words], input=given, capture_output=True, text=True, check=False, env=ALONE
    )
    assert done.returncode in {0, 1}, done.stderr
    return set(done.stdout.split("\0"))


def test_git_says_the_same(tmp_path: Path) -> None:
    """In a folder for each of many `.gitignore`, of the same paths; git does not look for them."""
    chosen = random.Random(1)  # noqa: S311 - the same pairs each time
    git(tmp_path, "init", "-q")
    paths = ["/".join("".join(chosen.choices("aabbcx* ", k=chosen.randint(1, 3))) for _ in range(depth % 4 + 1))
             for depth in range(PATHS)]  # fmt: skip
    files = {}
    for number in range(FILES):
        lines = ["".join(chosen.choices(PIECES, k=chosen.randint(1, 7))) for _ in range(chosen.randint(1, 3))]
        files[number] = lines
        (tmp_path / str(number)).mkdir()
        (tmp_path / str(number) / ".gitignore").write_text("\n".join(lines) + "\n", encoding="utf-8")
    pairs = [(number, path) for number in files for path in paths]
    given = "\0".join(f"{number}/{path}" for number, path in pairs)
    hidden = git(tmp_path, "check-ignore", "--no-index", "--stdin", "-z", given=given)
    assert len(hidden) > len(pairs) // 50
    wrong = [
        (files[number], path)
        for number, path in pairs
        if matches(path, files[number]) != (f"{number}/{path}" in hidden)
    ]
    assert wrong == []


@pytest.mark.alike
@pytest.mark.parametrize("seed", [5, 8, 10, 14])
def test_git_finds_the_same_decks(tmp_path: Path, seed: int) -> None:
    """In a tree with `.gitignore` files at several depths, of which one is above the folder that is searched."""
    chosen = random.Random(seed)  # noqa: S311 - the same tree each time
    git(tmp_path, "init", "-q")
    folders = [tmp_path / "top" / "/".join(chosen.choices("abcx", k=depth % 4)) for depth in range(120)]
    for folder in sorted({*folders, tmp_path}):
        folder.mkdir(parents=True, exist_ok=True)
        for name in chosen.sample(["a", "b", "ab", "x b", "c"], 3):
            (folder / f"{name}.das").touch()
        if chosen.random() < 0.3 or folder == tmp_path:
            lines = chosen.choices(
                ["a/", "*.das", "!b.das", "/c", "b/a.das", "x*", "**/c/a*", "!x b.das", "[bc]/**"], k=2
            )
            (folder / ".gitignore").write_text("\n".join(lines), encoding="utf-8")
    shown = git(tmp_path, "ls-files", "-z", "--others", "--exclude-standard", "top")
    wanted = {name for name in shown if name.endswith(".das")}
    assert len(wanted) > 50
    found = {
        Path(file.path or "").relative_to(tmp_path).as_posix()
        for file in GivenDecks((str(tmp_path / "top"),)).collect().files
    }
    assert found == wanted


@pytest.mark.parametrize(
    "pattern", ["*a*a*a*a*a*a*b", "**/a/**/a/**/a/**/b", "a*/*a*/*a*/**/b", "?" * 40 + "*b", "[a-z]*[a-z]*[a-z]*b"]
)
def test_many_stars_are_no_harm(pattern: str) -> None:
    """The time of a search with all ways to match would outlast every patience."""
    assert not matches(f"{'a' * 4000}/a{'/a' * 200}", [pattern])


def test_a_long_pattern_is_no_harm() -> None:
    assert not matches("a" * 2000, ["*a" * 2000 + "*b"])
    assert matches("a" * 2000, ["*a" * 1500])
