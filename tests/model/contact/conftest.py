"""Loops are plain Python here, which takes the fewest seconds, but for the tests that are about compiled ones."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec

import pytest


@pytest.fixture(autouse=True)
def _plain_loops(request: pytest.FixtureRequest) -> Iterator[None]:
    """Compile in tests marked `compiled` alone: others hold the same loops, uncompiled, against numpy."""
    if find_spec("numba") is None or request.node.get_closest_marker("compiled"):
        yield
        return
    from tests.model.contact.comparison import plain_loops  # noqa: PLC0415 - loads numba

    with plain_loops():
        yield
