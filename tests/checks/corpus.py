"""The golden corpus: decks under tests/data/corpus, and beside each of them what the linter finds in it.

`python -m tests.checks.corpus` writes the findings anew, prints what changed, and tells which rules no deck shows.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import unified_diff
from pathlib import Path

from mudline.checks.engine import lint_bytes
from mudline.checks.output import visible
from mudline.checks.registry import rules, select
from mudline.language.diagnostics import Diagnostic
from mudline.language.rules import Rule

CORPUS = Path(__file__).parents[1] / "data" / "corpus"
DECKS = frozenset({".keyx", ".keyxm", ".keyxi", ".das", ".json", ".yaml", ".yml"})
SUFFIX = ".expected"
OPTIONS = ("rules", "select", "dialect", "why")
"""What a first line `# OPTION: words` may say: rules that are off run too (`rules: all`), only these rules run, the
program that the deck is for, and why a good deck has findings."""


@dataclass(frozen=True, slots=True)
class Expected:
    """What stands beside a deck: options by name, and the findings, a line each."""

    options: tuple[tuple[str, str], ...]
    findings: tuple[str, ...]

    @classmethod
    def read(cls, text: str) -> Expected:
        """The content of a file; raises ValueError for an option that there is not."""
        heads = [line.removeprefix("# ").partition(": ") for line in text.splitlines() if line.startswith("# ")]
        unknown = {name for name, _, _ in heads} - set(OPTIONS)
        if unknown:
            raise ValueError(f"no such option: {', '.join(sorted(unknown))}")
        findings = tuple(line for line in text.splitlines() if not line.startswith("# "))
        return cls(tuple((name, words) for name, _, words in heads), findings)

    def option(self, name: str, default: str = "") -> str:
        """The words of an option."""
        return dict(self.options).get(name, default)

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules that run."""
        if self.option("rules") == "all":
            return rules()
        return select(self.option("select").replace(",", " ").split())

    @property
    def dialect(self) -> str:
        """The program that the deck is for."""
        return self.option("dialect", "mudline")

    def text(self) -> str:
        """The file."""
        return "".join(
            f"{line}\n" for line in (*(f"# {name}: {words}" for name, words in self.options), *self.findings)
        )


def decks() -> list[Path]:
    """All decks, by path."""
    return sorted(path for path in CORPUS.rglob("*") if path.suffix.lower() in DECKS)


def name_of(deck: Path) -> str:
    """The path of a deck in the corpus."""
    return deck.relative_to(CORPUS).as_posix()


def beside(deck: Path) -> Path:
    """The file with the findings of a deck."""
    return deck.with_name(f"{deck.name}{SUFFIX}")


def expected(deck: Path) -> Expected:
    """What is expected of a deck; nothing where no file is there yet."""
    path = beside(deck)
    return Expected.read(path.read_text(encoding="utf-8") if path.exists() else "")


def diagnostics(data: bytes, deck: Path, options: Expected) -> list[Diagnostic]:
    """The findings in a content that stands in the place of a deck."""
    return lint_bytes(data, deck.name, options.rules, folder=deck.parent, dialect=options.dialect)


def found_in(deck: Path) -> list[Diagnostic]:
    """What the linter finds in a deck."""
    return diagnostics(deck.read_bytes(), deck, expected(deck))


def lines(found: Iterable[Diagnostic], deck: Path) -> tuple[str, ...]:
    """The findings in a deck, in order: `line:column: CODE severity message`; its folder is `.` in messages."""
    here = deck.parent.as_posix()
    return tuple(
        f"{one.line}:{one.column}: {one.code} {one.severity} {visible(one.message).replace(here, '.')}"
        for one in sorted(found, key=lambda one: one.sort_key)
    )


def code_of(line: str) -> str:
    """The code in a line of findings."""
    return line.split(" ", 2)[1]


def severity_of(line: str) -> str:
    """The severity in a line of findings."""
    return line.split(" ", 3)[2]


def codes_not_shown() -> set[str]:
    """The codes of rules that no deck shows."""
    shown = {code_of(line) for deck in decks() for line in expected(deck).findings}
    return {rule.code.code for rule in rules()} - shown


def rewrite() -> list[str]:
    """Write all findings anew, remove files without a deck; returns what changed as lines of a diff."""
    changes: list[str] = []
    for deck in decks():
        path, old = beside(deck), expected(deck)
        before, after = old.text(), Expected(old.options, lines(found_in(deck), deck)).text()
        if before != after or not path.exists():
            path.write_text(after, encoding="utf-8", newline="\n")
            name = name_of(deck)
            changes.append(f"written: {name}")
            changes += unified_diff(before.splitlines(), after.splitlines(), name, name, lineterm="", n=0)
    for path in sorted(CORPUS.rglob(f"*{SUFFIX}")):
        if not path.with_suffix("").exists():
            path.unlink()
            changes.append(f"removed: {path.relative_to(CORPUS).as_posix()}")
    return changes


def main() -> None:
    """Write the findings anew, and tell what changed."""
    for line in rewrite():
        sys.stdout.write(f"{line}\n")
    sys.stdout.write(f"{len(decks())} decks; rules that none of them shows: {sorted(codes_not_shown())}\n")


if __name__ == "__main__":
    main()
