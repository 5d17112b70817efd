"""What a keyword module declares: rows, records and blocks, whose fields carry their meaning, unit and range."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import Any, ClassVar, cast

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    GetCoreSchemaHandler,
    GetJsonSchemaHandler,
    SerializationInfo,
    ValidationInfo,
    model_serializer,
    model_validator,
)
from pydantic_core import CoreSchema, core_schema

from mudline.keywords.annotations import choices_of, is_list, kind_of, metadata_of, parts_of
from mudline.keywords.json_schema import cell_schema, with_limits
from mudline.keywords.table import (
    AS_TABLES,
    Cell,
    Column,
    Listing,
    Table,
    checked_by_parts,
    fewest_fields,
    misfit,
    read_table,
    row_format,
)
from mudline.keywords.unknown import is_unknown
from mudline.keywords.values import Contents, Count, Facts, Kind, Names, Subject, Text
from mudline.limits import MOST_KEYS
from mudline.short_repr import counted, with_fields


@dataclass(frozen=True, slots=True)
class FieldInfo:
    """What a field means. Units in F (force), L, M, T, deg; "-" is dimensionless. `inferred` names our deduction.

    `names` says what the field is the name or number of, `defines` of what it gives a new thing its own. `also`
    is another name by which `mudline set` finds it, `heading` that of its column in a table of the manual. Behind a
    setting with one of the values `opaque`, or with a value that is not known, lines stand whose form is not public:
    they are kept in a record that can keep lines. None: what stands behind it has one form.
    """

    meaning: str
    unit: str = ""
    default: str = ""
    at_least: float | None = None
    above: float | None = None
    at_most: float | None = None
    inferred: str = ""
    names: Names | None = None
    also: str = ""
    defines: Names | None = None
    holds: Contents | None = None
    heading: str = ""
    opaque: tuple[str, ...] | None = None

    def fault(self, value: float) -> str:
        """What is wrong with a number, or nothing; NaN stands for one that could not be read."""
        if self.at_least is not None and value < self.at_least:
            return f"it must not be less than {self.at_least:g}"
        if self.above is not None and value <= self.above:
            return f"it must be greater than {self.above:g}"
        if self.at_most is not None and value > self.at_most:
            return f"it must not be more than {self.at_most:g}"
        return ""

    @property
    def limits(self) -> dict[str, float]:
        """The range as JSON Schema says it."""
        given = {"minimum": self.at_least, "exclusiveMinimum": self.above, "maximum": self.at_most}
        return {key: limit for key, limit in given.items() if limit is not None}

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        return core_schema.with_info_after_validator_function(self._in_range, schema) if self.limits else schema

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return with_limits(handler(schema), self.limits)

    def _in_range(self, value: object, info: ValidationInfo) -> object:
        """Refuse a number out of range; the text of a deck is read as it is, and its values are reported by checks."""
        numeric = isinstance(value, int | float) and info.context != AS_TEXT
        if numeric and (fault := self.fault(cast("float", value))):
            raise ValueError(f"{value!r} is out of range: {fault}")
        return value


AS_TEXT = "text of a deck"
"""The context in which the values of a text are validated."""


@dataclass(frozen=True, slots=True)
class Setting(FieldInfo):
    """A field written `KEY=value`; `inline` ones follow on the line of the setting before them.

    `behind` names the only setting whose line an inline one may follow on; without that it has a line of its own.
    """

    key: str = ""
    inline: bool = False
    behind: str = ""


FEWEST_POINTS = 2
"""Points of a curve."""


@dataclass(frozen=True, slots=True)
class Rows(FieldInfo):
    """A field that is a table; `row` declares its columns. The order of `unordered` rows has no meaning.

    A table that is a curve has an `abscissa`, one of its columns; the first of the others is the ordinate. `curve` says
    what kind of curve it is, in words. It is linear between its points, its end sections go on beyond them.
    """

    row: type[Row] | None = None
    unordered: bool = False
    curve: str = ""
    abscissa: str = ""

    @property
    def axes(self) -> tuple[int, int]:
        """The columns of the abscissa and the ordinate of a curve."""
        names = [spec.json for spec in record_schema(self.row).columns] if self.row else []
        over = names.index(self.abscissa)
        return over, next(index for index in range(len(names)) if index != over)

    def columns(self) -> list[Column]:
        """The columns of the table."""
        return table_columns(self.row) if self.row else []

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(
            self._read,
            serialization=core_schema.plain_serializer_function_ser_schema(self._written, info_arg=True),
        )

    def _read(self, given: object, info: ValidationInfo) -> Table:
        """A table; refuses a value out of the range of its column, and a curve of fewer than two points."""
        table = read_table(given, self.columns())
        if info.context == AS_TEXT:
            return table
        if self.curve and len(table) < FEWEST_POINTS:
            raise ValueError(f"{counted(len(table), 'point')}: a curve needs at least {FEWEST_POINTS}")
        for index, spec in enumerate(record_schema(self.row).columns if self.row else ()):
            for number, value in enumerate(table.column(index).tolist() if spec.about.limits else ()):
                if fault := spec.about.fault(value):
                    raise misfit(f"{value!r} is out of range: {fault}", number, index)
        return table

    def _written(self, table: Table | None, info: SerializationInfo) -> Listing | list[list[Cell]] | None:
        if table is None:  # of a block that could not be read
            return None
        listing = Listing(table, self.columns())
        return listing if info.context == AS_TABLES else listing.rows()

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        columns = self.columns()
        fewest = fewest_fields(column.required for column in columns)
        listed = {
            "type": "array",
            "prefixItems": [
                with_limits(cell_schema(column), spec.about.limits)
                for column, spec in zip(columns, record_schema(self.row).columns if self.row else (), strict=True)
            ],
            "items": False,
            "minItems": fewest,
        }
        return {
            "description": self.meaning,
            "anyOf": [
                {"type": "array", "items": listed, **({"minItems": FEWEST_POINTS} if self.curve else {})},
                {"type": "string", "description": "the same rows as text, one a line, fields separated by commas"},
            ],
        }


def about(meaning: str, **details: Any) -> FieldInfo:
    """A positional field."""
    return FieldInfo(meaning, **details)


def setting(key: str, meaning: str, **details: Any) -> Setting:
    """A field written `KEY=value`."""
    return Setting(meaning, key=key, **details)


def rows(row: type[Row], meaning: str, *, unordered: bool = False, inferred: str = "") -> Rows:
    """A table field."""
    return Rows(meaning, row=row, unordered=unordered, inferred=inferred)


def curve_points(row: type[Row], meaning: str, kind: str, *, abscissa: str, inferred: str = "") -> Rows:
    """A table field that is a curve of a kind, over one of its columns; its points may stand in any order."""
    return Rows(meaning, row=row, unordered=True, inferred=inferred, curve=kind, abscissa=abscissa)


class Comment(BaseModel):
    """A comment line; `before` is the index of the item that it precedes, `text` what follows the C."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
    before: Count
    text: Text

    def __repr__(self) -> str:
        return with_fields(self, [("before", self.before), ("text", self.text)])


def _no_comments() -> list[Comment]:
    """A function of our own: of the class `list` pydantic parses the signature, in each model that has the field."""
    return []


class Part(BaseModel):
    """Anything with declared fields."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True, serialize_by_alias=True, defer_build=True)

    def __repr__(self) -> str:
        given = ((name, getattr(self, name, None)) for name in type(self).model_fields if name != "comments")
        return with_fields(self, ((name, value) for name, value in given if value is not None))

    __str__ = __repr__

    @model_validator(mode="before")
    @classmethod
    def _few_keys(cls, given: object) -> object:
        """Every unknown key would be a fault."""
        if isinstance(given, dict) and len(given) > MOST_KEYS:
            raise ValueError(f"{len(given)} keys, expected {len(cls.model_fields)} at most")
        return given

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return checked_by_parts(handler(source))


class Row(Part):
    """A line of positional fields, or the values behind a KEY=."""


class ListRow(Row):
    """A row that JSON holds as a list, trailing fields left out."""

    @model_validator(mode="before")
    @classmethod
    def _from_list(cls, given: object) -> object:
        if not isinstance(given, list):
            return given
        columns = record_schema(cls).columns
        if not record_schema(cls).fewest <= len(given) <= len(columns):
            raise ValueError(f"{len(given)} values, expected {record_schema(cls).wanted}")
        return {slot.json: value for slot, value in zip(columns, given, strict=False)}

    @model_serializer
    def _to_list(self) -> list[object] | None:
        if is_unknown(self):
            return None
        given = [slot.name for slot in record_schema(type(self)).columns if slot.name in self.model_fields_set]
        values = (getattr(self, name) for name in given)
        return [str(value) if isinstance(value, str) else value for value in values]

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        found = record_schema(cls)
        items = [cell_schema(Column(s.label, s.kind or Kind.REAL, s.required)) for s in found.columns]
        return {"type": "array", "prefixItems": items, "items": False, "minItems": found.fewest}


class Record(Part):
    """Lines that belong together; `rule` is the grammar rule that says in what order they stand.

    `sticky` names a field that also holds for later records of the list, until one of them gives it again.
    """

    rule: ClassVar[str]
    sticky: ClassVar[str] = ""
    comments: list[Comment] = Field(default_factory=_no_comments)

    @classmethod
    def carries(cls, given: dict[str, object], last: object) -> object:
        """What `row_slot` is told as `last` in the next record, of what was read of this one."""
        return given.get(cls.sticky) or last

    @classmethod
    def row_slot(cls, number: int, fields: int, given: dict[str, object], last: object) -> str:
        """Which field the row `number` of this record fills; `fields` is how many values stand on it.

        `given` holds what was read of the record so far, `last` what the `sticky` field of the records before it gave.
        Only records with several kinds of row need to say.
        """
        return record_schema(cls).row_names[0]


class Block(Record):
    """A keyword with its data. The class variables are its declaration.

    `sections` are those where it belongs; `subject` is what it is about; `page` is the page of the manual with its
    format; `facts` is what else is known of it; `tabular` keeps runs of numeric lines whole, as arrays; `slashes` says
    that /.../ is one field; `example` is a block that reads without a finding. With `open_lines` a line of a form that
    the declaration does not know is passed through unchanged; with `known_forms` only one whose key or place it does
    not know: in others a fault is a fault.
    """

    sections: ClassVar[tuple[str, ...]] = ("MODEL",)
    subject: ClassVar[Subject] = "model"
    page: ClassVar[str] = ""
    facts: ClassVar[Facts] = Facts()
    summary: ClassVar[str]
    tabular: ClassVar[bool] = False
    slashes: ClassVar[bool] = False
    open_lines: ClassVar[bool] = False
    known_forms: ClassVar[bool] = False
    example: ClassVar[str]
    keyword: str


_OF_TEXT = (Kind.NAME, Kind.TITLE, Kind.OTHER)


@dataclass(slots=True)
class FieldSpec:
    """One field of a part, as the reader and the writer see it."""

    name: str
    json: str
    about: FieldInfo
    kind: Kind | None
    choices: tuple[str, ...]
    row: type[Row] | None
    record: dict[str, type[Record]]
    required: bool
    many: bool
    order: int

    @property
    def key(self) -> str:
        """The KEY of a setting, or ""."""
        return self.about.key if isinstance(self.about, Setting) else ""

    @property
    def is_text(self) -> bool:
        """Whether its values are names and words alone."""
        return not self.row and (self.kind in _OF_TEXT or (self.kind is None and bool(self.choices)))

    @property
    def label(self) -> str:
        """The field's name for a reader."""
        return self.key + "=" if self.key else self.json.replace("_", " ")


@dataclass
class RecordSchema:
    """The fields of a part by how they are written; what follows from them is found once."""

    columns: list[FieldSpec] = field(default_factory=list)
    keys: dict[str, FieldSpec] = field(default_factory=dict)
    table: FieldSpec | None = None
    children: dict[str, FieldSpec] = field(default_factory=dict)
    slots: list[FieldSpec] = field(default_factory=list)

    @cached_property
    def row_names(self) -> list[str]:
        """Names of the fields that a row can fill."""
        return [slot.name for slot in (*self.columns, *([self.table] if self.table else []))]

    @cached_property
    def fewest(self) -> int:
        """How many fields a row must have."""
        return fewest_fields(slot.required for slot in self.columns)

    @cached_property
    def wanted(self) -> str:
        """The columns in words: `depth, density [, gravity]`."""
        return row_format([slot.label for slot in self.columns], [slot.required for slot in self.columns])


@cache
def record_schema(part: type[Part]) -> RecordSchema:
    """The declared fields of a class, found once."""
    found = RecordSchema()
    for order, (name, info) in enumerate(part.model_fields.items()):
        meta = next((item for item in metadata_of(info) if isinstance(item, FieldInfo)), None)
        records = _records(info.annotation)
        if meta is None and not records:
            continue
        slot = FieldSpec(
            name=name,
            json=info.alias or name,
            about=meta or FieldInfo(""),
            kind=kind_of(info),
            choices=choices_of(info.annotation),
            row=meta.row if isinstance(meta, Rows) else _row(info.annotation),
            record={record.rule: record for record in records},
            required=info.is_required(),
            many=is_list(info.annotation),
            order=order,
        )
        found.slots.append(slot)
        if isinstance(meta, Rows):
            found.table = slot
        elif isinstance(meta, Setting):
            found.keys.setdefault(meta.key, slot)
        elif records:
            found.children |= dict.fromkeys(slot.record, slot)
        else:
            found.columns.append(slot)
    return found


def _is_empty(value: object) -> bool:
    return value is None or (isinstance(value, list | Table) and not len(value))


def columns_of(slot: FieldSpec) -> list[Column]:
    """The columns of a field that is a table."""
    return slot.about.columns() if isinstance(slot.about, Rows) else []


@cache
def table_columns(row: type[Row]) -> list[Column]:
    """The columns of a table whose rows are `row`."""
    return [Column(slot.label, slot.kind or Kind.REAL, slot.required) for slot in record_schema(row).columns]


def _records(annotation: Any) -> list[type[Record]]:
    return [piece for piece in parts_of(annotation) if isinstance(piece, type) and issubclass(piece, Record)]


def _row(annotation: Any) -> type[Row] | None:
    found = (piece for piece in parts_of(annotation) if isinstance(piece, type) and issubclass(piece, Row))
    return next(found, None)


def require_one(part: Part, *names: str) -> None:
    """Raise ValueError unless a part has a value in exactly one of some fields."""
    slots = [slot for slot in record_schema(type(part)).slots if slot.name in names]
    given = [slot.label for slot in slots if not _is_empty(getattr(part, slot.name))]
    if len(given) != 1:
        wanted = " or ".join(slot.label for slot in slots)
        raise ValueError(f"{' and '.join(given) or 'nothing'} is given: expected {wanted}")
