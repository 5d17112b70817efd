"""Running the commands of the pages, in this process, as they would print on a terminal that knows no colours."""

from __future__ import annotations

import io
import shlex
from contextlib import redirect_stderr, redirect_stdout

from mudline.__main__ import main
from mudline.checks.pages import page

_INSTALLED = str(page("SYN001")).removesuffix("docs/rules/SYN001.md")
"""Where the pages of rules are installed, which the pages show as a place on another machine."""


def run(words: str) -> tuple[int, list[str]]:
    """Run `mudline ...`: its exit code, and the lines on both streams without the blanks at their ends."""
    stream = _stream()
    code = _main(words, stream, stream)
    lines = [line.rstrip() for line in _text(stream).split("\n")]
    while lines and not lines[-1]:
        lines.pop()
    return code, lines


def output(words: str) -> str:
    """Run `mudline ...`: what it writes to standard output."""
    stream = _stream()
    _main(words, stream, _stream())
    return _text(stream)


def _main(words: str, out: io.TextIOWrapper, errors: io.TextIOWrapper) -> int:
    name, *arguments = shlex.split(words)
    assert name == "mudline", words
    with redirect_stdout(out), redirect_stderr(errors):
        return main(arguments)


def _stream() -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)


def _text(stream: io.TextIOWrapper) -> str:
    stream.seek(0)
    return stream.read().replace("\r\n", "\n").replace(_INSTALLED, "file:///opt/mudline/")
