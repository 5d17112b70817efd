"""`mudline config`, and the settings of each deck that `mudline lint` takes from a configuration.

The command line overrides the configuration file, which overrides the defaults.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePath
from typing import Any, TypeVar

import click

from mudline.cli import DONE, options
from mudline.cli.inputs import Input, is_deck
from mudline.cli.streams import emit, reason
from mudline.diagnostics import Severity
from mudline.linting.configuration import KEYS, TABLES, Configuration, ConfigurationError, Search, read_configuration
from mudline.linting.engine import Fixing, LintSettings
from mudline.linting.output import visible
from mudline.linting.registry import UnknownRule, rules, select
from mudline.patterns import matches

T = TypeVar("T")

_DEFAULTS = {"fail-on": "warning", "dialect": "mudline"}


@click.command("config")
@click.argument("path", default=".", metavar="[PATH]")
@click.option("--config", metavar="FILE", help="Use this configuration, not the nearest one.")
@click.option("--isolated", is_flag=True, help="Use no configuration file.")
@options.output_format("text", "json")
@options.common
def command(*, path: str, config: str | None, isolated: bool, output_format: str) -> int:
    """Show the configuration of a deck, or of the decks in a directory, and where each value comes from."""
    inside = str(Path(path) / "-") if os.path.isdir(path) else path  # noqa: PTH112 - Path raises for a long name
    rows = list(_rows(Configured(config, isolated).of(inside)))
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
        if key in found.values and found.path is not None:
            yield key, found.values[key], f"{found.path.as_posix()}:{found.lines[key]}"
        else:
            yield key, _DEFAULTS.get(key, {} if key in TABLES else []), "default"


# ---------------------------------------------------------------------------------------------- settings of a deck


@dataclass(frozen=True)
class Given:
    """The settings of the command line; None or empty where it has none."""

    chosen: tuple[str, ...] = ()
    ignored: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    fail_on: str | None = None
    dialect: str | None = None
    units: str | None = None
    fixing: Fixing = Fixing.NONE


@dataclass
class Configured:
    """The configuration of each deck: that of `--config`, none (`isolated`), or the nearest one upwards."""

    config: str | None = None
    isolated: bool = False
    _search: Search = field(default_factory=Search)
    _settings: dict[object, LintSettings] = field(default_factory=dict)
    _of_folder: dict[str, LintSettings] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.config is not None and self.isolated:
            raise click.UsageError("--config and --isolated exclude each other: give one of them")
        self._fixed = Configuration() if self.isolated else None
        if self.config is not None:
            self._fixed = _read(lambda: read_configuration(Path(str(self.config)))) or Configuration()

    def of(self, path: str | None) -> Configuration:
        """The configuration of a file; that of standard input is the working folder's."""
        if self._fixed is not None:
            return self._fixed
        folder = Path(os.path.abspath(path or "-")).parent  # noqa: PTH100 - links stay what they are called
        return _read(lambda: self._search.nearest(folder))

    def wanted(self, path: PurePath) -> bool:
        """Whether a file in a searched directory is linted: `include` adds to the suffixes, `exclude` removes."""
        found = self.of(str(path))
        include, exclude = found.words("include"), found.words("exclude")
        if not (include or exclude):
            return is_deck(path)
        relative = place(found, str(path))
        return (is_deck(path) or matches(relative, include)) and not matches(relative, exclude)

    def settings(self, file: Input, given: Given) -> LintSettings:
        """The settings of a file."""
        folder = os.path.dirname(file.path or "-")  # noqa: PTH120 - asked for each of many files
        if folder in self._of_folder:
            return self._of_folder[folder]
        found = self.of(file.path)
        relative = place(found, file.path or file.name)
        ignores = found.table("per-file-ignores")
        hidden = tuple(code for glob, codes in ignores.items() if matches(relative, [glob]) for code in codes)
        key = (found.path, hidden)
        if key not in self._settings:
            self._settings[key] = merged(found, given, hidden)
        if not ignores:
            self._of_folder[folder] = self._settings[key]
        return self._settings[key]


def place(found: Configuration, path: str) -> str:
    """A path as seen from the folder of a configuration, with `/`."""
    folder = Path() if found.path is None else found.path.parent
    try:
        return os.path.relpath(path, folder).replace(os.sep, "/")
    except ValueError:  # another drive
        return path.replace(os.sep, "/")


def merged(found: Configuration, given: Given, hidden: tuple[str, ...] = ()) -> LintSettings:
    """A configuration under a command line; `hidden` are codes that it ignores in a file."""
    severity = found.table("severity")
    off = [code for code, word in severity.items() if word == "off"]
    chosen = list(given.chosen) or found.words("select")
    ignored = [*given.ignored, *hidden] if given.chosen else [*given.ignored, *found.words("ignore"), *off, *hidden]
    try:
        running = select(chosen, ignored, [*given.also, *([] if given.chosen else found.words("extend-select"))])
    except UnknownRule as error:
        raise click.UsageError(str(error)) from error
    severities = {
        rule.code.code: Severity(word)
        for code, word in sorted(severity.items(), key=lambda item: len(item[0]))
        if word != "off"
        for rule in select([code])
    }
    return LintSettings(
        running,
        given.units,
        given.dialect or found.values.get("dialect", "mudline"),
        severities,
        Severity(given.fail_on or found.values.get("fail-on", "warning")),
        given.fixing,
        _unfixable(found),
    )


def _unfixable(found: Configuration) -> frozenset[str]:
    unfixable = _codes(found.words("unfixable"))
    fixable = found.words("fixable")
    return unfixable | ({rule.code.code for rule in rules()} - _codes(fixable)) if fixable else unfixable


def _codes(words: list[str]) -> frozenset[str]:
    return frozenset(rule.code.code for rule in select(words)) if words else frozenset()


def _read(read: Callable[[], T]) -> T:
    try:
        return read()
    except ConfigurationError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{error.filename}: the configuration cannot be read: {reason(error)}") from error
