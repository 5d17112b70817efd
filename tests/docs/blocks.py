"""Markdown pages taken apart: fenced blocks, headings, links, names of files."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from tests.docs.marking import anchor

_FENCE = re.compile(r'^```(\w*)(?: title="([\w./-]+)")?\n(.*?)^```$', re.MULTILINE | re.DOTALL)
_HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
_LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
_FILE = re.compile(r"`((?:docs|grammar|samples|src|tests|\.github)/[\w./-]+)`")


@dataclass
class Command:
    """A line behind `$ `, and the lines below it up to the next command."""

    words: str
    line: int
    shown: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Block:
    """A fenced block; `line` is that of its first line of text, `title` the file that it shows, if any."""

    language: str
    text: str
    line: int
    title: str = ""

    def commands(self) -> list[Command]:
        """The commands of a console block."""
        found: list[Command] = []
        for number, line in enumerate(self.text.splitlines(), self.line):
            if line.startswith("$ "):
                found.append(Command(line.removeprefix("$ "), number))
            elif found:
                found[-1].shown.append(line)
        return found


@dataclass(frozen=True)
class Page:
    """A Markdown file."""

    path: Path
    text: str

    @classmethod
    def read(cls, path: Path) -> Page:
        """Read a file."""
        return cls(path, path.read_text(encoding="utf-8"))

    @property
    def blocks(self) -> list[Block]:
        """The fenced blocks."""
        return [
            Block(match[1], match[3], self.text.count("\n", 0, match.start()) + 2, match[2] or "")
            for match in _FENCE.finditer(self.text)
        ]

    @property
    def prose(self) -> str:
        """The text without its fenced blocks."""
        return _FENCE.sub("", self.text)

    @property
    def anchors(self) -> set[str]:
        """What links to headings may point to."""
        return {anchor(heading) for heading in _HEADING.findall(self.prose)}

    def links(self) -> Iterator[str]:
        """Targets of links within the repository."""
        yield from (target for target in _LINK.findall(self.prose) if not re.match(r"[a-z]+:", target))

    def named_files(self) -> set[str]:
        """Files of the repository that the text names."""
        return set(_FILE.findall(self.prose))


def agree(shown: list[str], printed: list[str]) -> bool:
    """Whether a page shows what a command printed; `...` on its own line stands for any lines."""
    pattern = "".join(r"(?:.*\n)*" if line.strip() == "..." else re.escape(line) + r"\n" for line in shown)
    return re.fullmatch(pattern, "".join(f"{line}\n" for line in printed)) is not None
