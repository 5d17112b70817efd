"""The lowest versions that pyproject.toml allows of what users install, as constraints for pip: `make test-lowest`."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path


def constraints(pyproject: str) -> list[str]:
    """A line for each library of the project and its extras; those of the project's own extras are left out."""
    project = tomllib.loads(pyproject)["project"]
    extras = [line for extra in project["optional-dependencies"].values() for line in extra]
    libraries = [line for line in [*project["dependencies"], *extras] if not line.startswith(f"{project['name']}[")]
    return sorted({line.replace(">=", "==") for line in libraries})


if __name__ == "__main__":
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text(encoding="utf-8")
    sys.stdout.writelines(f"{line}\n" for line in constraints(text))
