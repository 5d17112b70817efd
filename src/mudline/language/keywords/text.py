"""Values of fields by their kind; texts that are not values, what was probably meant, and remarks after the data."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise

from mudline.basics.short_repr import cut
from mudline.basics.spelling import Effort, nearest
from mudline.language.codes.fields import SYN002, SYN003, SYN015, SYN016
from mudline.language.codes.lines import SYN001, SYN004, SYN005
from mudline.language.diagnostics import Problem, Repair, Severity, Span
from mudline.language.keywords.model import FieldSpec, record_schema
from mudline.language.keywords.table import LARGEST_WHOLE, not_whole
from mudline.language.keywords.values import WHOLE_KINDS, Equation, Kind, Label
from mudline.language.syntax.fields import Field, is_one_field, trimmed
from mudline.language.syntax.rows import blank_separated, read_number, spells_number

Value = float | int | str | None
_REAL = (Kind.REAL, Kind.REAL_OR_NAME)
_MIXED_FIELDS = 4
"""Least number of fields in a row with decimal commas among other commas: shorter rows are ambiguous."""
_WHOLE = re.compile(r"[-+]?[0-9]+")
_DECIMAL = re.compile(r"[-+]?[0-9]+,[0-9]+(?:[eEdD][-+]?[0-9]+)?")
_FRACTION = re.compile(r"[0-9]+(?:[eEdD][-+]?[0-9]+)?")
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
_NAME, _TITLE, _OTHER, _IDENT = Kind.NAME, Kind.TITLE, Kind.OTHER, Kind.IDENT
_NUMBERS = (*_REAL, *WHOLE_KINDS)
_BEGINS = frozenset("+-.0123456789")


class UnreadableError(Exception):
    """Field without a value; the problem is the reason."""

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        super().__init__(problem.message)


def read_value(field: Field, slot: FieldSpec, problems: list[Problem]) -> Value:
    """Return the value of a field; raises UnreadableError. Doubts are added to `problems`."""
    kind = slot.kind
    if kind is _NAME or kind is _TITLE:
        return field.text
    if kind is _OTHER:
        return _open_choice(field, slot, problems)
    if slot.choices and (kind is None or not maybe_number(field.text)):
        return _choice(field, slot)
    equation = None if kind is _IDENT or field.text[:1] != "=" else Equation.match(field.text)
    return equation or _number(field, slot, problems)


def _number(field: Field, slot: FieldSpec, problems: list[Problem]) -> Value:
    number = read_number(field.text)
    if number is None:
        if slot.kind in (Kind.IDENT, Kind.WHOLE_OR_LABEL):
            return _label(field, slot, problems)
        if slot.kind is Kind.REAL_OR_NAME and not field.text.startswith("=[") and not looks_numeric(field.text):
            return field.text
        raise UnreadableError(not_a_number(field.text, field.span, slot.label))
    if slot.kind not in WHOLE_KINDS:
        return number
    if not number.is_integer() or abs(number) > LARGEST_WHOLE:
        raise UnreadableError(Problem(SYN002, not_whole(field.text, number, slot.label), field.span))
    return int(number)


def _label(field: Field, slot: FieldSpec, problems: list[Problem]) -> Label:
    if label := Label.match(field.text):
        return label
    braced = Label.match("{" + field.text + "}")
    if braced is None or not field.text[:1].isalpha() or not_finite(field.text):
        raise UnreadableError(not_a_number(field.text, field.span, slot.label, slot.kind))
    message = f"{shown(field.text)} is not a number: if it is a label, write {braced}"
    repair = Repair("unsafe", "put the label in braces", ((field.span, braced),))
    problems.append(Problem(SYN016, message, field.span, repair=repair))
    return braced


def reads_as_name(text: str) -> bool:
    """Return True if a field for a number or a name takes this text for a name."""
    return is_one_field(text) and not maybe_number(text)


def shown(text: str) -> str:
    """Return a text of the deck in quotes, cut if it is long."""
    return repr(text if len(text) <= 60 else text[:57] + "...")


def hint(near: str, word: str = "") -> str:
    """Return ` (did you mean X?)`, or "" if no word is near; explains the difference to a `word` that looks equal."""
    if near and not (word.isascii() and near.isascii()) and _as_seen(word) == _as_seen(near):
        here, there = (text.encode("ascii", "backslashreplace").decode() for text in (word, near))
        return f" (it looks like {near}, but is written with other characters: {here} here, {there} there)"
    return f" (did you mean {near}?)" if near else ""


def _as_seen(text: str) -> str:
    """Return a text with accents as parts of their letters, without invisible characters."""
    import unicodedata  # noqa: PLC0415 - few decks have such letters

    seen = (letter for letter in unicodedata.normalize("NFKC", text) if unicodedata.category(letter) != "Cf")
    return "".join(seen).casefold()


def suggestion(word: str, known: Iterable[str], effort: Effort | None = None) -> str:
    """Return ` (did you mean X?)` for the nearest known word within two edits (one for a short word), or ""."""
    return hint(nearest(word, known, effort))


def instead(near: str, span: Span) -> Repair | None:
    """Return the repair that replaces a word by the near one; None if no word is near."""
    return Repair("unsafe", f"write {near}", ((span, near),)) if near else None


def decimal_comma(values: list[Field], kinds: list[Kind | None], fewest: int) -> Problem | None:
    """Return the problem of a row of whole numbers whose count is right if each real number takes two fields."""
    for length in range(max(fewest, 1), len(kinds) + 1):
        widths = [2 if kind in _REAL else 1 for kind in kinds[:length]]
        numbers = [field for field in values if field.text.lstrip("+-").isdecimal()]
        names = sum(kind is Kind.NAME for kind in kinds[:length])
        first = widths.index(2) if 2 in widths else len(values)
        if (
            sum(widths) == len(values) > length
            and len(numbers) >= len(values) - names
            and _is_tight(*values[first : first + 2])
        ):
            return _two_fields(values[first], values[first + 1], Severity.ERROR)
    return None


def semicolons(text: str, fields: list[Field]) -> Problem | None:
    """Return the problem of numbers separated by semicolons, as spreadsheets with decimal commas write them."""
    if not fields or text.find(";", fields[0].start, fields[-1].span.end) < 0:
        return None
    span = Span(fields[0].span.start, fields[-1].span.end)
    numbers = [part.strip() for part in text[span.start : span.end].split(";")]
    numbers = [part.replace(",", ".") if _DECIMAL.fullmatch(part) else part for part in numbers]
    if not all(map(spells_number, numbers)):
        return None
    message = "the numbers are separated by semicolons: write commas between them"
    return Problem(SYN003, message, span, repair=instead(", ".join(numbers), span))


def missing_comma(fields: list[Field], kinds: list[Kind | None], fewest: int) -> Problem | None:
    """Return the problem of a field of several numbers if commas between them make the row's count right."""
    filled = fields
    while filled and not filled[-1].text:
        filled = filled[:-1]
    joined = [at for at, field in enumerate(filled) if field.text[:1] in _BEGINS and blank_separated(field.text)]
    words = [filled[at].text.split() for at in joined]
    count = len(filled) + sum(len(each) - 1 for each in words)
    if not joined or not fewest <= count <= len(kinds) or any(kinds[at] not in _NUMBERS for at in joined):
        return None
    if len(words[0]) == 2 and _GROUPED.fullmatch(filled[joined[0]].text) and len(filled) >= fewest:
        return None
    first, second = words[0][:2]
    span, repaired = filled[joined[0]].span, ", ".join(words[0])
    message = f"a comma is missing between {first} and {second}: write {repaired}"
    return Problem(SYN003, message, span, repair=instead(repaired, span))


def _is_tight(first: Field, second: Field) -> bool:
    """Return True if there is a comma and no blank between two fields."""
    return first.start + len(first.text) + 1 == second.start


def _two_fields(first: Field, second: Field, severity: Severity | None = None) -> Problem:
    message = f"decimal comma? {first.text},{second.text} is two fields here: write {first.text}.{second.text}"
    return Problem(SYN015, message, first.span._replace(end=second.span.end), severity)


def mixed_commas(values: list[Field], kinds: list[Kind | None], fewest: int) -> Problem | None:
    """Return the problem of a row in which some commas, between digits, have no space beside them, but others have.

    A single comma without space may be a slip. It is a decimal comma if the second part begins with a zero, or all
    other numbers have a point. Several such commas in place of real numbers are decimal commas.
    """
    tight = [len(values) >= _MIXED_FIELDS and _is_tight(*pair) for pair in pairwise(values)]
    if not any(tight) or all(tight):
        return None
    pairs = [at for at, joined in enumerate(tight) if joined]
    alone = all(later - at > 1 for at, later in pairwise(pairs))
    halves = all(_WHOLE.fullmatch(values[at].text) and _FRACTION.fullmatch(values[at + 1].text) for at in pairs)
    places = [at - before for before, at in enumerate(pairs)]
    certain = len(pairs) > 1 or _is_split(values, pairs[0])
    if not certain or not alone or not halves or len(values) - len(pairs) < fewest:
        return None
    if any(kinds[place] not in _REAL for place in places):
        return None
    return _two_fields(values[pairs[0]], values[pairs[0] + 1])


def _is_split(values: list[Field], at: int) -> bool:
    """Return True if two fields are the halves of one number: `0,05`, or `9,81` among numbers that have a point."""
    half = values[at + 1].text
    texts = [field.text for i, field in enumerate(values) if i not in (at, at + 1)]
    pointed = sum("." in text for text in texts)
    return half.strip("0") != "" and ((half[0] == "0" and len(half) > 1) or (pointed > 0 and pointed >= len(texts) - 1))


def _choice(field: Field, slot: FieldSpec) -> str:
    word = " ".join(field.text.upper().split())
    if word in slot.choices:
        return word
    known = list(slot.choices)
    known = [*(["a number"] if slot.kind else []), *known, *([record_schema(slot.row).layout] if slot.row else [])]
    listed = ", ".join(known[:-1]) + f" or {known[-1]}" if len(known) > 1 else known[0]
    near = nearest(word, slot.choices)
    message = f"{shown(field.text)} is not allowed for {slot.label}: expected {listed}{hint(near)}"
    raise UnreadableError(Problem(SYN005, message, field.span, repair=instead(near, field.span)))


def _open_choice(field: Field, slot: FieldSpec, problems: list[Problem]) -> str:
    """Return a known value, or an unknown one unchanged, with a warning if it is spelt almost like a known one.

    Otherwise the unknown value is an info if the lines behind some known value would have been read.
    """
    word = " ".join(field.text.upper().split())
    if word in slot.choices:
        return word
    near, opaque = nearest(word, slot.choices), slot.about.opaque
    if near or not set(slot.choices).issubset(slot.choices if opaque is None else opaque):
        kept = ", and what it stands for is passed through unchanged" if opaque is not None else ""
        message = f"{shown(field.text)} is not known for {slot.label}{hint(near)}{kept}"
        severity = Severity.WARNING if near else Severity.INFO
        problems.append(Problem(SYN005, message, field.span, severity, repair=instead(near, field.span)))
    return field.text


def maybe_number(text: str) -> bool:
    """Return True if a text is a number or an equation, or was probably meant as one."""
    return text.startswith("=") or read_number(text) is not None or looks_numeric(text)


def looks_numeric(text: str) -> bool:
    """Return True if a text that is not a finite number was probably meant as a number."""
    return not_finite(text) or spells_number(text) or bool(_GROUPED.fullmatch(text) or _plain(text))


def not_finite(text: str) -> bool:
    """Return True if a text is a NaN or an infinity."""
    return text.lower().lstrip("+-") in ("nan", "inf", "infinity")


def cut_number(text: str) -> bool:
    """Return True if a text is the beginning of a number: a sign, or a number whose exponent has no digits."""
    return text in ("+", "-") or (text.rstrip("+-")[-1:] in ("e", "E", "d", "D") and spells_number(f"{text}0"))


def not_a_number(text: str, span: Span, label: str, kind: Kind | None = None) -> Problem:
    """Return the problem of a field that is not a number; characters of a word processor in a number are repaired."""
    if bare := _BARE_EXPONENT.fullmatch(text):
        repaired = f"{bare[1]}E{bare[2]}"
        message = f"{text!r} is not a number: if {bare[2]} is its exponent, write {repaired} for {label}"
        return Problem(SYN002, message, span, repair=instead(repaired, span))
    plain = _plain(text)
    if not plain:
        return Problem(SYN002, _fault(text, label, kind), span)
    odd = next(char for char in text if not char.isascii())
    message = f"{cut(text, 60)!r} is not a number, as it has the character U+{ord(odd):04X}: write {plain} for {label}"
    return Problem(SYN002, message, span, repair=instead(plain, span))


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
    if lower[:1].isdigit() and any(mark in lower for mark in "ed") and spells_number(lower):
        return f"{text} is too large for a double-precision number: {label} must be below 1.8E308"
    if _GROUPED.fullmatch(text):
        whole = "".join(char for char in text if char in "+-.0123456789")
        return f"{text!r} is not a number because its digits are grouped: write {whole} for {label}"
    return f"{cut(text, 60)!r} is not a number: expected a number or an equation =[...] for {label}"


_MARK = re.compile(r"(?<=[ \t])(?:!|(?:[#;]|//|--)[ \t])")
_LETTER = re.compile(r"[^\W\d_]")
_COMMENT = re.compile(r"[ \t]*(?:[#!;]|//|--(?![0-9.]))")
"""Beginning of a line that is a comment in other programs."""
_OF_FIELDS = frozenset({SYN002, SYN003, SYN005, SYN015, SYN016})
_OF_LINES = _OF_FIELDS | {SYN001, SYN004}
_NO_LINE = Span(0, 0)
_ADVICE = "a line cannot end with a comment; put it on a line of its own, after C and a space"


def remark_of(line: str) -> str:
    """Return the remark after the data of a line or a field, or ""."""
    mark = _MARK.search(line)
    if mark is None or not line[: mark.start()].strip(" \t") or not _LETTER.search(line, mark.end()):
        return ""
    before = line[: mark.start()]
    inside = before.count('"') % 2 or before.count("[") != before.count("]") or before.count("{") != before.count("}")
    return "" if inside else line[mark.start() :].rstrip(" \t\r\n")


def advice_on(name: str) -> str:
    """Return advice on a name that contains a remark, or ""."""
    return _ADVICE if remark_of(name) else ""


def merge_per_line(text: str, problems: list[Problem]) -> list[Problem]:
    """Return the problems of a text; those that a remark causes on one line are merged into one."""
    problems = _comments_named(text, problems)
    if not any(problem.code in _OF_FIELDS for problem in problems):
        return problems
    remarks = _remarks(text, problems)
    blamed: dict[Span, Problem] = {}
    ranks: dict[Span, tuple[bool, bool]] = {}
    for problem, remark in zip(problems, remarks, strict=True):
        if remark is None or problem.span is None or problem.span.end <= remark.start:
            continue
        rank = problem.weight is Severity.ERROR, problem.span.start <= remark.start
        if rank >= ranks.get(remark, rank):
            blamed[remark], ranks[remark] = problem, rank
    kept: list[Problem] = []
    reported: set[Span] = set()
    for problem, remark in zip(problems, remarks, strict=True):
        if remark is None or remark not in blamed:
            kept.append(problem)
        elif remark not in reported:
            reported.add(remark)
            message = f"{shown(text[slice(*remark)])} is read as data: {_ADVICE}"
            kept.append(replace(blamed[remark], message=message, span=remark, repair=None))
    return kept


def _comments_named(text: str, problems: list[Problem]) -> list[Problem]:
    """Return the problems of a text; those of a line that is a comment in other programs are merged into one."""
    if not problems:
        return problems
    kept: list[Problem] = []
    last = _NO_LINE
    for problem in problems:
        span = problem.span
        if span is None or problem.code not in _OF_LINES:
            kept.append(problem)
            continue
        if span.start < last.end and span.start >= last.start:
            continue
        start, end = text.rfind("\n", 0, span.start) + 1, text.find("\n", span.start)
        line = trimmed(text, start, len(text) if end < 0 else end)
        if _COMMENT.match(text, start, line.end):
            last = line
            message = f"{shown(text[slice(*line)])} is read as data: begin a comment with C and a space"
            kept.append(replace(problem, message=message, span=line, repair=None))
        else:
            kept.append(problem)
    return kept


def _remarks(text: str, problems: list[Problem]) -> list[Span | None]:
    """Return the span of the remark on the line of each problem, None for problems without remark or field."""
    remarks: list[Span | None] = []
    line, remark = _NO_LINE, None
    for problem in problems:
        if problem.span is None or problem.code not in _OF_FIELDS:
            remarks.append(None)
            continue
        if not line.start <= problem.span.start < line.end:
            end = text.find("\n", problem.span.start)
            line = Span(text.rfind("\n", 0, problem.span.start) + 1, (len(text) if end < 0 else end) + 1)
            words = remark_of(text[slice(*line)])
            start = text.find(words, line.start)
            remark = Span(start, start + len(words)) if words else None
        remarks.append(remark)
    return remarks
