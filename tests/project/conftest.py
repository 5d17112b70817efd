"""The packages of the project, built once for all tests that look at them or install them."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.helpers.checkout import build_packages
from tests.helpers.shared import shared


@pytest.fixture(scope="session")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the wheel and the source archive."""
    return shared(tmp_path_factory, "packages", build_packages)
