"""A raw block to the model of its keyword: contents, grammar, values, comments; every fault is one problem."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache, partial
from operator import attrgetter, itemgetter
from typing import NamedTuple, Protocol, cast

from pydantic import ValidationError

from mudline.codes.lines import SYN001, SYN004, SYN005, SYN013, SYN014
from mudline.diagnostics import Problem, Severity, Span
from mudline.keywords import grammar
from mudline.keywords.builder import Builder, ParsedRecord, construct
from mudline.keywords.grammar import END, ROW, Content, Mismatch
from mudline.keywords.model import AS_TEXT, Block, Part, RecordSchema, record_schema
from mudline.keywords.places import Path, Places
from mudline.keywords.plain import read_plain
from mudline.keywords.text import hint, instead, merge_per_line, shown, suggestion
from mudline.short_repr import short_repr
from mudline.spelling import nearest
from mudline.syntax.fields import first_key, trimmed
from mudline.syntax.rows import line_spans
from mudline.syntax.tree import Kind, Leaf, RawBlock


@dataclass(slots=True)
class ReadBlock:
    """A block that was read: its model, where its values stand, what was wrong, and the comments behind its last line.

    `lost` counts lines that could not be used at all: what they would have defined is unknown. `found` are the places
    in the text that was read, or what finds them when somebody asks; a block of the second kind has no damaged value.
    Where a piece was read, `whole` is the text that it belongs to and where it begins there.
    """

    model: Block
    found: Places | Callable[[], Places]
    problems: list[Problem]
    trailing: list[str] = field(default_factory=list)
    lost: int = 0
    whole: tuple[str, int] | None = None

    __repr__ = short_repr

    @property
    def own(self) -> Places:
        """The places in the text that was read."""
        found = self.found  # read once: decks that share a block may be read in two threads
        if not isinstance(found, Places):
            found = self.found = found()
        return found

    @property
    def places(self) -> Places:
        """The places in the whole text; worked out when somebody asks."""
        if self.whole:
            self.found = self.own.moved(*self.whole)
            self.whole = None
        return self.own

    def at(self, text: str, start: int, problems: list[Problem]) -> ReadBlock:
        """The block, with its problems there, in a text in which the piece that was read begins at `start`."""
        found = self.found if isinstance(self.found, Places) else lambda: self.own
        return ReadBlock(self.model, found, problems, self.trailing, self.lost, (text, start))

    def damaged(self, path: Path) -> bool:
        """Whether something at this place could not be read."""
        return isinstance(self.found, Places) and path in self.found.damaged

    @property
    def unpublished(self) -> bool:
        """Whether the lines may have a form that is not public, so that they are passed through unchanged."""
        return bool(self.problems) and self.model.other_form([problem.code for problem in self.problems])

    @property
    def misspelt(self) -> list[Problem]:
        """The words that may be misspelt in lines which are passed through unchanged, as warnings."""
        end = "; the block is passed through unchanged"
        near = [problem for problem in self.problems if problem.code in (SYN004, SYN005) and problem.repair]
        return [replace(problem, message=problem.message + end, severity=Severity.WARNING) for problem in near]


class BlockReader(Protocol):
    """Reads a block as `read_block` does."""

    def __call__(self, text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
        """`text` is the unified text of the source; `last` says that nothing follows the block in it."""


def read_block(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Read a block. `text` is the unified text of the source; `last` says that nothing follows the block in it."""
    found = partial(_places, text, raw, declared, last=last)
    return _plain(text, raw, declared, found) or _Reader(text, raw, declared, last=last).read()


def read_piece(piece: str, start: int, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Read a block as if its own lines were the whole text; `raw` is the block in the text, where it is at `start`."""
    return read_block(piece, _moved(raw, -start), declared, last=last)


def _plain(text: str, raw: RawBlock, declared: type[Block], found: Callable[[], Places]) -> ReadBlock | None:
    """A plain block, and the comments behind it; its places are found by reading it again, line by line."""
    leaves = raw.leaves
    end = len(leaves)
    while end and leaves[end - 1].kind in (Kind.COMMENT, Kind.BLANK):
        end -= 1
    model = read_plain(text, leaves[:end], raw.name, declared, all_keys(declared))
    if model is None:
        return None
    trailing = [text[slice(*leaf.span)].rstrip("\r\n")[1:] for leaf in leaves[end:] if leaf.kind is Kind.COMMENT]
    return ReadBlock(model, found, [], trailing)


def _places(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> Places:
    return _Reader(text, raw, declared, last=last).read().own


def _moved(raw: RawBlock, by: int) -> RawBlock:
    leaves = [Leaf(leaf.kind, leaf.span.moved(by)) for leaf in raw.leaves]
    return RawBlock(Leaf(raw.head.kind, raw.head.span.moved(by)), raw.name, leaves)


class _Reader:
    def __init__(self, text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> None:
        self.text = text
        self.raw = raw
        self.declared = declared
        self.last = last
        self.keys = all_keys(declared)
        self.problems: list[Problem] = []
        self.comments: list[_CommentLine] = []
        self.lost = 0

    def read(self) -> ReadBlock:
        contents = self._contents()
        mismatches: list[Mismatch] = []
        node = grammar.tree_of(self.declared.rule, contents)
        if node is None:
            from mudline.keywords.recovery import by_lines  # noqa: PLC0415 - lark, which most decks do without

            node, mismatches = by_lines(self.declared.rule, contents)
        places = Places(self.text, trimmed(self.text, *self.raw.head.span))
        end = len(self.text.rstrip(" \t")) if self.last and not self.text.endswith("\n") else -1
        builder = Builder(self.text, places, self.problems, slashes=self.declared.slashes, end=end)
        builder.damaged = any(mismatch.missing for mismatch in mismatches)
        for mismatch in mismatches:
            self._report(mismatch)
        built = builder.build(self.declared, node)
        trailing = _attach(self.comments, built) if self.comments else []
        self.lost += builder.lost
        model = self._model(built, builder)
        return ReadBlock(model, places, merge_per_line(self.text, self.problems), trailing, self.lost)

    def _model(self, built: ParsedRecord, builder: Builder) -> Block:
        """The validated model; of a block with faults, what could be read of it."""
        built.values["keyword"] = self.raw.name
        if not builder.damaged:
            try:
                return self.declared.model_validate(built.values, context=AS_TEXT)
            except ValidationError as error:
                for fault in error.errors():
                    place = tuple(fault["loc"])
                    message = fault["msg"].removeprefix("Value error, ")
                    if fault["type"] == "missing":
                        message = f"{_label(self.declared, place)} is missing here"
                    span = builder.places.find(place)
                    self.problems.append(Problem(SYN001, message, span))
        return cast("Block", construct(built))

    def _contents(self) -> list[Content]:
        contents: list[Content] = []
        for position, leaf in enumerate(self.raw.leaves):
            match leaf.kind:
                case Kind.COMMENT:
                    self._comment(position, leaf)
                case Kind.UNDECIDED:
                    self._undecided(position, leaf, contents)
                case Kind.SETTING:
                    self._setting(position, leaf.span, contents)
                case Kind.RUN if not self.declared.tabular:
                    contents += [Content(ROW, line, position) for line in line_spans(self.text, leaf.span)]
                case Kind.RUN | Kind.TEXT:
                    contents.append(Content(ROW, leaf.span, position))
                case _:
                    pass
        return contents

    def _comment(self, position: int, leaf: Leaf) -> None:
        line = self.text[slice(*leaf.span)].rstrip("\r\n")
        self.comments.append(_CommentLine(position, line[1:], leaf.span))

    def _undecided(self, position: int, leaf: Leaf, contents: list[Content]) -> None:
        """A line with C and a letter in column 1: a known key makes it data, else it is a comment, with a warning."""
        key = first_key(self.text, leaf.span)
        if key in self.keys:
            self._setting(position, leaf.span, contents)
            return
        line = self.text[slice(*leaf.span)].rstrip("\r\n")
        meant = suggestion(key, sorted(self.keys)) if key else ""
        message = (
            f"{shown(line)} begins with C in column 1 and is read as a comment (inferred){meant}: "
            "put a space after the C, or indent the line if it is data"
        )
        self.problems.append(Problem(SYN013, message, trimmed(self.text, *leaf.span)))
        self._comment(position, leaf)

    def _setting(self, position: int, span: Span, contents: list[Content]) -> None:
        key = first_key(self.text, span)
        if key in self.keys:
            contents.append(Content(grammar.terminal_of(key), span, position))
            return
        known = sorted(self.keys)
        allowed = ", ".join(f"{name}=" for name in known) or "no KEY= at all"
        body = trimmed(self.text, *span)
        end = self.text.find("=", body.start, body.end)
        near = nearest(key, known)
        advice = self.declared.facts.instead_of.get(key, "")
        message = f"*{self.raw.name} has no setting {key}={hint(near)}: {advice or f'it takes {allowed}'}"
        repair = instead(near, trimmed(self.text, body.start, end))
        self.problems.append(Problem(SYN004, message, Span(body.start, end + 1), repair=repair))
        self.lost += 1

    def _report(self, mismatch: Mismatch) -> None:
        wanted = " or ".join(self._describe(terminal) for terminal in mismatch.expected if terminal != END)
        wanted = wanted or "nothing more in this block"
        self.lost += 1
        if mismatch.found is None:
            code = SYN014 if self.last else SYN001
            where = "the file" if self.last else f"*{self.raw.name}"
            message = f"{where} is incomplete: missing {wanted}"
            lines = [leaf for leaf in (self.raw.head, *self.raw.leaves) if leaf.kind not in (Kind.BLANK, Kind.COMMENT)]
            span = trimmed(self.text, *lines[-1].span)
            self.problems.append(Problem(code, message, span))
            return
        span = trimmed(self.text, *mismatch.found.span)
        if mismatch.missing:
            wanted = self._describe(mismatch.missing)
            message = f"expected {wanted} before this line: write {wanted} and its value above it"
            if mismatch.missing == ROW:
                message = f"expected {wanted} before this line"
            self.problems.append(Problem(SYN001, message, span))
            return
        found = "a row" if mismatch.found.terminal == ROW else f"{first_key(self.text, mismatch.found.span)}="
        message = f"*{self.raw.name} has no place for {found} here: expected {wanted}"
        self.problems.append(Problem(SYN001, message, span))

    def _describe(self, terminal: str) -> str:
        if terminal == ROW:
            from mudline.keywords.format import row_formats  # noqa: PLC0415 - only for a line that does not fit

            formats = dict.fromkeys(row_formats(schemas_of(self.declared)))
            return "a row " + " or ".join(f"`{shape}`" for shape in formats)
        return next(f"{key}=" for key in self.keys if grammar.terminal_of(key) == terminal)


class _CommentLine(NamedTuple):
    """A comment: its position among the block's leaves, what follows the C, its place."""

    position: int
    text: str
    span: Span


def _attach(comments: list[_CommentLine], block: ParsedRecord) -> list[str]:
    """Give each comment to the innermost record whose lines stand on both sides of it, before the item it precedes.

    Returns the texts of those behind the last line of the block: they belong to what follows it.
    """
    trailing: list[str] = []
    whole = _CommentPlaces(block)
    owners: dict[int, ParsedRecord] = {}
    for comment in comments:
        if block.last is not None and comment.position < block.last:
            places = whole.owner(comment.position)
            found = {"before": places.index(comment.position), "text": comment.text}
            places.record.values.setdefault("comments", []).append(found)
            owners[id(places.record)] = places.record
        else:
            trailing.append(comment.text)
    for owner in owners.values():  # a setting may be read in another place than it is written back to
        owner.values["comments"].sort(key=itemgetter("before"))
    return trailing


class _CommentPlaces:
    """The places for comments in a record, in tables that are made once for all of its comments."""

    def __init__(self, record: ParsedRecord) -> None:
        self.record = record
        self.within = sorted(
            (child for children in record.children.values() for child in children if child.last is not None),
            key=attrgetter("first"),
        )
        self.starts = [child.first for child in self.within]
        self.inner: dict[int, _CommentPlaces] = {}
        self.items = sorted(record.items, key=attrgetter("position"))
        self.positions = [item.position for item in self.items]
        self.count, self.before = self._counts()

    def _counts(self) -> tuple[int, dict[tuple[int, int], int]]:
        """The number of items, and how many are written before those of an order and position."""
        before: dict[tuple[int, int], int] = {}
        count = 0
        for item in sorted(self.record.items, key=attrgetter("order", "position")):
            before.setdefault((item.order, item.position), count)
            count += item.count
        return count, before

    def owner(self, position: int) -> _CommentPlaces:
        """Those of the innermost record that has lines on both sides of a position."""
        at = bisect_left(self.starts, position) - 1
        if at < 0:
            return self
        last = self.within[at].last
        if last is None or last <= position:
            return self
        if at not in self.inner:
            self.inner[at] = _CommentPlaces(self.within[at])
        return self.inner[at].owner(position)

    def index(self, position: int) -> int:
        """Index, in the order in which the record is written, of the first item behind a position, or their number."""
        at = bisect_right(self.positions, position)
        if at == len(self.items):
            return self.count
        return self.before[self.items[at].order, self.items[at].position]


def _label(part: type[Part], place: tuple[str | int, ...]) -> str:
    """The name, for a reader, of the field at a place of a block."""
    label = ""
    for step in place:
        slot = next((slot for slot in record_schema(part).slots if slot.json == step), None)
        if slot is not None:
            label = slot.label
            part = slot.row or next(iter(slot.record.values()), part)
    return label


@cache
def all_keys(part: type[Part]) -> frozenset[str]:
    """Every KEY that the lines of a keyword may begin with or hold."""
    return frozenset(key for found in schemas_of(part) for key in found.keys)


def schemas_of(part: type[Part]) -> list[RecordSchema]:
    """The schema of a part and of the records below it."""
    own = record_schema(part)
    below = [inner for slot in own.children.values() for record in slot.record.values() for inner in schemas_of(record)]
    return [own, *below]
