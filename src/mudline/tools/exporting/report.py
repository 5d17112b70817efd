"""Report on each keyword of a deck in another program's file, and names that the program accepts."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from mudline.basics.arguments import given_path
from mudline.basics.files import write_atomically
from mudline.language.diagnostics import Where
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block
from mudline.language.keywords.text import shown as quoted
from mudline.model.scene.resolved import ResolvedDeck

_LETTERS = 120
"""Characters of a text of the deck in a comment."""

_MOST_NAMED = 5
"""Keywords and lines listed in a row."""

_BY_SUBJECT = {
    "loads": "loads and currents are not written: the shape at rest is that of weight, buoyancy and seabed",
    "waves": "no sea is written: no effect at rest",
    "vessels": "no vessel is written: ends on it are held where the deck puts them",
    "analysis": "settings of an analysis are the target's own",
    "post-processing": "results are chosen in the target",
    "seabed": "this law is not in the target's seabed",
    "model": "not in the target's model of the line",
    "deck": "other cases of the deck are not written: export each of them",
}
_UNKNOWN = "mudline does not read this keyword"
_WORDS = ("none", "fixed", "free", "anchored", "yes", "no", "y", "n", "true", "false", "on", "off", "null", "infinity")
"""Names that mean something else to a target or to YAML."""
_EFFECTS = {
    "SEABED SUCTION": "nothing holds the pipe back on the way up: no effect under its own weight",
    "SEABED UNLOADING": "the way up is the way down: no effect at first penetration",
    "SEABED TRENCH": "the walls are left out: friction alone holds the pipe sideways",
    "MASS": "a point mass is not written: its weight is missing",
    "RESTART": "the model of the deck that is continued is written; its load case is not",
}


class Outcome(StrEnum):
    """Result of the export of a keyword or a setting."""

    CARRIED = "carried"
    APPROXIMATED = "approximated"
    LEFT_OUT = "left out"
    RENAMED = "renamed"


@dataclass(frozen=True, slots=True)
class ExportEntry:
    """Result of the export of a keyword, or of a setting.

    Attributes:
        keyword: the keyword, with the setting if any.
        file: file of the block.
        line: its line.
        status: the result.
        target: the equivalent in the target.
        effect: the consequence.
    """

    keyword: str
    file: str
    line: int
    status: Outcome
    target: str
    effect: str


@dataclass
class ExportReport:
    """Report on the export of a deck. After `finish`, each block of the deck has an entry."""

    scene: ResolvedDeck
    entries: list[ExportEntry] = field(default_factory=list)
    _claimed: set[tuple[int, int]] = field(default_factory=set)

    def add(self, where: Where | None, status: Outcome, target: str, effect: str = "", setting: str = "") -> None:
        """Add the result for the block at a place, or for a `setting` in it; nothing without a place."""
        if where is None:
            return
        deck = self.scene.deck
        self._claimed.add((where.section, where.block))
        keyword = deck.sections[where.section].blocks[where.block].keyword
        base = deck.base_of(where)
        line = self.scene.line_of(where)
        name = f"*{one_line(keyword)}{f' {setting}' if setting else ''}"
        self.entries.append(ExportEntry(name, base[0].file if base else deck.file, line, status, target, effect))

    def claim(self, keyword: str, target: str, section: str = "MODEL") -> None:
        """Report all blocks of a keyword as carried."""
        for where, _ in self.scene.deck.blocks(keyword, section):
            self.add(where, Outcome.CARRIED, target)

    def finish(self) -> None:
        """Add the blocks without an entry, and sort all entries in the order of the deck."""
        self.claim("PARAMETERS", "the numbers that they give", "PREPROCESSOR")
        for where, section, block in self.scene.deck.every_block():
            if (where.section, where.block) not in self._claimed:
                known = next((entry.subject for entry in catalogue.entries(block.keyword)), "")
                subject = block.subject if isinstance(block, Block) else known
                if section.endswith("POSTPROCESSING"):
                    subject = "post-processing"
                effect = _EFFECTS.get(block.keyword) or _BY_SUBJECT.get(subject, _UNKNOWN)
                self.add(where, Outcome.LEFT_OUT, "none", effect)
        each_once = dict.fromkeys(self.entries)
        self.entries = sorted(each_once, key=lambda entry: (entry.file != self.scene.deck.file, entry.file, entry.line))

    @property
    def lost(self) -> list[ExportEntry]:
        """Entries that are not carried."""
        return [entry for entry in self.entries if entry.status is not Outcome.CARRIED]

    @property
    def is_exact(self) -> bool:
        """True if nothing was approximated or left out."""
        return all(entry.status in (Outcome.CARRIED, Outcome.RENAMED) for entry in self.entries)

    def rows(self) -> list[tuple[str, str, str, str, str]]:
        """Return rows of what does not carry over: keyword, line, status, equivalent in the target and effect.

        Keywords with the same status, equivalent and effect share a row.
        """
        alike: dict[tuple[str, str, str], list[ExportEntry]] = {}
        for entry in self.lost:
            alike.setdefault((entry.status.value, entry.target, entry.effect), []).append(entry)
        own = self.scene.deck.file
        return [
            (
                _some(entry.keyword for entry in entries),
                _some(str(entry.line) if entry.file == own else f"{entry.file}:{entry.line}" for entry in entries),
                *columns,
            )
            for columns, entries in alike.items()
        ]

    def comments(self, target: str) -> list[str]:
        """Return the comment lines at the head of a file: what does not carry over."""
        rows = self.rows()
        lines = [f"{target} model of {self.scene.source}, written by mudline export"]
        lines += ["What does not carry over (keyword, line of the deck, what is here, effect):"] * bool(rows)
        lines += [
            f"{keyword} ({place}) {status}: {target}; {effect}" for keyword, place, status, target, effect in rows
        ]
        return [one_line(line) for line in lines]


def _some(words: Iterable[str]) -> str:
    """Return the first of some words, each once, and the count of the others."""
    each = list(dict.fromkeys(words))
    more = len(each) - _MOST_NAMED
    return ", ".join(each[:_MOST_NAMED]) + (f" and {more} more" if more > 0 else "")


def one_line(text: str) -> str:
    """Return a text as one line of printable ASCII that is a comment in every target."""
    plain = "".join(letter if " " <= letter <= "~" else f"\\u{ord(letter):04x}" for letter in text)
    return re.sub(r"-{2,}", "-", plain).replace("#", "No.").strip()


def short_name(written: str) -> str:
    """Return a name of the deck in quotes, cut to what a table can show."""
    return quoted(written if len(written) <= _LETTERS else f"{written[:_LETTERS]}...")


class TargetNames:
    """Names that a target accepts: of `letters`, the content of a character class, each once, up to a length."""

    def __init__(self, report: ExportReport, letters: str, longest: int, reserved: Iterable[str] = ()) -> None:
        self.report, self.letters, self.longest = report, letters, longest
        self._taken = {name.casefold() for name in (*_WORDS, *reserved)}

    def take(self, written: str, where: Where) -> str:
        """Return the target's name for a name of the deck; a changed name is added to the report."""
        name = re.sub(f"[^{self.letters}]+", "_", written).strip("_. ")[: self.longest].strip("_. ")
        if not re.match("[A-Za-z]", name):
            name = f"S{name}"[: self.longest]
        stem, count = name, 1
        while name.casefold() in self._taken:
            count += 1
            name = f"{stem[: self.longest - len(str(count)) - 1]}_{count}"
        self._taken.add(name.casefold())
        if name != written:
            self.report.add(where, Outcome.RENAMED, name, "a name that the target takes", f"name {short_name(written)}")
        return name


class Export(NamedTuple):
    """The model of a deck for another program."""

    files: dict[str, str]
    """Texts of the files by name."""
    report: ExportReport
    """Keywords that do not carry over."""
    notes: tuple[str, ...] = ()
    """Remarks on a resting shape; none at the deck's own coordinates."""

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Write the files into a folder; raises OSError."""
        for name, text in self.files.items():
            write_atomically(given_path(folder, name="folder") / name, text.encode())
