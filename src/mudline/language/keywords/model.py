"""What a keyword module declares: rows, records and blocks, whose fields carry their meaning, unit and range."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

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

from mudline.basics.limits import MOST_KEYS
from mudline.basics.short_repr import counted, with_fields
from mudline.language.keywords.assigning import assign, checked_by_parts
from mudline.language.keywords.fields import (
    AS_TEXT,
    Comment,
    FieldInfo,
    Setting,
    cell_schema,
    choices_of,
    is_list,
    kind_of,
    metadata_of,
    parts_of,
    with_limits,
)
from mudline.language.keywords.table import (
    AS_TABLES,
    Cell,
    Column,
    Listing,
    Table,
    fewest_fields,
    misfit,
    read_table,
    row_format,
)
from mudline.language.keywords.unknown import is_unknown
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Facts, Kind, Subject

FEWEST_POINTS = 2
"""Points of a curve."""


@dataclass(frozen=True, slots=True)
class Rows(FieldInfo):
    """A field that is a table; `row` declares its columns. The order of `unordered` rows has no meaning.

    A table that is a curve has an `abscissa`, one of its columns; the first of the others is the ordinate. `curve` says
    what kind of curve it is, in words. It is linear between its points; `ends` says what it is beyond them: its end
    sections go on ("slope"), its last value stays ("value"), or nothing is known of it ("none").
    """

    row: type["Row"] | None = None
    unordered: bool = False
    curve: str = ""
    abscissa: str = ""
    ends: Literal["slope", "value", "none"] = "none"

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
        listed = {
            "type": "array",
            "prefixItems": [
                with_limits(cell_schema(column), spec.about.limits)
                for column, spec in zip(columns, record_schema(self.row).columns if self.row else (), strict=True)
            ],
            "items": False,
            "minItems": fewest_fields(column.required for column in columns),
        }
        return {
            "description": self.meaning,
            "anyOf": [
                {"type": "array", "items": listed, **({"minItems": FEWEST_POINTS} if self.curve else {})},
                {"type": "string", "description": "the same rows as text, one a line, fields separated by commas"},
            ],
        }


def rows(row: type["Row"], meaning: str, *, unordered: bool = False, inferred: str = "") -> Rows:
    """A table field."""
    return Rows(meaning, row=row, unordered=unordered, inferred=inferred)


Path = tuple[str | int, ...]
"""Keys and indices as JSON has them, from a part inwards; a table is followed by row and column."""


class Value(NamedTuple):
    """What a field of a part holds: one item of a list, a whole table, or a part with fields of its own."""

    path: Path
    field: "FieldSpec"
    value: Any


Wanted = Callable[["FieldSpec"], bool]
"""Tells of a field whether its values are wanted; one function of a module, as what it tells is remembered."""


class Part(BaseModel):
    """Anything with declared fields."""

    model_config = ConfigDict(
        extra="forbid", populate_by_name=True, serialize_by_alias=True, defer_build=True, validate_assignment=True
    )

    if not TYPE_CHECKING:  # a checker takes any attribute of a class that has this

        def __setattr__(self, name: str, value: Any) -> None:
            """Set a field. Raises ValueError for what is none, or a value that it cannot have: it keeps its own."""
            assign(self, name, value, record_schema, super().__setattr__)

    def __repr__(self) -> str:
        given = ((name, getattr(self, name, None)) for name in type(self).model_fields if name != "comments")
        return with_fields(self, ((name, value) for name, value in given if value is not None))

    __str__ = __repr__

    def walk(self, wanted: Wanted | None = None) -> list[Value]:
        """Return the values of the part, and of the parts inside it, whose field is wanted: of all if nothing tells.

        What is left out (None) is none.
        """
        found: list[Value] = []
        _walk(self, (), wanted, found)
        return found

    def at(self, path: Path) -> tuple["FieldSpec | None", Any]:
        """Return the field and the value that a path leads to; None for a value that is not there."""
        field: FieldSpec | None = None
        value: Any = self
        for number, step in enumerate(path):
            if isinstance(value, Table):
                return _cell(field, value, path[number:])
            if isinstance(value, Part):
                slots = record_schema(type(value)).slots
                field = next((one for at, one in enumerate(slots) if step in (one.json, at)), None)
                value = None if field is None else getattr(value, field.name, None)
            elif isinstance(value, list) and isinstance(step, int):
                value = value[step] if step < len(value) else None
            else:
                return field, None
        return field, value

    @model_validator(mode="before")
    @classmethod
    def _few_keys(cls, given: object) -> object:
        """Every unknown key would be a fault."""
        if isinstance(given, dict) and len(given) > MOST_KEYS:
            raise ValueError(f"{len(given)} keys, expected {len(cls.model_fields)} at most")
        return given

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return checked_by_parts(handler(source), cls)


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
    # Of the class `list` pydantic parses the signature, in each model that has the field.
    comments: list[Comment] = Field(default_factory=lambda: [])  # noqa: PIE807 - as above

    def known_as(self) -> Any:
        """The name of the record, or that of its set: its first field for a name; None where it has none."""
        slot = next((slot for slot in record_schema(type(self)).slots if slot.kind is Kind.NAME), None)
        return (getattr(self, slot.name) or slot.about.default or None) if slot else None

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
    that /.../ is one field; `example` is a block that reads without a finding. With `open_lines` lines of unknown forms
    are passed through unchanged; with `known_forms` only those whose key or place is not known.
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
    """One field of a part, as the reader and the writer see it; `of_list` for one of a `ListRow`."""

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
    usuals: tuple[Usual, ...]
    of_list: bool = False

    @property
    def key(self) -> str:
        """The KEY of a setting, or ""."""
        return self.about.key if isinstance(self.about, Setting) else ""

    @property
    def parts(self) -> list[type[Part]]:
        """The parts that a value of the field may be, or its table consists of."""
        return [part for part in (self.row, *self.record.values()) if part]

    @property
    def is_text(self) -> bool:
        """Whether its values are names and words alone."""
        return not self.row and (self.kind in _OF_TEXT or (self.kind is None and bool(self.choices)))

    @property
    def columns(self) -> list[Column]:
        """The columns of a field that is a table; of others none."""
        return self.about.columns() if isinstance(self.about, Rows) else []

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
        columns = [slot for slot in self.columns if slot.about.older is not True]
        return row_format([slot.label for slot in columns], [slot.required for slot in columns])


@cache
def record_schema(part: type[Part]) -> RecordSchema:
    """The declared fields of a class, found once."""
    found = RecordSchema()
    for order, (name, info) in enumerate(part.model_fields.items()):
        meta = next((item for item in metadata_of(info) if isinstance(item, FieldInfo)), None)
        classes = [piece for piece in parts_of(info.annotation) if isinstance(piece, type)]
        records = [piece for piece in classes if issubclass(piece, Record)]
        rows = [piece for piece in classes if issubclass(piece, Row)]
        if meta is None and not records:
            continue
        slot = FieldSpec(
            name=name,
            json=info.alias or name,
            about=meta or FieldInfo(""),
            kind=kind_of(info),
            choices=choices_of(info.annotation),
            row=meta.row if isinstance(meta, Rows) else next(iter(rows), None),
            record={record.rule: record for record in records},
            required=info.is_required(),
            many=is_list(info.annotation),
            order=order,
            usuals=meta.usuals if meta else (),
            of_list=issubclass(part, ListRow),
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


_is_part = cache(lambda kind: issubclass(kind, Part))  # to ask a model itself takes several times as long


def _walk(part: Part, prefix: Path, wanted: Wanted | None, found: list[Value]) -> None:
    for slot, own in _leading(type(part), wanted):
        value: Any = getattr(part, slot.name, None)
        listed = isinstance(value, list)
        for index, item in enumerate(value if listed else () if value is None else (value,)):
            path = (*prefix, slot.json, index) if listed else (*prefix, slot.json)
            if own:
                found.append(Value(path, slot, item))
            kind: type[BaseModel] = type(item)
            if _is_part(kind):
                _walk(item, path, wanted, found)


@cache
def _leading(part: type[Part], wanted: Wanted | None) -> tuple[tuple[FieldSpec, bool], ...]:
    """The fields of a part that are wanted (True), or hold parts with such fields alone (False)."""
    found = ((slot, wanted is None or wanted(slot)) for slot in record_schema(part).slots)
    return tuple((slot, own) for slot, own in found if own or any(_leading(one, wanted) for one in slot.parts))


def fields_of(part: type[Part]) -> Iterator[FieldSpec]:
    """Yield the fields that a part declares, and those of the parts inside it; columns of tables among them."""
    for slot in record_schema(part).slots:
        yield slot
        for one in slot.parts:
            yield from fields_of(one)


def _cell(field: FieldSpec | None, table: Table, path: Path) -> tuple[FieldSpec | None, Any]:
    """The column and the value of a cell; a row that could not be read has none."""
    columns = record_schema(field.row).columns if field is not None and field.row else []
    row, column = (int(step) for step in path) if len(path) > 1 else (0, len(columns))
    return (columns[column], table.cell(row, column)) if column < len(columns) else (None, None)


@cache
def table_columns(row: type[Row]) -> list[Column]:
    """The columns of a table whose rows are `row`."""
    return [Column(slot.label, slot.kind or Kind.REAL, slot.required) for slot in record_schema(row).columns]
