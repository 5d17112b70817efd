"""Every rule: its docstring holds what it says, and its code, slug and severity are those that were agreed."""

from __future__ import annotations

import pkgutil
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

import mudline.linting.rules as rules_package
from mudline import codes
from mudline.deck.json_form import to_json
from mudline.deck.loading import load_bytes
from mudline.deck.yaml_form import to_yaml
from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.engine import lint_bytes
from mudline.linting.fix_state import FixState, Reader
from mudline.linting.registry import MODULES, Rule, rule, rules
from mudline.linting.settings import LintSettings

AGREED = """
SYN001 unreadable-line E
SYN002 bad-number E
SYN003 wrong-field-count E
SYN004 unknown-setting E
SYN005 bad-choice E
SYN006 unbalanced-bracket E
SYN007 keyword-outside-section E
SYN008 keyword-in-wrong-section E
SYN009 unknown-keyword I
SYN010 unknown-section I
SYN011 data-outside-keyword W
SYN012 bad-encoding W
SYN013 ambiguous-comment W
SYN014 truncated-file E
SYN015 decimal-comma W
SYN016 label-without-braces W
SYN017 expression-error E
REF001 undefined-set E
REF002 undefined-curve E
REF003 unused-curve W
REF004 duplicate-curve W
REF005 undefined-element E
REF006 undefined-node E
REF007 duplicate-id E
REF008 subset-cycle E
REF009 redefined-all E
REF010 empty-set W
REF011 long-name W
REF012 long-list W
REF013 undefined-parameter E
REF014 parameter-cycle E
REF015 missing-file W
REF016 repeated-set W
REF017 repeated-parameter W
GEO001 inner-exceeds-outer E
GEO002 number-and-curve W
GEO003 drag-diameter-assumed I
GEO004 zero-length-element E
GEO005 not-on-the-seabed W
GEO006 repeated-section W
CRV001 too-few-points E
CRV002 unsorted-points I
CRV003 duplicate-ratio E
CRV004 repeated-point W
CRV005 decreasing-force W
CRV006 negative-ratio W
CRV007 force-at-zero W
CRV008 steep-extrapolation W
CRV009 swapped-columns W
CRV010 ratio-range W
CRV011 slope-overflow E
CRV012 curve-pulls W
CRV013 flat-last-segment W
CRV014 beyond-curve I
SBD001 rigid-with-curve E
SBD002 two-seabed-types E
SBD003 missing-type E
SBD004 missing-embedment E
SBD005 embedment-needs-elastic E
SBD006 no-vertical-restraint W
SBD007 lateral-and-friction W
SBD008 overlapping-sets I
SBD009 missing-diameter E
SBD010 negative-property E
SBD011 profile-needs-elastic E
SBD012 steep-slope E
SBD013 legacy-friction-order W
SBD014 unused-friction-stiffness I
SBD015 extent-without-stiffness W
SBD016 mixed-families W
SBD017 curve-named-as-number W
SBD018 extension-keyword E
SBD019 short-mobilisation W
SBD020 unused-characteristic-length I
SBD021 one-constrained-dof W
SBD022 deep-node W
SBD023 unreadable-profile I
SBD024 one-friction-coefficient W
SBD025 law-without-effect W
EXT001 extension-needs-elastic E
EXT002 floor-conflict E
EXT003 bad-trench E
EXT004 bad-cutoff E
EXT005 suction-incomplete E
EXT006 suction-conflict E
EXT007 bad-plane E
EXT008 soft-unloading W
EXT009 unloading-conflict E
LEG001 superseded-keyword I
UNT001 gravity-mismatch W
UNT002 suspicious-magnitude W
UNT003 large-friction W
UNT004 suspicious-density W
UNT005 suspicious-modulus W
UNT006 suspicious-length W
STB001 suction-snap I
STB002 coarse-time-step I off
STB003 stiff-jump W
STY001 tab-character W
STY002 lower-case-comment W
STY003 fortran-exponent W
STY004 blank-separated W
STY005 indented-keyword W
STY006 keyword-case I
STY007 trailing-blank I off
STY008 key-like-comment I
STY009 indented-comment W
STY010 unused-suppression W
"""
"""Code, slug, severity, and whether the rule is off unless it is selected. A code never changes its meaning."""

SEVERITIES = {"E": Severity.ERROR, "W": Severity.WARNING, "I": Severity.INFO}
TABLE = {words[0]: words[1:] for words in (line.split() for line in AGREED.strip().split("\n"))}
NO_RULE = {"DOC001", "DOC002", "DAT001", "EXP001", "MIG001", "RUN001"}
"""What is said of other files than keyword decks, and of runs."""

ADVICE = re.compile(
    r"\b(expected|did you mean|write|save|put|remove|define|choose|give|must|needs?|takes|keep|correct|add|belongs? in|"
    r"missing|superseded by|stand in)\b"
)

FIXED = {
    "safe": "CRV002 CRV004 REF012 STY001 STY002 STY003 STY004 STY005 STY006 STY007 STY008",
    "unsafe": "SYN004 SYN005 SYN009 SYN010 SYN016 REF003 CRV009 LEG001 STY010",
}
"""The codes with a fix, as the examples show it; the others have none. STY010 guesses there, and removes safely."""

KIND_OF_FIX = {code: kind for kind, codes in FIXED.items() for code in codes.split()}

NOWHERE = Path("decks")
"""A folder that is not there: files that an example names are looked for and not found."""

each_rule = pytest.mark.parametrize("given", rules(), ids=lambda given: given.code.code)


@each_rule
def test_the_bad_deck_gives_one_finding_where_the_docstring_says(given: Rule) -> None:
    found = lint_bytes(given.bad_bytes, given.file, [given], folder=NOWHERE, dialect=given.dialect)
    assert [(one.line, one.column) for one in found] == [given.place], [str(one) for one in found]
    assert [(one.code, one.slug) for one in found] == [(given.code.code, given.code.slug)]


@each_rule
def test_the_good_deck_is_clean_under_all_rules(given: Rule) -> None:
    assert lint_bytes(given.good_bytes, given.file, rules(), folder=NOWHERE, dialect=given.dialect) == []


@each_rule
def test_the_message_says_what_to_do(given: Rule) -> None:
    message = lint_bytes(given.bad_bytes, given.file, [given], folder=NOWHERE, dialect=given.dialect)[0].message
    assert message == message.strip()
    assert not message.endswith(".")
    assert "\n" not in message
    assert ADVICE.search(message), message


@each_rule
def test_the_docstring_has_a_title_and_a_reason(given: Rule) -> None:
    assert given.title.endswith((".", "?"))
    assert given.why.endswith(".")
    assert len(given.why.split()) >= 10


@each_rule
def test_code_slug_and_severity_are_as_agreed(given: Rule) -> None:
    slug, severity, *off = TABLE[given.code.code]
    assert (given.code.slug, given.code.severity) == (slug, SEVERITIES[severity])
    assert given.off == bool(off)


@each_rule
def test_the_finding_has_the_kind_of_fix_that_was_agreed(given: Rule) -> None:
    found = lint_bytes(given.bad_bytes, given.file, [given], folder=NOWHERE, dialect=given.dialect)
    assert [one.fix and one.fix.applicability for one in found] == [KIND_OF_FIX.get(given.code.code)]


FIXABLE = [given for given in rules() if given.code.code in KIND_OF_FIX]


@pytest.mark.parametrize("given", FIXABLE, ids=lambda given: given.code.code)
def test_the_fix_clears_the_finding_and_brings_no_other(given: Rule) -> None:
    """All rules are on, those too that are off unless they are selected."""
    reader = Reader(given.file, LintSettings(tuple(rules()), dialect=given.dialect), NOWHERE)
    before = reader.read(given.bad_bytes)
    fixes = [one.repair for one in before.told if one.code == given.code and one.repair]
    assert len(fixes) == 1
    after = reader.after(before, fixes)
    assert after is not None
    assert given.code.code not in _codes(after)
    assert not _codes(after) - _codes(before)


def _codes(state: FixState) -> Counter[str]:
    return Counter(problem.code.code for problem in state.told)


SYNTAX = [given for given in rules() if given.code.code.startswith("SYN")]


@pytest.mark.parametrize("given", SYNTAX, ids=lambda given: given.code.code)
def test_a_fault_of_writing_is_told_once(given: Rule) -> None:
    """What could not be read leads to no second finding; a decimal comma explains a wrong number of fields."""
    found = {one.code for one in lint_bytes(given.bad_bytes, given.file, rules())}
    assert found - {given.code.code} == ({"SYN003"} if given.code.code == "SYN015" else set())


SPELLING = {f"STY00{number}" for number in range(1, 10)}
"""What only a text can have: tabs, blanks, case, the letter of an exponent."""

MEANING = [
    given
    for given in rules()
    if given.code.code not in SPELLING and not load_bytes(given.bad_bytes, given.file).problems
]


@pytest.mark.parametrize("given", MEANING, ids=lambda given: given.code.code)
def test_a_fault_of_meaning_is_found_in_json_and_yaml_too(given: Rule) -> None:
    deck = load_bytes(given.bad_bytes, given.file)
    for text, name in ((to_json(deck), "deck.json"), (to_yaml(deck), "deck.yaml")):
        found = lint_bytes(text.encode(), name, [given], folder=NOWHERE, dialect=given.dialect)
        assert [one.code for one in found] == [given.code.code]
        assert found[0].line > 1


def test_every_code_and_every_slug_is_there_once() -> None:
    for names in ([given.code.code for given in rules()], [given.code.slug for given in rules()]):
        assert len(set(names)) == len(names)
    assert len({words[0] for words in TABLE.values()}) == len(TABLE)


def test_everything_that_reading_and_resolving_notice_has_a_rule() -> None:
    raised = {code.code for code in vars(codes).values() if isinstance(code, Code)}
    assert raised - {given.code.code for given in rules()} == NO_RULE


def test_every_module_of_rules_is_listed() -> None:
    assert {module.name for module in pkgutil.iter_modules(rules_package.__path__)} == set(MODULES)


def test_an_example_may_have_its_own_encoding_and_end() -> None:
    by_code = {given.code.code: given for given in rules()}
    assert b"\xd8" in by_code["SYN012"].bad_bytes
    assert by_code["SYN012"].remark == "saved as CP1252"
    assert not by_code["SYN014"].bad.endswith("\n")
    assert by_code["SYN014"].remark == "the file ends behind the last character, without a line end"
    assert by_code["SYN002"].remark == ""


def test_two_rules_cannot_share_a_code_or_a_slug() -> None:
    def again(context: LintContext) -> Iterator[Problem]:
        """A title.

        A reason.

        Bad:
            $MODEL

        Good:
            $MODEL

        Finds: 1:1
        """
        yield from context.told(codes.SYN001)

    for code in (codes.SYN001, Code("ABC001", codes.SYN001.slug, Severity.INFO)):
        with pytest.raises(ValueError, match="already"):
            rule(code)(again)


@pytest.mark.parametrize(
    ("docstring", "lacking"),
    [
        ("A title.\n\nA reason.\n\nBad:\n    $MODEL\n\nFinds: 1:1\n", "lacks Good"),
        ("A title.\n\nBad:\n    $\n\nGood:\n    $MODEL\n\nFinds: 1:1\n", "lacks a title or a reason"),
        ("", "lacks Bad, Good, Finds"),
    ],
)
def test_a_docstring_that_lacks_a_part_is_refused(docstring: str, lacking: str) -> None:
    def check(context: LintContext) -> Iterator[Problem]:
        yield from context.told(codes.SYN001)

    check.__doc__ = docstring
    with pytest.raises(ValueError, match=lacking):
        rule(Code("ABC001", "nothing", Severity.INFO))(check)
