"""Console blocks written anew from what their commands print."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from tests.docs.blocks import Block, Command, agree
from tests.docs.commands import run

_RUN = re.compile(r'^```(?:console|\w+ title="([\w./-]+)")\n(.*?)^```$', re.MULTILINE | re.DOTALL)
"""Blocks of commands, and of files that a page has its reader write."""


def copy_of_files(root: Path, folder: Path) -> None:
    """Put the files that commands of the pages name into a folder, where the commands may write too."""
    for name in ("grammar", "samples"):
        shutil.copytree(root / name, folder / name)
    shutil.copytree(root / "docs/examples", folder / "docs/examples")


def refreshed(text: str, by_hand: list[str]) -> str:
    """The text of a page with fresh output; of what stands around one `...` as many lines as before.

    To `by_hand` go the commands whose output has changed and shows several `...`: that is to be cut by hand.
    """
    return _RUN.sub(lambda match: _block(match, by_hand), text)


def _block(match: re.Match[str], by_hand: list[str]) -> str:
    if match[1]:
        Path(match[1]).write_text(match[2], encoding="utf-8")
        return match[0]
    commands = Block("console", match[2], 1).commands()
    if not any(command.words.startswith("mudline") for command in commands):
        return match[0]
    code = 0
    lines: list[str] = []
    for command in commands:
        if command.words == "echo $?":
            printed = [str(code)]
        else:
            code, printed = run(command.words)
        lines += [f"$ {command.words}", *_shown(command, printed, by_hand)]
    return "\n".join(["```console", *lines, "```"])


def _shown(command: Command, printed: list[str], by_hand: list[str]) -> list[str]:
    cuts = [index for index, line in enumerate(command.shown) if line.strip() == "..."]
    if not cuts:
        return printed
    if agree(command.shown, printed):
        return command.shown
    if len(cuts) > 1:
        by_hand.append(command.words)
        return command.shown
    before, behind = cuts[0], len(command.shown) - cuts[0] - 1
    return [*printed[:before], "...", *printed[len(printed) - behind :]]
