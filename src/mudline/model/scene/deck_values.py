"""Values of a deck: numbers, defaults, files that it names, and names that unread lines make."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from itertools import islice
from pathlib import Path, PurePath

from mudline.basics.files import look
from mudline.basics.outside import is_made_by_system, is_refused, project_of
from mudline.basics.units import FOOT, POUND
from mudline.language.deck.model import Deck, NamedPlace, Opaque
from mudline.language.deck.parameters import Parameters, bare, folded, unquoted
from mudline.language.diagnostics import Severity, Span, Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import of_keys
from mudline.language.keywords.model import Block, Row, record_schema
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import LINE_SETS, Names
from mudline.language.syntax.fields import FieldGroup, read_line
from mudline.language.syntax.rows import read_number
from mudline.language.syntax.tree import data_lines

DEFAULT_DENSITY = {"metric": 1025.0, "imperial": 1025.0 * FOOT**4 / POUND}
DEFAULT_GRAVITY = {"metric": 9.81, "imperial": 9.81 / FOOT}
LARGEST_MOBILISATION = {"metric": 10.0 * FOOT, "imperial": 10.0}
"""Largest default mobilisation length: 10 ft."""


def number(part: object, name: str, default: float = math.nan) -> float:
    """Return a value if it is given and a number, else `default`."""
    value = getattr(part, name, None)
    return float(value) if isinstance(value, float | int) else default


def file_name(written: str) -> str:
    """Return a file's name as a deck writes it, without quotes and with `/` between folders."""
    return unquoted(written.strip()).replace("\\", "/")


def find_file(folder: Path | None, written: str) -> Path | None:
    """Return the regular file that a deck in `folder` names; None if it is not there or must not be read.

    A name without a folder refers to a file next to the deck. A deck without a path (`folder` None) finds nothing.
    """
    name = file_name(written)
    if folder is None or not name or "\0" in name:
        return None
    path = look(folder / name)
    try:
        usable = path.is_file() and not is_made_by_system(path) and not is_refused(path, folder)
    except OSError:
        return None
    return path if usable else None


def not_found(folder: Path, name: str) -> tuple[str, Severity]:
    """Return the reason why a deck in a folder does not get the file that it names, and its severity.

    It is an error if the file is refused, a warning if files with the same suffix are there, and an info otherwise.
    """
    try:
        refused = "\0" not in name and is_refused(folder / name, folder)
    except OSError:
        refused = False
    if refused:
        message = f"the file {shown(name)} lies outside of the project {project_of(folder).as_posix()}, and is refused"
        return message, Severity.ERROR
    looked = f"looked in {folder.as_posix()}"
    message = f"the file {shown(name)} was not found ({looked}): correct the name, or put the file there"
    return message, Severity.WARNING if _has_siblings(folder / name) else Severity.INFO


_MOST_BESIDE = 1000
"""Number of files of a folder that are looked at; a larger folder is taken to have every kind of file."""


def _has_siblings(path: Path) -> bool:
    """Return True if the folder of a file has other files with its suffix."""
    try:
        with os.scandir(path.parent) as entries:
            names = [entry.name for entry in islice(entries, _MOST_BESIDE)]
    except (OSError, ValueError):
        return False
    return len(names) == _MOST_BESIDE or any(PurePath(name).suffix.lower() == path.suffix.lower() for name in names)


def missing_files(deck: Deck, names: Iterable[NamedPlace]) -> Iterator[tuple[Where, Path, str]]:
    """Yield every FILE= of a deck itself that names no file: its place, the folder searched, the name as filled.

    `names` are those of the deck, also of the decks that it continues. Nothing is yielded for a deck without a path, as
    it is not known where its files could be.
    """
    if deck.folder is None:
        return
    own = len(deck.own_sections)
    files = [(one.where, one.name) for one in names if one.kind is Names.FILE and one.name and one.where.section < own]
    parameters = Parameters(deck) if files else None
    for where, written in files:
        name = file_name(parameters.filled(written) if parameters else written)
        if "%" not in name and find_file(deck.folder, name) is None:
            yield where, deck.folder, name


_WORD = re.compile(r"[^-+.,0-9 \t]")


def is_read_definer(keyword: str) -> bool:
    """Return True if a keyword is read, and its lines make objects which the deck does not show."""
    facts = catalogue.facts_of(keyword)
    return bool(facts.makes) and not facts.out_of_sight


def definition_by(definer: str, keyword: str) -> str:
    """Return in words how a definer may define an object of `keyword`; "" if it cannot."""
    if keyword not in makes(definer):
        return ""
    if is_read_definer(definer):
        return f"the lines of *{definer}, which this deck does not show, may define it"
    why = "whose nodes have no coordinates here" if catalogue.facts_of(definer).out_of_sight else "which is not read"
    return f"*{definer}, {why}, may define it"


def unread_makers(definers: Iterable[str], keyword: str) -> list[str]:
    """Return the definers that are not read and may define objects of `keyword`."""
    return [definer for definer in definers if keyword in makes(definer) and not is_read_definer(definer)]


def makes_labels(definer: str) -> bool:
    """Return True if a definer gives labels to nodes."""
    kept = catalogue.opaque_keyword("MODEL", definer)
    return kept is not None and kept.labels


@lru_cache(1024)
def makes(keyword: str) -> tuple[str, ...]:
    """Return the keywords whose objects a keyword of the model makes out of sight."""
    kept = catalogue.opaque_keyword("MODEL", keyword)
    return kept.makes if kept else catalogue.facts_of(keyword).makes


def first_written(deck: Deck, named: Callable[[Block | Opaque], Iterator[str]]) -> dict[str, str]:
    """Return the names in every block of `$MODEL`, read or not, by their folded form."""
    names: dict[str, str] = {}
    blocks = (block for _, section, block in deck.every_block() if section == "MODEL")
    for text in filter(None, (bare(name) for block in blocks for name in named(block))):
        names.setdefault(folded(text), text)
    return names


def sets_in(block: Block | Opaque) -> Iterator[str]:
    """Yield the element sets that a block of lines names."""
    if isinstance(block, Opaque):
        kept = catalogue.opaque_keyword("MODEL", block.keyword)
        keys = kept.name_settings if kept else {}
        for group in settings_in(block.lines) if keys else ():
            if kind := keys.get(group.key):
                yield from (field.text for field in group.fields[: None if kind is Names.SETS else 1])
    elif block.facts.makes:
        for _, _, value in block.walk(of_keys(*LINE_SETS)):
            name = getattr(value, record_schema(type(value)).columns[0].name) if isinstance(value, Row) else value
            if isinstance(name, str) and name:
                yield name


def settings_in(lines: Iterable[str], *, words: bool = True) -> Iterator[FieldGroup]:
    """Yield the settings in lines that are not read; with `words` none of a line with C and a letter in column 1."""
    for line in data_lines(lines, words=words):
        yield from read_line(line, Span(0, len(line))).groups if "=" in line else ()


def texts_in(block: Block | Opaque) -> Iterator[str]:
    """Yield every value of a block that is neither a number nor an equation."""
    kept = catalogue.opaque_keyword("MODEL", block.keyword)
    if not isinstance(block, Opaque) or kept is None or not kept.labels:
        return
    for line in data_lines(block.lines, words=True):
        if _WORD.search(line):
            texts = (field.text for group in read_line(line, Span(0, len(line))).groups for field in group.fields)
            yield from (text for text in texts if read_number(text) is None and not text.startswith("=["))
