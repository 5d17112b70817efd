"""Tables and lists of pages written by hand that come from the program: forms of findings and results, quantities."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

from mudline.basics.quantities import ELEMENTS, LINES, NODES, Quantity
from mudline.checks.output import TEXT, TEXT_SUMMARY, form_module, form_names
from mudline.model.contact.columns import CUT
from mudline.model.contact.input import LawKind
from mudline.model.results.cases import CASES
from mudline.model.results.forms import FORMS
from mudline.tools.archive.rows import TABLES, columns_of
from tests.docs.marking import marked

_ROOT = Path(__file__).parents[2]
_FINDINGS = "| form | what it is |\n| --- | --- |\n"
_RESULTS = "| suffix | holds |\n| --- | --- |\n"
_ELEMENT = "An element:\n\n| key | holds | unit |\n| --- | --- | --- |\n"
_NODE = "A node:\n\n| key | holds | unit |\n| --- | --- | --- |\n"
_CASE = "A deck among many:\n\n| key | holds | unit |\n| --- | --- | --- |\n"
_LINES = "the first and the last:\n\n| column | holds | unit |\n| --- | --- | --- |\n"
_AGAINST = (
    "| `force_against`, `stiffness_against`, `ratio_against` "
    "| only with `--against`: the value in the file, or `null` | as ours |\n"
)


def form_table() -> str:
    """A row a form of findings."""
    rows = [(TEXT, TEXT_SUMMARY), *((name, form_module(name).SUMMARY) for name in form_names())]
    return _FINDINGS + "".join(f"| `{name}` | {summary} |\n" for name, summary in rows)


def result_table() -> str:
    """A row a form of result files."""
    return _RESULTS + "".join(f"| `.{name}` | {form.summary} |\n" for name, form in FORMS.items())


def quantity_rows(quantities: Iterable[Quantity]) -> str:
    """A row a quantity, with its unit in metric and imperial decks; neighbours with the same meaning share a row."""
    alike = groupby(quantities, key=lambda each: (each.meaning, _unit(each)))
    return "".join(
        f"| {', '.join(f'`{each.name}`' for each in group)} | {meaning} |{unit}|\n" for (meaning, unit), group in alike
    )


def _unit(quantity: Quantity) -> str:
    return f" {quantity.unit_name('metric')} / {quantity.unit_name('imperial')} " if quantity.unit else " "


def law_names() -> list[str]:
    """The names of laws in the results of decks, but for the curves."""
    return [CUT, *(kind.name.lower() for kind in LawKind if kind not in {LawKind.CURVE, LawKind.OTHER})]


def pages_with_laws() -> dict[str, str]:
    """The page and the schema that list the laws of elements in results."""
    names = law_names()
    listed = f"{', '.join(f'`{name}`' for name in ('curve:NAME', *names[:-1]))} or `{names[-1]}`"
    lists = {
        "docs/numerics.md": (r"(?<=\nIn the results the law of an element is ).*(?=\.\n)", listed),
        "docs/schemas/evaluate.json": (
            r'(?<="law": {"type": "string", "pattern": ").*(?="})',
            f"^(curve:.*|{'|'.join(names)})$",
        ),
    }
    texts = {}
    for path, (place, words) in lists.items():
        texts[path], found = re.subn(place, words, (_ROOT / path).read_text(encoding="utf-8"))
        assert found == 1
    return texts


def archive_columns() -> dict[str, str]:
    """The columns of each table of an archive, as lists."""
    return {_head(table): _head(table) + "".join(_column_lines(table)) for table in TABLES}


def _head(table: str) -> str:
    return f"Columns of `{table}`:\n\n"


def _column_lines(table: str) -> Iterable[str]:
    return (f"* `{name}`: {marked(meaning)}\n" for name, _, meaning in columns_of(table) if name != "file")


def pages_with_tables() -> dict[str, str]:
    """The pages written by hand that have such tables, with the tables written anew."""
    tables = {
        "docs/archive.md": archive_columns(),
        "docs/outputs.md": {_FINDINGS: form_table()},
        "docs/evaluate.md": {_RESULTS: result_table()},
        "docs/json.md": {
            _ELEMENT: _ELEMENT + quantity_rows(ELEMENTS.values()) + _AGAINST,
            _NODE: _NODE + quantity_rows(NODES.values()),
            _CASE: _CASE + quantity_rows(CASES.values()),
            _LINES: _LINES + quantity_rows(LINES.values()),
        },
    }
    return {page: _with_tables(page, of_page) for page, of_page in tables.items()}


def _with_tables(page: str, tables: dict[str, str]) -> str:
    text = (_ROOT / page).read_text(encoding="utf-8")
    for head, table in tables.items():
        parts = re.split(re.escape(head) + r"(?:[|*][^\n]*\n)*", text)
        assert len(parts) == 2
        text = table.join(parts)
    return text
