"""What a study was run on: without these words a run time says nothing."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

_PACKAGES = ("mudline", "numpy", "scipy", "mpmath", "matplotlib", "numba")
_PROCESSORS = Path("/proc/cpuinfo")


def machine() -> dict[str, str]:
    """Return processor, cores, system and versions, by name; nothing that names the machine or its user."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.machine()}",
        "Python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: found for name in _PACKAGES if (found := _version(name))},
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def _processor(listing: Path = _PROCESSORS) -> str:
    """The model name as the system tells it; Python alone knows it on few systems."""
    try:
        lines = listing.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or "unknown"
