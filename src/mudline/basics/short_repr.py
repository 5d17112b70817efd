"""Short representations: names, counts and shapes in place of data; errors that list the known names."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence, Sized
from dataclasses import fields, is_dataclass
from enum import Enum

from mudline.basics.limits import LISTED, SHOWN_LETTERS

LETTERS = 200
"""Characters of a representation."""
_SHORT_TUPLE = 4


class UnknownNameError(KeyError):
    """Unknown name; the message lists the known names."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""

    @classmethod
    def among(cls, kind: str, name: object, names: Collection[str], hint: str = "") -> UnknownNameError:
        """Return the error for a name that is not among `names`, those of the objects of a `kind` (`set`)."""
        if not names:
            return cls(f"no {kind} {name!r}: there are no {kind}s")
        verb = "is" if len(names) == 1 else "are"
        return cls(f"no {kind} {name!r}{hint}: there {verb} {listed(names)}")


def short_repr(thing: object) -> str:
    """Return class and fields of a dataclass or named tuple, arrays as shapes; for use as `__repr__`."""
    shown = [item.name for item in fields(thing) if item.repr] if is_dataclass(thing) else getattr(thing, "_fields", ())
    return with_fields(thing, ((name, getattr(thing, name)) for name in shown))


def with_fields(thing: object, values: Iterable[tuple[str, object]]) -> str:
    """Return the class of an object and given fields, arrays as shapes, in at most `LETTERS` characters."""
    text = ", ".join(f"{name}={brief(value)}" for name, value in values)
    return f"{type(thing).__name__}({cut(text, LETTERS - len(type(thing).__name__) - 2)})"


def outline(title: str, *parts: str) -> str:
    """Return `<title: part; part>` without empty parts, in at most `LETTERS` characters."""
    text = "; ".join(part for part in parts if part)
    return f"<{cut(f'{title}: {text}', LETTERS - 2)}>"


def brief(value: object) -> str:
    """Return a value in a few words: numbers and short texts in full, otherwise the kind and size."""
    shape = getattr(value, "shape", None)
    if isinstance(value, Enum):
        text = value.name
    elif value is None or isinstance(value, bool | int | float):
        text = repr(value)
    elif isinstance(value, str):
        text = repr(cut(value, SHOWN_LETTERS - 2))
    elif isinstance(shape, tuple):
        text = f"<{getattr(value, 'dtype', type(value).__name__)} {shape}>"
    elif type(value) is tuple and len(value) <= _SHORT_TUPLE:
        text = f"({', '.join(map(brief, value))}{',' if len(value) == 1 else ''})"
    elif isinstance(value, list) or (isinstance(value, Collection) and type(value).__module__ == "builtins"):
        text = counted(len(value), "item") if value else repr(value)
    else:
        size = f" of {len(value)}" if isinstance(value, Sized) and not isinstance(value, tuple) else ""
        text = f"<{type(value).__name__}{size}>"
    return text


def cut(text: str, most: int) -> str:
    """Return a text in at most `most` characters, with dots in place of the omitted end."""
    return text if len(text) <= most else f"{text[: most - 3]}..."


def printable(text: str, kept: str = "") -> str:
    """Return the text with a replacement mark for every character that does not print, except those that are kept."""
    return text if text.isprintable() else "".join(c if c.isprintable() or c in kept else "\ufffd" for c in text)


def counted(number: int, thing: str) -> str:
    """Return a number with its noun: `1 set`, `2 sets`."""
    return f"{number} {thing}{'' if number == 1 else 's'}"


def listed_numbers(numbers: Sequence[float]) -> str:
    """Return the first numbers, and the count of those left out."""
    more = f" and {len(numbers) - LISTED} more" if len(numbers) > LISTED else ""
    return ", ".join(map(repr, numbers[:LISTED])) + more


def listed(names: Collection[str]) -> str:
    """Return the first names in quotes, and the count of those left out."""
    first = [repr(cut(name, SHOWN_LETTERS)) for name, _ in zip(names, range(LISTED), strict=False)]
    rest = len(names) - len(first)
    return ", ".join([*first, f"and {rest} more"] if rest else first)
