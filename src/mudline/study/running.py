"""Run a study part by part: finished parts are written at once, and an interrupted study is resumed from them.

`STUDY.json` has the finished parts, and as `key` the digest of deck, options, machine and versions. A run takes from it
the finished ones of its parts; if all of them are finished, it starts again.
"""

from __future__ import annotations

import json
import pickle
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from hashlib import blake2b
from pathlib import Path
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np

from mudline.codes.references import REF015
from mudline.deck.forms.json import to_json
from mudline.deck.reading import TextOrigin
from mudline.scene.model import Scene
from mudline.study.pages import MissingTableError, Tables
from mudline.study.pictures import Picture
from mudline.study.report import (
    Column,
    Finished,
    Layout,
    Omission,
    Section,
    StudyError,
    StudyOptions,
    StudyReport,
    StudyTable,
    part_files,
    write_files,
)
from mudline.study.timing import machine

MACHINE = Layout[tuple[str, str]](
    "machine",
    "What was studied, and on what machine",
    {"what": lambda pair: pair[0], "value": lambda pair: pair[1]},
    brief=False,
)
RUN_TIME = "run time [s]"
"""The row of `MACHINE` that says how long all parts took."""


class Part(NamedTuple):
    """A part of a study.

    name: as in `--only`.
    run: measures; what depends on the scene alone is computed again in each part.
    weight: about how many seconds it takes; only the ratios of the parts count, for the time that is left.
    """

    name: str
    run: Callable[[Scene, StudyOptions], Section]
    weight: float = 1.0


def _nothing(tables: Tables) -> str:
    del tables
    return ""


@dataclass(frozen=True, slots=True)
class Study:
    """What `mudline study NAME` runs.

    Attributes:
        name: of the command; the files begin with it.
        title: what is studied, for readers; {deck} is the name of the file.
        parts: in the order in which they run.
        page: the Markdown page from the tables; "" for none. May raise MissingTableError.
        advice: one sentence about the deck, "use scheme X with step Y, because of Z (deck line n)"; "" for none. May
            raise MissingTableError.
        order: of the tables; those that are not named come last.
    """

    name: str
    title: str
    parts: tuple[Part, ...]
    page: Callable[[Tables], str] = _nothing
    advice: Callable[[Tables], str] = _nothing
    order: tuple[str, ...] = ()

    def unknown(self, only: Sequence[str]) -> list[str]:
        """Names that no part has."""
        names = {part.name for part in self.parts}
        return [name for name in only if name not in names]

    @np.errstate(all="ignore")  # what overflows is not finite, and that is a failure with its reason
    def run(self, scene: Scene, options: StudyOptions) -> StudyReport:
        """Run the parts that are wanted; finished ones are written into the folder of the options at once.

        Raises DeckError where the scene cannot be evaluated, ImportError without the extra, OSError where the folder
        cannot be written, and StudyError, also for a scene without elements.
        """
        require_elements(scene)
        folder, key = options.folder, digest(self.name, scene, options)
        if folder:  # before anything is measured
            folder.mkdir(parents=True, exist_ok=True)
        wanted = [part for part in self.parts if not options.only or part.name in options.only]
        finished = known_parts(folder, self.name, key) if folder else {}
        todo = [part for part in wanted if part.name not in finished] or wanted
        for part in wanted:
            if part not in todo:
                options.progress(f"{part.name}: finished before, taken from the folder")
        done, total = 0.0, sum(part.weight for part in todo)
        for part in todo:
            ahead = partial(_ahead, options.advance, done / total, part.weight / total)
            start = perf_counter()
            section = part.run(scene, replace(options, advance=ahead))
            done += part.weight
            if folder:  # the next part may be interrupted
                section = section._replace(pictures=[picture.kept() for picture in section.pictures])
            finished[part.name] = Finished(part.name, perf_counter() - start, section)
            if folder:
                write_files(folder, part_files(self.name, section))
                write_files(folder, [self._report(scene, options, key, finished).json_file()])
            options.advance(done / total)
        if not folder:
            finished = {part.name: finished[part.name] for part in wanted}
        return self._report(scene, options, key, finished)

    def _report(self, scene: Scene, options: StudyOptions, key: str, finished: Mapping[str, Finished]) -> StudyReport:
        """The report of the parts that are finished; its page and advice once all tables are there."""
        parts = [finished[part.name] for part in self.parts if part.name in finished]
        about = Section([MACHINE.table(_about(scene, options, parts))])
        title = self.title.format(deck=scene.deck.file)
        report = StudyReport.of(self.name, title, [*(part.section for part in parts), about])
        places = {name: place for place, name in enumerate(self.order)}
        ordered = tuple(sorted(report.tables, key=lambda table: places.get(table.name, len(places))))
        tables = Tables({table.name: "".join(table.csv()) for table in ordered})
        page, advice = (_made(words, tables) for words in (self.page, self.advice))
        return replace(report, tables=ordered, page=page, advice=advice, key=key, parts=tuple(parts))


def require_elements(scene: Scene) -> None:
    """Raise StudyError for a scene without elements, with the file that is missing where it would have them."""
    if not len(scene.element_ids):
        missing = [problem.message for problem in scene.noticed if problem.code is REF015]
        cause = missing[0] if missing else "give one with *ELEMENT"
        raise StudyError(f"the deck has no elements of its own, so there is nothing to study: {cause}")


def _ahead(advance: Callable[[float], None], start: float, width: float, share: float) -> None:
    advance(start + width * share)


def _made(words: Callable[[Tables], str], tables: Tables) -> str:
    try:
        return words(tables)
    except MissingTableError:  # of a part that is not finished
        return ""


def _about(scene: Scene, options: StudyOptions, parts: Sequence[Finished]) -> list[tuple[str, str]]:
    pairs = {"deck": scene.deck.source, "units": scene.units, "full": "yes" if options.full else "no", **machine()}
    return [*pairs.items(), (RUN_TIME, f"{sum(part.seconds for part in parts):.1f}")]


# --------------------------------------------------------------------------------------------------- finished before


def digest(study: str, scene: Scene, options: StudyOptions) -> str:
    """What the numbers of a study depend on: the deck and what it reads, options, machine and versions."""
    made = blake2b(json.dumps([study, scene.units, options.full, machine()]).encode(), digest_size=20)
    origin = scene.deck.origin
    text = origin.tree.source.text if isinstance(origin, TextOrigin) else ""  # the lines that advice names
    made.update((text + to_json(scene.deck)).encode("utf-8", "backslashreplace"))
    inputs = scene.contact_input()
    made.update(pickle.dumps([getattr(inputs, field.name) for field in fields(inputs) if field.name != "names"]))
    return made.hexdigest()


def known_parts(folder: Path, study: str, key: str) -> dict[str, Finished]:
    """The finished parts of a folder's `STUDY.json` with this key and with all of their pictures."""
    found: dict[str, Finished] = {}
    try:
        whole = json.loads((folder / f"{study}.json").read_bytes())
        for part in whole["parts"] if whole["key"] == key else ():
            pictures = [_picture(folder, study, one) for one in whole["pictures"] if one["name"] in part["pictures"]]
            if all(picture.data for picture in pictures):
                tables = [_table(one) for one in whole["tables"] if one["name"] in part["tables"]]
                omissions = [Omission(one["what"], one["reason"]) for one in part["omissions"]]
                section = Section(tables, pictures, [str(note) for note in part["notes"]], omissions)
                found[part["name"]] = Finished(part["name"], float(part["seconds"]), section)
    except (OSError, ValueError, KeyError, TypeError):  # not there, or not as this program writes it
        return {}
    return found


def _table(one: Mapping[str, Any]) -> StudyTable:
    columns = tuple(Column(column["name"], column["unit"]) for column in one["columns"])
    return StudyTable(one["name"], one["title"], columns, [tuple(row) for row in one["rows"]], one["brief"])


def _picture(folder: Path, study: str, one: Mapping[str, Any]) -> Picture:
    path = folder / f"{study}-{one['name']}.png"
    return Picture(one["name"], one["caption"], data=path.read_bytes() if path.exists() else b"")
