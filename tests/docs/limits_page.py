"""The page of the limits of input, made from `mudline.basics.limits`: each with its value; the reasons stand there."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from inspect import getsource
from itertools import pairwise

from mudline.basics import limits

_HEAD = """# Limits

These limits guard against hostile or huge input. A message names the line that is refused. The reasons are in
`src/mudline/basics/limits.py`, with the limits of messages, caches and editors.
"""
_GROUPS = ("text of decks", "sizes that decks cause", "files")
_GROUP = re.compile(r"^# -+ (.+)$", re.MULTILINE)


def limits_page() -> str:
    """Return the limits of input in their groups, each with its value."""
    _, *parts = _GROUP.split(getsource(limits))
    groups = zip(parts[::2], parts[1::2], strict=True)
    shown = [(title, source) for title, source in groups if title in _GROUPS]
    return _HEAD + "".join(f"\n## {title.capitalize()}\n\n{_table(source)}" for title, source in shown)


def _table(source: str) -> str:
    return "| limit | value | of |\n| --- | --- | --- |\n" + "".join(_rows(source))


def _rows(source: str) -> Iterator[str]:
    for limit, reason in pairwise(ast.parse(source).body):
        if isinstance(limit, ast.Assign) and isinstance(reason, ast.Expr):
            name = ast.unparse(limit.targets[0])
            value = getattr(limits, name)
            shown = f"{value:,}" if isinstance(value, int) else f"{value:g}"
            yield f"| `{name}` | {shown} | {ast.literal_eval(reason.value).partition(': ')[0].rstrip('.')} |\n"
