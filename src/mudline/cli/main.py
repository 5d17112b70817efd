"""The command group: a command's file is imported when the command is run."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import cast

import click

from mudline import __version__
from mudline.cli.exits import CLOSED_PIPE, INTERRUPTED, WRONG_USAGE

COMMANDS = {
    "lint": "Find faults in decks.",
    "validate": "Say of each deck whether it is legal and complete.",
    "convert": "Convert a deck between keyword text, JSON and YAML.",
    "show": "Summarise a deck: sections, keywords, sets, curves, diameters.",
    "curves": "Show the force-embedment curves that a deck really gives.",
    "evaluate": "Contact forces and stiffnesses of a deck.",
    "rules": "List the rules, or explain one.",
    "schema": "Print the JSON Schema of a deck in JSON or YAML.",
}


class _Commands(click.Group):
    """Knows the names and one-line helps of the commands without importing them."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002 - click's signature
        if cmd_name not in COMMANDS:
            return None
        return cast("click.Command", import_module(f"mudline.cli.{cmd_name}_command").command)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's signature
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(
    cls=_Commands,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit codes: 0 clean, 1 findings or an illegal deck, 2 wrong usage or a path that cannot be read.",
)
@click.version_option(__version__, prog_name="mudline", message="%(prog)s %(version)s")
def mudline() -> None:
    """Read, check and convert the keyword decks of riser and pipeline analysis, and evaluate their seabed contact."""


def run(arguments: Sequence[str]) -> int:
    """Run a command line; returns its exit code. A closed pipe ends quietly."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="backslashreplace")
    try:
        code = mudline.main(list(arguments), prog_name="mudline", standalone_mode=False)
        sys.stdout.flush()
    except click.ClickException as error:
        error.show()
        return WRONG_USAGE
    except click.exceptions.Exit as leaving:
        return leaving.exit_code
    except (click.Abort, KeyboardInterrupt):
        return INTERRUPTED
    except BrokenPipeError:
        _drop_output()
        return CLOSED_PIPE
    return code if isinstance(code, int) else 0


def _drop_output() -> None:
    """Nobody reads any more: what is still in the buffer must not raise again when the interpreter ends."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
