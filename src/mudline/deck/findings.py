"""Findings about sections and keywords that are unknown or in a wrong place, whatever form the deck has."""

from __future__ import annotations

from collections import Counter

from mudline.codes.lines import SYN007, SYN008, SYN009, SYN010, SYN011
from mudline.diagnostics import MORE, MOST_REPORTED, Code, Problem, Severity, Span, Where
from mudline.keywords import catalogue
from mudline.keywords.catalogue import meant_in, meant_keyword, meant_section, words_behind
from mudline.keywords.text import hint, instead


class Findings:
    """Adds to the problems of a deck; each method takes the place as a span of the text or as one among the values."""

    def __init__(self, problems: list[Problem]) -> None:
        self.problems = problems
        self.reported: Counter[str] = Counter()

    def unknown_section(self, name: str, where: Where, head: Span | None = None) -> None:
        """A section that is not in the catalogue; `head` is its line in a text."""
        if not self._reports(SYN010, None, where):
            return
        near = meant_section(name)
        message = f"section ${name} is not known{_meant(name, near)}: it is passed through unchanged"
        self._misspelt(SYN010, message, where, f"${near}" if near else "", head)

    def no_model(self, keyword: str, section: str, where: Where, head: Span | None = None) -> None:
        """A block that is passed through: no finding if its keyword is known and allowed in the section.

        `head` is its first line in a text.
        """
        sections = catalogue.sections_of(keyword)
        if sections is None:
            if self._reports(SYN009, None, where):
                near = meant_keyword(keyword)
                message = f"keyword *{keyword} is not known{_meant(keyword, near)}: it is passed through unchanged"
                self._misspelt(SYN009, message, where, f"*{near}" if near else "", head)
        elif (
            sections
            and section not in sections
            and section in catalogue.SECTIONS
            and self._reports(SYN008, None, where)
        ):
            near = meant_in(keyword, section)
            message = f"*{keyword} does not belong in ${section}{hint(near)}: it belongs in {_belongs(keyword)}"
            repair = instead(f"*{near}", head) if head and near else None
            self.problems.append(Problem(SYN008, message, None, None, where, repair))

    def _misspelt(self, code: Code, message: str, where: Where, meant: str, head: Span | None) -> None:
        """A name that is not known, which is a warning where another one was meant."""
        repair = instead(meant, head) if head else None
        self.problems.append(Problem(code, message, None, Severity.WARNING if meant else None, where, repair))

    def before_sections(self, keyword: str, span: Span | None = None, where: Where | None = None) -> None:
        """A block before the first section."""
        if self._reports(SYN007, span, where):
            message = f"*{keyword} stands before any $SECTION: put it in its section, {_belongs(keyword)}"
            self.problems.append(Problem(SYN007, message, span, None, where))

    def stray(self, count: int, place: str, span: Span | None = None, where: Where | None = None) -> None:
        """Data lines of a place under no keyword, the first of which is given: one finding for all of them."""
        if self._reports(SYN011, span, where):
            lines = "1 line" if count == 1 else f"{count} lines"
            message = f"{lines} {place} under no keyword: not read; write a title as a comment, C and a space"
            self.problems.append(Problem(SYN011, message, span, None, where))

    def _reports(self, code: Code, span: Span | None, where: Where | None) -> bool:
        """Whether one more finding of a code is reported: a file of another kind would have as many as it has lines."""
        self.reported[code.code] += 1
        count = self.reported[code.code]
        if count == MOST_REPORTED + 1:
            self.problems.append(Problem(code, MORE, span, None, where))
        return count <= MOST_REPORTED


def _meant(name: str, near: str) -> str:
    behind = ", with nothing behind the name" if near and words_behind(name, near) else ""
    return f" (did you mean {near}{behind}?)" if near else ""


def _belongs(keyword: str) -> str:
    sections = catalogue.sections_of(keyword)
    return " or ".join(f"${name}" for name in sections) if sections else "such as $MODEL"
