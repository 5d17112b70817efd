"""Texts that are not numbers: the number that was probably meant, and messages."""

from __future__ import annotations

import re

from mudline.basics.short_repr import cut
from mudline.language.codes.fields import SYN002
from mudline.language.diagnostics import Problem, Repair, Span
from mudline.language.keywords.values import Equation, Kind
from mudline.language.syntax.rows import read_number, spells_number

_GROUPED = re.compile(r"[-+]?[0-9]{1,3}(?:[ '_\xa0\u202f][0-9]{3})+(?:\.[0-9]*)?")
"""Number with its digits in groups of three."""
TOO_WIDE = "asterisks stand for a number too wide for its column"
_MINUS = "\u2010\u2011\u2012\u2013\u2014\u2212\ufe63\uff0d"
"""Hyphens, dashes and minus signs of word processors."""
_QUOTES = "\u2018\u2019\u201a\u201c\u201d\u201e\xab\xbb"
"""Quotes of word processors."""
_BARE_EXPONENT = re.compile(r"([-+]?(?:[0-9]+\.[0-9]*|\.[0-9]+))([-+][0-9]{1,3})")
"""Number whose exponent has no letter, as Fortran writes exponents of three digits."""
_BLANKS = "\xa0\u2007\u2009\u200b\u202f\ufeff"
"""Blanks that word processors put around a number, and invisible marks."""


def maybe_number(text: str) -> bool:
    """Return True if a text is a number or an equation, or was probably meant as one."""
    return text.startswith("=") or read_number(text) is not None or looks_numeric(text)


def looks_numeric(text: str) -> bool:
    """Return True if a text that is not a finite number was probably meant as a number."""
    return not_finite(text) or spells_number(text) or bool(_GROUPED.fullmatch(text) or _plain(text))


def not_finite(text: str) -> bool:
    """Return True if a text is a NaN or an infinity."""
    return text.lower().lstrip("+-") in ("nan", "inf", "infinity")


def is_grouped(text: str) -> bool:
    """Return True if a text may be one number with its digits in groups of three."""
    return _GROUPED.fullmatch(text) is not None


def cut_number(text: str) -> bool:
    """Return True if a text is the beginning of a number: a sign, or a number whose exponent has no digits."""
    return text in ("+", "-") or (text.rstrip("+-")[-1:] in ("e", "E", "d", "D") and spells_number(f"{text}0"))


def not_a_number(text: str, span: Span, label: str, kind: Kind | None = None) -> Problem:
    """Return the problem of a field that is not a number; characters of a word processor in a number are repaired."""
    if bare := _BARE_EXPONENT.fullmatch(text):
        repaired = f"{bare[1]}E{bare[2]}"
        message = f"{text!r} is not a number: if {bare[2]} is its exponent, write {repaired} for {label}"
        return Problem(SYN002, message, span, repair=Repair("unsafe", f"write {repaired}", ((span, repaired),)))
    plain = _plain(text)
    if not plain:
        return Problem(SYN002, _fault(text, label, kind), span)
    odd = next(char for char in text if not char.isascii())
    message = f"{cut(text, 60)!r} is not a number, as it has the character U+{ord(odd):04X}: write {plain} for {label}"
    return Problem(SYN002, message, span, repair=Repair("unsafe", f"write {plain}", ((span, plain),)))


def _plain(text: str) -> str:
    """Return the number in a text, in plain characters; "" if there is none, or it is plain already."""
    if text.isascii():
        return ""
    bare = text.strip(_BLANKS + _QUOTES)
    plain = "".join("-" if char in _MINUS else str(int(char)) if char.isdecimal() else char for char in bare)
    return plain if spells_number(plain) else ""


def _fault(text: str, label: str, kind: Kind | None) -> str:
    """Return the fault of a text that is not a number, in words that tell what to do."""
    lower = text.lower().lstrip("+-")
    if not_finite(text):
        return f"{text!r} is not a finite number: {label} needs a number"
    if kind is Kind.IDENT and Equation.match(text):
        return f"{cut(text, 60)!r} is an equation: expected {kind.value} for {label}"
    if text and not text.strip("*"):
        return f"{text!r} is not a number: {TOO_WIDE}, write {label} itself"
    if text.startswith(("[", "=")):
        return f"{text!r} is not an equation: write =[...] for {label}"
    if lower[:1].isdigit() and any(mark in lower for mark in "ed"):
        try:
            float(lower.replace("d", "e"))
        except ValueError:
            pass
        else:
            return f"{text} is too large for a double-precision number: {label} must be below 1.8E308"
    if _GROUPED.fullmatch(text):
        whole = "".join(char for char in text if char in "+-.0123456789")
        return f"{text!r} is not a number because its digits are grouped: write {whole} for {label}"
    return f"{cut(text, 60)!r} is not a number: expected a number or an equation =[...] for {label}"
