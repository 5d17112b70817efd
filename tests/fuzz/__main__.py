"""Fuzzing: `python -m tests.fuzz [--seconds N] [--target NAME] [--seed N] [--plain]`, or `make fuzz`.

Each target is a process of its own. With atheris installed inputs are guided by coverage, else (or with `--plain`) they
are made at random; both change decks as people do (`mutation.py`). What breaks a promise is written to
`tests/fuzz/found/`, once for each place in the program, and stays there as a seed when it is mended.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import resource
import signal
import subprocess
import sys
import time
import traceback
import warnings
from contextlib import nullcontext, redirect_stderr
from importlib import import_module
from importlib.util import find_spec
from io import StringIO
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tests.fuzz.mutation import Mutator

FOUND = Path(__file__).parent / "found"
SECONDS_PER_100KB = 2.0
MEMORY = 512 << 20
"""Bytes that one input may need beyond what the program has when it begins."""
_GUIDED = 0.7
"""Share of inputs that are made of what coverage chose; the others begin anew."""


class Hang(BaseException):
    """An input took too long; no handler of the program takes it for an error of its own."""


class Watch:
    """Runs inputs through a target, and keeps what breaks."""

    def __init__(self, name: str) -> None:
        from tests.fuzz.targets import TARGETS  # noqa: PLC0415 - instrumented first

        self.name, self.target = name, TARGETS[name]
        self.inputs = self.held = 0
        self.ends = self.patience = 0.0
        self.places: dict[str, Path] = {}
        signal.signal(signal.SIGPROF, _too_long)

    def begin(self, seconds: float) -> None:
        """Count and limit from here: with the seeds, modules were imported."""
        self.inputs, self.held, self.patience = 0, _most_memory(), SECONDS_PER_100KB
        self.ends = time.monotonic() + seconds

    @property
    def over(self) -> bool:
        """Whether the time is up."""
        return time.monotonic() > self.ends

    def take(self, data: bytes) -> None:
        """Run one input."""
        self.inputs += 1
        signal.setitimer(signal.ITIMER_PROF, self.patience * max(1.0, len(data) / 1e5))
        try:
            self.target.check(data)
        except (Exception, Hang, RecursionError) as error:  # noqa: BLE001 - whatever breaks is what is looked for
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            self._keep(data, error)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)

    def tell(self) -> None:
        """Print how many inputs there were, and how many places broke."""
        grown = _most_memory() - self.held
        if grown > MEMORY:
            sys.stderr.write(f"{self.name}: memory grew by {grown >> 20} MB\n")
        sys.stdout.write(f"{self.name:<14} {self.inputs:>9} inputs {len(self.places):>3} found\n")
        sys.stdout.flush()

    def _keep(self, data: bytes, error: BaseException) -> None:
        frames = [one for one in traceback.extract_tb(error.__traceback__) if "mudline" in one.filename]
        last = frames[-1] if frames else None
        place = f"{type(error).__name__} {error if last is None else f'{Path(last.filename).name}:{last.lineno}'}"
        if place in self.places:
            return
        FOUND.mkdir(exist_ok=True)
        path = FOUND / f"{self.name}-{hashlib.sha256(data).hexdigest()[:12]}"
        path.write_bytes(data)
        self.places[place] = path
        sys.stderr.write(f"{self.name}: {place}: {str(error)[:200]} -> {path.name}\n")


def _most_memory() -> int:
    """The most bytes that this process had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10


def _too_long(_number: int, _frame: FrameType | None) -> None:
    raise Hang


def fuzz(name: str, seconds: float, seed: int, *, plain: bool) -> None:
    """Fuzz one target in this process; prints its inputs and what was found."""
    warnings.simplefilter("ignore")
    guided = not plain and find_spec("atheris") is not None
    mutator, watch = _begun(name, seconds, seed, guided=guided)
    if guided:
        _guided(watch, mutator, seed)
    while not watch.over and not guided:
        watch.take(mutator.made())
    watch.tell()


def _begun(name: str, seconds: float, seed: int, *, guided: bool) -> tuple[Mutator, Watch]:
    """What makes inputs and what takes them, which has taken the seeds; the modules that they need are instrumented."""
    said = StringIO()
    hook = import_module("atheris").instrument_imports(include=["mudline"]) if guided else nullcontext()
    with redirect_stderr(said), hook:
        from tests.fuzz import mutation, targets  # noqa: PLC0415 - instrumented first

        mutator, watch = mutation.Mutator(targets.TARGETS[name].seeds(), seed), Watch(name)
        for data in mutator.seeds:
            watch.take(data)
    watch.begin(seconds)
    sys.stderr.writelines(line for line in said.getvalue().splitlines(keepends=True) if not line.startswith("INFO: "))
    return mutator, watch


def _guided(watch: Watch, mutator: Mutator, seed: int) -> None:
    """Coverage tells which inputs are changed further; what is made of them is as without it."""
    atheris = import_module("atheris")  # it has no types

    def one(data: bytes) -> None:
        watch.take(data)
        if watch.over:
            watch.tell()
            os._exit(0)  # libFuzzer ends the process, and does not return

    def change(data: bytes, most: int, _seed: int) -> bytes:
        base = data if len(data) > 1 and mutator.random.random() < _GUIDED else mutator.random.choice(mutator.seeds)
        return mutator.changed(base, mutator.random.choice((1, 1, 2, 3)))[:most]

    atheris.Setup([sys.argv[0], f"-seed={seed + 1}", "-max_len=40000", "-verbosity=0"], one, custom_mutator=change)
    atheris.Fuzz()


def main() -> int:
    """Fuzz one target here, or each in a process of its own."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--target", default="")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--plain", action="store_true")
    given = parser.parse_args()
    if given.target:
        fuzz(given.target, given.seconds, given.seed, plain=given.plain)
        return 0
    before = len(list(FOUND.glob("*")))
    from tests.fuzz.targets import TARGETS  # noqa: PLC0415 - instrumented where one is fuzzed

    for name in TARGETS:
        words = ["--target", name, "--seconds", str(given.seconds), "--seed", str(given.seed)]
        subprocess.run([sys.executable, "-m", "tests.fuzz", *words, *["--plain"] * given.plain], check=True)
    return int(len(list(FOUND.glob("*"))) > before)


if __name__ == "__main__":
    sys.exit(main())
