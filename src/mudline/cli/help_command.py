"""`mudline help`."""

from __future__ import annotations

from typing import cast

import click

from mudline.cli import DONE, options


def _commands(context: click.Context) -> click.Group:
    """The group of all commands."""
    return cast("click.Group", context.find_root().command)


def _complete(context: click.Context, _parameter: click.Parameter, incomplete: str) -> list[str]:
    return [name for name in _commands(context).list_commands(context) if name.startswith(incomplete)]


@options.command("help")
@click.argument("name", metavar="[COMMAND]", required=False, shell_complete=_complete)
@options.common
@click.pass_context
def command(context: click.Context, /, *, name: str | None) -> int:
    """Show the help of COMMAND, as `mudline COMMAND --help` does, or the list of all commands."""
    root = context.find_root()
    if name is None:
        click.echo(root.get_help())
        return DONE
    _, found, _ = _commands(context).resolve_command(root, [name])
    if found is not None:
        click.echo(found.get_help(click.Context(found, root, name)))
    return DONE
