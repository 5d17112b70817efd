"""Options that many commands share."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import wraps

import click

Command = Callable[..., int]


@dataclass(frozen=True, slots=True)
class View:
    """How to tell things: colours ("auto", "always", "never"), less, or more."""

    color: str = "auto"
    quiet: bool = False
    verbose: bool = False


def common(command: Command) -> Command:
    """`--color`, `-q`, `-v`; they reach the command as `view`, if it asks for that."""
    wanted = "view" in inspect.signature(command).parameters

    @wraps(command)
    def viewed(*, color: str, quiet: bool, verbose: bool, **given: object) -> int:
        view = {"view": View(color, quiet, verbose)} if wanted else {}
        return command(**given, **view)

    for option in (
        click.option("-v", "--verbose", is_flag=True, help="Tell more."),
        click.option("-q", "--quiet", is_flag=True, help="Tell the result only."),
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
    help="Unit system of the deck, instead of what its suffix, *UNITS or gravity tell.",
)

_files = click.Path().shell_complete
"""What a shell completes; what is given is not checked here, so that every path is told of in the same words."""

deck = click.argument("deck", metavar="DECK", shell_complete=_files)

paths = click.argument("paths", nargs=-1, required=True, metavar="PATHS...", shell_complete=_files)

every_file = click.option(
    "--no-gitignore", "every_file", is_flag=True, help="Take from directories what a .gitignore hides, too."
)

stdin_name = click.option(
    "--stdin-filename",
    "stdin_name",
    default="<stdin>",
    metavar="NAME",
    help="Name, and by its suffix the form, of what is read from standard input (-).",
)


def output_format(*formats: str) -> Callable[[Command], Command]:
    """`--output-format` with the formats that a command has."""
    return click.option(
        "--output-format",
        "output_format",
        type=click.Choice(formats),
        default=formats[0],
        show_default=True,
        help="Form of what is printed.",
    )
