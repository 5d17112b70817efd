"""Dataclasses whose methods are made when they are first called.

Python compiles up to six methods of each dataclass while its module is imported. That takes half a millisecond a class,
as long for all of them as to import numpy, and a command makes objects of some of the classes only.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass  # noqa: PLC0414 - to a reader of types it is that one
else:
    import dataclasses

    def dataclass(
        given: type | None = None, /, *, frozen: bool = False, eq: bool = True, **others: bool
    ) -> type | Callable[[type], type]:
        """What `dataclasses.dataclass` does with these arguments."""
        shown = others.pop("repr", True)

        def lean(cls: type) -> type:
            own = cls.__dict__
            hashed = own.get("__hash__") is not None
            wanted = {"__init__": True, "__repr__": shown, "__eq__": eq}
            later = [name for name, needed in wanted.items() if needed and name not in own]
            cls.__doc__ = cls.__doc__ or cls.__name__  # else the signature would be worked out
            made = dataclasses.dataclass(init=False, repr=False, eq=False, **others)(cls)
            if eq and not hashed:
                made.__hash__ = _later(made, "__hash__", frozen=True) if frozen else None
            for name in later:
                setattr(made, name, _later(made, name, frozen=frozen))
            if frozen:
                made.__setattr__ = made.__delattr__ = _refuse
                if others.get("slots"):
                    made.__getstate__, made.__setstate__ = _state, _restore
            return made

        return lean if given is None else lean(given)

    def _later(cls: type, name: str, *, frozen: bool) -> Callable[..., Any]:
        """A method that puts the one that the fields make in its place, and calls it."""

        def method(self: object, /, *given: object, **named: object) -> object:
            if name == "__init__":
                found = _init(cls, frozen=frozen)
            else:
                fields = [(field.name, field.type, field) for field in dataclasses.fields(cls)]
                described = {"__doc__": name}  # see above
                made = dataclasses.make_dataclass("_", fields, init=False, frozen=frozen, namespace=described)
                found = getattr(made, name)
            setattr(cls, name, found)
            return found(self, *given, **named)

        return method

    def _init(cls: type, *, frozen: bool) -> Callable[..., None]:
        """The `__init__` of the fields. What stands in its text are their names and nothing else that varies."""
        known: dict[str, Any] = {"_put": object.__setattr__, "_none": dataclasses.MISSING}
        taken: dict[bool, list[str]] = {False: [], True: []}
        body = [" pass"]
        for field in dataclasses.fields(cls):
            name, default, value = field.name, "", field.name
            if field.default_factory is not dataclasses.MISSING:
                known[f"_default_{name}"] = field.default_factory
                default, value = "=_none", f"_default_{name}()"
                value += f" if {name} is _none else {name}" if field.init else ""
            elif field.default is not dataclasses.MISSING:
                known[f"_default_{name}"] = field.default
                default, value = f"=_default_{name}", name if field.init else f"_default_{name}"
            if field.init:
                taken[field.kw_only].append(name + default)
            elif not default:
                continue
            body.append(f" _put(self, {name!r}, {value})" if frozen else f" self.{name} = {value}")
        if hasattr(cls, "__post_init__"):
            body.append(" self.__post_init__()")
        given = ", ".join(["self", *taken[False], *(["*", *taken[True]] if taken[True] else [])])
        exec(f"def __init__({given}):\n" + "\n".join(body), known)  # noqa: S102 - as dataclasses does
        return known["__init__"]

    def _refuse(self: object, name: str, *_: object) -> None:  # noqa: ARG001 - Python's signature
        raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")

    def _state(self: object) -> list[object]:
        return [getattr(self, field.name) for field in dataclasses.fields(self)]

    def _restore(self: object, state: list[object]) -> None:
        for field, value in zip(dataclasses.fields(self), state, strict=True):
            object.__setattr__(self, field.name, value)
