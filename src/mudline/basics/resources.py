"""Data files and modules of the package: grammars, pages of rules, modules to import."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from types import ModuleType


def grammar_file(name: str) -> Path:
    """Return the path of the grammar file `name`: the package's own copy first, the checkout's second."""
    return _own_file(f"grammar/{name}")


def rule_file(code: str) -> Path:
    """Return the path of the page of a rule, in the package or the checkout."""
    return _own_file(f"docs/rules/{code}.md")


def _own_file(path: str) -> Path:
    package = Path(__file__).parents[1]
    return package / path if (package / path).exists() else package.parents[1] / path


def modules_of(package: str) -> list[ModuleType]:
    """Import every module of a package and of its subpackages, so that their declarations are known."""
    return [import_module(module.name) for module in walk_packages(import_module(package).__path__, f"{package}.")]
