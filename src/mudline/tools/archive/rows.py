"""Tables of an archive, each a list of columns with types and meanings, and the rows of a deck for each table.

The first column of each table is `file`, by which tables are joined. Numbers are in the units of their deck. A deck is
read, resolved and linted once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from hashlib import blake2b
from pathlib import Path
from typing import Annotated, Any, NamedTuple, get_args, get_type_hints

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.engine import LintSettings, all_findings, errors_of, lint_context
from mudline.checks.fixing import with_severities
from mudline.language.deck.keyword_text import meaning
from mudline.language.deck.loading import coverage_of, extent, load_bytes
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.parameters import Parameters, folded, name_key
from mudline.language.diagnostics import DeckError, Diagnostic, Severity, Where
from mudline.language.keywords.catalogue import is_extension, is_superseded
from mudline.language.keywords.model import Block
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import Equation, Names
from mudline.language.syntax.tree import data_lines
from mudline.model.scene.model import Scene
from mudline.model.scene.sets import ALL


class DeckRow(NamedTuple):
    """A deck."""

    units: Annotated[str, "unit system of all its numbers: metric, imperial or user"]
    ok: Annotated[bool, "true if no rule of severity error finds anything"]
    errors: Annotated[int, "findings of severity error"] = 0
    warnings: Annotated[int, "findings of severity warning"] = 0
    infos: Annotated[int, "findings of severity info"] = 0
    sections: Annotated[int, "sections"] = 0
    keywords: Annotated[int, "keyword blocks"] = 0
    read: Annotated[int, "keyword blocks that were read completely"] = 0
    partly: Annotated[int, "keyword blocks of which a line or a part was not read"] = 0
    unread: Annotated[int, "keyword blocks whose lines were not read"] = 0
    nodes: Annotated[int, "nodes"] = 0
    elements: Annotated[int, "elements"] = 0
    sets: Annotated[int, "element sets, without ALL"] = 0
    curves: Annotated[int, "curves of the seabed"] = 0
    length: Annotated[float | None, "total length of the elements"] = None
    depth: Annotated[float | None, "water depth of the last *OCEAN"] = None
    content: Annotated[int | None, "digest of its values; equal where only layout and comments differ"] = None
    key: Annotated[str, "digest of its bytes, its form, and the program and the settings that read it"] = ""


class KeywordRow(NamedTuple):
    """A keyword block."""

    number: Annotated[int, "place among the blocks of the deck, from 1"]
    section: Annotated[str, "section, without $"]
    keyword: Annotated[str, "keyword, without *"]
    line: Annotated[int | None, "line of the keyword"]
    is_read: Annotated[bool, "true if its lines are read; otherwise they are passed through unchanged"]
    partly: Annotated[bool, "true if a line or a part of it was not read"]
    superseded: Annotated[bool, "true if a newer keyword supersedes it"]
    extension: Annotated[bool, "true if it is an extension of mudline"]
    content: Annotated[int, "digest of its values; equal for equal blocks"]
    others: Annotated[int, "digest of all other blocks; equal where decks differ in this block only"]


class SetRow(NamedTuple):
    """An element set, without the predefined ALL."""

    name: Annotated[str, "name"]
    elements: Annotated[int, "number of its elements"]
    first: Annotated[int | None, "smallest element number"]
    last: Annotated[int | None, "largest element number"]
    complete: Annotated[bool, "true if the deck lists all its elements"]
    used: Annotated[bool, "true if anything in the deck names it"]
    line: Annotated[int | None, "line of its definition"]


class CurveRow(NamedTuple):
    """A curve: those of a seabed first, then all others."""

    curve: Annotated[int, "place among the curves of the deck, from 1"]
    name: Annotated[str, "name; of *EMBEDMENT that of its set"]
    kind: Annotated[str, "kind of curve, such as force-embedment curve"]
    keyword: Annotated[str, "keyword that gives it"]
    legacy: Annotated[bool, "true for a curve of *EMBEDMENT"]
    ratios: Annotated[
        list[float],
        "embedment ratios of its points, sorted: penetration / external diameter; for others the abscissa",
    ]
    forces: Annotated[list[float], "forces per unit length at these points; for others the ordinate"]
    first_ratio: Annotated[float | None, "smallest embedment ratio"]
    last_ratio: Annotated[float | None, "largest embedment ratio"]
    largest_force: Annotated[float | None, "largest force per unit length at a point"]
    steepest: Annotated[float | None, "largest d force / d ratio of a segment"]
    elements: Annotated[int, "elements that follow it"]
    shape: Annotated[int, "digest of its sorted points; equal for equal curves"]
    line: Annotated[int | None, "line of its name"]


class LawRow(NamedTuple):
    """A seabed stiffness or curve that the deck assigns to a set."""

    law: Annotated[int, "place among the laws of the deck, from 1"]
    keyword: Annotated[str, "keyword that gives it"]
    family: Annotated[str, "legacy or new"]
    kind: Annotated[str, "curve, linear, rigid or none"]
    set: Annotated[str, "set to which it is assigned"]
    curve: Annotated[int | None, "number of its curve"]
    stiffness: Annotated[float | None, "linear stiffness per unit length"]
    set_elements: Annotated[int, "elements of the set"]
    elements: Annotated[int, "elements that follow it"]
    line: Annotated[int | None, "line of the assignment"]


class ParameterRow(NamedTuple):
    """A parameter of *PARAMETERS."""

    name: Annotated[str, "name"]
    value: Annotated[float | None, "value, if it is a number"]
    text: Annotated[str | None, "value, if it is a text"]
    equation: Annotated[str | None, "equation, if one gives the value"]
    used: Annotated[bool | None, "true if an equation names it; none in a deck with variations"]
    line: Annotated[int | None, "line of its value"]


class FindingRow(NamedTuple):
    """A finding of mudline lint, under the configuration of the deck."""

    code: Annotated[str, "code of the rule"]
    slug: Annotated[str, "name of the rule"]
    severity: Annotated[str, "error, warning or info"]
    message: Annotated[str, "message"]
    line: Annotated[int | None, "line, from 1"]
    start_column: Annotated[int | None, "column, from 1"]
    end_line: Annotated[int | None, "line of the end"]
    end_column: Annotated[int | None, "column of the end, exclusive"]
    fix: Annotated[str | None, "safe or unsafe, if it can be fixed"]
    blocks: Annotated[bool, "true if it prevents evaluation of the deck"]


TABLES: dict[str, type[Any]] = {
    f"{row.__name__.removesuffix('Row').lower()}s": row
    for row in (DeckRow, KeywordRow, SetRow, CurveRow, LawRow, ParameterRow, FindingRow)
}
"""Class of the rows of each table, by the name of its file and view."""


def columns_of(table: str) -> Iterator[tuple[Any, ...]]:
    """Yield name, Python type and meaning of the columns of a table."""
    yield "file", str, "path of the deck from the folder that holds the archive"
    for name, hint in get_type_hints(TABLES[table], include_extras=True).items():
        yield name, *get_args(hint)


# -------------------------------------------------------------------------------------------------- rows of a deck

_DIGESTS = 1 << 63
"""Upper bound of digests, which are whole numbers in the tables."""
_EQUATION = re.compile(r"=\[((?:[^\[\]]|\[[^\[\]]*\])*)\]|%([^%\s]+)%")
_WORD = re.compile(r"[^\W\d][\w.]*")

Rows = dict[str, list[Any]]
"""Rows of a deck by table, without the column `file`."""


def rows_of(data: bytes, name: str, settings: LintSettings, folder: Path | None) -> Rows:
    """Return the rows of a deck of this content and file name; never raises for content."""
    try:
        deck = load_bytes(data, name, units=settings.units, folder=folder)
    except DeckError as error:
        row = DeckRow(settings.units or "user", ok=False, errors=len(error.diagnostics))
        return {"decks": [row], "findings": list(_findings(error.diagnostics))}
    context = LintContext(deck, dialect=settings.dialect)
    findings = with_severities(lint_context(context, settings.rules), settings)
    scene, coverage = context.scene, coverage_of(deck)
    keywords = list(_keywords(deck))
    rows: Rows = {
        "findings": list(_findings(findings)),
        "keywords": keywords,
        "sets": list(_sets(deck, scene)),
        "curves": list(_curves(deck, scene)),
        "laws": list(_laws(deck, scene)),
        "parameters": list(_parameters(deck, data)),
    }
    levels = [finding.severity for finding in findings]
    severities = (levels.count(Severity.ERROR), levels.count(Severity.WARNING), levels.count(Severity.INFO))
    read = (coverage.total, coverage.read, sum(coverage.partly.values()), sum(coverage.unread.values()))
    sizes = (len(scene.node_ids), len(scene.element_ids), len(rows["sets"]), len(scene.laws.curves))
    ok = not errors_of(all_findings(context))
    measures = (float(np.nansum(scene.length)), scene.surroundings.depth)
    content = (keywords[0].content + keywords[0].others) % _DIGESTS if keywords else 0
    row = DeckRow(deck.units, ok, *severities, len(deck.sections), *read, *sizes, *measures, content)
    return {"decks": [row], **rows}


def _line(deck: Deck, where: Where | None) -> int | None:
    return None if where is None else deck.place(where).line


def _findings(findings: Iterable[Diagnostic]) -> Iterator[FindingRow]:
    for each in findings:
        place = (each.line, each.column, each.end_line, each.end_column)
        fix = each.fix.applicability if each.fix else None
        yield FindingRow(each.code, each.slug, each.severity.value, each.message, *place, fix, each.blocks)


def _keywords(deck: Deck) -> Iterator[KeywordRow]:
    blocks = deck.every_block()
    digests = [_digest(section, block) for _, section, block in blocks]
    total = sum(digests)
    for place, ((where, section, block), digest) in enumerate(zip(blocks, digests, strict=True), 1):
        names = (section, block.keyword, _line(deck, where), type(block) is not Opaque)
        facts = (extent(block) == "partly", is_superseded(block.keyword), is_extension(block.keyword))
        yield KeywordRow(place, *names, *facts, digest, (total - digest) % _DIGESTS)


def _sets(deck: Deck, scene: Scene) -> Iterator[SetRow]:
    named = {key: entry for key, entry in scene.set_table.named.items() if key != ALL}
    names = scene.context.names_of((Names.SET, Names.SUBSET))
    used = {name_key(use.name) for each in names for use in each.used}
    for key, entry in named.items():
        ids = scene.element_ids[entry.elements]
        first, last = (int(ids.min()), int(ids.max())) if len(ids) else (None, None)
        is_used = key in used or key in scene.context.unread_text
        yield SetRow(entry.name, len(ids), first, last, not entry.open, is_used, _line(deck, entry.where))


def _curves(deck: Deck, scene: Scene) -> Iterator[CurveRow]:
    """Yield the curves of the seabed, then all other curves, which no element follows."""
    for place, entry in enumerate([*scene.laws.curves, *scene.other_curves]):
        followers = len(scene.followers(place)) if entry.of_seabed and len(scene.element_ids) else 0
        curve = entry.curve
        over, values = (curve.ratios, curve.forces) if curve else np.ascontiguousarray(entry.points.T)
        first, last, largest = map(float, (over[0], over[-1], values.max())) if len(over) else (None, None, None)
        steepest = float(curve.slopes.max()) if curve else None
        points = (over.tolist(), values.tolist(), first, last, largest, steepest)
        shape = _number(over.tobytes() + values.tobytes())
        line, legacy = _line(deck, entry.title), entry.embedment
        yield CurveRow(place + 1, entry.name, entry.kind, entry.keyword, legacy, *points, followers, shape, line)


def _laws(deck: Deck, scene: Scene) -> Iterator[LawRow]:
    laws = scene.laws.set_laws
    followers = np.bincount(scene.laws.of_element + 1, minlength=len(laws) + 1)[1:].tolist()
    for place, (law, elements) in enumerate(zip(laws, followers, strict=True), 1):
        keyword = scene.deck.sections[law.where.section].blocks[law.where.block].keyword
        names = (place, keyword, law.family, law.kind.name.lower(), law.set_.name)
        numbers = (law.curve + 1 or None, law.stiffness, len(law.set_.elements), elements)
        yield LawRow(*names, *numbers, _line(deck, law.where))


def _parameters(deck: Deck, data: bytes) -> Iterator[ParameterRow]:
    if "PARAMETERS" not in deck.keywords("PREPROCESSOR"):
        return
    parameters = Parameters(deck)
    varied = "VARIATION" in deck.keywords("PREPROCESSOR")
    equations = (match[1] or match[2] for match in _EQUATION.finditer(data.decode("utf-8", "replace")))
    used = {folded(word) for piece in equations for word in (*_WORD.findall(piece), piece)}
    for key, definition in parameters.definitions.items():
        value = parameters.values.get(key)
        text = value if isinstance(value, str) else None
        amount = None if text is not None or value is None else float(value)
        equation = str(definition.value) if isinstance(definition.value, Equation) else None
        is_used = None if varied else key in used
        yield ParameterRow(definition.name, amount, text, equation, is_used, _line(deck, definition.where))


def _number(data: bytes) -> int:
    return int.from_bytes(blake2b(data, digest_size=8).digest()) >> 1


def _digest(section: str, block: Block | Opaque) -> int:
    """Return a digest of the values of a block; layout and comments do not count."""
    if type(block) is Opaque:
        block = Opaque(keyword=block.keyword, lines=data_lines(block.lines))
    values = (f"{path} {_plain(value)}" for path, value in meaning(block).items())
    return _number("\n".join([section, *values]).casefold().encode("utf-8", "backslashreplace"))


def _plain(value: object) -> object:
    """Return a value as it is compared: a text without layout, a table as its words and a digest of its numbers."""
    if isinstance(value, Table):
        return sorted(value.words.items()), _number(value.values.tobytes() + value.lengths.tobytes())
    if isinstance(value, tuple):  # a line that is not read
        return tuple(map(_plain, value))
    return " ".join(value.split()) if isinstance(value, str) else value
