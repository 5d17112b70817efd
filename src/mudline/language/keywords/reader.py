"""Reading of a block: contents, grammar, values, comments, and the model of its keyword; every fault is one problem."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from functools import cache
from typing import Protocol, cast

from pydantic import ValidationError

from mudline.basics.short_repr import short_repr
from mudline.basics.spelling import nearest
from mudline.language.codes.lines import SYN001, SYN004, SYN013, SYN014
from mudline.language.diagnostics import Problem, Severity, Span
from mudline.language.keywords.builder import Builder
from mudline.language.keywords.contents import is_choice, opened, range_faults
from mudline.language.keywords.fields import AS_TEXT
from mudline.language.keywords.model import Block, Part, RecordSchema, record_schema
from mudline.language.keywords.parsed import (
    Between,
    ParsedRecord,
    Places,
    attach,
    construct,
    doubtful,
    lose,
    of_other_form,
)
from mudline.language.keywords.text import hint, instead, merge_per_line, shown, suggestion
from mudline.language.syntax.fields import first_key, trimmed
from mudline.language.syntax.grammars import END, ROW, Content, Mismatch, by_lines, terminal_of, tree_of
from mudline.language.syntax.rows import line_spans
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock


@dataclass(slots=True)
class ReadBlock:
    """Result of reading a block: model, places of its values, problems, and `trailing` comments behind its last line.

    Attributes:
        own: places in the text that was read.
        lost: number of lines that could not be used at all; their definitions are unknown. Rows below each other that
            are passed through count as one.
        whole: text that contains the piece that was read, and the offset of the piece in it.
        opaque: True if mandatory lines may be among lines of unknown form: the block is then passed through unchanged.
        kept: number of lost lines that are passed through on purpose; 0 in a block with an error, where others may look
            like them.
    """

    model: Block
    own: Places
    problems: list[Problem]
    trailing: list[str] = field(default_factory=list)
    lost: int = 0
    whole: tuple[str, int] | None = None
    opaque: bool = False
    kept: int = 0

    __repr__ = short_repr

    @property
    def places(self) -> Places:
        """Places in the whole text, moved there on demand."""
        if self.whole:
            self.own, self.whole = self.own.moved(*self.whole), None
        return self.own

    def at(self, text: str, start: int, problems: list[Problem]) -> ReadBlock:
        """Return the block as part of a text in which its piece begins at `start`, with its problems there."""
        return ReadBlock(
            self.model, self.own, problems, self.trailing, self.lost, (text, start), self.opaque, self.kept
        )


class BlockReader(Protocol):
    """Reader of a block, with the signature of `read_block`."""

    def __call__(self, text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
        """Return the block read from the unified text of a source; `last`: nothing follows the block."""


def read_block(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Return the block read from the unified text of a source; `last` is True if nothing follows the block in it."""
    return _BlockParser(text, raw, declared, last=last).read()


def reads(text: str, raw: RawBlock, declared: type[Block]) -> bool:
    """Return True if a block reads without an error, and keeps no lines but those that its declaration leaves unread.

    This is faster than finding the errors.
    """
    ends: frozenset[str] = frozenset()
    keys = all_keys(declared)
    for leaf in raw.leaves:
        key = first_key(text, leaf.span) if leaf.kind is LeafKind.SETTING else ""
        if key and (not ends or key in ends):
            value = text[slice(*leaf.span)].partition("=")[2]
            ends = opened(declared, key, value)
            if key not in keys or (ends and not is_choice(declared, key, value)):
                return False
    reader = _BlockParser(text, raw, declared, last=False)
    if tree_of(declared.rule, reader.contents()) is None or reader.lost:
        return False
    kept = len(reader.kept)
    block = read_block(text, raw, declared, last=False)
    if block.lost != kept or any(problem.weight is Severity.ERROR for problem in block.problems):
        return False
    return not any(True for _ in range_faults(block.model))


def read_piece(piece: str, start: int, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Return a block read as if its lines were the whole text; `raw` is the block at offset `start` of the text."""
    head, *leaves = (Leaf(leaf.kind, leaf.span.moved(-start)) for leaf in (raw.head, *raw.leaves))
    return read_block(piece, RawBlock(head, raw.name, leaves, raw.older), declared, last=last)


class _BlockParser:
    def __init__(self, text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> None:
        self.text = text
        self.raw = raw
        self.declared = declared
        self.last = last
        self.keys = all_keys(declared) if raw.older else all_keys(declared) - older_keys(declared)
        self.problems: list[Problem] = []
        self.comments: list[Between] = []
        self.kept: list[Between] = []
        self.lost = 0

    def read(self) -> ReadBlock:
        """Return the block read from its lines, without lines of unknown form if it is open."""
        contents = self.contents()
        noticed, lost = self.problems, self.lost
        while True:
            self.problems, self.lost = [*noticed], lost
            block = self._attempt(contents)
            if not self.declared.open_lines or self.declared.known_forms:
                return block
            odd = of_other_form(self.text, self.problems, contents, tabular=self.declared.tabular)
            if not odd:
                return block
            noticed += doubtful(self.problems)
            self._keep_all(odd, contents)

    def _attempt(self, contents: list[Content]) -> ReadBlock:
        mismatches: list[Mismatch] = []
        node = tree_of(self.declared.rule, contents)
        if node is None:
            node, mismatches = by_lines(self.declared.rule, contents, insert=not self.declared.open_lines)
            if self.declared.open_lines:
                self._keep_all({mismatch.found for mismatch in mismatches if mismatch.found}, contents)
                mismatches = [mismatch for mismatch in mismatches if not mismatch.found]
        end = len(self.text.rstrip(" \t")) if self.last and not self.text.endswith("\n") else -1
        self.places = Places(self.text, trimmed(self.text, *self.raw.head.span))
        slashes = self.declared.slashes
        builder = Builder(self.places, self.problems, slashes=slashes, end=end, older=self.raw.older)
        for mismatch in mismatches:
            self._report(mismatch)
        built = builder.build(self.declared, node)
        trailing = attach(self.comments, self.kept, built, self.places) if self.comments or self.kept else []
        self.lost += builder.lost + len(self.kept)
        model = self._model(built)
        problems = merge_per_line(self.text, self.problems)
        may_keep = "unread" in self.declared.model_fields
        if self.kept and may_keep and any(problem.code in (SYN001, SYN014) for problem in problems):
            first = min(kept.span.start for kept in self.kept)  # lines before it are of known form
            lines = [item.found.span for item in mismatches if item.found and item.found.span.start < first]
            certain = [item for item in problems if item.span and any(a <= item.span.start < b for a, b in lines)]
            rest = [problem for problem in problems if problem not in certain]
            return ReadBlock(model, self.places, [*certain, *doubtful(rest)], lost=self.lost, opaque=True)
        faulty = any(problem.weight is Severity.ERROR for problem in problems)
        return ReadBlock(model, self.places, problems, trailing, self.lost, kept=0 if faulty else len(self.kept))

    def _model(self, built: ParsedRecord) -> Block:
        """Return the validated model; for a block with faults an unvalidated model of its readable values."""
        built.values["keyword"] = self.raw.name
        if not any(problem.weight is Severity.ERROR for problem in self.problems):
            try:
                return self.declared.model_validate(built.values, context=AS_TEXT)
            except ValidationError as error:
                for fault in error.errors():
                    place = tuple(fault["loc"])
                    message = fault["msg"].removeprefix("Value error, ")
                    if fault["type"] == "missing":
                        message = f"{_label(self.declared, place)} is missing here"
                    self.problems.append(Problem(SYN001, message, self.places.find(place)))
        lost = [problem.span.start for problem in self.problems if problem.code in (SYN001, SYN004) and problem.span]
        if lost:
            lose(built, lost)
        return cast("Block", construct(built))

    def contents(self) -> list[Content]:
        """Return the lines as terminals of the grammar; report unknown ones."""
        contents: list[Content] = []
        ends: frozenset[str] = frozenset()
        for leaf in self.raw.leaves:
            kind, span = leaf
            if ends and kind not in (LeafKind.COMMENT, LeafKind.BLANK):
                if first_key(self.text, span) not in ends:
                    self._keep(span)
                    continue
                ends = frozenset()
            match kind:
                case LeafKind.COMMENT:
                    self._comment(leaf)
                case LeafKind.UNDECIDED:
                    ends = self._undecided(leaf, contents)
                case LeafKind.SETTING:
                    ends = self._setting(span, contents)
                case LeafKind.RUN if not self.declared.tabular:
                    contents += [Content(ROW, line) for line in line_spans(self.text, span)]
                case LeafKind.RUN | LeafKind.TEXT:
                    contents.append(Content(ROW, span))
        return contents

    def _keep_all(self, odd: Collection[Content], contents: list[Content]) -> None:
        """Keep lines that were to be read."""
        for content in odd:
            self._keep(content.span)
        contents[:] = [content for content in contents if content not in odd]

    def _keep(self, span: Span) -> None:
        self.kept.append(Between(span.start, self.text[slice(*span)], span, kept=True))

    def _comment(self, leaf: Leaf) -> None:
        line = self.text[slice(*leaf.span)].rstrip("\r\n")
        self.comments.append(Between(leaf.span.start, line[1:], leaf.span))

    def _undecided(self, leaf: Leaf, contents: list[Content]) -> frozenset[str]:
        """Read a line with C and a letter in column 1: data if its key is known, else a comment, with a warning."""
        key = first_key(self.text, leaf.span)
        if key in self.keys:
            return self._setting(leaf.span, contents)
        line = self.text[slice(*leaf.span)].rstrip("\r\n")
        near = suggestion(key, sorted(self.keys)) if key else ""
        message = (
            f"{shown(line)} begins with C in column 1 and is read as a comment (inferred){near}: "
            "put a space after the C, or indent the line if it is data"
        )
        self.problems.append(Problem(SYN013, message, trimmed(self.text, *leaf.span)))
        self._comment(leaf)
        return frozenset()

    def _setting(self, span: Span, contents: list[Content]) -> frozenset[str]:
        """Read a line that begins with a setting; return the keys that end the kept lines after it, if any."""
        key = first_key(self.text, span)
        if key in self.keys:
            contents.append(Content(terminal_of(key), span))
            return opened(self.declared, key, self.text[slice(*span)].partition("=")[2])
        known = sorted(self.keys)
        allowed = ", ".join(f"{name}=" for name in known) or "no KEY= at all"
        body = trimmed(self.text, *span)
        end = self.text.find("=", body.start, body.end)
        near = nearest(key, known)
        advice = self.declared.facts.instead_of.get(key, "")
        message = f"*{self.raw.name} has no setting {key}={hint(near)}: {advice or f'it takes {allowed}'}"
        repair = instead(near, trimmed(self.text, body.start, end))
        problem = Problem(SYN004, message, Span(body.start, end + 1), repair=repair)
        if self.declared.open_lines:
            self.problems += doubtful([problem])
            self._keep(span)
        else:
            self.problems.append(problem)
            self.lost += 1
        return frozenset()

    def _report(self, mismatch: Mismatch) -> None:
        hidden = set() if self.raw.older else {terminal_of(key) for key in older_keys(self.declared)}
        shown_ = (terminal for terminal in mismatch.expected if terminal != END and terminal not in hidden)
        expected = " or ".join(map(self._describe, shown_))
        expected = expected or "nothing more in this block"
        self.lost += 1
        if mismatch.found is None:
            code = SYN014 if self.last else SYN001
            where = "the file" if self.last else f"*{self.raw.name}"
            message = f"{where} is incomplete: missing {expected}"
            no_data = LeafKind.BLANK, LeafKind.COMMENT
            lines = [leaf for leaf in (self.raw.head, *self.raw.leaves) if leaf.kind not in no_data]
            span = trimmed(self.text, *lines[-1].span)
            cut_off = self.last and not self.text.endswith("\n")
            reported = any(problem.span and problem.span.end == span.end for problem in self.problems)
            if cut_off or not reported:  # a line in place of the missing one has its finding
                self.problems.append(Problem(code, message, span))
            return
        span = trimmed(self.text, *mismatch.found.span)
        if mismatch.missing:
            expected = self._describe(mismatch.missing)
            advice = "" if mismatch.missing == ROW else f": write {expected} and its value above it"
            self.problems.append(Problem(SYN001, f"expected {expected} before this line{advice}", span))
            return
        line = "a row" if mismatch.found.type == ROW else f"{first_key(self.text, mismatch.found.span)}="
        message = f"*{self.raw.name} has no place for {line} here: expected {expected}"
        self.problems.append(Problem(SYN001, message, span))

    def _describe(self, terminal: str) -> str:
        if terminal == ROW:
            from mudline.language.keywords.format import row_formats  # noqa: PLC0415 - only for a line that does not fit

            formats = dict.fromkeys(row_formats(schemas_of(self.declared)))
            return "a row " + " or ".join(f"`{shape}`" for shape in formats)
        return next(f"{key}=" for key in all_keys(self.declared) if terminal_of(key) == terminal)


def _label(part: type[Part], place: tuple[str | int, ...]) -> str:
    """Return the label, for a reader, of the field at a place of a block."""
    label = ""
    for step in place:
        slot = next((slot for slot in record_schema(part).slots if slot.json == step), None)
        if slot is not None:
            label = slot.label
            part = slot.row or next(iter(slot.record.values()), part)
    return label


@cache
def all_keys(part: type[Part]) -> frozenset[str]:
    """Return every KEY on the lines of a keyword, at the beginning or within."""
    return frozenset(key for schema in schemas_of(part) for key in schema.keys)


@cache
def older_keys(part: type[Part]) -> frozenset[str]:
    """Return the KEYs that only decks of the older program have."""
    fields = (field for schema in schemas_of(part) for field in schema.keys.items())
    return frozenset(key for key, slot in fields if slot.about.older is True)


def schemas_of(part: type[Part]) -> list[RecordSchema]:
    """Return the schemas of a part and of its inner records."""
    own = record_schema(part)
    below = [inner for slot in own.children.values() for record in slot.record.values() for inner in schemas_of(record)]
    return [own, *below]
