"""A raw block to the model of its keyword: contents, grammar, values, comments; every fault is one problem."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import cast

from pydantic import ValidationError

from mudline.codes import SYN001
from mudline.diagnostics import Problem
from mudline.keywords import grammar
from mudline.keywords.builder import Builder
from mudline.keywords.built import Built, attach, construct
from mudline.keywords.contents import Contents
from mudline.keywords.findings import Findings
from mudline.keywords.mismatches import MismatchReport
from mudline.keywords.model import Block
from mudline.keywords.places import Places
from mudline.syntax.fields import trimmed
from mudline.syntax.tree import RawBlock


@dataclass(slots=True)
class ReadBlock:
    """A block that was read: its model, where its values stand, what was wrong, and the comments behind its last line.

    `lost` counts lines that could not be used at all: what they would have defined is unknown.
    """

    model: Block
    places: Places
    problems: list[Problem]
    trailing: list[str] = field(default_factory=list)
    lost: int = 0


def read_block(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Read a block. `text` is the unified text of the source; `last`: nothing follows the block in the file."""
    findings = Findings(Places(text, trimmed(text, *raw.head.span)))
    contents = Contents(text, declared, findings)
    contents.read(raw.leaves)
    node, mismatches = grammar.parse(declared.rule, contents.lines)
    MismatchReport(text, raw, declared, contents, last=last).tell(mismatches)
    built = Builder(text, declared, findings).build(declared, node)
    trailing = [comment.text for comment in contents.comments if not attach(comment.position, comment.text, built)]
    built.values["keyword"] = raw.name
    model = _model(built, declared, findings)
    return ReadBlock(model, findings.places, findings.finish(), trailing, findings.lost)


def _model(built: Built, declared: type[Block], findings: Findings) -> Block:
    """The validated model; of a block with faults, what could be read of it."""
    if findings.whole:
        try:
            return declared.model_validate(built.values)
        except ValidationError as error:
            for fault in error.errors(include_url=False):
                findings.damage((), Problem(SYN001, fault["msg"], findings.places.find(tuple(fault["loc"]))))
    return cast("Block", construct(built))
