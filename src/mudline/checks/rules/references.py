"""Names that are defined in one place and used in another: sets, parameters, vessels, water, outputs, data files."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

from mudline.basics.outside import without_text
from mudline.basics.spelling import Effort, nearest
from mudline.checks.context import LintContext
from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import Parameters, folded, list_items
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.language.keywords.model import FieldSpec, Part, has_fields
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import DataFile, Names, is_unknown, known_name
from mudline.language.rules import rule
from mudline.language.syntax.edits import TextEdit, with_line_ends
from mudline.language.syntax.fields import read_line
from mudline.model.scene.context import records_of
from mudline.model.scene.data_files import fault_of, has_uneven_times, operators, unequal_frequencies
from mudline.model.scene.deck_values import file_name, find_file
from mudline.model.scene.references import THINGS, repeated
from mudline.model.scene.sets import ALL, LONGEST_NAME

if TYPE_CHECKING:
    from mudline.language.keywords.library.mesh import ElementSet, SetList
    from mudline.language.keywords.library.preprocessor import Parameter

REF011 = Code("REF011", "long-name", Severity.WARNING)
REF012 = Code("REF012", "long-list", Severity.WARNING)
REF016 = Code("REF016", "repeated-set", Severity.WARNING)
REF017 = Code("REF017", "repeated-parameter", Severity.WARNING)
REF018 = Code("REF018", "missing-ocean", Severity.WARNING)
REF020 = Code("REF020", "repeated-name", Severity.WARNING)
REF021 = Code("REF021", "misspelt-output", Severity.WARNING)
DAT002 = Code("DAT002", "faulty-data", Severity.ERROR)

LONGEST_LIST = 20


@rule(REF011)
def long_name(context: LintContext) -> Iterator[Problem]:
    """The name of a set has more than 256 characters.

    The language allows 256. A longer name may be cut when the deck is run, and names that differ only after the cut
    would then be one set. Choose a shorter name.

    Example on sets:
        - SET=Eastern export flowline from the manifold to the platform between kilometre post 12.400 and kilometre\
 post 12.900 as surveyed before the trench was made and again after it was filled with the crossings of both cables\
 and the two mattresses that were laid on the eastern one in the second season
        + SET=Flowline

    Finds: 12:6
    """
    for where, entry in context.records("ELEMENT SETS"):
        length = len(cast("str | None", entry.name) or "")
        if length > LONGEST_NAME:
            message = f"a set name of {length} characters: it must not be longer than {LONGEST_NAME}"
            yield Problem(REF011, message, where=where.inside("name"))


@rule(REF012)
def long_list(context: LintContext) -> Iterator[Problem]:
    """A line of a set lists more than 20 elements.

    The language allows 20 on a line. Further elements may be dropped without a warning when the deck is run, and then
    lack the stiffness or the curve of their set. Put the rest on lines of their own: lines of a set add up.

    Example:
         $MODEL
         *NODE
          1, 12.0, 0.0
          25, 12.0, 240.0
          GEN=1, 25
         *ELEMENT
          1, 1, 2
          GEN=1, 24
         *ELEMENT SETS
          SET=Coated Joints
        - 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 24
        + 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20
        + 22, 24

    Finds: 11:73
    """
    for where, entry in records_of(context.written("ELEMENT SETS")):
        for number, member in enumerate(entry.members):
            count = len(cast("SetList", member).elements) if member.rule == "set_list" else 0
            if count > LONGEST_LIST:
                place = where.inside("members", number, "elements")
                message = (
                    f"{count} elements on a line: the language allows {LONGEST_LIST}; put the rest on lines of their "
                    "own"
                )
                repair = _split(context.text, place, count) if context.text else None
                yield Problem(REF012, message, where=place.inside(LONGEST_LIST), repair=repair)


def _split(text: TextOrigin, where: Where, count: int) -> Repair | None:
    """Return a repair that breaks a line after every 20 elements; None if anything but commas is between them.

    New lines are indented as the line is.
    """
    source, line = text.source.unified, text.span(where)
    indentation = source[text.source.line_around(line.start).start : line.start] if line else ""
    edits: list[TextEdit] = []
    for following in range(LONGEST_LIST, count, LONGEST_LIST):
        places = [where.inside(at) for at in (following - 1, following)]
        before, behind = (text.span(place) for place in places)
        if before is None or behind is None or not all(text.written(place) for place in places):
            return None
        between = Span(before.end, behind.start)
        if source[slice(*between)].strip(" \t") not in ("", ","):
            return None
        edits.append(TextEdit(between, f"\n{indentation or ' '}"))
    ended = tuple(with_line_ends(text.source, edits))
    return Repair("safe", f"put at most {LONGEST_LIST} elements on a line", ended)


@rule(REF016)
def repeated_set(context: LintContext) -> Iterator[Problem]:
    """A set is defined twice: it holds the elements of both definitions.

    A change of one definition does not remove the elements of the other one from the set. They keep its stiffness and
    curve. Names are case-insensitive. It is an info if the numbers of both lie apart, so that they add up. Put the
    elements under one SET=, or choose another name.

    Example on sets:
          1, 2
        + 3
          SET=Flowline
          GEN=3, 4
        - SET=RISER
        - 3

    Finds: 14:6
    """
    known: dict[str, list[tuple[int, int]]] = {}
    for where, entry in records_of(context.written("ELEMENT SETS")):
        name = known_name(entry.name)
        if name is None or (key := folded(name)) == ALL:
            continue
        own = [*_spans(entry)]
        if key in known:
            message = f"set {shown(name)} is already defined, and this adds to it: put its elements under one SET="
            apart = own and all(last < low or high < first for low, high in own for first, last in known[key])
            yield Problem(REF016, message, None, Severity.INFO if apart else None, where.inside("name"))
        known.setdefault(key, []).extend(own)


def _spans(entry: ElementSet) -> Iterator[tuple[int, int]]:
    """Yield the lowest and the highest number of each line of a set that has only numbers."""
    for member in entry.members:
        span = getattr(member, "generate", None)
        numbers = getattr(member, "elements", None) or ([span.start, span.end] if span else [])
        whole = [number for number in numbers if isinstance(number, int)]
        if whole:
            yield min(whole), max(whole)


@rule(REF020)
def repeated_name(context: LintContext) -> Iterator[Problem]:
    """Two vessels, or two other objects of one kind, have the same name.

    The language does not say which of them the name then refers to. Names are case-insensitive. Choose another name, or
    keep one of them. Sets and curves have their own rules.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0
        - VESSEL=fpso
        + VESSEL=Tanker
          INITIAL POSITION=1005.0, 250.0, 0.0

    Finds: 5:9
    """
    return repeated(context.scene.context, THINGS, REF020)


@rule(REF017)
def repeated_parameter(context: LintContext) -> Iterator[Problem]:
    """A parameter is defined twice: the later value applies everywhere.

    Equations before the second definition use its value too. A reader finds the first definition first, but it is
    overridden. Items of a list have the name of the list in front, as in Soil_stiffness. Remove one of the two.

    Example on parameters:
        - Depth, 910.0
          depth, 850.0

    Finds: 4:2
    """
    known: set[str] = set()
    for where, parameter in records_of(context.written("PARAMETERS", "PREPROCESSOR"), "parameters"):
        again: list[str] = []
        for name in _names(parameter):
            if folded(name) in known:
                again.append(name)
            known.add(folded(name))
        if again:
            others = f" (and {len(again) - 1} more of this list)" if len(again) > 1 else ""
            message = (
                f"parameter {shown(again[0])}{others} is defined twice, and this value overrides the earlier one: "
                "remove one of them"
            )
            yield Problem(REF017, message, where=where.inside("name"))


def _names(parameter: Parameter) -> list[str]:
    """Return the parameters that a line defines."""
    name, value = parameter.name, parameter.value
    if is_unknown(name) or is_unknown(value):
        return []
    if isinstance(value, str) and value.startswith("/"):
        return [item.name for item in list_items(name, value)[0]]
    return [name]


_WATER = re.compile(r"CURRENT|WAVE(?:-.*)?")


def in_water(deck: Deck) -> Iterator[tuple[Where, str]]:
    """Yield place and keyword of all waves and currents of load cases, read or not."""
    for where, section, block in deck.every_block():
        if section == "LOAD CASE" and _WATER.fullmatch(block.keyword):
            yield where, block.keyword


@rule(REF018)
def missing_ocean(context: LintContext) -> Iterator[Problem]:
    """A load case has waves or a current, and the model has no *OCEAN.

    Their velocities depend on the depth of the water, which *OCEAN gives in the model, with its density; the depth has
    no default. Give *OCEAN, or remove the waves and currents of a model in air. A deck with *RESTART takes the water
    from the deck that it continues.

    Example on held:
         $MODEL
        +*OCEAN
        + 500.0, 1025.0, 9.81

          GEN=1, 2
        |*HYDRODYNAMIC SETS
        | SET=ALL, TYPE=CONSTANT
        | 1.0

          3, 1
        |*WAVE-REGULAR
        | 3.0, 11.0, 180.0

    Finds: 17:1
    """
    scene = context.scene
    if "OCEAN" in context.keywords or not scene.element_ids.size or scene.context.possible_definition("OCEAN"):
        return
    for where, keyword in in_water(context.deck):
        if where.section < len(context.deck.own_sections):
            yield Problem(REF018, f"*{keyword} needs the depth of the water: give *OCEAN in $MODEL", where=where)
            return


# ---------------------------------------------------------------------------------------------------- requested results

WORDS = (
    *("EFFECTIVE", "TENSION", "AXIAL", "FORCE", "LOCAL", "SHEAR", "BENDING", "MOMENT", "TORQUE", "CURVATURE"),
    *("RESULTANT", "STRESS", "STRAIN", "MISES", "REACTION", "MOTION", "DISPLACEMENT", "VELOCITY", "ACCELERATION"),
)
"""Words in the names of outputs, from the manual's page on the database of forces; the list is not complete."""
_REQUESTS = "POSTPROCESSING"
_SHORTEST = 4
"""Number of letters from which a word is compared."""


@rule(REF021)
def misspelt_output(context: LintContext) -> Iterator[Problem]:
    """The name of an output variable has a word that is nearly one of the usual words.

    Results are requested by name, such as EFFECTIVE TENSION. With one wrong letter the run ends without them, and hours
    are lost. Correct the word. Other words are not reported, as not every variable is known.

    Example:
         $SUMMARY POSTPROCESSING
         *PARA FORCE
          DATA1=12
          DATA2=1
        - DATA3=EFFECTIVE TENSON
        + DATA3=EFFECTIVE TENSION

    Finds: 5:8
    """
    if not any(section.name.endswith(_REQUESTS) for section in context.deck.own_sections):
        return
    effort = Effort()
    own = len(context.deck.own_sections)
    used = context.scene.context.names(Names.VARIABLE).used
    requests = [(use.where, use.name) for use in used if use.where.section < own]
    for where, name in [*requests, *_of_kept_lines(context)]:
        for word in name.upper().replace("-", " ").split():
            near = nearest(word, WORDS, effort) if word not in WORDS and len(word) >= _SHORTEST else ""
            if near and word not in (f"{near}S", f"{near}ES"):
                message = f"output {shown(name)}: {shown(word)} is no usual word (did you mean {near}?)"
                yield Problem(REF021, f"{message}: correct it, else the run gives no such output", where=where)


def _of_kept_lines(context: LintContext) -> Iterator[tuple[Where, str]]:
    """Yield the texts at the start of unread postprocessing lines that begin without a setting."""
    for where, _, line in context.scene.context.unread_lines:
        if context.deck.sections[where.section].name.endswith(_REQUESTS):
            first = read_line(line, Span(0, len(line))).groups[0]
            if not first.key and first.fields[0].text[:1].isalpha():
                yield where.inside(*first.fields[0].span), first.fields[0].text


# ----------------------------------------------------------------------------------------------------------- data files

_OWN_FORMATS = (None, "", "MCS")
"""Values of FORMAT= whose file format is public."""


class _Named(NamedTuple):
    """Data file that a field names, with the part that the field belongs to."""

    where: Where
    part: Part
    slot: FieldSpec
    name: str


@rule(DAT002)
def faulty_data(context: LintContext) -> Iterator[Problem]:
    """A file that the deck names does not hold the data it should, or the lines in its place do not.

    The analysis program stops at such a file, or reads other values than were meant. Checked are operators of a vessel,
    histories of motions and of the sea, coefficients and matrices, as far as their format is public. The message names
    the first faulty line. In files of operators with one line for each frequency, every heading needs the same
    frequencies. Files in the format of another program are not read. Correct the line.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=100.0, 0.0, 0.0
         $LOAD CASE
         *RAO
          VESSEL=FPSO
          LAYOUT=LINE
          0.0, 0.10, 0.9, 10.0, 0.4, 90.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.1, -80.0
        - 90.0, 0.12, 0.8, 12.0, 0.0, 0.0, 0.5, 90.0, 0.0, 0.0, 1.4, 80.0, 0.0, 0.0
        + 90.0, 0.10, 0.8, 12.0, 0.0, 0.0, 0.5, 90.0, 0.0, 0.0, 1.4, 80.0, 0.0, 0.0

    Finds: 9:2
    """
    for where, vessel in context.records("RAO", "vessels", "LOAD CASE"):
        columns = [vessel.lines.column(column).tolist() for column in (0, 1)] if vessel.lines is not None else []
        rows = zip(*columns, strict=True)  # a heading and a frequency, NaN where it is not known
        if fault := unequal_frequencies([row for row in rows if not any(map(math.isnan, row))]):
            yield Problem(DAT002, f"{fault}: correct the lines", where=where.inside("lines"))
    for named, path in context.once(_there):
        if fault := _fault(named, path):
            shown_fault = without_text(fault, path, context.deck.folder)
            yield Problem(DAT002, f"{shown(path.name)} cannot be used: {shown_fault}", where=named.where)


def operator_files(context: LintContext) -> list[tuple[Where, str, list[list[float]]]]:
    """Return the files of operators that a deck names and that can be used.

    Each has its place in the deck, its name, and its rows in the form of LAYOUT=LINE.
    """
    files = []
    for named, path in context.once(_there):
        if named.slot.about.holds is DataFile.OPERATORS and _is_own(named):
            with suppress(OSError, ValueError):  # DAT002 says why
                files.append((named.where, path.name, operators(path, _layout(named))))
    return files


def _there(context: LintContext) -> list[tuple[_Named, Path]]:
    """Return the existing files that a deck names, each with its path."""
    files = list(_files(context)) if context.deck.folder else []
    parameters = Parameters(context.deck) if files else None
    names = (file_name(parameters.filled(named.name) if parameters else named.name) for named in files)
    paths = (find_file(context.deck.folder, name) for name in names)
    return [(named, path) for named, path in zip(files, paths, strict=True) if path is not None]


def _is_own(named: _Named) -> bool:
    return getattr(named.part, "format", None) in _OWN_FORMATS


def _layout(named: _Named) -> str:
    return getattr(named.part, "layout", "") or ""


def _fault(named: _Named, path: Path) -> str:
    contents = cast("DataFile", named.slot.about.holds)
    if contents is DataFile.OPERATORS and not _is_own(named):
        return ""
    if fault := fault_of(path, contents, layout=_layout(named)):
        return fault
    if contents is DataFile.ELEVATIONS and getattr(named.part, "increment", None) is None and has_uneven_times(path):
        return "its times are uneven: give a time step in the deck"
    return ""


def _files(context: LintContext) -> Iterator[_Named]:
    """Yield the files of the deck itself whose contents are known."""
    for where, _, block in context.deck.alone.every_block():
        for path, slot, name in block.walk(_holds_data) if has_fields(type(block), _holds_data) else ():
            if isinstance(name, str) and name:
                yield _Named(where._replace(path=path), block.at(path[:-1])[1], slot, name)


def _holds_data(slot: FieldSpec) -> bool:
    return slot.about.holds is not None
