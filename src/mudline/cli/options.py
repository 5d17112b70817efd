"""Options that several commands share."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from functools import partial, wraps
from typing import Any

import click

from mudline.basics import files
from mudline.basics.overwriting import claim
from mudline.basics.units import UNITS
from mudline.cli.streams import refusing
from mudline.cli.view import View

Command = Callable[..., int]

# ----------------------------------------------------------------------------------------------------------------- help

OWN, INPUT, OUTPUT, RUN, COMMON = "Options", "Input", "Output", "Run", "Common options"
"""Headings in help: options of one command, and options that several commands share."""


class Option(click.Option):
    """Option that help shows under a heading."""

    def __init__(self, declarations: Sequence[str] | None = None, *, group: str = OWN, **attributes: Any) -> None:  # noqa: ANN401 - as click.Option
        super().__init__(declarations, **attributes)
        self.group = group


class GroupedCommand(click.Command):
    """Command whose help shows its options under headings."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options by heading: own options first, common options and --help last."""
        groups: dict[str, list[tuple[str, str]]] = {OWN: []}
        for parameter in self.get_params(ctx):
            record = parameter.get_help_record(ctx) if isinstance(parameter, click.Option) else None
            if record is not None:
                heading = COMMON if "--help" in parameter.opts else getattr(parameter, "group", OWN)
                groups.setdefault(heading, []).append(record)
        for heading in sorted(groups, key=COMMON.__eq__):
            if groups[heading]:
                with formatter.section(heading):
                    formatter.write_dl(groups[heading])


command = partial(click.command, cls=GroupedCommand)
option = partial(click.option, cls=Option)
flag = partial(option, is_flag=True)
input_option, output_option, run_option = (partial(option, group=group) for group in (INPUT, OUTPUT, RUN))
"""Decorators of options under the headings that several commands have."""

# -------------------------------------------------------------------------------------------------------------- options


Adding = Callable[[Command], Command]
"""Decorator that adds an argument or options to a command."""


def gathered(name: str, record: type, *added: Adding) -> Adding:
    """Return a decorator that adds options; those named as the fields of a record reach the command as one record.

    The record is the command's parameter `name`; a command without this parameter ignores these options.
    """

    def decorated(command: Command) -> Command:
        def given(**values: object) -> int:
            fields = {field: values.pop(field) for field in record.__annotations__ if field in values}
            if name in command.__annotations__:
                values[name] = record(**fields)
            return command(**values)

        wrapped: Command = wraps(command)(given)
        for add in reversed(added):
            wrapped = add(wrapped)
        return wrapped

    return decorated


common = gathered(
    "view",
    View,
    option(
        "--color",
        group=COMMON,
        type=click.Choice(["auto", "always", "never"]),
        default="auto",
        show_default=True,
        help="Colour the output; auto: on a terminal, unless NO_COLOR is set.",
    ),
    flag("-q", "--quiet", group=COMMON, help="Print the result only."),
    flag("-v", "--verbose", group=COMMON, help="Print more."),
)
"""Decorator that adds `--color`, `-q` and `-v`, which reach the command as `view`."""

jobs = run_option(
    "--jobs",
    type=click.IntRange(min=0),
    default=0,
    metavar="N",
    help="Use at most N processes, if that saves time; 0 (default): one for each processor.",
)

units = input_option(
    "--units",
    type=click.Choice(tuple(UNITS)),
    help="Read the deck in this unit system, in place of that of its suffix, *UNITS or gravity.",
)


def _encoding(_context: click.Context, _parameter: click.Parameter, value: str) -> str:
    """Return the encoding; raises click.BadParameter for an encoding unknown to Python."""
    from mudline.checks.configuration import is_encoding  # noqa: PLC0415 - few decks need it

    if value and not is_encoding(value):
        raise click.BadParameter(
            f"{value!r} is not known: give one as Python names it, such as cp437, cp1251, shift_jis"
        )
    return value


encoding = input_option(
    "--encoding",
    default="",
    metavar="NAME",
    callback=_encoding,
    help="Read and write keyword decks in this encoding, such as cp437.",
)


def completing(names: Callable[[], Iterable[str]]) -> Callable[..., list[str]]:
    """Return the completion of a word by the names that begin as it does."""
    return lambda _context, _parameter, start: [name for name in names() if name.startswith(start)]


complete_files = click.Path().shell_complete
"""Completion of paths by a shell; paths are not checked here, so that messages are the same everywhere."""


def complete_rules(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """Return the completions for rules: codes and slugs, also after other rules and a comma."""
    from mudline.checks.registry import rules  # noqa: PLC0415 - as above
    from mudline.language.diagnostics import PluginError  # noqa: PLC0415 - only completion needs it

    before, comma, word = incomplete.rpartition(",")
    try:
        names = [name for rule in rules() for name in (rule.code.code, rule.code.slug)]
    except PluginError:
        return []
    return [f"{before}{comma}{name}" for name in names if name.startswith((word.upper(), word.lower()))]


every_file = input_option(
    "--no-gitignore", "every_file", is_flag=True, help="Include files of directories that are hidden by a .gitignore."
)

stdin_name = input_option(
    "--stdin-filename",
    "stdin_name",
    default="<stdin>",
    metavar="NAME",
    help="Name of standard input (-) in messages; its suffix gives format and units.",
)

no_outside = input_option(
    "--no-outside",
    is_flag=True,
    help="Refuse decks that name files outside their project: the nearest folder with a configuration or .git.",
)

config = input_option(
    "--config", metavar="FILE", help="Use this configuration for all decks, not the nearest one of each deck."
)

isolated = input_option("--isolated", is_flag=True, help="Use no configuration file.")

force_exclude = input_option(
    "--force-exclude", is_flag=True, help="Leave out files that the configuration excludes, even if given by name."
)


def output_format(*formats: str) -> Adding:
    """Return `--output-format` with the formats of a command."""
    return output_option(
        "--output-format",
        "output_format",
        type=click.Choice(formats),
        default=formats[0],
        show_default=True,
        help="Print in this format.",
    )


check = flag("--check", help="Write nothing; name the files that would change; exit with 1 if there are any.")

diff = flag("--diff", help="Write nothing; print the changes; exit with 1 if there are any.")


def form_of_file(path: str, forms: Collection[str]) -> str:
    """Return the form of a file to write, by its suffix; raises click.UsageError unless it is among `forms`."""
    with refusing(ValueError):
        return files.form_of_file(path, forms)


class _OutputFile(click.types.StringParamType):
    """File that an option writes; `prints` if `-` is standard output."""

    def __init__(self, *, prints: bool = False) -> None:
        self._prints = prints

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Claim the file; raises OverwriteError."""
        if value == "-":
            return "" if self._prints else value
        if not value and self._prints:
            self.fail("give the name of a file, or - for standard output", param, ctx)
        if param is not None and not (ctx is not None and ctx.resilient_parsing):
            claim(value, param.opts[0])
        return value


OUTPUT_FILE = _OutputFile()
OUTPUT_TEXT = _OutputFile(prints=True)
"""File of a command that prints a text if it writes none; "" is standard output, given as `-`."""
output = partial(option, "-o", "--output", type=OUTPUT_FILE, metavar="OUT")
"""Decorator of `-o`, with the help of a command."""


class _AboveZero(click.types.FloatParamType):
    """Number that is finite and above 0."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:  # noqa: ANN401 - as click has it
        """Return the number; raises click.UsageError."""
        number = super().convert(value, param, ctx)
        if not 0.0 < number < math.inf:
            name = param.opts[0] if param else "the number"
            raise click.UsageError(
                f"{name} is {number!r}: it must be greater than 0{'' if math.isfinite(number) else ' and finite'}", ctx
            )
        return number


ABOVE_ZERO = _AboveZero()
