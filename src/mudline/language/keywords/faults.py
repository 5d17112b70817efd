"""Messages for values that pydantic refuses: the path of a value, and the value expected there."""

from __future__ import annotations

import sys
from typing import Any

from pydantic_core import ErrorDetails

from mudline.basics.limits import SHOWN_LETTERS
from mudline.language.keywords.values import Equation, Label

DocumentPath = tuple[str | int, ...]


def path_text(path: DocumentPath) -> str:
    """Return a path in its usual spelling: `sections[0].blocks[2].curves[0].points`."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".") or "the document"


def holds(value: object, part: str | int) -> bool:
    """Return True if a value of a document has a key or an index."""
    if isinstance(value, dict):
        return part in value
    return isinstance(value, list) and isinstance(part, int) and part < len(value)


def path_in(value: Any, steps: DocumentPath) -> DocumentPath:
    """Return the steps of a path that the document has: pydantic puts names of alternatives between them."""
    path: list[str | int] = []
    for step in steps:
        if holds(value, step):
            path.append(step)
            value = value[step]
    return tuple(path)


def shown(value: object) -> str:
    """Return a value of a document for a message, cut if it is long."""
    if isinstance(value, dict | list):
        return "an object" if isinstance(value, dict) else "a list"
    text = repr(value[:SHOWN_LETTERS] if isinstance(value, str) else value)
    return text if len(text) <= SHOWN_LETTERS else text[:SHOWN_LETTERS] + "..."


_WANTED = {
    "float_type": "a number",
    "finite_number": "a finite number",
    "int_type": "a whole number",
    "int_from_float": "a whole number",
    "string_type": "a text",
    "string_unicode": "a text without half of a surrogate pair",
    "list_type": "a list",
    "model_type": "an object",
    "model_attributes_type": "an object",
}
_FORMS = {Equation.form: "an equation =[...]", Label.form: "a {label}"}


def fault_in_words(faults: list[ErrorDetails], expected: str = "") -> str:
    """Return the faults of one value in a sentence: first the expected value, then other faults."""
    forms: list[str] = []
    sentences: list[str] = []
    for fault in faults:
        match fault["type"]:
            case "string_pattern_mismatch":
                forms.append(_FORMS.get(fault["ctx"]["pattern"], "a text without line ends"))
            case "literal_error":
                forms.append(fault["ctx"]["expected"])
            case "missing":
                sentences.append("is missing")
            case "extra_forbidden":
                sentences.append("unknown key")
            case kind if kind in _WANTED:
                forms.append(_WANTED[kind])
            case _:
                sentences.append(fault["msg"].removeprefix("Value error, "))
    if forms:
        value = faults[0]["input"]
        large = ", too large for double precision" if isinstance(value, int) and abs(value) > sys.float_info.max else ""
        sentences.insert(0, f"expected {expected or ' or '.join(dict.fromkeys(forms))}, found {shown(value)}{large}")
    return "; or ".join(dict.fromkeys(sentences))
