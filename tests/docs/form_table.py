"""The forms of findings as a table: what `docs/outputs.md` has from the program."""

from __future__ import annotations

import re
from pathlib import Path

from mudline.linting.output.formats import TEXT, TEXT_SUMMARY, form_module, form_names

_PAGE = Path(__file__).parents[2] / "docs/outputs.md"
_HEAD = "| form | what it is |\n| --- | --- |\n"
_TABLE = re.compile(re.escape(_HEAD) + r"(?:\|[^\n]*\n)*")


def form_table() -> str:
    """A row a form."""
    rows = [(TEXT, TEXT_SUMMARY), *((name, form_module(name).SUMMARY) for name in form_names())]
    return _HEAD + "".join(f"| `{name}` | {summary} |\n" for name, summary in rows)


def outputs_page() -> str:
    """The page of forms, written by hand, with its table written anew."""
    fresh, count = _TABLE.subn(lambda _: form_table(), _PAGE.read_text(encoding="utf-8"))
    assert count == 1
    return fresh
