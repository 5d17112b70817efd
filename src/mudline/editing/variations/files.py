"""Files of an expansion: their paths, the text of each new deck, the manifest, and conflicts with existing files."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate
from pathlib import Path
from typing import cast

from mudline.basics.overwriting import is_read
from mudline.basics.short_repr import short_repr
from mudline.editing.variations.cases import Action, Addition, ParameterTargets
from mudline.language.deck.forms import KEYWORD, form_of
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.model import Deck, raw_lines
from mudline.language.deck.parameters import DEFINING
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import names_given
from mudline.language.keywords.reader import all_keys
from mudline.language.keywords.values import Names
from mudline.language.syntax.edits import TextEdit, edited_bytes
from mudline.language.syntax.tree import RawBlock, RawSection, is_data
from mudline.model.scene.deck_values import file_name, find_file, settings_in

_FORBIDDEN = re.compile(r'[\x00-\x1f\x7f<>:"|?*]')
_DRIVE = re.compile(r"[A-Za-z]:")
_DEVICES = frozenset(["CON", "PRN", "AUX", "NUL", *(f"{name}{n}" for name in ("COM", "LPT") for n in range(1, 10))])
PART_BYTES = 240
"""Longest name of a folder or a file, in bytes; the systems in use allow 255."""
PATH_BYTES = 1000
"""Longest path within the output folder, in bytes."""


def path_fault(path: str) -> str:
    """Return the reason why a path may not be used within the output folder, on any system; "" if it may."""
    if "\\" in path:
        return "holds a backslash: separate folders by /"
    if path.startswith("/") or _DRIVE.match(path):
        return "is absolute: it would leave the output folder"
    if len(path.encode(errors="replace")) > PATH_BYTES:
        return f"is longer than {PATH_BYTES} bytes"
    return next((fault for part in path.split("/") if (fault := _part_fault(part))), "")


def _part_fault(part: str) -> str:
    """Return the reason why a folder or a file may not have this name; "" if it may."""
    device = part.partition(".")[0].strip(" ")
    sign = next(iter(_FORBIDDEN.findall(part)), "")
    shown = sign if sign.isprintable() else f"U+{ord(sign):04X}"
    faults = {
        "leads out of the output folder with ..": part == "..",
        "has a part without a name": not part.strip(" ."),
        f"holds {shown}, which not every system has in names of files": bool(sign),
        "has a part that ends with a space or a dot, which some systems drop": part.endswith((" ", ".")),
        f"has the part {device}, which is a device on some systems": device.upper() in _DEVICES,
        f"has a part that is longer than {PART_BYTES} bytes": len(part.encode(errors="replace")) > PART_BYTES,
    }
    return next((fault for fault, applies in faults.items() if applies), "")


class Taken:
    """Paths in use, each with the number of its deck."""

    def __init__(self) -> None:
        self._files: dict[str, int] = {}
        self._folders: dict[str, int] = {}

    def take(self, path: str, number: int) -> int | None:
        """Reserve a path for a number; return the number that uses it already as file or folder, else None."""
        # some systems confuse paths that differ in case or in Unicode composition
        place = unicodedata.normalize("NFC", unicodedata.normalize("NFC", path).casefold())
        folders = list(accumulate(place.split("/")[:-1], "{}/{}".format))
        taken = [self._files[name] for name in (place, *folders) if name in self._files]
        holder = taken[0] if taken else self._folders.get(place)
        if holder is None:
            self._files[place] = number
            for folder in folders:
                self._folders.setdefault(folder, number)
        return holder


# ------------------------------------------------------------------------------------------------------- other files

_KEYS = ("FILE", "LAST")
"""Settings that name a file in lines that are not read."""


def companions(deck: Deck) -> list[str]:
    """Return the existing files that a deck names, relative to the deck, each once.

    Files of `$PREPROCESSOR` are left out: they are needed to make the new decks, not by the new decks.
    """
    names = map(file_name, _written(deck))
    return list(dict.fromkeys(name for name in names if name and not path_fault(name) and find_file(deck.folder, name)))


def _written(deck: Deck) -> Iterator[str]:
    for _, section, block in deck.every_block():
        if section == DEFINING:
            continue
        settings = settings_in(raw_lines(block), words=False)
        yield from (group.fields[0].text for group in settings if group.key in _KEYS)
        yield from (name for what in (Names.FILE, Names.DECK) for _, name in names_given(block, what))


# ------------------------------------------------------------------------------------------------ the text of each deck


@dataclass(frozen=True, slots=True)
class PlannedDeck:
    """A deck to write.

    Attributes:
        path: path in the output folder, with `/`.
        description: description of the combination.
        variations: names of the variations combined in the deck.
        values: varied parameters as they will be written.
        actions: blocks to add and to remove.
    """

    path: str
    description: str
    variations: Sequence[str]
    values: Mapping[str, str]
    actions: Sequence[Action] = field(default=(), repr=False)

    __repr__ = short_repr


@dataclass(frozen=True, slots=True)
class ExpansionPlan:
    """Decks of an expansion, in the order of `*COMBINATIONS`.

    Attributes:
        source: name of the file of the source.
        deck: the source as it was read from text.
        targets: its parameters.
        decks: the planned decks.
        notes: remarks for a reader.
    """

    source: str
    deck: Deck
    targets: ParameterTargets
    decks: Sequence[PlannedDeck]
    notes: Sequence[str] = ()

    __repr__ = short_repr

    def content(self, planned: PlannedDeck) -> bytes:
        """Return a new deck, in the form given by its path's suffix."""
        content = edited_bytes(cast("TextOrigin", self.deck.origin).source, self.edits(planned))
        form = form_of(planned.path)
        if form == KEYWORD:
            return content
        read = load_bytes(content, self.deck.file, form=KEYWORD, units=self.deck.units)
        return dump(replace(read, source=planned.path.rpartition("/")[2]), form).encode()

    def edits(self, planned: PlannedDeck) -> list[TextEdit]:
        """Return the edits of the source's text that give a planned deck."""
        targets = ((self.targets.target(name), value) for name, value in planned.values.items())
        edits = [TextEdit(target.span, value) for target, value in targets if value != target.text]
        origin = cast("TextOrigin", self.deck.origin)
        text, sections = origin.source.unified, origin.tree.sections
        gone = {(where.section, where.block) for where, _ in self.deck.blocks_with("plans_decks", DEFINING)}
        for action in planned.actions:
            if not isinstance(action, Addition):
                gone |= action
                continue
            raw = sections[action.section]  # lines are added after the last line of a section that is not a comment
            last = _end(text, raw, raw.blocks[-1]) if raw.blocks else raw.above.end
            lacks_end = not text.endswith("\n", 0, last)
            edits.append(TextEdit(Span(last, last), f"\n{action.text}" if lacks_end else action.text))
        for index, number in sorted(gone):  # comments and blank lines after a block belong to the next one
            block = sections[index].blocks[number]
            edits.append(TextEdit(Span(block.head.span.start, _end(text, sections[index], block)), ""))
        return edits


def _end(text: str, section: RawSection, block: RawBlock) -> int:
    """Return the end of the last line of a block that is not a comment."""
    declared = catalogue.block_class(section.name, block.name)
    keys = all_keys(declared) if declared else None
    ends = (leaf.span.end for leaf in block.leaves if is_data(text, leaf, keys))
    return max(ends, default=block.head.span.end)


# -------------------------------------------------------------------------------------------- manifest and conflicts


FORMAT = "mudline-expand/1"
MANIFEST = "manifest.json"
"""Name of the file in the output folder."""


def manifest(source: str, decks: Iterable[PlannedDeck]) -> dict[str, object]:
    """Return the list of the new decks for JSON; it depends on the deck only, not on time or place of the run."""
    listed = [
        {"file": deck.path, "description": deck.description}
        | {"variations": list(deck.variations), "parameters": dict(deck.values)}
        for deck in decks
    ]
    return {"format": FORMAT, "source": source, "decks": listed}


def conflicts(folder: Path, planned: ExpansionPlan, *, force: bool) -> list[str]:
    """Return messages about files of a plan that may not be written into a folder; `force` allows overwriting.

    Links are not followed out of the folder, and files that the run reads are never overwritten.
    """
    try:
        return list(_conflicts(folder, planned, force=force))
    except (OSError, ValueError) as error:
        return [f"{folder.as_posix()}: cannot be inspected: {str(error).lower()}"]


def lacking(folder: Path, planned: ExpansionPlan) -> list[str]:
    """Return the files named by the new decks that at least one of them would not find."""
    parents = {(folder / deck.path).parent for deck in planned.decks}
    return [
        name
        for name in companions(planned.deck)
        if not all(os.path.exists(parent / name) for parent in parents)  # noqa: PTH110 - Path raises where it may not look
    ]


def _conflicts(folder: Path, planned: ExpansionPlan, *, force: bool) -> Iterator[str]:
    if folder.exists() and not folder.is_dir():
        yield f"{folder.as_posix()}: is a file: expected a folder for the decks"
        return
    root = os.path.realpath(folder)
    inside: dict[Path, bool] = {}
    for name in (*(deck.path for deck in planned.decks), MANIFEST):
        path = folder / name
        if path.parent not in inside:
            inside[path.parent] = os.path.commonpath([root, os.path.realpath(path.parent)]) == root
        if not inside[path.parent]:
            yield f"{path.as_posix()}: a link in its path leads out of the folder"
        elif os.path.lexists(path) and (path.is_symlink() or not path.is_file()):
            yield f"{path.as_posix()}: exists already and is not a regular file: it is not overwritten"
        elif os.path.lexists(path):
            if is_read(path):
                yield f"{path.as_posix()}: this run reads the file, which is not overwritten"
            elif not force:
                yield f"{path.as_posix()}: exists already: --force overwrites it"
        else:
            above = (parent for parent in path.parents if parent != folder and folder in parent.parents)
            for file in (parent for parent in above if parent.exists() and not parent.is_dir()):
                yield f"{path.as_posix()}: {file.as_posix()} is a file, not a folder"
