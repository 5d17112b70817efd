"""Options that many commands share."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from functools import wraps

import click

from mudline.cli.view import View

Command = Callable[..., int]


def common(command: Command) -> Command:
    """`--color`, `-q`, `-v`; they reach the command as `view`, if it asks for that."""
    wanted = "view" in inspect.signature(command).parameters

    @wraps(command)
    def viewed(*, color: str, quiet: bool, verbose: bool, **given: object) -> int:
        view = {"view": View(color, quiet, verbose)} if wanted else {}
        return command(**given, **view)

    for option in (
        click.option("-v", "--verbose", is_flag=True, help="Print more."),
        click.option("-q", "--quiet", is_flag=True, help="Print the result only."),
        click.option(
            "--color",
            type=click.Choice(["auto", "always", "never"]),
            default="auto",
            show_default=True,
            help="Colour the output; auto: on a terminal, unless NO_COLOR is set.",
        ),
    ):
        viewed = option(viewed)
    return viewed


units = click.option(
    "--units",
    type=click.Choice(["metric", "imperial", "user"]),
    help="Read the deck in this unit system, not in that of its suffix, *UNITS or gravity.",
)

complete_files = click.Path().shell_complete
"""What a shell completes; paths are not checked here, so that every fault of one is worded the same way."""

deck = click.argument("deck", metavar="DECK", shell_complete=complete_files)

decks = click.argument("decks", nargs=-1, required=True, metavar="DECKS...", shell_complete=complete_files)

paths = click.argument("paths", nargs=-1, required=True, metavar="PATHS...", shell_complete=complete_files)


def complete_rules(_context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    """What a shell completes where rules are named: codes and slugs, also behind others and a comma."""
    from mudline.diagnostics import PluginError  # noqa: PLC0415 - only completion needs it
    from mudline.linting.registry import rules  # noqa: PLC0415 - as above

    before, comma, word = incomplete.rpartition(",")
    try:
        names = [name for rule in rules() for name in (rule.code.code, rule.code.slug)]
    except PluginError:
        return []
    return [f"{before}{comma}{name}" for name in names if name.startswith((word.upper(), word.lower()))]


every_file = click.option(
    "--no-gitignore", "every_file", is_flag=True, help="Include files of directories that a .gitignore hides."
)

stdin_name = click.option(
    "--stdin-filename",
    "stdin_name",
    default="<stdin>",
    metavar="NAME",
    help="Call standard input (-) by this name in messages; its suffix gives the format and the units.",
)


def output_format(*formats: str) -> Callable[[Command], Command]:
    """`--output-format` with the formats that a command has."""
    return click.option(
        "--output-format",
        "output_format",
        type=click.Choice(formats),
        default=formats[0],
        show_default=True,
        help="Print in this format.",
    )
