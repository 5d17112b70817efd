"""Strategies that follow the declarations: documents of every keyword with a model, and of whole decks."""

from __future__ import annotations

from hypothesis import strategies as st

from mudline.deck.document import FORMAT, UNITS
from mudline.keywords import catalogue
from mudline.keywords.model import Block, Record, layout
from tests.generated.arranged import ARRANGED
from tests.generated.lines import Values, cell, line, table
from tests.reading.spellings import comments as comment_lines
from tests.reading.spellings import no_head, texts

Keyword = tuple[str, str]


def declared(keyword: Keyword) -> type[Block]:
    """The class of a keyword in a section."""
    found = catalogue.block_class(*keyword)
    assert found is not None
    return found


KEYWORDS: list[Keyword] = [
    (section, keyword)
    for section in catalogue.SECTIONS
    for keyword in catalogue.keywords()
    if catalogue.block_class(section, keyword)
]
"""Every keyword with a model, after its section."""

remarks = comment_lines.map(lambda text: text[1:])
"""What follows the C of a comment."""


@st.composite
def record(draw: st.DrawFn, part: type[Record], index: int = 0) -> Values:
    """The values of a record, or of a whole block; `index` is its place among its siblings."""
    found = layout(part)
    first = found.slots[0]
    plain = [slot for slot in found.columns if not slot.row and not slot.many]
    own_line = plain if len(plain) == len(found.columns) else []
    made: Values = draw(line(own_line)) if own_line else {}
    for slot in found.slots:
        opens = index > 0 and slot is first and bool(slot.key)
        if slot in own_line or not (slot.required or opens or draw(st.booleans())):
            continue
        if slot is found.table:
            made[slot.json] = draw(table(slot, fewest=0 if made and slot.required else 1))
        elif slot.record:
            made[slot.json] = draw(records(list(slot.record.values())))
        else:
            made[slot.json] = draw(cell(slot))
    if part.rule in ARRANGED:
        made = draw(ARRANGED[part.rule](made))
    if all(value in (None, []) for value in made.values()) and not issubclass(part, Block):
        made[first.json] = draw(cell(first))  # a record is lines
    told = draw(st.lists(remarks, max_size=2))
    return made | ({"comments": draw(comments(told, 6))} if told else {})


@st.composite
def records(draw: st.DrawFn, kinds: list[type[Record]]) -> list[Values]:
    """A list of records; nothing would part two that are rows only."""
    made: list[Values] = []
    last: type[Record] | None = None
    for _ in range(draw(st.integers(0, 3))):
        kind = draw(st.sampled_from(kinds))
        if kind is not last or layout(kind).slots[0] is not layout(kind).table:
            made.append(draw(record(kind, len(made))))
            last = kind
    return made


@st.composite
def comments(draw: st.DrawFn, told: list[str], items: int) -> list[Values]:
    """Comments before some of a number of items, or behind the last."""
    return [{"before": draw(st.integers(0, items)), "text": text} for text in told]


def block(keyword: Keyword) -> st.SearchStrategy[Values]:
    """A block of a keyword."""
    return record(declared(keyword)).map(lambda values: {"keyword": keyword[1], **values})


opaque: st.SearchStrategy[Values] = st.builds(
    lambda keyword, lines: {"keyword": keyword, "lines": lines},
    st.sampled_from(["HYDRODYNAMIC SETS", "WAVE-REGULAR", "TITLE", "NEW THING", "GEL\u00c4NDE", "A,B", ""]),
    st.lists(texts.map(no_head), max_size=4),
)
"""A block without a model."""

_SECTIONS = [*dict.fromkeys(section for section, _ in KEYWORDS), "CLEAR", "NEW THING", "\u6d77\u5e95"]


@st.composite
def section(draw: st.DrawFn, blocks: int = 3) -> Values:
    """A section, known or not, with stray lines and comments."""
    name = draw(st.sampled_from(_SECTIONS))
    known = [block(keyword) for keyword in KEYWORDS if keyword[0] == name]
    made: Values = {"name": name, "blocks": draw(st.lists(st.one_of(*known, opaque), max_size=blocks))}
    if draw(st.integers(0, 3)) == 0:
        made["lines"] = ["stray" + line for line in draw(st.lists(texts, min_size=1, max_size=2))]
    told = draw(st.lists(remarks, max_size=2))
    return made | ({"comments": draw(comments(told, blocks + 1))} if told else {})


@st.composite
def document(draw: st.DrawFn) -> Values:
    """A whole deck."""
    made: Values = {"format": FORMAT, "source": draw(st.sampled_from(["a.keyxm", "\u00e9 b"]))}
    made["units"] = draw(st.sampled_from(UNITS))
    told = draw(st.lists(remarks, max_size=2))
    if told:
        made["comments"] = draw(comments(told, 4))
    if draw(st.booleans()):
        made["preamble"] = draw(st.lists(comment_lines | st.sampled_from(["", "a title", " 1, 2"]), max_size=3))
    made["sections"] = draw(st.lists(section(), max_size=3))
    return made


def alone(keyword: Keyword, values: Values) -> Values:
    """A document of one block."""
    return {"format": FORMAT, "sections": [{"name": keyword[0], "blocks": [values]}]}
