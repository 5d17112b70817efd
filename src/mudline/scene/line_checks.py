"""Names that the keywords of lines use of each other, and labels that are spelt nearly as one that a line makes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING, cast

from mudline.codes.references import REF001, REF005, REF006
from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Severity, Where
from mudline.keywords.text import shown
from mudline.keywords.values import Label
from mudline.scene.context import Context
from mudline.scene.harvest import bare, may_label

if TYPE_CHECKING:
    from mudline.keywords.library.element import ElementRows, Elements
    from mudline.keywords.library.element_sets import ElementSets
    from mudline.keywords.library.line_path_sections import LinePathSections
    from mudline.keywords.library.line_section_groups import LineSectionGroups

_PATHS = "LINE PATHS"
_GROUPS = "LINE SECTION GROUPS"
_MARKS = re.compile(r"[0-9]+|\b\w{1,2}\b")
"""Numbers and words of one or two letters: things of a kind are told apart by them."""


def check_lines(context: Context) -> None:
    """The lines and groups that `*LINE PATH SECTIONS` names, and the labels of elements and sets: warnings at most."""
    groups = _groups(context)
    for where, block in context.deck.blocks("LINE PATH SECTIONS"):
        for index, path in enumerate(cast("LinePathSections", block).paths):
            place = where._replace(path=("paths", index))
            if path.line and _PATHS in context.definers:
                inner = place._replace(path=(*place.path, "line"))
                _check_name(context, ("LINE=", "line", _PATHS), path.line, inner, context.labels)
            for number, section in enumerate(path.sections):
                if section.repeat:
                    inner = place._replace(path=(*place.path, "sections", number, "repeat"))
                    _check_name(context, ("REPEAT=", "group", _GROUPS), section.repeat, inner, groups)
    for code, label, where in chain(_of_elements(context), _of_sets(context)) if context.definers else ():
        check_label(context, code, label, where)


def check_label(context: Context, code: Code, label: str, where: Where) -> None:
    """A label that no line names, but is spelt nearly as one that a line does, is told under a code, as a warning.

    Nothing is said of other labels: lines are not read, and may make labels in ways that are not known.
    """
    name = bare(label)
    if not context.definers or folded(name) in context.labels:
        return
    near = context.near(name, context.labels)
    if near and _is_slip(folded(name), near) and not context.doubted(where):
        makers = " or ".join(f"*{keyword}" for keyword in context.definers if may_label(keyword))
        message = f"label {shown(label)} does not stand in {makers} (did you mean {{{context.labels[near]}}}?)"
        context.tell(code, f"{message}: correct it", where, Severity.WARNING)


def _is_slip(name: str, near: str) -> bool:
    """Whether one of two names that are spelt nearly alike is a slip of the pen: {End 2} is none of {End 1}."""
    return _MARKS.findall(name) == _MARKS.findall(near)


def _check_name(context: Context, what: tuple[str, str, str], name: str, where: Where, known: dict[str, str]) -> None:
    """A name, given by a KEY for a thing that a keyword defines; `known` has the names by their folded form."""
    key, thing, keyword = what
    if folded(bare(name)) in known:
        return
    near = context.near(name, known)
    hint = f" (did you mean {known[near]}?)" if near else ""
    message = f"{key} names no {thing}: {shown(name)} is not defined{hint}; define it in *{keyword}"
    supplier = context.supplier(keyword)
    context.tell(REF001, f"{message}; {supplier}" if supplier else message, where, Severity.WARNING)


def _groups(context: Context) -> dict[str, str]:
    """Names of the groups of sections by their folded form."""
    blocks = (cast("LineSectionGroups", block) for _, block in context.deck.blocks(_GROUPS))
    return {folded(bare(group.name)): group.name for block in blocks for group in block.groups if group.name}


def _of_elements(context: Context) -> Iterator[tuple[Code, str, Where]]:
    """Labels of nodes."""
    for where, block in context.deck.blocks("ELEMENT"):
        for index, entry in enumerate(cast("Elements", block).entries):
            if hasattr(entry, "elements"):
                for (row, column), word in cast("ElementRows", entry).elements.words.items():
                    if isinstance(word, Label):
                        yield REF006, word, where._replace(path=("entries", index, "elements", row, column))


def _of_sets(context: Context) -> Iterator[tuple[Code, str, Where]]:
    """Labels of elements."""
    for where, block in context.deck.blocks("ELEMENT SETS"):
        for index, entry in enumerate(cast("ElementSets", block).sets):
            for number, member in enumerate(entry.members):
                for at, element in enumerate(getattr(member, "elements", None) or ()):
                    if isinstance(element, Label):
                        path = ("sets", index, "members", number, "elements", at)
                        yield REF005, element, where._replace(path=path)
