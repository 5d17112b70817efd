"""Every rule: its docstring holds what it says, and its code, slug and severity are those that were agreed."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest

import mudline.language.codes
from mudline.checks.engine import LintSettings, lint_bytes
from mudline.checks.fixing import FixState, StageReader
from mudline.checks.registry import rules
from mudline.language.codes import all_codes
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.forms.yaml import to_yaml
from mudline.language.deck.keyword_text import with_raw_lines
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import Code, DeckError, Severity
from mudline.language.rules import Rule, described_by

ROW = re.compile(r"\| \[([A-Z]+[0-9]+)\]\(\1\.md\) \| `([a-z0-9-]+)` \| (\w+)(, off)? \| (\w*) \| .+ \|")
PAGE = Path(__file__).parents[2] / "docs" / "rules" / "README.md"
AGREED = {row[1]: row.groups()[1:] for row in map(ROW.fullmatch, PAGE.read_text(encoding="utf-8").splitlines()) if row}
"""Slug, severity, whether it is off, and kind of fix of each code, on the page that users know and that `make docs`
writes. A code never changes its meaning: whoever runs it looks at what became of the old rows."""

NO_RULE = {"DOC001", "DOC002", "DAT001", "EXP001", "MIG001", "RUN001", *(f"RUN00{n}" for n in range(3, 9))}
"""What is said of other files than keyword decks, and of runs."""

ADVICE = re.compile(
    r"\b(expected|did you mean|write|save|put|remove|define|choose|give|must|needs?|takes|keep|correct|add|belongs? in|"
    r"missing|superseded by)\b"
)

NOWHERE = Path("decks")
"""A folder that is not there: files that an example names are looked for and not found."""

each_rule = pytest.mark.parametrize("given", rules(), ids=lambda given: given.code.code)


@each_rule
def test_a_docstring_says_what_the_rule_does(given: Rule) -> None:
    (found,) = lint_bytes(given.page.bad_bytes, given.page.file, [given], folder=NOWHERE, dialect=given.page.dialect)
    assert (found.line, found.column, found.code, found.slug) == (*given.page.place, given.code.code, given.code.slug)
    assert ADVICE.search(found.message), found.message
    assert found.message == found.message.strip().removesuffix(".").replace("\n", "")
    assert given.page.title.endswith((".", "?"))
    assert given.page.why.endswith(".")
    assert len(given.page.why.split()) >= 10
    off, fix = ", off" if given.off else None, found.fix.applicability if found.fix else "none"
    agreed = AGREED.get(given.code.code)
    assert agreed == (given.code.slug, given.code.severity.value, off, fix), "run make docs, and look at what changed"


@each_rule
def test_the_good_deck_is_clean_under_all_rules(given: Rule) -> None:
    assert (
        lint_bytes(given.page.good.encode(), given.page.file, rules(), folder=NOWHERE, dialect=given.page.dialect) == []
    )


def test_no_code_that_was_agreed_is_gone() -> None:
    assert AGREED.keys() == {given.code.code for given in rules()}


FIXABLE = [given for given in rules() if AGREED.get(given.code.code, ("none",))[-1] != "none"]


@pytest.mark.parametrize("given", FIXABLE, ids=lambda given: given.code.code)
def test_the_fix_clears_the_finding_and_brings_no_other(given: Rule) -> None:
    """All rules are on, those too that are off unless they are selected."""
    reader = StageReader(given.page.file, LintSettings(tuple(rules()), dialect=given.page.dialect), NOWHERE)
    before = reader.read(given.page.bad_bytes)
    fixes = [one.repair for one in before.findings if one.code == given.code and one.repair]
    assert len(fixes) == 1
    after = reader.after(before, fixes)
    assert after is not None
    assert given.code.code not in _codes(after)
    assert not _codes(after) - _codes(before)


def _codes(state: FixState) -> Counter[str]:
    return Counter(problem.code.code for problem in state.findings)


SYNTAX = [given for given in rules() if given.code.code.startswith("SYN")]


@pytest.mark.parametrize("given", SYNTAX, ids=lambda given: given.code.code)
def test_a_fault_of_writing_is_told_once(given: Rule) -> None:
    """What could not be read leads to no second finding; a decimal comma explains a wrong number of fields."""
    found = {one.code for one in lint_bytes(given.page.bad_bytes, given.page.file, rules())}
    assert found == {given.code.code}


MEANING = [
    given
    for given in rules()
    if (given.code.code == "STY010" or not given.code.code.startswith("STY"))
    and not load_bytes(given.page.bad_bytes, given.page.file).problems
]


@pytest.mark.parametrize("given", MEANING, ids=lambda given: given.code.code)
def test_a_fault_of_meaning_is_found_in_json_and_yaml_too(given: Rule) -> None:
    for write, name in ((to_json, "deck.json"), (to_yaml, "deck.yaml")):
        deck = load_bytes(given.page.bad_bytes, given.page.file)
        if given.code.code in OF_MODELS:
            with pytest.raises(DeckError, match="DOC002"):
                write(deck)
            deck, _ = with_raw_lines(deck)
        text = write(deck)
        found = lint_bytes(text.encode(), name, [given], folder=NOWHERE, dialect=given.page.dialect)
        assert [one.code for one in found] == [given.code.code]
        assert found[0].line > 1 or given.code.code == "SYN019"  # of the whole file


def test_every_code_and_every_slug_is_there_once() -> None:
    for names in ([given.code.code for given in rules()], [given.code.slug for given in rules()]):
        assert len(set(names)) == len(names)
    assert len({words[0] for words in AGREED.values()}) == len(AGREED)


def test_everything_that_reading_and_resolving_notice_has_a_rule() -> None:
    raised = {code.code for code in all_codes()}
    assert raised - {given.code.code for given in rules()} == NO_RULE


OF_MODELS = {"CRV001", "SBD010"}
"""What the models of JSON and YAML refuse themselves."""

EXAMPLE = "A title.\n\nA reason.\n\nExample{base}:\n{lines}\n\nFinds: 1:1\n"
NOTHING = Code("ABC001", "nothing", Severity.INFO)


@pytest.mark.parametrize(
    ("lines", "bad", "good"),
    [
        ("     $MODEL\n    -*A\n    +*B", "$MODEL\n*A\n", "$MODEL\n*B\n"),
        ("    -$MODEL", "$MODEL\n", ""),
        ("\n\n     $MODEL\n\n    +*B\n\n", "$MODEL\n\n", "$MODEL\n\n*B\n"),
        ("     $MODEL\n    -\n    + ", "$MODEL\n\n", "$MODEL\n \n"),
        ("     *A  \n    - 1\t2\t\n    + 1, 2", "*A  \n 1\t2\t\n", "*A  \n 1, 2\n"),
        ("    --1.0, 2\n    ++1.0, 2", "-1.0, 2\n", "+1.0, 2\n"),
    ],
    ids=["both", "bad only", "empty lines", "empty lines of one", "blanks and tabs", "signs"],
)
def test_an_example_holds_both_decks(lines: str, bad: str, good: str) -> None:
    said = described_by(NOTHING, EXAMPLE.format(base="", lines=lines))
    assert (said.bad, said.good) == (bad, good)


OCEAN = " 500.0, 1025.0, 9.81\n"


@pytest.mark.parametrize(
    ("lines", "bad", "good"),
    [
        ("    - 500.0\n    + 500.0, 1025.0, 9.81", "$MODEL\n*OCEAN\n 500.0\n", f"$MODEL\n*OCEAN\n{OCEAN}"),
        ("    +*OCEAN", f"$MODEL\n{OCEAN}", f"$MODEL\n*OCEAN\n{OCEAN}"),
        ("     *OCEAN\n    -c\n    +C", f"$MODEL\n*OCEAN\nc\n{OCEAN}", f"$MODEL\n*OCEAN\nC\n{OCEAN}"),
        ("    -C\n     $MODEL", f"C\n$MODEL\n*OCEAN\n{OCEAN}", f"$MODEL\n*OCEAN\n{OCEAN}"),
        (
            "     $MODEL\n    |*A\n    - 1\n    + 2\n    | 3\n     *OCEAN",
            f"$MODEL\n*A\n 1\n 3\n*OCEAN\n{OCEAN}",
            f"$MODEL\n*A\n 2\n 3\n*OCEAN\n{OCEAN}",
        ),
        (
            "    -$Model\n    +$MODEL\n\n      500.0, 1025.0, 9.81\n    -*OCEAN",
            f"$Model\n*OCEAN\n{OCEAN}*OCEAN\n",
            f"$MODEL\n*OCEAN\n{OCEAN}",
        ),
    ],
    ids=["replaced", "left out", "put in", "at the top", "added to both", "two changes"],
)
def test_an_example_on_a_base_deck_has_only_the_lines_around_the_change(lines: str, bad: str, good: str) -> None:
    said = described_by(NOTHING, EXAMPLE.format(base=" on ocean", lines=lines))
    assert (said.bad, said.good) == (bad, good)


@pytest.mark.parametrize(
    ("base", "lines", "said"),
    [
        ("", "     $MODEL\n    |*A", "'    |*A' of the example of ABC001 must have four spaces, then a space, - or +"),
        (" on ocean", "    *OCEAN", "'    *OCEAN' of the example of ABC001 must have four spaces, then a space, |, -"),
        (" on oceans", "    -*OCEAN", "the example of ABC001 must be on clay, held, ocean, "),
        (" on ocean", "     *Ocean\n    + 1", "the lines ' *Ocean', '+ 1' of the example of ABC001, those"),
        (" on ocean", "     $MODEL\n      500.0, 1025.0, 9.81\n    -A", "the lines ' $MODEL', '  500.0, 1025.0, 9.81'"),
        (" on ocean", "     *OCEAN\n    -A\n\n     $MODEL\n    -B", "the lines ' $MODEL', '-B' of"),
        (" on pipe", "      SET=ALL\n    -A", "the lines '  SET=ALL', '-A' of"),
        (" on ocean", "     $MODEL\n     *OCEAN\n    -A\n\n    -B", "the lines '-B' of"),
    ],
    ids=["added to no base", "no mark", "no base", "other case", "not together", "other order", "twice", "no place"],
)
def test_a_line_of_an_example_has_a_mark_and_one_place(base: str, lines: str, said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)):
        described_by(NOTHING, EXAMPLE.format(base=base, lines=lines))


def test_examples_stand_on_every_base_deck() -> None:
    there = {file.stem for file in (Path(mudline.language.codes.__file__).parent / "examples").iterdir()}
    assert there == {base for given in rules() for base in re.findall(r"Example on (\w+):", given.docstring)}
