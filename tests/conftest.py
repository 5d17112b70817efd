"""How many examples and cases are run, without a deadline, and the same ones on every run under CI; what is traced."""

from __future__ import annotations

import gc
import os
from collections.abc import Generator, Iterator
from importlib.util import find_spec

import pytest
from hypothesis import HealthCheck, settings

from tests.helpers import tracing
from tests.helpers.shared import ALL

# Before numpy is imported: the workers share the processors, on which threads of small matrix products only wait.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# A loaded machine draws examples slowly; that says nothing about the code under test.
settings.register_profile(
    "mudline", max_examples=200 if ALL else 20, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("mudline-ci", settings.get_profile("mudline"), derandomize=True, print_blob=True)
settings.load_profile("mudline-ci" if os.environ.get("CI") else "mudline")


Report = pytest.CollectReport
OPTIONAL = (
    *("distributed", "duckdb", "jsonschema", "lsprotocol", "matplotlib", "mpmath", "numba", "openpyxl", "pandas"),
    *("polars", "pyarrow", "pygls", "pytest_lsp", "scipy", "xarray", "xlsxwriter"),
)
"""Libraries without which the rest can be tested: what needs one that is not installed is skipped, and names it."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Iterator[None]:
    """Skip a test that fails for want of an optional library."""
    try:
        yield
    except ImportError as error:
        name = (error.name or "").partition(".")[0]
        if name in OPTIONAL and find_spec(name) is None:
            pytest.skip(f"{name} is not installed")
        raise


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, Report, Report]:
    """Skip a module that cannot be imported for want of an optional library."""
    report = yield
    if report.failed:
        missing = [name for name in OPTIONAL if f"No module named '{name}" in str(report.longrepr)]
        if missing and find_spec(missing[0]) is None:
            report.outcome = "skipped"
            report.longrepr = (str(collector.path), 0, f"Skipped: {missing[0]} is not installed")
    return report


@pytest.hookimpl(trylast=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Behind pytest-cov, which begins to measure here."""
    tracing.begin(session.config)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out cases that are like others and tests of the night; stop coverage for tests that are not measured."""
    if not ALL:
        seen: set[str] = set()
        later = [
            item
            for item in items
            if item.get_closest_marker("nightly") or (item.get_closest_marker("alike") and not _is_first(item, seen))
        ]
        config.hook.pytest_deselected(items=later)
        items[:] = [item for item in items if item not in set(later)]
    if tracing.is_measured() and not config.pluginmanager.has_plugin(tracing.NAME):
        for item in items:
            if not tracing.is_traced(item):
                item.add_marker(pytest.mark.no_cover)


def _is_first(item: pytest.Item, seen: set[str]) -> bool:
    """Return True for the first case of a test."""
    test = item.nodeid.partition("[")[0]
    is_new = test not in seen
    seen.add(test)
    return is_new


def pytest_collection_finish() -> None:
    """What is there when the tests begin stays to their end: the garbage collector need not look at it again."""
    gc.collect()
    gc.freeze()
