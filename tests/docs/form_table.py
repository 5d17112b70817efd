"""The forms of findings and of result files as tables, which pages written by hand have from the program."""

from __future__ import annotations

import re
from pathlib import Path

from mudline.cli.result_files import result_file, result_forms
from mudline.linting.output.forms import TEXT, TEXT_SUMMARY, form_module, form_names

_ROOT = Path(__file__).parents[2]
_FINDINGS = "| form | what it is |\n| --- | --- |\n"
_RESULTS = "| suffix | holds |\n| --- | --- |\n"


def form_table() -> str:
    """A row a form of findings."""
    rows = [(TEXT, TEXT_SUMMARY), *((name, form_module(name).SUMMARY) for name in form_names())]
    return _FINDINGS + "".join(f"| `{name}` | {summary} |\n" for name, summary in rows)


def result_table() -> str:
    """A row a form of result files."""
    return _RESULTS + "".join(f"| `.{name}` | {result_file(name).SUMMARY} |\n" for name in result_forms())


def pages_with_tables() -> dict[str, str]:
    """The pages written by hand that have a table of forms, with the table written anew."""
    tables = {"docs/outputs.md": (_FINDINGS, form_table()), "docs/evaluate.md": (_RESULTS, result_table())}
    return {page: _with_table(page, *table) for page, table in tables.items()}


def _with_table(page: str, head: str, table: str) -> str:
    text = (_ROOT / page).read_text(encoding="utf-8")
    fresh, count = re.subn(re.escape(head) + r"(?:\|[^\n]*\n)*", lambda _: table, text)
    assert count == 1
    return fresh
