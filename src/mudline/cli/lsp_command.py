"""Command `mudline lsp`."""

from __future__ import annotations

import sys

from mudline.cli import WRONG_USAGE, options
from mudline.cli.streams import notify, require


@options.command("lsp")
@options.common
def command() -> int:
    """Serve an editor: findings, fixes, help, names and formatting of open decks, over the language server protocol.

    An editor starts this command and exchanges messages on standard input and output; docs/editors.md shows the setup.
    """
    require("lsp", "lsp", "pygls")
    if sys.stdin is None:
        notify("standard input is closed: lsp is started by an editor, which talks to it there")
        return WRONG_USAGE
    if sys.stdin.isatty():
        notify("lsp is started by an editor, which talks to it; Ctrl-C ends it")
    from mudline.tools.lsp.server import serve  # noqa: PLC0415 - needs the extra `lsp`

    return serve()
