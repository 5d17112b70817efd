"""The configuration of each deck: the file that `--config` names, or the nearest one."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import field
from pathlib import Path
from typing import TypeVar

import click

from mudline.cli.inputs import is_deck
from mudline.cli.streams import reason
from mudline.lean import dataclass
from mudline.linting.configuration import CodeFault, Configuration, ConfigurationError, Search, read_configuration
from mudline.patterns import matches

T = TypeVar("T")


@dataclass
class Configured:
    """The configuration of each deck: that of `--config`, none (`isolated`), or the nearest one upwards.

    `code_fault` checks the words that are to name rules, as `read_configuration` says.
    """

    config: str | None = None
    isolated: bool = False
    code_fault: CodeFault | None = None
    _fixed: Configuration | None = field(init=False, default=None)
    _search: Search = field(init=False)
    _of_folder: dict[str, Configuration] = field(init=False, default_factory=dict)

    def __post_init__(self) -> None:
        if self.config is not None and self.isolated:
            raise click.UsageError("--config and --isolated exclude each other: give one of them")
        self._search = Search(self.code_fault)
        if self.isolated:
            self._fixed = Configuration()
        elif self.config is not None:
            path = Path(self.config)
            self._fixed = _read(lambda: read_configuration(path, code_fault=self.code_fault)) or Configuration()

    def of(self, path: str | None) -> Configuration:
        """The configuration of a file; that of standard input is the working folder's."""
        if self._fixed is not None:
            return self._fixed
        folder = os.path.dirname(path or "-")  # noqa: PTH120 - asked for each of many files
        if folder not in self._of_folder:
            whole = Path(os.path.abspath(folder))  # noqa: PTH100 - links stay what they are called
            self._of_folder[folder] = _read(lambda: self._search.nearest(whole))
        return self._of_folder[folder]

    def wanted(self, path: str) -> bool:
        """Whether a file in a searched directory is linted: `include` adds to the suffixes, `exclude` removes."""
        found = self.of(path)
        include, exclude = found.words("include"), found.words("exclude")
        if not (include or exclude):
            return is_deck(path)
        relative = found.relative(path)
        return (is_deck(path) or matches(relative, include)) and not matches(relative, exclude)


def _read(read: Callable[[], T]) -> T:
    try:
        return read()
    except ConfigurationError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{error.filename}: the configuration cannot be read: {reason(error)}") from error
