"""Commands that are killed while they write: `python -m tests.cli.kills --decks 1000 --size 4000000 --rounds 20`.

A process, as a copy of this one, runs a command on many decks and is killed: at one of the operations on files that it
makes, or, with `--rounds`, so many times at a random moment, each going on with what the one before has left. Then each
file must be as it was before or as a whole run leaves it, and the next run that is not killed must end as the whole run
did, without a temporary file.
"""

from __future__ import annotations

import argparse
import itertools
import os
import random
import shutil
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import redirect_stderr, redirect_stdout, suppress
from io import BytesIO, StringIO, TextIOWrapper
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from mudline.__main__ import main
from mudline.basics import files
from tests.helpers.builders.decks import CLEAN

DECK = (
    CLEAN.partition("*SEABED PROPERTIES")[0].replace("100.0", "{depth}")
    + "*ELASTIC SURFACE\n 5.0D4, 0.3\n*EMBEDMENT\n SET=Pipe\n 0.1, 1000.0\n 0.0,  0.0\n 0.5, 3{depth:.0f}.0\n"
    + "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n 1, 2\n 1, 3\n 3, 1\n 3, 2\n 3, 3\n{filling}"
)
"""A legacy deck that `lint --fix`, `format`, `set` and `migrate` change, and the other commands read."""
FILLING = "C what makes the file as large as those of a project\n"
MEMORIES = (".mudline-batch", "archive")
"""What is not the same bytes in each run: its content is asked for."""
OLD, NEW = 100.0, 101.0
"""Depths of the decks, of which files are made that are killed later, and dates of the decks."""
ERRORS = "../errors.txt"

Files = dict[str, bytes]


class Command(NamedTuple):
    """A command line; `decks` are the most that it takes, `makes` says that it writes other files than decks.

    Without `--rounds` it is killed at `every` so many of its operations.
    """

    words: tuple[str, ...]
    decks: int = 1_000_000
    makes: bool = True
    every: int = 1


COMMANDS = {
    "fix": Command(("lint", "--fix", "--exit-zero", "-q", "decks"), makes=False),
    "format": Command(("format", "-q", "decks"), makes=False),
    "set": Command(("set", "-q", "OCEAN.density=1030", "decks"), makes=False),
    "migrate": Command(("migrate", "-q", "decks"), makes=False),
    "convert": Command(("convert", "-q", "decks/deck0.keyxm", "-o", "deck.json"), 1),
    "export": Command(("export", "-q", "decks/deck0.keyxm", "--to", "moordyn", "-o", "line.txt"), 1),
    "batch": Command(("batch", "-q", "decks", "-o", "results", "--form", "json"), every=4),
    "report": Command(("report", "-q", "decks", "-o", "pages", "--sections", "findings"), 60, every=7),
    "index": Command(("index", "-q", "decks", "-o", "archive", "--isolated"), every=9),
}


def written(decks: int, size: int, depth: float) -> None:
    """Write decks into a folder of the working folder: the first and every 200th of about so many bytes."""
    Path("decks").mkdir(exist_ok=True)
    for number in range(decks):
        lines = 0 if number % 200 else max(0, size - len(DECK)) // len(FILLING)
        text = DECK.format(depth=depth, filling=FILLING * lines)
        path = Path("decks", f"deck{number}.keyxm")
        path.write_text(text, encoding="utf-8")
        os.utime(path, (depth, depth))  # is on the page of a report


def found() -> Files:
    """All files below the working folder but those that have no fixed bytes."""
    paths = [path for path in Path().rglob("*") if path.is_file() and not set(path.parts) & set(MEMORIES)]
    return {path.as_posix(): path.read_bytes() for path in sorted(paths)}


def faults(old: Files, new: Files) -> Iterator[str]:
    """What is neither as before nor as behind a whole run."""
    now = found()
    for name in now.keys() | (old.keys() & new.keys()):
        if name.endswith(".mudline"):
            continue
        if name not in now or now[name] not in (old.get(name), new.get(name)):
            yield f"{name} is neither old nor new"
    rows()


def rows() -> int:
    """The decks in the archive, 0 without one; raises ValueError or OSError for a table that is not whole."""
    if not Path("archive").exists():
        return 0
    import pyarrow.parquet as pq  # noqa: PLC0415 - an extra

    path = Path("archive", "decks.parquet")
    return int(pq.read_table(path).num_rows) if path.exists() else 0


def nothing(*_: object) -> None:
    """Let a process run to its end."""


def whole_run(words: tuple[str, ...]) -> None:
    """Run a command, which must not fail."""
    code = forked(words)
    assert code in {0, 1}, Path(ERRORS).read_text(encoding="utf-8")


def forked(words: tuple[str, ...], kill: Callable[[int], None] = nothing, before: Callable[[], None] = nothing) -> int:
    """Run a command in a copy of this process, which `kill` is given the number of; its exit code or -signal."""
    child = os.fork()
    if child == 0:
        os.setsid()
        files._tidied.clear()
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(os.open(ERRORS, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 2)
        before()
        os._exit(main(list(words)))
    kill(child)
    _, status = os.waitpid(child, 0)
    with suppress(ProcessLookupError, PermissionError):
        while True:  # its own processes end by themselves
            os.killpg(child, 0)
            time.sleep(0.002)
    return os.waitstatus_to_exitcode(status)


def at_operation(number: int) -> Callable[[], None]:
    """What lets a process kill itself at the operation on files with this number."""
    left = number

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        nonlocal left
        opens = event == "open" and int(str(arguments[2])) & os.O_CREAT
        if opens or event in {"os.rename", "os.chmod", "os.remove", "os.mkdir"}:
            left -= 1
            if left == -1:
                os.kill(os.getpid(), signal.SIGKILL)

    return lambda: sys.addaudithook(hook)


def at_moment(seconds: float, chance: random.Random) -> Callable[[int], None]:
    """What kills a process after a random time, alone or with those that it started."""

    def kill(child: int) -> None:
        time.sleep(chance.random() * seconds)
        with suppress(ProcessLookupError):
            os.kill(child, signal.SIGKILL) if chance.random() < 0.5 else os.killpg(child, signal.SIGKILL)

    return kill


def restored(files: Files) -> None:
    """Make the working folder as it was."""
    for path in Path().iterdir():
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    for name, data in files.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_bytes(data)
        os.utime(name, (NEW, NEW))


def tried(command: Command, decks: int, size: int, rounds: int, chance: random.Random) -> tuple[int, list[str]]:
    """Kill a command in the working folder again and again; how often that was before its end, and what was wrong.

    Without `rounds` at its first operation on files, its second, and so on.
    """
    count = min(decks, command.decks)
    written(1, 0, OLD)
    with redirect_stdout(TextIOWrapper(BytesIO())), redirect_stderr(StringIO()):
        main(list(command.words))  # imports what the copies of this process need
    restored({})
    written(count, size, OLD)
    if command.makes:
        whole_run(command.words)
    written(count, size, NEW)
    old = found()
    start = time.monotonic()
    whole_run(command.words)
    seconds = time.monotonic() - start
    new, whole = found(), rows()
    wrong = [] if new != old or whole else ["a whole run changes nothing"]
    killed = 0
    restored(old)
    for number in range(rounds) if rounds else itertools.count():
        before = nothing if rounds else at_operation(number * command.every)
        kill = at_moment(seconds / 2, chance) if rounds else nothing
        ended = forked(command.words, kill, before) != -signal.SIGKILL
        if ended and not rounds:
            break
        killed += not ended
        wrong += faults(old, new)
        if ended or not rounds or number == rounds - 1:  # else the next run goes on with what is there
            whole_run(command.words)
            if found() != new or rows() != whole:
                wrong.append("the next run ends in another way than a whole one")
            restored(old)
    return killed, wrong


def run_all(decks: int, size: int, rounds: int, names: list[str]) -> bool:
    """Kill commands; returns whether nothing was wrong, which is printed."""
    chance = random.Random(1)  # noqa: S311 - no secret
    right = True
    for name in names:
        with TemporaryDirectory() as place:
            work = Path(place, "work")
            work.mkdir()
            os.environ["MUDLINE_CACHE_DIR"] = f"{place}/cache"
            os.chdir(work)
            killed, wrong = tried(COMMANDS[name], decks, size, rounds, chance)
            os.chdir("/")
        report = [f"{name}: {min(decks, COMMANDS[name].decks)} decks, killed {killed} times", *wrong[:10]]
        sys.stdout.write("\n    ".join(report) + "\n")
        sys.stdout.flush()
        right = right and killed > 0 and not wrong
    return right


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    for option, value in (("decks", 4), ("size", 2000), ("rounds", 0)):
        parser.add_argument(f"--{option}", type=int, default=value)
    parser.add_argument("names", nargs="*", default=list(COMMANDS))
    given = parser.parse_args()
    sys.exit(not run_all(given.decks, given.size, given.rounds, given.names))
