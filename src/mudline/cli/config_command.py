"""`mudline config`, and the configuration of each deck: the file that `--config` names, or the nearest one."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import click

from mudline.basics.patterns import matches
from mudline.checks.configuration import (
    ENCODING,
    EXTEND,
    KEYS,
    NO_OUTSIDE,
    TABLES,
    CodeFault,
    Configuration,
    ConfigurationError,
    Search,
    read_configuration,
)
from mudline.checks.output import visible
from mudline.cli import DONE, options
from mudline.cli.streams import emit, reason
from mudline.language.deck.searching import is_deck, is_document, is_in_any_form

T = TypeVar("T")

_DEFAULTS = {EXTEND: "", ENCODING: "", "fail-on": "warning", "dialect": "mudline", NO_OUTSIDE: False}


@options.command("config")
@click.argument("path", default=".", metavar="[PATH]")
@options.config
@options.isolated
@options.output_format("text", "json")
@options.common
def command(*, path: str, config: str | None, isolated: bool, output_format: str) -> int:
    """Show the configuration of a deck, or of the decks in a directory, and where each value comes from."""
    from mudline.checks.registry import code_fault  # noqa: PLC0415 - of the commands, lint alone needs all rules

    inside = str(Path(path) / "-") if os.path.isdir(path) else path  # noqa: PTH112 - Path raises for a long name
    rows = list(_rows(Configured(config, isolated, code_fault).of(inside)))
    if output_format == "json":
        emit([json.dumps([dict(zip(("key", "value", "from"), row, strict=True)) for row in rows], indent=1), "\n"])
    else:
        emit(
            f"{key} = {visible(json.dumps(value, ensure_ascii=False))}  # {visible(origin)}\n"
            for key, value, origin in rows
        )
    return DONE


def _rows(found: Configuration) -> Iterator[tuple[str, Any, str]]:
    """Key, value and origin of every key."""
    for key in KEYS:
        if key in found.values:
            path, line = found.origins[key]
            yield key, found.values[key], f"{path.as_posix()}:{line}"
        else:
            yield key, _DEFAULTS.get(key, {} if key in TABLES else []), "default"


# ---------------------------------------------------------------------------------------------------- of each deck


@dataclass(eq=False)
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
        """The configuration of a file, by its path or the name that standard input is given."""
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
            return is_in_any_form(path)
        relative = found.relative(path)
        taken = is_deck(path) or matches(relative, include) or is_document(path)
        return taken and not matches(relative, exclude)

    def encoding(self, path: str) -> str:
        """Return the encoding that the file's configuration gives, "" where it gives none."""
        return str(self.of(path).values.get(ENCODING, ""))

    def excludes(self, path: str) -> bool:
        """Return whether `exclude` of the file's configuration leaves it out."""
        found = self.of(path)
        exclude = found.words("exclude")
        return bool(exclude) and matches(found.relative(path), exclude)


def _read(read: Callable[[], T]) -> T:
    try:
        return read()
    except ConfigurationError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{error.filename}: the configuration cannot be read: {reason(error)}") from error
