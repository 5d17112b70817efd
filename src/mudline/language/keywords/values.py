"""What a field of a deck can hold and name, and the facts about a keyword besides its fields."""

from __future__ import annotations

import re
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, Self, get_args

from pydantic import BeforeValidator, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

_NO_LINE_END = {"not": {"pattern": "[\\r\\n]"}}
"""Said apart in JSON Schema: in some dialects of patterns $ matches also before a line end."""


class _Pattern(str):
    """A string of a fixed form, kept as written."""

    __slots__ = ()
    form: ClassVar[str]

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_after_validator_function(
            cls,
            core_schema.str_schema(pattern=cls.form, strict=True),
            serialization=core_schema.plain_serializer_function_ser_schema(str, return_schema=core_schema.str_schema()),
        )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return cls.json_schema()

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The form in JSON Schema."""
        return {"type": "string", "pattern": cls.form, **_NO_LINE_END}

    @classmethod
    def match(cls, text: str) -> Self | None:
        """The text as this type, or None when it has not this form."""
        return cls(text) if re.search(cls.form, text) and not text.endswith("\n") else None


class Equation(_Pattern):
    """`=[expression]`, kept as written until the scene evaluates it."""

    form = r"^=\[[^\r\n]*\]$"
    __slots__ = ()

    @property
    def expression(self) -> str:
        """What stands between the brackets."""
        return self[2:-1]


class Label(_Pattern):
    """`{label}` of a node or an element, braces included."""

    form = r"^\{[^{}\r\n]*\}$"
    __slots__ = ()


class Kind(Enum):
    """How a field's text is read; the sentence says what is expected there."""

    REAL = "a number or an equation =[...]"
    WHOLE = "a whole number or an equation =[...]"
    IDENT = "a number or a {label}"
    WHOLE_OR_LABEL = "a whole number, an equation =[...] or a {label}"
    REAL_OR_NAME = "a number, an equation =[...] or a name"
    NAME = "a name"
    TITLE = "a text"
    OTHER = "another value"


def _whole(given: object) -> object:
    """1.0 is a whole number in JSON."""
    return int(given) if isinstance(given, float) and given.is_integer() else given


class _Either:
    """The schema of a type that is one or the other, tried in this order; it is made once for all fields of the type.

    To make it for each field takes half of the time in which pydantic makes the models of a deck.
    """

    __slots__ = ("_schema", "_types")

    def __init__(self, types: object) -> None:
        self._types = types
        self._schema: CoreSchema | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        if self._schema is None:
            self._schema = handler.generate_schema(Annotated[self._types, Field(union_mode="left_to_right")])
        return copy(self._schema)


Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Integer = Annotated[int, Field(strict=True, ge=-(2**53), le=2**53), BeforeValidator(_whole)]
Count = Annotated[int, Field(strict=True, ge=0, le=2**53), BeforeValidator(_whole)]
Text = Annotated[str, Field(strict=True, pattern=r"^[^\r\n]*$", json_schema_extra=_NO_LINE_END)]

Real = Annotated[float | Equation, _Either(Finite | Equation), Kind.REAL]
Whole = Annotated[int | Equation, _Either(Integer | Equation), Kind.WHOLE]
WholeOrLabel = Annotated[int | Equation | Label, _Either(Integer | Equation | Label), Kind.WHOLE_OR_LABEL]
Ident = Annotated[int | Label, _Either(Integer | Label), Kind.IDENT]
RealOrName = Annotated[float | Equation | str, _Either(Finite | Equation | Text), Kind.REAL_OR_NAME]
Name = Annotated[Text, Kind.NAME]
Title = Annotated[Text, Kind.TITLE]
"""A text to the end of its line, commas included."""
Other = Annotated[Text, Kind.OTHER]
"""Beside the known values of a choice: there are others, which are kept as written."""


@dataclass(frozen=True, slots=True)
class Successor:
    """A keyword that supersedes another one; with `key`, by that setting."""

    keyword: str
    key: str = ""

    def __str__(self) -> str:
        return f"{self.key}= of *{self.keyword}" if self.key else f"*{self.keyword}"


Gift = Literal["elements", "sections", "hydrodynamics", "supports"]
"""What the lines of a keyword may give to a model: some of these, or nothing; the kinds of names are `Names`."""


@dataclass(frozen=True, slots=True)
class Facts:
    """Facts about a keyword.

    Which keyword it is: `superseded_by` newer ones, of which each `supersedes` older ones; an `extension` is mudline's
    own; `plans_decks` says that its lines are about decks to be made, which do not have it.

    What it does: `defines` is what its records define by number or name; `makes` are the keywords of what things
    outside the deck, which its lines are about, may define; `out_of_sight` says that the deck has these things, and
    where they lie is not computed. With `later_wins` an element follows the last record whose SET= holds it, and that
    record as a whole. `carried` are the fields that a block has from the block before it, where it does not give them.
    `seabed_type` is the type of seabed that a legacy surface is. `gives_law` is the kind of law that elements get in
    place of what they had, and the field of a record that asks for it. `soil_springs` hold elements in the soil, and
    what `moves_vessels` lets them follow the waves or a time history; lines that are kept may be of what it `gives` to
    elements and nodes; it may stand `once` in a section; of elements with `zero_length` the ends may lie at one place.
    What is computed from it is said under the heading `computed_in` of the page on the contact evaluator.
    `instead_of` says what to write instead of a setting that other keywords have.
    """

    superseded_by: tuple[Successor, ...] = ()
    supersedes: bool = False
    extension: bool = False
    plans_decks: bool = False
    defines: Literal["", "nodes", "elements", "sets", "curves", "parameters"] = ""
    makes: tuple[str, ...] = ()
    out_of_sight: bool = False
    later_wins: bool = False
    carried: tuple[str, ...] = ()
    seabed_type: Literal["", "RIGID", "ELASTIC"] = ""
    gives_law: tuple[Literal["", "soil", "nodal"], str] = ("", "")
    soil_springs: bool = False
    moves_vessels: bool = False
    gives: tuple[Gift, ...] = ()
    once: bool = False
    zero_length: bool = False
    computed_in: str = ""
    instead_of: Mapping[str, str] = field(default_factory=dict)
    beside: tuple[str, ...] = ()
    telling: tuple[str, ...] = ()
    tells_units: bool = False


class Names(Enum):
    """What a value names, or what a field `defines`; the words are for a reader.

    Each is checked wherever it is named. Sets, force-embedment curves, nodes, elements, parameters and files have
    checks of their own, as they are more than names; all other kinds share one.
    """

    SET = "an element set"
    SETS = "one or more element sets"
    SUBSET = "another element set"
    CURVE = "a force-embedment curve"
    FILE = "a file"
    DECK = "the deck before"
    NODE = "a node"
    ELEMENT = "an element"
    PARAMETER = "a parameter"
    VESSEL = "a vessel"
    BODY = "a floating body"
    AUXILIARY = "an auxiliary body"
    CABLE = "a cable"
    LINE = "a line"
    SECTION_GROUP = "a group of line sections"
    VECTOR = "a vector"
    AXIS = "an axis system"
    GUIDE = "a guide"
    MOMENT_CURVATURE = "a moment-curvature curve"
    FORCE_STRAIN = "a force-strain curve"
    TORQUE_TWIST = "a torque-twist curve"
    STRESS_STRAIN = "a stress-strain curve"
    DAMPER = "a damper curve"
    DRAG_LIFT = "a drag lift curve"
    PIP_STIFFNESS = "a stiffness of pipe-in-pipe connections"
    S_N_CURVE = "an S-N curve"
    VARIABLE = "an output variable"

    __hash__ = object.__hash__  # that of `Enum` is a function of Python, and names are looked up by kind


class Contents(Enum):
    """What a file that a deck names holds; the words are for a reader."""

    OPERATORS = "response amplitude operators"
    MOTIONS = "time and six displacements"
    ELEVATIONS = "time and elevation"
    NUMBERS = "numbers"


LINE_SETS: Mapping[str, Names] = {
    "LINE": Names.SET,
    "NAME": Names.SET,
    "SECTION": Names.SET,
    "ADDITIONAL": Names.SETS,
}
"""Settings of lines that make element sets: a line and each of its sections is one."""


Subject = Literal["deck", "model", "seabed", "loads", "waves", "vessels", "analysis", "post-processing"]
"""What a keyword is about."""
SUBJECTS: tuple[Subject, ...] = get_args(Subject)


class Entry(NamedTuple):
    """A declaration in the index: its module, its name there, and what has to be known of it before it is imported.

    The lines of a keyword that is `kept` are passed through. With `sections_inferred` it is not confirmed where it
    belongs. `names` and `defines` are the kinds of things, as members of `Names`, that its fields name and define;
    `telling` are lines that it alone has.
    """

    keyword: str
    module: str
    name: str
    sections: tuple[str, ...]
    subject: Subject
    kept: bool = False
    sections_inferred: bool = False
    zero_length: bool = False
    names: tuple[str, ...] = ()
    defines: tuple[str, ...] = ()
    telling: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class OpaqueKeyword:
    """A keyword that is known, and whose lines are passed through unchanged.

    `example` shows what its lines may look like, not its format. `certain` and `inferred` say what we know of it and
    what we conclude. `name_settings` has the settings that give names; of a SET only the first value is a name.
    `labels` says that any text among its lines may be the label of a node; in `free_text`, words for people, nothing is
    looked for. `makes` are the keywords of what it may define: a thing of these kinds that is missing may come from
    here. `gives` is what elements and nodes may have from it: rules that look for what is missing of that say nothing
    in a deck with it. `sections_inferred` says that its section is not confirmed: in another one it is not reported.
    """

    keyword: str
    summary: str
    example: str
    certain: str
    inferred: str
    sections: tuple[str, ...] = ("MODEL",)
    sections_inferred: bool = False
    name_settings: Mapping[str, Names] = field(default_factory=dict)
    labels: bool = False
    free_text: bool = False
    makes: tuple[str, ...] = ()
    gives: tuple[Gift, ...] = ()
    subject: Subject = "model"
    zero_length: bool = False


_LETTERS = str.maketrans("OolI", "0011")
_WITH_LETTERS = re.compile(r"(?=[^.]*[0-9])[-+]?[0-9OolI]+\.[0-9OolI]*[0-9][0-9OolI]*(?:[eEdD][-+]?[0-9]+)?")


def number_meant(text: str) -> str:
    """The number with a point of which a text has a letter in the place of a digit, or ""."""
    meant = text.translate(_LETTERS)
    return meant if meant != text and _WITH_LETTERS.fullmatch(text) else ""
