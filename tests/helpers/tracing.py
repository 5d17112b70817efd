"""When coverage is measured: while mudline is imported, and in the tests that meet lines which no other test meets.

Up to Python 3.13 coverage is a tracer, which slows down whatever runs beside it: pytest, libraries, a compiler.
"""

from __future__ import annotations

import sys
from collections.abc import Generator, Iterator
from contextlib import contextmanager, nullcontext, suppress
from importlib import import_module
from pkgutil import walk_packages

import pytest
from coverage import Coverage

import mudline

NAME = "tracing"


def is_traced(item: pytest.Item) -> bool:
    """Not those of which tracing takes as long as they do, and whose lines other tests meet."""
    is_property = getattr(getattr(item, "obj", None), "is_hypothesis_test", False)
    return not (is_property or item.get_closest_marker("covered") or item.get_closest_marker("untraced"))


_measures: list[Coverage] = []


def is_measured() -> bool:
    """Whether this run measures coverage."""
    return bool(_measures)


def begin(config: pytest.Config) -> None:
    """Let coverage rest until there is something to measure, where it is a tracer.

    In a process of pytest-xdist two measurements have begun: pytest-cov keeps the last, the other would trace all.
    """
    if (measure := Coverage.current()) is None:
        return
    _measures.append(measure)
    if sys.gettrace() is not None:
        while other := Coverage.current():
            other.stop()
        config.pluginmanager.register(Tracing(measure, imports=config.getoption("dist", "no") == "no"), NAME)


class Tracing:
    """Starts and stops coverage around what is measured."""

    def __init__(self, measure: Coverage, *, imports: bool) -> None:
        self.measure = measure
        self.imports = imports

    @contextmanager
    def on(self) -> Iterator[None]:
        if Coverage.current() is self.measure:  # a fixture that another one asks for
            yield
            return
        self.measure.start()
        try:
            yield
        finally:
            self.measure.stop()

    @pytest.hookimpl(wrapper=True)
    def pytest_collection(self) -> Generator[None, object, object]:
        """Lines of modules are met when these are imported, whichever test would be the first to need them."""
        if self.imports:
            with self.on():
                for module in walk_packages(mudline.__path__, "mudline."):
                    if not module.name.endswith("__main__"):
                        with suppress(ImportError):  # it needs a library that is not installed
                            import_module(module.name)
        return (yield)

    @pytest.hookimpl(wrapper=True, trylast=True)
    def pytest_fixture_setup(
        self, fixturedef: pytest.FixtureDef[object], request: pytest.FixtureRequest
    ) -> Generator[None, object, object]:
        """What a fixture of ours prepares for a test."""
        own = fixturedef.func.__module__.startswith("tests.")
        with self.on() if own and is_traced(request._pyfuncitem) else nullcontext():
            return (yield)

    @pytest.hookimpl(wrapper=True, trylast=True)
    def pytest_runtest_call(self, item: pytest.Item) -> Generator[None, None, None]:
        with self.on() if is_traced(item) else nullcontext():
            yield
