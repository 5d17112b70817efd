"""Command group, and exit codes of faults; the module of a command is imported when the command is run."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from importlib import import_module
from typing import cast

import click
from click.shell_completion import shell_complete

from mudline.basics.files import reason
from mudline.basics.outside import refusing_outside
from mudline.basics.overwriting import OverwriteError, refusing_overwriting
from mudline.basics.spelling import nearest
from mudline.basics.version import __version__
from mudline.checks.configuration import ConfigurationError, refuses_outside
from mudline.cli import CLOSED_PIPE, DONE, FOUND, WRONG_USAGE, options, streams
from mudline.cli.streams import notify, notify_diagnostics
from mudline.language.diagnostics import DeckError, PluginError
from mudline.tools.running.executors import RunError

COMPLETION = "_MUDLINE_COMPLETE"
"""Variable by which a shell asks for completions, as click describes."""

COMMANDS = {
    "lint": "Find faults in decks.",
    "validate": "Validate decks.",
    "format": "Rewrite decks in canonical layout, or check their layout.",
    "convert": "Convert a deck between keyword text, JSON and YAML.",
    "set": "Change one value in many decks.",
    "expand": "Write the decks that *VARIATION and *COMBINATIONS describe.",
    "diff": "Compare two decks semantically.",
    "migrate": "Rewrite legacy seabed keywords in the new family.",
    "show": "Summarise a deck: sections, keywords, sets, curves, diameters.",
    "curves": "Show the force-embedment curves of a deck as they are evaluated.",
    "backbone": "Print a published backbone curve as a block for a deck.",
    "evaluate": "Evaluate the contact forces and stiffnesses of a deck.",
    "batch": "Evaluate many decks or load cases: a row and a result file each.",
    "index": "Bring decks into an archive.",
    "study": "Measure accuracy, cost and stability of a touchdown zone.",
    "report": "Write a page about a deck for a checker to sign.",
    "rules": "List the rules, or explain one.",
    "export": "Export the model of a deck for another program.",
    "schema": "Print the JSON Schema of decks, or of the configuration.",
    "config": "Show the configuration of a deck.",
    "lsp": "Serve an editor: findings, fixes, help and names as you type.",
    "help": "Show the help of a command.",
}


class _Commands(click.Group):
    """Group that lists names and one-line helps of the commands without importing them."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 - click's signature
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name == "help":
            return cast("click.Command", _help)
        if cmd_name in COMMANDS:
            return cast("click.Command", import_module(f"mudline.cli.{cmd_name}_command").command)
        if not ctx.resilient_parsing:  # a shell that asks for completions shows no errors
            near = nearest(cmd_name, COMMANDS)
            ctx.fail(f"unknown command {cmd_name!r}{f': did you mean {near}?' if near else ''}")
        return None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002 - click's signature
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(
    cls=_Commands,
    no_args_is_help=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit codes: 0 clean, 1 findings or an illegal deck, 2 wrong usage or a path that cannot be read.",
)
@click.version_option(__version__, prog_name="mudline", message="%(prog)s %(version)s")
def mudline() -> None:
    """Read, check and convert the keyword decks of riser and pipeline analysis, and evaluate their seabed contact."""


@options.command("help")
@click.argument("name", metavar="[COMMAND]", required=False, shell_complete=options.completing(lambda: COMMANDS))
@options.common
@click.pass_context
def _help(context: click.Context, /, *, name: str | None) -> int:
    """Show the help of COMMAND, as `mudline COMMAND --help` does, or the list of all commands."""
    root = context.find_root()
    shown = mudline.resolve_command(root, [name])[1] if name else None
    click.echo(root.get_help() if shown is None else shown.get_help(click.Context(shown, root, name)))
    return DONE


def run(arguments: Sequence[str]) -> int:
    """Run a command line and return its exit code. A closed pipe ends the program quietly."""
    completing = os.environ.get(COMPLETION)
    try:
        streams.prepare()
        if sys.flags.optimize > 1:  # helps are docstrings too
            from mudline.checks.registry import STRIPPED  # noqa: PLC0415 - most runs have them

            notify(STRIPPED)
            return WRONG_USAGE
        code = shell_complete(mudline, {}, "mudline", COMPLETION, completing) if completing else _invoke(arguments)
        sys.stdout.flush()
        sys.stderr.flush()
    except (ConfigurationError, OverwriteError, RunError) as error:
        notify(str(error))
        return WRONG_USAGE
    except OSError as error:  # standard output is full or closed (EINVAL on Windows)
        closed = isinstance(error, BrokenPipeError) or (os.name == "nt" and error.errno == errno.EINVAL)
        if not closed:
            with suppress(OSError):  # standard error may be full too
                what = f"{error.filename}:" if error.filename else "the output"
                notify(f"{what} cannot be written: {reason(error)}")
        streams.drop()
        return CLOSED_PIPE if closed else WRONG_USAGE
    return code


def _invoke(arguments: Sequence[str]) -> int:
    """Invoke a command without click's `main`, which ends the process with its own exit codes."""
    try:
        with refusing_overwriting(), mudline.make_context("mudline", list(arguments)) as context:
            if not arguments:
                click.echo(mudline.get_help(context), err=True)
                return WRONG_USAGE
            with refusing_outside(refuses_outside):
                return cast("int", mudline.invoke(context))
    except click.exceptions.Exit as leaving:
        return leaving.exit_code
    except click.ClickException as error:
        if isinstance(error, click.UsageError) and error.ctx is not None:
            path = error.ctx.command_path
            click.echo(f"{error.ctx.get_usage()}\nTry '{path} --help' for help.\n", err=True)
        notify(error.format_message())
        return WRONG_USAGE
    except DeckError as error:
        notify_diagnostics(error.diagnostics)
        return FOUND
    except PluginError as error:
        for fault in error.faults:
            notify(fault)
        return WRONG_USAGE
    except MemoryError:
        notify("out of memory")
        return FOUND
