"""Running the commands of the pages, in this process, as they would print on a terminal that knows no colours."""

from __future__ import annotations

import io
import shlex
from contextlib import redirect_stderr, redirect_stdout

from mudline.__main__ import main


def run(words: str) -> tuple[int, list[str]]:
    """Run `mudline ...`: its exit code, and its lines on both streams without the blanks at their ends."""
    name, *arguments = shlex.split(words)
    assert name == "mudline", words
    memory = io.BytesIO()
    stream = io.TextIOWrapper(memory, encoding="utf-8", write_through=True)
    with redirect_stdout(stream), redirect_stderr(stream):
        code = main(arguments)
    lines = [line.rstrip() for line in memory.getvalue().decode().replace("\r\n", "\n").split("\n")]
    while lines and not lines[-1]:
        lines.pop()
    return code, lines
