"""Command `mudline lsp`."""

from __future__ import annotations

import sys
from importlib.util import find_spec

from mudline.cli import WRONG_USAGE, options
from mudline.cli.streams import notify, notify_missing


@options.command("lsp")
@options.common
def command() -> int:
    """Serve an editor: findings, fixes, help, names and formatting of open decks, over the language server protocol.

    An editor starts this command and exchanges messages on standard input and output; docs/editors.md shows the setup.
    """
    if find_spec("pygls") is None:
        notify_missing("lsp", "pygls", "lsp")
        return WRONG_USAGE
    if sys.stdin is None:
        notify("standard input is closed: lsp is started by an editor, which talks to it there")
        return WRONG_USAGE
    if sys.stdin.isatty():
        notify("lsp is started by an editor, which talks to it; Ctrl-C ends it")
    from mudline.tools.lsp.serving import serve  # noqa: PLC0415 - needs the extra `lsp`

    return serve()
