"""What resolving a deck needs at every step: the evaluated deck, and the list of what went wrong."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cached_property

from mudline.deck.model import Deck, Opaque
from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Problem, Severity, Where

MOST_TOLD = 1000
"""Findings of one code told one by one; the rest is counted."""

DEFINERS = ("LINES", "LINE LOCATIONS", "LINE PATHS", "LINE PATH SECTIONS", "LINE SECTION GROUPS", "CABLE", "NODE,CURVILINEAR")
"""Blocks without a model that make nodes, elements or sets."""

_NAMING = re.compile(r"\b(LINE|SECTION|NAME|ADDITIONAL)[ \t]*=[ \t]*([^=\r\n]*?)(?=,[^,=]*=|$)", re.IGNORECASE)


@dataclass
class Context:
    """The evaluated deck and what was noticed in it."""

    deck: Deck
    problems: list[Problem] = field(default_factory=list)
    told: dict[str, int] = field(default_factory=dict)

    def tell(self, code: Code, message: str, where: Where, severity: Severity | None = None) -> None:
        """Note a problem."""
        count = self.told[code.code] = self.told.get(code.code, 0) + 1
        if count <= MOST_TOLD:
            self.problems.append(Problem(code, message, None, severity, where))
        elif count == MOST_TOLD + 1:
            self.problems.append(Problem(code, "and more of the same: only the first are listed", None, severity, where))

    def tell_missing(self, code: Code, message: str, where: Where, keyword: str) -> None:
        """Note a name that nothing defines: an error, or a warning where something unread could define it."""
        if supplier := self.supplier(keyword):
            self.tell(code, f"{message}; {supplier}", where, Severity.WARNING)
        else:
            self.tell(code, message, where)

    def supplier(self, keyword: str) -> str:
        """What could define a name that is missing, in words, or ""."""
        if self.definers:
            return f"*{self.definers[0]}, which is not read, may define it"
        if self.restart:
            return "the deck that *RESTART continues may define it"
        if keyword in self.incomplete:
            return f"a line of *{keyword} that could not be read may define it"
        return ""

    @cached_property
    def definers(self) -> list[str]:
        """Keywords of the model that make nodes, elements or sets and are not read."""
        present = self.deck.keywords()
        return [keyword for keyword in DEFINERS if keyword in present]

    @cached_property
    def restart(self) -> bool:
        """Whether the deck continues another one."""
        return "RESTART" in self.deck.keywords("LOAD CASE")

    @cached_property
    def incomplete(self) -> set[str]:
        """Keywords of which a line that could define something was not usable."""
        return {
            block.keyword
            for i, section in enumerate(self.deck.sections)
            for j, block in enumerate(section.blocks)
            if self.deck.origin.lost(i, j)
        }

    @cached_property
    def harvested(self) -> dict[str, str]:
        """Names of lines, sections and additional sets in the blocks that are not read, by their folded form."""
        names: dict[str, str] = {}
        for section in self.deck.sections:
            for block in section.blocks:
                if section.name == "MODEL" and isinstance(block, Opaque) and block.keyword in DEFINERS:
                    for key, value in (match for line in block.lines for match in _NAMING.findall(line)):
                        parts = value.split(",") if key.upper() == "ADDITIONAL" else value.split(",")[:1]
                        names |= {folded(part): part.strip(" \t") for part in parts if part.strip(" \t")}
        return names
