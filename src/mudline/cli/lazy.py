"""What a command needs only sometimes: printing in colours, drawing. The one place for such imports."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType


def printing(name: str) -> ModuleType:
    """The module of the command line that prints for people; it imports rich."""
    return import_module(f"mudline.cli.{name}_text")


def drawing(name: str) -> ModuleType:
    """The module of the results that draws; raises ImportError without the extra `plot`."""
    return import_module(f"mudline.results.{name}_plot")
