"""What the annotation of a field says, taken apart: its metadata, its kind, its choices, whether it is a list."""

from __future__ import annotations

from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import fields as pydantic_fields

from mudline.language.keywords.values import Kind


def parts_of(annotation: Any) -> list[Any]:
    """A type taken apart: members of unions, items of lists, what is annotated."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return [*parts_of(get_args(annotation)[0]), *get_args(annotation)[1:]]
    if origin in (Union, UnionType, list):
        return [piece for member in get_args(annotation) for piece in parts_of(member)]
    return [] if annotation is NoneType else [annotation]


def metadata_of(info: pydantic_fields.FieldInfo) -> list[Any]:
    """What a field is annotated with, and its types taken apart."""
    return [*info.metadata, *parts_of(info.annotation)]


def kind_of(info: pydantic_fields.FieldInfo) -> Kind | None:
    """How the text of a field is read, None for a part."""
    return next((item for item in metadata_of(info) if isinstance(item, Kind)), None)


def choices_of(annotation: Any) -> tuple[str, ...]:
    """The words that a field may hold, () where it is no choice."""
    literal = (piece for piece in parts_of(annotation) if get_origin(piece) is Literal)
    return next((get_args(piece) for piece in literal), ())


def is_list(annotation: Any) -> bool:
    """Whether a field holds a list."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return is_list(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return any(is_list(member) for member in get_args(annotation))
    return origin is list
