"""Base classes of keyword declarations: rows, records and blocks, whose fields carry meaning, unit and range."""

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
    Table,
    fewest_fields,
    misfit,
    read_table,
    row_format,
)
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Facts, Kind, Subject, is_unknown

FEWEST_POINTS = 2
"""Least number of points of a curve."""


@dataclass(frozen=True, slots=True)
class Rows(FieldInfo):
    """Field that is a table; `row` declares its columns. The order of `unordered` rows has no meaning.

    A table that is a curve has an `abscissa`, one of its columns; the first other column is the ordinate. `curve` is
    the kind of curve in words. The curve is linear between its points. `ends` is its shape beyond them: continued with
    the slope of the end sections ("slope"), with the last value ("value"), or unknown ("none").
    """

    row: type["Row"] = field(kw_only=True)
    unordered: bool = False
    curve: str = ""
    abscissa: str = ""
    ends: Literal["slope", "value", "none"] = "none"

    @property
    def axes(self) -> tuple[int, int]:
        """Columns of the abscissa and the ordinate of a curve."""
        names = [spec.json for spec in record_schema(self.row).columns]
        over = names.index(self.abscissa)
        return over, next(index for index in range(len(names)) if index != over)

    def columns(self) -> list[Column]:
        """Return the columns of the table."""
        return record_schema(self.row).cells

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(
            self._read,
            serialization=core_schema.plain_serializer_function_ser_schema(self._written, info_arg=True),
        )

    def _read(self, data: object, info: ValidationInfo) -> Table:
        """Return a table; raises ValueError for a value out of its range or a curve of fewer than two points."""
        table = read_table(data, self.columns())
        if info.context == AS_TEXT:
            return table
        if self.curve and len(table) < FEWEST_POINTS:
            raise ValueError(f"{counted(len(table), 'point')}: a curve needs at least {FEWEST_POINTS}")
        for index, spec in enumerate(record_schema(self.row).columns):
            for number, value in enumerate(table.column(index).tolist() if spec.about.limits else ()):
                if fault := spec.about.fault(value):
                    raise misfit(f"{value!r} is out of range: {fault}", number, index)
        return table

    def _written(self, table: Table | None, info: SerializationInfo) -> Table | list[list[Cell]] | None:
        if table is None:  # the block could not be read
            return None
        return table if info.context == AS_TABLES else table.rows()

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        declared = record_schema(self.row)
        pairs = zip(declared.cells, declared.columns, strict=True)
        cells = [with_limits(cell_schema(column), spec.about.limits) for column, spec in pairs]
        listed = {"type": "array", "prefixItems": cells, "items": False, "minItems": declared.fewest}
        return {
            "description": self.meaning,
            "anyOf": [
                {"type": "array", "items": listed, **({"minItems": FEWEST_POINTS} if self.curve else {})},
                {"type": "string", "description": "the same rows as text, one a line, fields separated by commas"},
            ],
        }


def rows(row: type["Row"], meaning: str, *, unordered: bool = False, inferred: str = "") -> Rows:
    """Return a table field."""
    return Rows(meaning, row=row, unordered=unordered, inferred=inferred)


Path = tuple[str | int, ...]
"""Keys and indices as in JSON, from a part inwards; a table is followed by row and column."""


class PartValue(NamedTuple):
    """Value of a part's field: one item of a list, a whole table, or a part with fields of its own."""

    path: Path
    field: "FieldSpec"
    value: Any


FieldFilter = Callable[["FieldSpec"], bool]
"""Predicate that selects fields; a module-level function, as its results are cached."""


class Part(BaseModel):
    """Base class of all classes with declared fields."""

    model_config = ConfigDict(
        extra="forbid", populate_by_name=True, serialize_by_alias=True, defer_build=True, validate_assignment=True
    )

    if not TYPE_CHECKING:  # with this method type checkers accept any attribute

        def __setattr__(self, name: str, value: Any) -> None:
            """Set a field; raises ValueError for an unknown field or an invalid value, and leaves it unchanged."""
            assign(self, name, value, record_schema, super().__setattr__)

    def __repr__(self) -> str:
        fields = ((name, getattr(self, name, None)) for name in type(self).model_fields if name != "comments")
        return with_fields(self, ((name, value) for name, value in fields if value is not None))

    __str__ = __repr__

    def walk(self, wanted: FieldFilter | None = None) -> list[PartValue]:
        """Return the values of the part and its inner parts whose fields are `wanted`; without a predicate all.

        Fields without a value (None) are left out.
        """
        values: list[PartValue] = []
        _walk(self, (), wanted, values)
        return values

    def at(self, path: Path) -> tuple["FieldSpec | None", Any]:
        """Return the field and the value at a path; None for a value that does not exist."""
        field: FieldSpec | None = None
        value: Any = self
        for number, step in enumerate(path):
            if isinstance(value, Table):
                return _cell(field, value, path[number:])
            if isinstance(value, Part):
                slots = record_schema(type(value)).slots
                field = next((spec for at, spec in enumerate(slots) if step in (spec.json, at)), None)
                value = None if field is None else getattr(value, field.name, None)
            elif isinstance(value, list) and isinstance(step, int):
                value = value[step] if step < len(value) else None
            else:
                return field, None
        return field, value

    @model_validator(mode="before")
    @classmethod
    def _few_keys(cls, document: object) -> object:
        """Limit the number of keys: every unknown key would be a fault."""
        if isinstance(document, dict) and len(document) > MOST_KEYS:
            raise ValueError(f"{len(document)} keys, expected {len(cls.model_fields)} at most")
        return document

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return checked_by_parts(handler(source), cls)


class Row(Part):
    """Line of positional fields, or the values after a KEY=."""


class ListRow(Row):
    """Row that JSON holds as a list without trailing empty fields."""

    @model_validator(mode="before")
    @classmethod
    def _from_list(cls, items: object) -> object:
        if not isinstance(items, list):
            return items
        columns = record_schema(cls).columns
        if not record_schema(cls).fewest <= len(items) <= len(columns):
            raise ValueError(f"{len(items)} values, expected {record_schema(cls).layout}")
        return {slot.json: value for slot, value in zip(columns, items, strict=False)}

    @model_serializer
    def _to_list(self) -> list[object] | None:
        if is_unknown(self):
            return None
        names = [slot.name for slot in record_schema(type(self)).columns if slot.name in self.model_fields_set]
        values = (getattr(self, name) for name in names)
        return [str(value) if isinstance(value, str) else value for value in values]

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        declared = record_schema(cls)
        items = list(map(cell_schema, declared.cells))
        return {"type": "array", "prefixItems": items, "items": False, "minItems": declared.fewest}


class Record(Part):
    """Lines that belong together; `rule` is the grammar rule of their order.

    `sticky` names a field that also holds for later records of the list, until one of them gives it again.
    """

    rule: ClassVar[str]
    sticky: ClassVar[str] = ""
    # With the class `list`, pydantic parses its signature in each model that has the field.
    comments: list[Comment] = Field(default_factory=lambda: [])  # noqa: PIE807 - as above

    def known_as(self) -> Any:
        """Return the name of the record or of its set, which is its first name field; None if it has none."""
        slot = record_schema(type(self)).name
        return (getattr(self, slot.name) or slot.about.default or None) if slot else None

    @classmethod
    def carries(cls, values: dict[str, object], last: object) -> object:
        """Return the value passed as `last` to `row_slot` of the next record."""
        return values.get(cls.sticky) or last

    @classmethod
    def row_slot(cls, number: int, fields: int, values: dict[str, object], last: object) -> str:
        """Return the name of the field that row `number` of this record fills; `fields` is the row's number of values.

        `values` are those of the record read so far, `last` the value of the `sticky` field in earlier records.
        Only records with several kinds of row override this method.
        """
        return record_schema(cls).row_names[0]


class Block(Record):
    """Keyword with its data. The class variables are its declaration.

    Attributes:
        sections: sections where the keyword belongs.
        subject, summary: subject, and sentence for a reader.
        page: page of the manual with its format.
        facts: further facts about the keyword.
        tabular: True if runs of numeric lines are read as arrays.
        slashes: True if /.../ is one field.
        open_lines: True if lines of unknown form are passed through; with `known_forms`, only those with an unknown
            key or place.
        example: block that reads without a finding.
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


@dataclass(slots=True)
class FieldSpec:
    """Field of a part for reader and writer; `of_list` is True in a `ListRow`."""

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
    span: tuple[float, float]
    of_list: bool = False

    @property
    def key(self) -> str:
        """KEY of a setting, or ""."""
        return self.about.key if isinstance(self.about, Setting) else ""

    @property
    def parts(self) -> list[type[Part]]:
        """Possible parts of the field's values, or of its table's rows."""
        return [part for part in (self.row, *self.record.values()) if part]

    @property
    def is_text(self) -> bool:
        """True if the values can only be names and words."""
        words = self.kind in (Kind.NAME, Kind.TITLE, Kind.OTHER) or (self.kind is None and bool(self.choices))
        return words and not self.row

    @property
    def columns(self) -> list[Column]:
        """Columns of a field that is a table; none of other fields."""
        return self.about.columns() if isinstance(self.about, Rows) else []

    @property
    def label(self) -> str:
        """Name of the field for a reader."""
        return self.key + "=" if self.key else self.json.replace("_", " ")


@dataclass
class RecordSchema:
    """Fields of a part by the way they are written; derived values are cached."""

    columns: list[FieldSpec] = field(default_factory=list)
    keys: dict[str, FieldSpec] = field(default_factory=dict)
    tables: list[FieldSpec] = field(default_factory=list)
    children: dict[str, FieldSpec] = field(default_factory=dict)
    slots: list[FieldSpec] = field(default_factory=list)

    @cached_property
    def name(self) -> FieldSpec | None:
        """First field that is a name: that of the part itself, or of what its values belong to."""
        return next((slot for slot in self.slots if slot.kind is Kind.NAME), None)

    @cached_property
    def row_names(self) -> list[str]:
        """Names of the fields that a row can fill."""
        return [slot.name for slot in (*self.columns, *self.tables)]

    @cached_property
    def cells(self) -> list[Column]:
        """Columns of a table whose rows have these fields."""
        return [Column(slot.label, slot.kind or Kind.REAL, slot.required) for slot in self.columns]

    @cached_property
    def fewest(self) -> int:
        """Least number of fields in a row."""
        return fewest_fields(slot.required for slot in self.columns)

    @cached_property
    def layout(self) -> str:
        """Columns in words: `depth, density [, gravity]`."""
        columns = [slot for slot in self.columns if slot.about.older is not True]
        return row_format([slot.label for slot in columns], [slot.required for slot in columns])


@cache
def record_schema(part: type[Part]) -> RecordSchema:
    """Return the declared fields of a class, cached."""
    schema = RecordSchema()
    for order, (name, info) in enumerate(part.model_fields.items()):
        about = next((item for item in metadata_of(info) if isinstance(item, FieldInfo)), FieldInfo(""))
        classes = [piece for piece in parts_of(info.annotation) if isinstance(piece, type)]
        records = [piece for piece in classes if issubclass(piece, Record)]
        rows = [piece for piece in classes if issubclass(piece, Row)]
        if not (about.meaning or records):
            continue
        slot = FieldSpec(
            name=name,
            json=info.alias or name,
            about=about,
            kind=kind_of(info),
            choices=choices_of(info.annotation),
            row=about.row if isinstance(about, Rows) else next(iter(rows), None),
            record={record.rule: record for record in records},
            required=info.is_required(),
            many=is_list(info.annotation),
            order=order,
            usuals=about.usuals,
            span=about.span,
            of_list=issubclass(part, ListRow),
        )
        schema.slots.append(slot)
        if isinstance(about, Rows):
            schema.tables.append(slot)
        elif isinstance(about, Setting):
            schema.keys.setdefault(about.key, slot)
        elif records:
            schema.children |= dict.fromkeys(slot.record, slot)
        else:
            schema.columns.append(slot)
    return schema


is_part = cache(lambda kind: issubclass(kind, Part))  # several times as fast as `issubclass` of a model


def _walk(part: Part, prefix: Path, wanted: FieldFilter | None, values: list[PartValue]) -> None:
    for slot, own in _leading(type(part), wanted):
        value: Any = getattr(part, slot.name, None)
        listed = isinstance(value, list)
        for index, item in enumerate(value if listed else () if value is None else (value,)):
            path = (*prefix, slot.json, index) if listed else (*prefix, slot.json)
            if own:
                values.append(PartValue(path, slot, item))
            kind: type[BaseModel] = type(item)
            if is_part(kind):
                _walk(item, path, wanted, values)


@cache
def _leading(part: type[Part], wanted: FieldFilter | None) -> tuple[tuple[FieldSpec, bool], ...]:
    """Return the fields of a part that are wanted (True), or only contain parts with wanted fields (False)."""
    slots = ((slot, wanted is None or wanted(slot)) for slot in record_schema(part).slots)
    return tuple((slot, own) for slot, own in slots if own or any(_leading(inner, wanted) for inner in slot.parts))


@cache
def has_fields(part: type[Part], wanted: FieldFilter) -> bool:
    """Return True if a part or an inner part has a wanted field: without one, a walk is not needed."""
    return bool(_leading(part, wanted))


def fields_of(part: type[Part]) -> Iterator[FieldSpec]:
    """Yield the fields of a part and of its inner parts, including the columns of tables."""
    for slot in record_schema(part).slots:
        yield slot
        for inner in slot.parts:
            yield from fields_of(inner)


def _cell(field: FieldSpec | None, table: Table, path: Path) -> tuple[FieldSpec | None, Any]:
    """Return the column and the value of a cell; None for a row that could not be read."""
    columns = record_schema(field.row).columns if field is not None and field.row else []
    row, column = (int(step) for step in path) if len(path) > 1 else (0, len(columns))
    return (columns[column], table.cell(row, column)) if column < len(columns) else (None, None)
