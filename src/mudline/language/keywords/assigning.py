"""Assignment of values in a program to fields of a block and to their lists."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from itertools import islice
from typing import TYPE_CHECKING, Annotated, Any, Generic, NamedTuple, Self, SupportsIndex, TypeVar, cast, overload

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic_core import CoreSchema, ErrorDetails, InitErrorDetails, PydanticCustomError, core_schema

from mudline.basics.short_repr import UnknownNameError
from mudline.basics.spelling import nearest
from mudline.language.keywords.faults import fault_in_words, path_in, path_text
from mudline.language.keywords.table import plain

_ENTRIES_AT_ONCE = 32
"""Greatest number of entries checked at a time; lists are nested three deep at most."""

_UNCHECKED = PydanticCustomError("unchecked", "not checked, nor what follows: correct the entries before it first")


def assign(part: BaseModel, name: str, value: Any, schema: Callable[..., Any], put: Callable[[str, Any], None]) -> None:
    """Assign a value to a field of a part, which validates it; several values are those of a row, one for each column.

    `schema` is `record_schema`, passed in because this module cannot import it.

    Raises ValueError, and leaves the part unchanged.
    """
    kind = type(part)
    if name not in kind.model_fields:
        near = nearest(name, kind.model_fields)
        raise ValueError(f"{kind.__name__} has no field {name!r}{f': did you mean {near}?' if near else ''}")
    plain_value, kept, known = plain(value), dict(part.__dict__), set(part.model_fields_set)
    slot = next((slot for slot in schema(kind).slots if slot.name == name), None)
    if slot and slot.row and not (slot.many or slot.columns) and isinstance(plain_value, list):
        columns = [column.json for column in schema(slot.row).columns]
        if len(plain_value) > len(columns):
            raise ValueError(f"{kind.__name__}.{name}: {len(plain_value)} values, at most {len(columns)} expected")
        plain_value = dict(zip(columns, plain_value, strict=False))
    try:
        put(name, plain_value)
    except ValidationError as error:
        object.__setattr__(part, "__dict__", kept)
        object.__setattr__(part, "__pydantic_fields_set__", known)
        expected = slot.kind.value if slot and slot.kind and not slot.choices else ""
        raise _refusal(kind.__name__, {name: plain_value}, error, expected) from None


def _refusal(name: str, value: object, error: ValidationError, expected: str = "") -> ValueError:
    """Return the error of a value that cannot be assigned: path and `expected` value of the first fault."""
    by_path: dict[tuple[str | int, ...], list[ErrorDetails]] = {}
    for fault in error.errors(include_url=False):
        lacking = fault["loc"][-1:] if fault["type"] == "missing" else ()
        by_path.setdefault((*path_in(value, fault["loc"]), *lacking), []).append(fault)
    path, faults = next(iter(by_path.items()))
    return ValueError(f"{path_text((name, *path))}: {fault_in_words(faults, expected)}")


class ListOf(NamedTuple):
    """Field of a part, whose list is validated."""

    part: type[BaseModel]
    name: str

    def by_parts(self, values: object, check: core_schema.ValidatorFunctionWrapHandler) -> ValidatedList:
        """Return all entries, or raise the faults of the first chunk with any. The input may be a generator."""
        validated = ValidatedList()
        validated.of = self
        if not isinstance(values, Iterator) and not (isinstance(values, list) and len(values) > _ENTRIES_AT_ONCE):
            list.extend(validated, check(values))
            return validated
        entries: Iterator[object] = iter(values)
        while part := list(islice(entries, _ENTRIES_AT_ONCE)):
            try:
                list.extend(validated, check(part))
            except ValidationError as error:
                start = len(validated)
                moved = [_moved(fault, start) for fault in error.errors(include_url=False)]
                if any(True for _ in entries):
                    moved.append(InitErrorDetails(type=_UNCHECKED, loc=(start + _ENTRIES_AT_ONCE,), input=None))
                raise ValidationError.from_exception_data(error.title, moved) from error
        return validated


class ValidatedList(list[Any]):
    """List of a part whose entries are validated when they are added; records are found by their name too."""

    __slots__ = ("of",)
    of: ListOf

    def __reduce__(self) -> tuple[Any, ...]:
        """Return a function that fills a copy without validation: the entries are valid."""
        return _filled, (self.of, list(self))

    def __getitem__(self, at: Any) -> Any:
        """Return an entry by index, or by name without case; raises KeyError for a name of no entry or of several."""
        if not isinstance(at, str):
            return super().__getitem__(at)
        names = [entry.known_as() if hasattr(entry, "known_as") else None for entry in self]
        indices = [
            index for index, name in enumerate(names) if isinstance(name, str) and name.casefold() == at.casefold()
        ]
        if len(indices) == 1:
            return super().__getitem__(indices[0])
        if indices:
            raise UnknownNameError(f"{at!r} is the name of {len(indices)} entries: take one by its index, of {indices}")
        raise UnknownNameError.among("entry", at, [name for name in names if isinstance(name, str)])

    def __setitem__(self, at: Any, value: Any) -> None:
        super().__setitem__(at, self._valid(value) if isinstance(at, slice) else self._valid([value])[0])

    def __iadd__(self, values: Iterable[Any]) -> Self:  # type: ignore[misc]  # `list` accepts any values
        self.extend(values)
        return self

    def append(self, value: Any) -> None:
        """Append an entry; raises ValueError for an entry that does not belong in the list."""
        super().extend(self._valid([value]))

    def extend(self, values: Iterable[Any]) -> None:
        """Append entries, all or none; raises ValueError for an entry that does not belong in the list."""
        super().extend(self._valid(values))

    def insert(self, at: SupportsIndex, value: Any) -> None:
        """Insert an entry before an index; raises ValueError for an entry that does not belong in the list."""
        super().insert(at, self._valid([value])[0])

    def _valid(self, values: Iterable[Any]) -> list[Any]:
        entries = plain(list(values))
        try:
            return cast("list[Any]", _entries(self.of).validate_python(entries))
        except ValidationError as error:
            raise _refusal(f"{self.of.part.__name__}.{self.of.name}", entries, error) from None


if TYPE_CHECKING:
    _Entry = TypeVar("_Entry")

    class RecordList(list[_Entry]):
        """Interface of a `ValidatedList` for type checkers."""

        @overload
        def __getitem__(self, at: SupportsIndex | str) -> _Entry: ...
        @overload
        def __getitem__(self, at: slice) -> list[_Entry]: ...
        def __getitem__(self, at: Any) -> Any: ...

    class Records(Generic[_Entry]):
        """Descriptor of a list of parts: read as a `RecordList`, assigned from several parts or their values."""

        def __get__(self, part: object, kind: type | None = None) -> RecordList[_Entry]: ...
        def __set__(self, part: object, values: Iterable[_Entry | Mapping[str, Any]]) -> None: ...

else:
    Records = list


def _filled(of: ListOf, entries: list[Any]) -> ValidatedList:
    filled = ValidatedList(entries)
    filled.of = of
    return filled


@cache
def _entries(of: ListOf) -> TypeAdapter[Any]:
    info = of.part.model_fields[of.name]
    kind: Any = Annotated[info.annotation, *info.metadata] if info.metadata else info.annotation
    return TypeAdapter(kind)


def checked_by_parts(schema: CoreSchema, part: type[BaseModel], name: str = "") -> CoreSchema:
    """Return the schema of a model whose own lists are validated in chunks; inner models have limits of their own."""
    core = cast("dict[str, Any]", schema)
    if core["type"] == "list":
        return core_schema.no_info_wrap_validator_function(ListOf(part, name).by_parts, schema)
    if name and core["type"] in ("model", "function-wrap"):
        return schema
    if core["type"] == "default" and core.get("default") == [] and core["schema"]["type"] == "list":
        core["validate_default"] = True
    if "schema" in core:
        core["schema"] = checked_by_parts(core["schema"], part, name)
    if core["type"] == "model-fields":
        for key, field in core["fields"].items():
            field["schema"] = checked_by_parts(field["schema"], part, key)
    return schema


def _moved(fault: ErrorDetails, start: int) -> InitErrorDetails:
    """Return a fault of a chunk as a fault of the whole list."""
    kind = PydanticCustomError(
        cast("Any", fault["type"]), "{message}", {**fault.get("ctx", {}), "message": fault["msg"]}
    )
    index, *rest = fault["loc"]
    return InitErrorDetails(type=kind, loc=(cast("int", index) + start, *rest), input=fault["input"])
