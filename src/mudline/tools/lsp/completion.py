"""Completion at the cursor: sections, keywords with their lines, settings, values and names."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import count, islice
from typing import NamedTuple

from lsprotocol import types

from mudline.basics.limits import MOST_OFFERED
from mudline.language.diagnostics import Span
from mudline.language.expression.evaluation import FORMS, FUNCTIONS
from mudline.language.keywords import catalogue
from mudline.language.keywords.fields import Setting
from mudline.language.keywords.model import Block, FieldSpec, record_schema
from mudline.language.keywords.reader import all_keys
from mudline.language.keywords.values import Names
from mudline.language.syntax.tree import LeafKind, Spot
from mudline.tools.lsp.decks import Analysis, value_text
from mudline.tools.lsp.help import field_help, keyword_help, section_help
from mudline.tools.lsp.places import slot_of_key

TRIGGERS = ["$", "*", "=", "[", ",", "{", "%"]
_HEAD = re.compile(r"[ \t]*([$*])[^\r\n]*$")
_IN_EQUATION = re.compile(r"=\[[^\]\r\n]*?([A-Za-z_]\w*)?$")
_SETTING = re.compile(r"(?:^|,)[ \t]*([A-Za-z][\w \t-]*)=([^=]*)$")
_WORD = re.compile(r"[^,=\s][^,=]*$")
_FIELD = re.compile(r'[^,{}="\[\]]+')
_ESCAPED = re.compile(r"([$}\\])")


class _Cursor(NamedTuple):
    """Place of a completion, with the text before it on its line, and its block."""

    analysis: Analysis
    offset: int
    before: str
    spot: Spot
    snippets: bool

    def item(
        self, label: str, kind: types.CompletionItemKind, text: str, start: int, detail: str = ""
    ) -> types.CompletionItem:
        """Return an item that replaces the text from `start` on."""
        range_ = self.analysis.document.range(Span(start, self.offset))
        return types.CompletionItem(label, kind=kind, detail=detail or None, text_edit=types.TextEdit(range_, text))


def completions(analysis: Analysis, offset: int, *, snippets: bool) -> list[types.CompletionItem]:
    """Return the completions at an offset; `snippets` says that the editor accepts placeholders."""
    document = analysis.document
    line = document.source.line_around(offset)
    here = analysis.origin.tree.at(max(line.start - 1, 0))
    cursor = _Cursor(analysis, offset, document.text[line.start : offset], here, snippets)
    if head := _HEAD.match(cursor.before):
        start = line.start + head.start(1)
        return list(_sections(cursor, start) if head[1] == "$" else _keywords(cursor, start))
    comments = (leaf.span for leaf in here.part.leaves if leaf.kind is LeafKind.COMMENT)
    if any(span.start < offset < span.end for span in comments):
        return []
    if match := _IN_EQUATION.search(cursor.before):
        return list(_in_equation(cursor, line.start + (match.start(1) if match[1] else match.end())))
    declared = catalogue.block_class(here.section.name, here.keyword)
    items = list(_in_block(cursor, declared, line.start)) if declared else []
    if not cursor.before.strip():
        items += _keywords(cursor, offset)
        items += _sections(cursor, offset)
    return items


def resolved(item: types.CompletionItem) -> types.CompletionItem:
    """Return an item with its help."""
    data = item.data if isinstance(item.data, dict) else {}
    keyword, section = data.get("keyword"), data.get("section")
    if isinstance(section, str):
        text = keyword_help(keyword, section) if isinstance(keyword, str) else section_help(section)
        item.documentation = types.MarkupContent(types.MarkupKind.Markdown, text)
    return item


# ---------------------------------------------------------------------------------------------- sections and keywords


def _sections(cursor: _Cursor, start: int) -> Iterator[types.CompletionItem]:
    for name in catalogue.SECTIONS:
        item = cursor.item(f"${name}", types.CompletionItemKind.Module, f"${name}", start)
        item.data = {"section": name}
        yield item


def _keywords(cursor: _Cursor, start: int) -> Iterator[types.CompletionItem]:
    """Yield the keywords of the section first, then those allowed in any; with the lines of each, as an example."""
    section = cursor.spot.section.name
    for name in catalogue.keywords():
        belongs = catalogue.sections_of(name) or ()
        if belongs and section not in belongs:
            continue
        declared = catalogue.block_class(section, name)
        detail = declared.summary if declared else ""
        item = cursor.item(f"*{name}", types.CompletionItemKind.Keyword, f"*{name}", start, detail)
        item.data = {"section": section, "keyword": name}
        item.sort_text = f"{0 if declared else 1 if belongs else 2}{name}"
        yield item
        if declared is not None and cursor.snippets:
            lines = cursor.item(f"*{name} ...", types.CompletionItemKind.Snippet, snippet(declared), start, detail)
            lines.insert_text_format = types.InsertTextFormat.Snippet
            lines.filter_text = f"*{name}"
            lines.sort_text = f"{item.sort_text} ..."
            lines.data = item.data
            yield lines


def _literal(text: str) -> str:
    """Return a text in which a snippet finds no placeholders."""
    return _ESCAPED.sub(r"\\\1", text)


def snippet(declared: type[Block]) -> str:
    """Return the example of a keyword with its values as placeholders."""
    head, *lines = declared.example.rstrip("\n").split("\n")
    numbers = count(1)

    def place(match: re.Match[str]) -> str:
        text = match[0]
        if not text.strip():
            return text
        blanks = text[: len(text) - len(text.lstrip())]
        return f"{blanks}${{{next(numbers)}:{_literal(text.strip())}}}"

    filled = []
    for line in lines:
        key, equals, values = line.rpartition("=") if "[" not in line else ("", "", line)
        plain = '"' in line or "/" in line or "[" in line
        filled.append(_literal(line) if plain else f"{key}{equals}{_FIELD.sub(place, values)}")
    return "\n".join([_literal(head), *filled, "$0"])


# --------------------------------------------------------------------------------------------------- lines of a block


def _in_equation(cursor: _Cursor, start: int) -> Iterator[types.CompletionItem]:
    parameters = cursor.analysis.parameters
    for key, definition in parameters.definitions.items():
        value = value_text(parameters.values[key]) if key in parameters.values else "no value"
        yield cursor.item(definition.name, types.CompletionItemKind.Variable, definition.name, start, f"= {value}")
    for name, form in {**FUNCTIONS, **FORMS}.items():
        yield cursor.item(name, types.CompletionItemKind.Function, f"{name}(", start, form.meaning)


def _in_block(cursor: _Cursor, declared: type[Block], line: int) -> Iterator[types.CompletionItem]:
    match = _SETTING.search(cursor.before)
    slot = slot_of_key(declared, match[1]) if match else None
    word = _WORD.search(cursor.before)
    start = line + word.start() if word else cursor.offset
    if match is None:
        first = cursor.before.rpartition(",")[2].strip()
        if not first or first[0].isalpha():
            yield from _settings(cursor, declared, start, inline="," in cursor.before)
    elif slot is not None:
        values = match[2].split(",")
        field = _field(slot, len(values) - 1)
        if field is not None:
            yield from _values(cursor, field, start)
        if len(values) > 1 and field is None:
            yield from _settings(cursor, declared, start, inline=True)


def _field(slot: FieldSpec, index: int) -> FieldSpec | None:
    """Return the field of the value after `index` commas."""
    if slot.row is not None and (index or not slot.choices):
        columns = record_schema(slot.row).columns
        return columns[index] if index < len(columns) else None
    return slot if slot.many or not index else None


def _settings(cursor: _Cursor, declared: type[Block], start: int, *, inline: bool) -> Iterator[types.CompletionItem]:
    for key in sorted(all_keys(declared)):
        slot = slot_of_key(declared, key)
        if slot is not None and (not inline or (isinstance(slot.about, Setting) and slot.about.inline)):
            item = cursor.item(f"{key}=", types.CompletionItemKind.Property, f"{key}=", start, slot.about.meaning)
            item.documentation = types.MarkupContent(
                types.MarkupKind.Markdown, field_help(slot, cursor.analysis.deck.units)
            )
            item.sort_text = f" {key}"
            yield item


def _values(cursor: _Cursor, slot: FieldSpec, start: int) -> Iterator[types.CompletionItem]:
    for choice in slot.choices:
        yield cursor.item(choice, types.CompletionItemKind.EnumMember, choice, start)
    kind = types.CompletionItemKind.Reference
    for name, detail in islice(_named(cursor, slot.about.names), MOST_OFFERED):
        yield cursor.item(name, kind, name, start, detail)


def _named(cursor: _Cursor, kind: Names | None) -> Iterator[tuple[str, str]]:
    """Yield the names allowed in a field, each with a description."""
    scene, path = cursor.analysis.scene, cursor.analysis.document.path
    if kind in (Names.SET, Names.SETS, Names.SUBSET):
        yield from ((each.name, f"{len(each.elements)} elements") for each in scene.set_table.named.values())
    elif kind is Names.CURVE:
        curves = (each for each in scene.laws.curves if not each.embedment and each.name)
        yield from ((each.name, f"{len(each.points)} points") for each in curves)
    elif kind is Names.PARAMETER:
        yield from ((each.name, "") for each in cursor.analysis.parameters.definitions.values())
    elif kind in (Names.FILE, Names.DECK) and path:
        yield from ((other.name, "") for other in sorted(path.parent.iterdir()) if other != path and other.is_file())
