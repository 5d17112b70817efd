"""Types of values in the fields of a deck, values that could not be read, kinds of names, facts about a keyword."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated, Any, ClassVar, Final, Literal, NamedTuple, Self, get_args

from pydantic import Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

_NO_LINE_END = {"not": {"pattern": "[\\r\\n]"}}
"""Separate condition in JSON Schema: in some dialects of patterns $ also matches before a line end."""


class _Pattern(str):
    """String of a fixed form, kept as written."""

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
        """Return the form in JSON Schema."""
        return {"type": "string", "pattern": cls.form, **_NO_LINE_END}

    @classmethod
    def match(cls, text: str) -> Self | None:
        """Return the text as this type, or None if it does not have the form."""
        return cls(text) if re.search(cls.form, text) and not text.endswith("\n") else None


class Equation(_Pattern):
    """`=[expression]`, kept as written until the scene evaluates it."""

    form = r"^=\[[^\r\n]*\]$"
    __slots__ = ()

    @property
    def expression(self) -> str:
        """Text between the brackets."""
        return self[2:-1]


class Label(_Pattern):
    """`{label}` of a node or an element, braces included."""

    form = r"^\{[^{}\r\n]*\}$"
    __slots__ = ()


class Kind(Enum):
    """Kind of a field's text; the sentence tells what is expected."""

    REAL = "a number or an equation =[...]"
    WHOLE = "a whole number or an equation =[...]"
    IDENT = "a number or a {label}"
    WHOLE_OR_LABEL = "a whole number, an equation =[...] or a {label}"
    REAL_OR_NAME = "a number, an equation =[...] or a name"
    NAME = "a name"
    TITLE = "a text"
    OTHER = "another value"


WHOLE_KINDS = (Kind.WHOLE, Kind.IDENT, Kind.WHOLE_OR_LABEL)
"""Kinds whose numbers are whole."""


def _whole(value: object) -> object:
    return int(value) if isinstance(value, float) and value.is_integer() else value


class _FromFloat:
    """Schema of a whole number that also takes an integral float, as 1.0 is a whole number in JSON."""

    @staticmethod
    def __get_pydantic_core_schema__(source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        whole = handler(source)
        from_float = core_schema.no_info_before_validator_function(_whole, whole)
        return core_schema.union_schema([whole, from_float], mode="left_to_right")


class _Either:
    """Schema of a union, tried in order; created once for all fields of the type.

    A schema for each field would take half of the time in which pydantic creates the models of a deck.
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
Integer = Annotated[int, Field(strict=True, ge=-(2**53), le=2**53), _FromFloat()]
Count = Annotated[int, Field(strict=True, ge=0, le=2**53), _FromFloat()]
Text = Annotated[str, Field(strict=True, pattern=r"^[^\r\n]*$", json_schema_extra=_NO_LINE_END)]

Real = Annotated[float | Equation, _Either(Finite | Equation), Kind.REAL]
Whole = Annotated[int | Equation, _Either(Integer | Equation), Kind.WHOLE]
WholeOrLabel = Annotated[int | Equation | Label, _Either(Integer | Equation | Label), Kind.WHOLE_OR_LABEL]
Ident = Annotated[int | Label, _Either(Integer | Label), Kind.IDENT]
RealOrName = Annotated[float | Equation | str, _Either(Finite | Equation | Text), Kind.REAL_OR_NAME]
Name = Annotated[Text, Kind.NAME]
Title = Annotated[Text, Kind.TITLE]
"""Text to the end of its line, commas included."""
Other = Annotated[Text, Kind.OTHER]
"""Unknown value of a choice with known values, kept as written."""


@dataclass(frozen=True, slots=True)
class Successor:
    """Keyword that supersedes another keyword; with `key`, a setting of that keyword."""

    keyword: str
    key: str = ""

    def __str__(self) -> str:
        return f"{self.key}= of *{self.keyword}" if self.key else f"*{self.keyword}"


Gift = Literal["elements", "sections", "hydrodynamics", "supports"]
"""Property of the model that the lines of a keyword may define; kinds of names are in `Names`."""


@dataclass(frozen=True, slots=True)
class Facts:
    """Facts about a keyword.

    Attributes:
        superseded_by: newer keywords with the same purpose.
        supersedes: True if older keywords have the same purpose.
        extension: True for a keyword of mudline itself.
        plans_decks: True if its lines describe decks to be generated, which do not have the keyword.
        defines: kind of objects that its records define by number or name.
        makes: keywords whose objects may be defined outside the deck, by the things that its lines refer to.
        out_of_sight: True if the deck defines such objects, but their positions are not computed.
        later_wins: True if an element follows the last record whose SET= contains it, and that record as a whole.
        carried: fields that a block takes over from the block before it unless it gives them.
        seabed_type: type of seabed of a legacy surface.
        gives_law: kind of law that replaces that of the elements, a name of `LawKind` in lower case, and the field of a
            record that requests it.
        soil_springs: True if it holds elements in the soil.
        moves_vessels: True if vessels follow the waves or a time history because of it.
        gives: properties of elements and nodes that kept lines may define.
        once: True if a section may have it only once.
        zero_length: True if both ends of its elements may be at one place.
        computed_in: heading, on the page on the contact evaluator, of the results that depend on it.
        instead_of: replacement for settings that other keywords have, by the setting.
        beside: keywords that the deck must also have.
        telling: lines that no other keyword has.
        tells_units: True if its values show the unit system.
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
    gives_law: tuple[str, str] = ("", "")
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
    """Kind of object that a value refers to, or that a field `defines`; the words are for a reader.

    Each reference is checked. Sets, force-embedment curves, nodes, elements, parameters and files have checks of their
    own; all other kinds share one.
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
    HARDENING = "a plastic hardening model"
    VARIABLE = "an output variable"

    __hash__ = object.__hash__  # that of `Enum` is slow Python, and names are looked up by kind


class DataFile(Enum):
    """Contents of a file that a deck names; the words are for a reader."""

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
"""Settings of lines that create element sets: a line and each of its sections is a set."""


Subject = Literal["deck", "model", "seabed", "loads", "waves", "vessels", "analysis", "post-processing"]
"""Subject of a keyword."""
SUBJECTS: tuple[Subject, ...] = get_args(Subject)


class Entry(NamedTuple):
    """Entry of the index: a declaration, and the facts that are needed before its module is imported.

    Attributes:
        keyword: name of the keyword.
        module: module that declares it.
        name: name of the declaration in the module.
        sections: sections where the keyword belongs.
        subject: subject of the keyword.
        kept: True if the lines are passed through.
        sections_inferred: True if the sections are not confirmed.
        zero_length: True if the elements may have no length.
        names: kinds of objects that its fields refer to, as members of `Names`.
        defines: kinds of objects that its fields define.
        telling: lines that no other keyword has.
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
    """Known keyword whose lines are passed through unchanged.

    Attributes:
        keyword, summary: name, and sentence for a reader.
        example: lines that the keyword may have; not its format.
        certain: known facts, in words.
        inferred: conclusions from these, in words.
        sections: sections where the keyword belongs.
        sections_inferred: True if the sections are not confirmed: the keyword is not reported in other sections.
        name_settings: settings that hold names; only the first value of SET= is a name.
        labels: True if any text on its lines may be the label of a node.
        free_text: True if its lines are words for people, which are not searched for names.
        makes: keywords whose objects it may define: a missing object of these kinds may come from here.
        gives: properties that it may define for elements and nodes; rules for missing ones are silent in such a deck.
        subject: subject of the keyword.
        zero_length: True if its elements may have no length.
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


_WITH_LETTERS = re.compile(r"(?=[^.]*[0-9])[-+]?[0-9OolI]+\.[0-9OolI]*[0-9][0-9OolI]*(?:[eEdD][-+]?[0-9]+)?")


def number_meant(text: str) -> str:
    """Return the number that was meant by a text with letters in place of digits and a point, or ""."""
    number = text.translate(str.maketrans("OolI", "0011"))
    return number if number != text and _WITH_LETTERS.fullmatch(text) else ""


# ---------------------------------------------------------------- unreadable values: neither absent (None) nor numbers


class Unknown(float):
    """Class of `UNKNOWN`: a NaN whose attributes and items are unknown too.

    A check for an absent value (`is None`) does not report it, and a comparison of numbers is False. In a table an
    unknown cell is a NaN without a word.
    """

    __slots__ = ()

    def __new__(cls) -> Self:
        """Return the NaN."""
        return super().__new__(cls, "nan")

    def __getattr__(self, name: str) -> Any:
        """Return an unknown attribute; AttributeError for names that Python itself looks up."""
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __call__(self, *_: object, **__: object) -> Self:
        """Return an unknown result."""
        return self

    def __getitem__(self, _: object) -> Self:
        """Return an unknown item."""
        return self

    def __iter__(self) -> Iterator[Any]:
        """Return an iterator over the known items: none."""
        return iter(())

    def __len__(self) -> int:
        """Return the number of known items: 0."""
        return 0

    def __bool__(self) -> bool:
        """Return True: the value was given."""
        return True

    def __repr__(self) -> str:
        """Return the name of the value."""
        return "UNKNOWN"

    def __reduce__(self) -> str:
        """Return the name of the only instance, also for a copy."""
        return "UNKNOWN"


UNKNOWN: Final[Any] = Unknown()
"""Unreadable value, in the place of a value of any type but text."""


class UnknownName(str):
    """Class of `UNKNOWN_NAME`: an empty text, which refers to no object."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Return the name of the value."""
        return "UNKNOWN_NAME"

    def __reduce__(self) -> str:
        """Return the name of the only instance, also for a copy."""
        return "UNKNOWN_NAME"


UNKNOWN_NAME: Final[str] = UnknownName()
"""Unreadable name or word."""


class Partly(list[Any]):
    """List with unreadable items: it may have more items than these."""


def known_name(name: str | None) -> str | None:
    """Return a name that was given and could be read, else None."""
    return None if name is UNKNOWN_NAME else name


def is_unknown(value: object) -> bool:
    """Return True if a value is given in the deck, but could not be read."""
    return value is UNKNOWN or value is UNKNOWN_NAME
