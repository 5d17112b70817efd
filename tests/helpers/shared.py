"""How much of the suite is run, and what its workers share."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.helpers.processes import TIMEOUT

ALL = os.environ.get("MUDLINE_TESTS") == "all"
"""Every case, and ten times as many examples: `make test-all`."""


def shared(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """The folder of a name, filled once in a run of the suite, by whichever worker is the first to ask for it."""
    base = factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / name
    outcome = folder.with_suffix(".made")
    try:
        folder.mkdir()
    except FileExistsError:
        end = time.monotonic() + 2 * TIMEOUT
        while not outcome.exists() and time.monotonic() < end:
            time.sleep(0.1)
    else:
        fault = "it broke off"
        try:
            make(folder)
            fault = ""
        finally:
            outcome.write_text(fault, encoding="utf-8")
    assert outcome.read_text(encoding="utf-8") == "", f"{name} could not be made, see the first test that needed it"
    return folder
