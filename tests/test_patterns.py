"""Patterns of paths: what they fit, as git and pathspec say, and what matching costs."""

from __future__ import annotations

import random

import pytest
from pathspec import GitIgnoreSpec

from mudline.patterns import matches, read_pattern

PIECES = ["a", "b", "*", "*", "?", "**", "/", "/", "[ab]", "[a-c]", "[]a]", r"\a", r"\*", "ab", ".x", " ", "!", "#"]
PAIRS = 2000


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


def test_the_last_pattern_that_fits_counts() -> None:
    assert matches("a/old.das", ["*.das", "!new.das"])
    assert not matches("a/new.das", ["*.das", "!new.das"])
    assert matches("a/new.das", ["!new.das", "*.das"])
    assert matches("a/new.das", ["a/", "!new.das"])


def test_folders_are_told_from_files() -> None:
    pattern = read_pattern("b/")
    assert pattern is not None
    assert pattern.fits("a/b", folder=True)
    assert not pattern.fits("a/b", folder=False)
    assert not pattern.fits("a/b/c", folder=True)


def test_pathspec_says_the_same() -> None:
    """It lets `[!a]` take a "/", and drops a first `./`, where git does neither: such pairs are not made."""
    chosen = random.Random(1)  # noqa: S311 - the same pairs each time
    fitted = 0
    for _ in range(PAIRS):
        pattern = "".join(chosen.choices(PIECES, k=chosen.randint(1, 7)))
        path = "/".join(
            "".join(chosen.choices("aabbcx* ", k=chosen.randint(1, 3))) for _ in range(chosen.randint(1, 4))
        )
        try:
            expected = GitIgnoreSpec.from_lines([pattern]).match_file(path)
        except ValueError:  # a backslash at the end, or nothing behind "!": these fit nothing
            expected = False
        assert matches(path, [pattern]) == expected, (pattern, path)
        fitted += expected
    assert fitted > PAIRS // 50


@pytest.mark.parametrize(
    "pattern",
    ["*a*a*a*a*a*a*b", "**/a/**/a/**/a/**/b", "a*/*a*/*a*/**/b", "?" * 40 + "*b", "[a-z]*[a-z]*[a-z]*b"],
)
def test_many_stars_are_no_harm(pattern: str) -> None:
    """The time of a search with all ways to match would outlast every patience."""
    assert not matches(f"{'a' * 4000}/a{'/a' * 200}", [pattern])


def test_a_long_pattern_is_no_harm() -> None:
    assert not matches("a" * 2000, ["*a" * 2000 + "*b"])
    assert matches("a" * 2000, ["*a" * 1500])
