"""The stubs that tell type checkers the class of each keyword. `make index` writes them, a test holds them."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import groupby
from pathlib import Path

from mudline.language.keywords.values import Entry
from tests.language.keywords.index import declared_entries

KEYWORDS = Path("src/mudline/keywords.pyi")
TYPED = Path("src/mudline/language/deck/typed.pyi")

_LIBRARY = "mudline.language.keywords.library"
_MADE = "# fmt: off\n# `make index` makes this of the declarations in the library: change those."
_TYPED = """\
# ruff: noqa: E501
{made}
from collections.abc import Iterator
from typing import Any, Literal, TypeVar, overload

from mudline import keywords
from mudline.language.deck.editable import EditableDeck
from mudline.language.diagnostics import Where
from mudline.language.keywords.model import Block

_B = TypeVar("_B", bound=Block)

class TypedDeck(EditableDeck):
    @overload
    def block(self, keyword: type[_B], section: str | None = ...) -> _B: ...
{block}
    @overload
    def block(self, keyword: str, section: str | None = ...) -> Any: ...
    @overload
    def blocks(self, keyword: type[_B], section: str | None = ...) -> Iterator[tuple[Where, _B]]: ...
{blocks}
    @overload
    def blocks(self, keyword: str, section: str | None = ...) -> Iterator[tuple[Where, Any]]: ...
"""


def stubs() -> Mapping[Path, str]:
    """The text of each stub by its path in the repository."""
    read = sorted((entry for entry in declared_entries() if not entry.kept), key=lambda entry: entry.keyword)
    by_keyword = {keyword: list(found) for keyword, found in groupby(read, key=lambda entry: entry.keyword)}
    typed = _TYPED.format(
        made=_MADE,
        block="\n".join(_overload("block", keyword, found, "{}") for keyword, found in by_keyword.items()),
        blocks="\n".join(
            _overload("blocks", keyword, found, "Iterator[tuple[Where, {}]]") for keyword, found in by_keyword.items()
        ),
    )
    classes = (_imported(entry) for entry in sorted(read, key=lambda one: one.name))
    return {KEYWORDS: "\n".join(["# ruff: noqa: I001", _MADE, *classes, ""]), TYPED: typed}


def _imported(entry: Entry) -> str:
    return f"from {_LIBRARY}.{entry.module} import {entry.name} as {entry.name}"


def _overload(method: str, keyword: str, found: list[Entry], form: str) -> str:
    """One of a keyword; where it means other things in other sections, without one the model's is looked for."""
    meant = [entry for entry in found if "MODEL" in entry.sections] or found
    section = "str | None" if len(found) == 1 else "None"
    given = f'keyword: Literal["{keyword}"], section: {section} = ...'
    kinds = " | ".join(f"keywords.{entry.name}" for entry in meant)
    return f"    @overload\n    def {method}(self, {given}) -> {form.format(kinds)}: ..."
