"""Mutation testing: `python -m tests.mutants PACKAGE [--sample N] [--seed N]`, or `make mutants ARGS=PACKAGE`.

Each mutant (`operators.py`) is put into the functions of a process of its own, forked from one that has collected the
tests of the package. There the tests run that reach its lines, the fastest first, until one fails: then it is killed.
PACKAGE is a name of `PACKAGES` or a module of one, as `model/curves/backbones`.
"""

from __future__ import annotations

import argparse
import ast
import gc
import os
import pickle
import random
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterable
from importlib import import_module
from itertools import zip_longest
from pathlib import Path
from types import CodeType, FunctionType
from typing import NamedTuple

import pytest
from _pytest.runner import runtestprotocol
from coverage import Coverage

from tests.mutants.operators import Mutant, mutants

SOURCE = Path(__file__).parents[2] / "src" / "mudline"
KILLED, SURVIVED, IMPOSSIBLE = 1, 0, 3
"""How a process ends in which a test failed, none did, and whose functions cannot have the mutant."""
SLOW = 1.0
"""Seconds of processor time, traced, beyond which a test is left out."""
_LAWS = (
    *("friction", "suction", "trench", "test_law_borders.py", "test_closed_forms.py", "test_damping.py"),
    *("test_errors.py", "test_lateral.py", "test_normal_laws.py", "test_plan.py", "test_registered_law.py"),
    *("test_soil.py", "test_stiffest.py", "test_tangent.py", "test_unloading.py"),
)
_RECOVERY = ("recovery", "recovery_rows", "engine")
PACKAGES = {
    "model/curves": (("model/curves",), ["tests/model/curves"]),
    "model/contact/laws": (("model/contact/laws",), [f"tests/model/contact/{name}" for name in _LAWS]),
    "checks/fixing": (
        ("checks/fixing",),
        [f"tests/checks/test_{name}.py" for name in ("fixing", "repairs", *_RECOVERY)],
    ),
    "editing/migration": (("editing/migration",), ["tests/editing/migration"]),
    "keywords": (
        ("language/keywords/builder", "language/keywords/values", "checks/recovery", "checks/engine"),
        ["tests/language/keywords", *(f"tests/checks/test_{name}.py" for name in ("joining", *_RECOVERY))],
    ),
}
"""Of each package its modules, folders or files of `src/mudline`, and its tests."""


class Timed(NamedTuple):
    """A test, its processor time, and the lines it reaches in each file."""

    item: pytest.Item
    seconds: float
    reached: dict[str, set[int]]


def forked(work: Callable[[], object]) -> tuple[int, object]:
    """Run something in a process of its own; return how that ended (a signal is negative), and what it gave."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        code = 70
        try:
            given = work()
            code = given if isinstance(given, int) else 0
            os.write(writing, pickle.dumps(given))
        finally:
            os._exit(code)
    os.close(writing)
    with os.fdopen(reading, "rb") as stream:
        data = stream.read()
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return code, pickle.loads(data) if data else None  # noqa: S301 - of our own child


def passes(item: pytest.Item, following: pytest.Item | None = None) -> bool:
    """Run a test; whether it passed."""
    return all(report.passed for report in runtestprotocol(item, log=False, nextitem=following))


def timed_tests(items: list[pytest.Item], files: list[str]) -> list[Timed]:
    """The tests that pass as the program is and are not slow, the fastest first, run under trace."""

    def run() -> object:
        coverage = Coverage(data_file=None, include=files, config_file=False)
        coverage.set_option("run:disable_warnings", ["no-data-collected"])
        coverage.start()
        seconds = {}
        for number, (item, following) in enumerate(zip_longest(items, items[1:])):
            coverage.switch_context(str(number))
            begun = time.process_time()
            if passes(item, following) and (took := time.process_time() - begun) < SLOW:
                seconds[number] = took
        coverage.stop()
        data = coverage.get_data()
        return seconds, {file: data.contexts_by_lineno(file) for file in files}

    _, given = forked(run)
    if not isinstance(given, tuple):
        raise TypeError("the tests did not come to an end")
    seconds, lines = given
    reached: dict[str, dict[str, set[int]]] = {}
    for file, contexts in lines.items():
        for line, tests in contexts.items():
            for test in tests:
                reached.setdefault(test, {}).setdefault(file, set()).add(line)
    tests = [Timed(items[number], took, reached.get(str(number), {})) for number, took in seconds.items()]
    return sorted(tests, key=lambda test: test.seconds)


def named(code: CodeType) -> tuple[object, ...]:
    """What a function keeps when it gets a mutant: its name, place and arguments."""
    return code.co_qualname, code.co_firstlineno, code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]


def codes(code: CodeType) -> dict[tuple[object, ...], CodeType]:
    """The code of every function of a module, and of those within."""
    found = {named(code): code}
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            found |= codes(constant)
    return found


def trial(code: CodeType, functions: Iterable[FunctionType], tests: list[Timed]) -> int:
    """In a process of its own: put the code of a module into its functions, and run tests until one fails."""
    new = codes(code)
    try:
        for function in functions:
            function.__code__ = new.get(named(function.__code__), function.__code__)
    except ValueError:
        return IMPOSSIBLE
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
    for test, following in zip_longest(tests, tests[1:]):
        # Ten times its time, or the mutant hangs; the alarm is for one that waits.
        limit = int(time.process_time() + 10.0 * test.seconds) + 2
        resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.RLIM_INFINITY))
        signal.alarm(60 + int(50.0 * test.seconds))
        if not passes(test.item, following and following.item):
            return KILLED
    return SURVIVED


class Runner:
    """Instead of running the collected tests once, runs them against mutants."""

    def __init__(self, name: str, paths: list[Path], sample: int, seed: int) -> None:
        self.name, self.paths, self.sample, self.seed = name, paths, sample, seed
        self.killed = self.count = 0

    @pytest.hookimpl(tryfirst=True)
    def pytest_configure(self) -> None:
        """Property tests do not make smaller what fails, and try the same examples with every mutant."""
        from hypothesis import HealthCheck, Phase, settings  # noqa: PLC0415 - pytest has to see it first

        profile = settings(
            max_examples=25,
            deadline=None,
            derandomize=True,
            phases=(Phase.explicit, Phase.generate),
            report_multiple_bugs=False,
            suppress_health_check=list(HealthCheck),
        )
        settings.register_profile("mutants", profile)

    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Count the mutants, run a sample of them, print those that no test kills."""
        sys.modules["numba"] = None  # type: ignore[assignment] # compiled loops are made of the source without a mutant
        gc.unfreeze()
        for path in self.paths:
            import_module(
                ".".join(("mudline", *path.relative_to(SOURCE).with_suffix("").parts)).removesuffix(".__init__")
            )
        files = [str(path) for path in self.paths]
        timed = timed_tests(session.items, files)
        say(f"{len(timed)} of {len(session.items)} tests, {sum(test.seconds for test in timed):.1f} s")
        functions = [
            each for each in gc.get_objects() if type(each) is FunctionType and each.__code__.co_filename in files
        ]
        gc.freeze()  # or every child would copy what its collector looks at
        trees = [(path, ast.parse(path.read_text(encoding="utf-8"))) for path in self.paths]
        total = sum(1 for _, tree in trees for _ in mutants(tree))
        chosen = set(range(total))
        if total > self.sample:
            chosen = set(random.Random(self.seed).sample(range(total), self.sample))  # noqa: S311 - no secret
        number = -1
        for path, tree in trees:
            own = [function for function in functions if function.__code__.co_filename == str(path)]
            for mutant in mutants(tree):
                number += 1
                if number in chosen:
                    self._take(path, mutant, compile(tree, str(path), "exec", dont_inherit=True), own, timed)
        of = f", a sample of {len(chosen)} of {total}, seed {self.seed}" if total > len(chosen) else ""
        share = 100.0 * self.killed / max(self.count, 1)
        say(f"{self.name}: {int(share)} % killed ({self.killed} of {self.count}){of}")
        return True

    def _take(
        self, path: Path, mutant: Mutant, code: CodeType, functions: list[FunctionType], timed: list[Timed]
    ) -> None:
        tests = [test for test in timed if not test.reached.get(str(path), set()).isdisjoint(mutant.lines)]
        ended, _ = forked(lambda: trial(code, functions, tests))
        if ended == IMPOSSIBLE:
            return
        if ended not in {KILLED, SURVIVED} and ended >= 0:
            raise RuntimeError(f"{path.name}:{mutant.line}: the process ended with {ended}")
        self.count += 1
        self.killed += ended != SURVIVED
        if ended == SURVIVED:
            place = f"{path.relative_to(SOURCE)}:{mutant.line}"
            text = path.read_text(encoding="utf-8").splitlines()[mutant.line - 1].strip()
            reached = "" if tests else "  (no test reaches it)"
            say(f"{place}: {mutant.before}  ->  {mutant.after}  in  {text}{reached}")


def say(text: str) -> None:
    """Print behind pytest's back, which keeps what tests print."""
    os.write(OUT, f"{text}\n".encode())


def modules_of(name: str) -> tuple[list[Path], list[str]]:
    """The files of a package, or of a module of one, and its tests."""
    for package, (parts, tests) in PACKAGES.items():
        files = [
            path for part in parts for path in sorted(SOURCE.glob(f"{part}.py")) or sorted(SOURCE.glob(f"{part}/*.py"))
        ]
        wanted = [path for path in files if name in {package, path.relative_to(SOURCE).with_suffix("").as_posix()}]
        if wanted:
            return wanted, tests
    raise SystemExit(f"{name} is no package: {', '.join(PACKAGES)}, or a module of one")


def main() -> None:
    """Run one package."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutants")
    parser.add_argument("package")
    parser.add_argument("--sample", type=int, default=200, help="mutants that are tried where there are more")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    paths, tests = modules_of(given.package)
    runner = Runner(given.package, paths, given.sample, given.seed)
    options = [
        *("--no-cov", "-n0", "-q", "-pno:cacheprovider", "--hypothesis-profile=mutants"),
        "--continue-on-collection-errors",
    ]
    raise SystemExit(pytest.main([*options, *tests], plugins=[runner]))


OUT = os.dup(1)

if __name__ == "__main__":
    main()
