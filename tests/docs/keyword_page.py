"""docs/keywords/, a page per keyword, from the declarations of the keywords."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.language.keywords import catalogue
from mudline.language.keywords.format import format_lines
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import OpaqueKeyword
from tests.docs.keyword_fields import inferences, tables
from tests.docs.keyword_rules import Declared, keyword_of, rules_of
from tests.docs.marking import MADE, marked

_HEAD = """{made}

# `{title}`

{summary}

Section: {sections}. Subject: {subject}. [All keywords](../keywords.md).
"""

_FORMAT = """## Format

```text
{lines}
```

How to read this: [formats](../keywords.md#formats). Where a number belongs, an equation `=[...]` may be written.
"""

_KEPT = """## Format

The format of this keyword is not public. Its lines are passed through unchanged, in every form of the deck
and through every change; in JSON and YAML they are under `lines`.
"""

_EXAMPLE = """## Example

```mudline
{example}
```
"""

_RULES = """## Rules

{table}The rules on syntax (`SYN...`) hold for every keyword: [all rules](../rules/README.md).
"""

_CERTAIN = """## Certain and inferred

{text}
"""


def keyword_pages() -> dict[str, str]:
    """The text of every page by its path in the repository."""
    return {f"docs/keywords/{page_name(each)}.md": keyword_page(each) for each in declarations()}


def declarations() -> list[Declared]:
    """Every keyword that a module declares, in the order of the catalogue."""
    return [*models(), *catalogue.opaque_keywords()]


def models() -> list[type[Block]]:
    """Those whose fields are read."""
    return catalogue.block_classes()


def title(declared: Declared) -> str:
    """The keyword as it is written."""
    return f"*{keyword_of(declared)}"


def page_name(declared: Declared) -> str:
    """The file of a page, without its suffix: `seabed-properties`; of a second declaration, with its section."""
    keyword = keyword_of(declared)
    first = catalogue.entries(keyword)[0].sections
    own = keyword if declared.sections == first else f"{keyword} {declared.sections[0]}"
    return re.sub(r"[^a-z0-9]", "-", own.lower())


def sections_of(declared: Declared) -> str:
    """Where a keyword belongs."""
    return " or ".join(f"`${name}`" for name in declared.sections)


def keyword_page(declared: Declared) -> str:
    """The page of one keyword."""
    parts = _of_kept(declared) if isinstance(declared, OpaqueKeyword) else _of_model(declared)
    return "\n".join([_head(declared), *parts])


def _head(declared: Declared) -> str:
    return _HEAD.format(
        made=MADE,
        title=title(declared),
        summary=marked(declared.summary),
        sections=sections_of(declared),
        subject=declared.subject,
    )


def _of_model(block: type[Block]) -> Iterator[str]:
    yield _FORMAT.format(lines="\n".join(format_lines(block)))
    yield "## Fields\n\nUnits are given as metric / imperial; a deck with user units has its own.\n"
    for caption, table in tables(block):
        yield "\n".join([*([caption, ""] if caption else []), *table, ""])
    yield _EXAMPLE.format(example=block.example.rstrip("\n"))
    if block.facts.computed_in:
        yield f"What is computed from it: [the contact evaluator](../contact.md#{block.facts.computed_in}).\n"
    yield _rules(block)
    yield _CERTAIN.format(text=_certain(block))


def _of_kept(kept: OpaqueKeyword) -> Iterator[str]:
    yield _KEPT
    if kept.name_settings or kept.labels:
        yield "\n".join(["## Names", "", *_names(kept), ""])
    yield (
        _EXAMPLE.format(example=kept.example.rstrip("\n")) + "\nWhat its lines may look like, no definition of them.\n"
    )
    yield _rules(kept)
    yield _CERTAIN.format(text=f"Certain: {marked(kept.certain)}\n\nInferred: {marked(kept.inferred)}")


def _names(kept: OpaqueKeyword) -> Iterator[str]:
    if kept.name_settings:
        yield from ("| setting | names |", "| --- | --- |")
        yield from (f"| `{key}=` | {what.value} |" for key, what in kept.name_settings.items())
    if kept.labels:
        yield from (*([""] if kept.name_settings else []), "Any text among its lines may be the label of a node.")


def _rules(declared: Declared) -> str:
    found = rules_of(declared)
    rows = [f"| [{rule.code.code}](../rules/{rule.code.code}.md) | {marked(rule.page.title)} |" for rule in found]
    return _RULES.format(table="\n".join(["| code | finds |", "| --- | --- |", *rows, "", ""]) if found else "")


def _certain(block: type[Block]) -> str:
    says = (
        "This keyword is mudline's own: the page defines it"
        if block.facts.extension
        else "What this page says is certain"
    )
    says += f", by the page `{block.page}` of the manual" if block.page else ""
    if found := inferences(block):
        return "\n".join([f"{says}, but for what is inferred:", "", *(f"* {each}" for each in found)])
    return f"{says}. Nothing is inferred."
