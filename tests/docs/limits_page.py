"""The page of limits, made from `mudline.basics.limits`: each with its value and its reason."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from inspect import getsource
from itertools import pairwise

from mudline.basics import limits

_HEAD = """# Limits

What guards against hostile or huge input, and how much a message shows. Where a limit refuses something, the message
says so with its line. A number that belongs to a file format or to one algorithm is not here.
"""
_GROUP = re.compile(r"^# -+ (.+)$", re.MULTILINE)


def limits_page() -> str:
    """The limits in their groups, each with its value and its reason."""
    _, *parts = _GROUP.split(getsource(limits))
    groups = zip(parts[::2], parts[1::2], strict=True)
    return _HEAD + "".join(f"\n## {title.capitalize()}\n\n{_table(source)}" for title, source in groups)


def _table(source: str) -> str:
    return "| limit | value | of what, and why |\n| --- | --- | --- |\n" + "".join(_rows(source))


def _rows(source: str) -> Iterator[str]:
    for limit, reason in pairwise(ast.parse(source).body):
        if isinstance(limit, ast.Assign) and isinstance(reason, ast.Expr):
            name = ast.unparse(limit.targets[0])
            value = getattr(limits, name)
            shown = f"{value:,}" if isinstance(value, int) else f"{value:g}"
            yield f"| `{name}` | {shown} | {ast.literal_eval(reason.value)} |\n"
