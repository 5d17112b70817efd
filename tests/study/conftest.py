"""One study of the precision of the sample, which the tests of studies and of their command share."""

from __future__ import annotations

import pytest

from mudline.study import precision, sample_scene
from mudline.study.precision import curves, integration, smoothing
from mudline.study.report import StudyOptions, StudyReport


def shorten(patch: pytest.MonkeyPatch) -> None:
    """Short ladders, and few ratios and widths, for studies of precision."""
    patch.setattr(integration, "LADDER", (0.5, 10.0))
    patch.setattr(integration, "FINE_LADDER", (0.3,))
    patch.setattr(integration, "_TIMED", 0.0)
    patch.setattr(curves, "POINTS", (3, 10))
    patch.setattr(curves, "_TIMED", 1000)
    patch.setattr(curves, "_CHECKED", 50)
    patch.setattr(smoothing, "_IMPACT_SHARES", (0.0, 0.1))


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    shorten(monkeypatch)


@pytest.fixture(scope="session")
def sample_progress() -> list[str]:
    """What the study of the sample said while it ran."""
    return []


@pytest.fixture(scope="session")
def sample_report(sample_progress: list[str]) -> StudyReport:
    """The study of the sample with short ladders."""
    with pytest.MonkeyPatch.context() as patch:
        shorten(patch)
        return precision.run(sample_scene(), StudyOptions(progress=sample_progress.append))
