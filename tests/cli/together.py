"""Commands that run at the same time on the same files: `python -m tests.cli.together --decks 1000 --rounds 5`.

Each is a copy of this process. What they leave and print must be what one after the other do.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sys
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from mudline.__main__ import main
from mudline.basics import files
from tests.helpers.builders.decks import CLEAN
from tests.tools.archive.trial import deck, write

UNTIDY = CLEAN.replace(" 0.1, 1000.0\n", " 0.1 1.0D3\n").replace(" 1, 1, 2\n", "\t1, 1, 2\n")
"""A deck that `lint --fix` changes."""
IMPORTED = (
    "mudline.cli.lint_run",
    "mudline.checks.fixing",
    "mudline.model.scene.rules",
    "mudline.tools.archive.updating",
)
"""What the copies need, none of which reads a grammar yet."""
CACHE = "../cache"


class Ended(NamedTuple):
    """How a command ended: its exit code and what it printed."""

    code: int
    out: str
    err: str


def together(*commands: tuple[str, ...]) -> list[Ended]:
    """Run commands at the same time."""
    children = [_started(words, f"../{number}") for number, words in enumerate(commands)]
    codes = [os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) for child in children]
    texts = [
        [Path(f"../{number}.{name}").read_text(encoding="utf-8") for name in ("out", "err")]
        for number in range(len(codes))
    ]
    return [Ended(code, *both) for code, both in zip(codes, texts, strict=True)]


def _started(words: tuple[str, ...], place: str) -> int:
    child = os.fork()
    if child == 0:
        for number, name in ((1, "out"), (2, "err")):
            os.dup2(os.open(f"{place}.{name}", os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        files._tidied.clear()
        code = main(list(words))
        sys.stdout.flush()
        os._exit(code)
    return child


def content() -> dict[str, bytes]:
    """All files below the folder of decks."""
    return {path.as_posix(): path.read_bytes() for path in Path("decks").rglob("*") if path.is_file()}


def fixed(decks: int) -> Iterator[str]:
    """Two runs that fix one tree."""
    texts = {f"d{number}": UNTIDY for number in range(decks)}
    words = ("lint", "--fix", "-q", "decks")
    write(Path("decks"), **texts)
    (alone,) = together(words)
    wanted = content()
    write(Path("decks"), **texts)
    for one in together(words, words):
        if one != alone:
            yield f"one of two runs that fix ended otherwise: {one}"
    if content() != wanted or UNTIDY.encode() in wanted.values():
        yield "two runs that fix leave other decks than one"


def cached(decks: int) -> Iterator[str]:
    """Eight runs that share a cache: cold and warm, with the same decks and with their own."""
    for number in range(8):
        texts = {
            f"d{one}": CLEAN.replace("100.0", f"1{number}.0") if one % 3 else UNTIDY for one in range(decks // 8 + 1)
        }
        write(Path(f"decks/{number}"), **texts)
    lint = ("lint", "--output-format", "json")
    (plain,) = together((*lint, "decks", "--no-cache"))
    rows = json.loads(plain.out)
    for state, folders in (("cold", range(8)), ("warm", None)):
        if state == "cold":
            shutil.rmtree(CACHE, ignore_errors=True)
        places = ["decks"] * 8 if folders is None else [f"decks/{number}" for number in folders]
        for place, one in zip(places, together(*((*lint, place) for place in places)), strict=True):
            if json.loads(one.out) != [row for row in rows if row["file"].startswith(f"{place}/")] or one.err:
                yield f"one of eight runs with a {state} cache says something else than one without: {one}"


def indexed(decks: int) -> Iterator[str]:
    """Two runs that bring decks into one archive: others, and the same."""
    if not (find_spec("duckdb") and find_spec("pyarrow")):
        return
    from tests.tools.archive.trial import contents  # noqa: PLC0415 - an extra

    for half in ("decks/a", "decks/b"):
        write(Path(half), **{f"d{number}": deck(half, depth=100.0 + number) for number in range(decks // 2)})
    index = ("index", "--isolated", "-o")
    together((*index, "whole", "decks"))
    halves = [(*index, "halves", "decks/a"), (*index, "halves", "decks/b")]
    same = [(*index, "same", "decks")] * 2
    for lines in (halves, same, halves):
        ended = together(*lines)
        if any(one.code for one in ended):
            yield f"a run that brings decks into an archive failed: {ended}"
    for name in ("halves", "same"):
        if contents(Path(name)) != contents(Path("whole")):
            yield f"two runs left another archive {name} than one"


def run_all(decks: int, rounds: int) -> bool:
    """Whether nothing was wrong, which is printed."""
    wrong = []
    for name in IMPORTED:
        if name != "mudline.tools.archive.updating" or find_spec("duckdb"):
            import_module(name)
    for _ in range(rounds):
        for scenario in (fixed, cached, indexed):
            with TemporaryDirectory() as place:
                Path(place, "work").mkdir()
                os.environ["MUDLINE_CACHE_DIR"] = f"{place}/cache"
                os.chdir(Path(place, "work"))
                found = list(scenario(decks))
                found += [f"left: {path}" for path in Path(place).rglob("*.mudline")]
                os.chdir("/")
            sys.stdout.write("\n    ".join([f"{scenario.__name__}: {decks} decks", *found[:10]]) + "\n")
            sys.stdout.flush()
            wrong += found
    return not wrong


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    for option, value in (("decks", 16), ("rounds", 1)):
        parser.add_argument(f"--{option}", type=int, default=value)
    given = parser.parse_args()
    sys.exit(not run_all(given.decks, given.rounds))
