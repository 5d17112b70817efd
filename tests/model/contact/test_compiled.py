"""When series are evaluated by compiled loops, and what is needed for them: numba, a cache, threads."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import pytest

from mudline.model.contact import ContactModel, LawAssignment
from mudline.model.contact import plan as choices
from mudline.model.contact.plan import Backend, BackendChoice
from tests.helpers.builders.contact import LINEAR, at_depths, chain, friction, on
from tests.helpers.processes import TIMEOUT

pytestmark = pytest.mark.slow

LONG, LONGER = 5_000_000, 50_000_000
"""Nodes times steps from which on loops are used with a history, and without."""


def choice_of(backend: Backend, *laws: LawAssignment) -> BackendChoice:
    """The choice of a model of 100 nodes."""
    return ContactModel(chain([LINEAR] * 99, *laws), backend=backend)._choice


def test_the_backend_that_a_series_gets() -> None:
    assert choice_of("fast").compiles(1)
    assert not choice_of("numpy").compiles(10**9)
    plain, sliding = choice_of("auto"), choice_of("auto", friction(3))
    assert not sliding.compiles(LONG // 100 - 1)
    assert sliding.compiles(LONG // 100)
    assert not plain.compiles(LONGER // 100 - 1)
    assert plain.compiles(LONGER // 100)


def test_without_numba_there_are_no_loops(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "numba", None)
    monkeypatch.setattr(choices, "find_spec", lambda _name: None)
    assert not choice_of("auto").compiles(10**9)
    with pytest.raises(ImportError):
        ContactModel(chain([LINEAR]), backend="fast")


def test_a_backend_of_another_name() -> None:
    wrong: Backend = "cuda"  # type: ignore[assignment]  # on purpose
    with pytest.raises(ValueError, match="backend must be auto, numpy or fast, not 'cuda'"):
        ContactModel(chain([LINEAR]), backend=wrong)


@pytest.mark.parametrize("threads", [0, -1])
def test_no_threads_at_all_are_refused(threads: int) -> None:
    with pytest.raises(ValueError, match=f"threads must be 1 or more, not {threads}"):
        ContactModel(chain([LINEAR]), threads=threads)


def test_numpy_alone_does_not_load_numba() -> None:
    program = """if True:
        import sys, numpy as np
        from tests.helpers.builders.contact import everything, journey
        from mudline.model.contact import ContactModel
        positions, velocities, _ = journey(3, 4, 1)
        ContactModel(everything(3, 1)).evaluate(positions, velocities=velocities)
        print("numba" in sys.modules)"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=TIMEOUT, check=True)
    assert run.stdout.strip() == "False"


@pytest.mark.compiled
@pytest.mark.covered
def test_loops_are_compiled_once_for_any_number_of_elements_and_springs() -> None:
    """The arrays of a single row have the same layout as those of several."""
    for elements in (1, 3):
        contact = ContactModel(chain([LINEAR] * elements, on("lateral", elements, stiffness=1e3)), backend="fast")
        contact.evaluate(at_depths([[0.1] * (elements + 1)] * 2))
        driver = contact._driver(2)
        assert driver is not None
        loop: Any = driver._loop
        assert len(loop.signatures) == 1
