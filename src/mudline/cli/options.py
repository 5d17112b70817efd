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
            help="Colours in the output; auto: on a terminal, unless NO_COLOR is set.",
        ),
    ):
        viewed = option(viewed)
    return viewed


units = click.option(
    "--units",
    type=click.Choice(["metric", "imperial", "user"]),
    help="Unit system of the deck, instead of that of its suffix, *UNITS or gravity.",
)

_files = click.Path().shell_complete
"""What a shell completes; paths are not checked here, so that every fault of one is worded the same way."""

deck = click.argument("deck", metavar="DECK", shell_complete=_files)

paths = click.argument("paths", nargs=-1, required=True, metavar="PATHS...", shell_complete=_files)

every_file = click.option(
    "--no-gitignore", "every_file", is_flag=True, help="Include files of directories that a .gitignore hides."
)

stdin_name = click.option(
    "--stdin-filename",
    "stdin_name",
    default="<stdin>",
    metavar="NAME",
    help="Name of standard input (-) in messages; its suffix gives the format and the units.",
)


def output_format(*formats: str) -> Callable[[Command], Command]:
    """`--output-format` with the formats that a command has."""
    return click.option(
        "--output-format",
        "output_format",
        type=click.Choice(formats),
        default=formats[0],
        show_default=True,
        help="Format of standard output.",
    )
