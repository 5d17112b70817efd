"""docs/rules/, from the docstrings of the rules."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from textwrap import fill

from mudline.checks.engine import lint_bytes
from mudline.language.diagnostics import Diagnostic
from mudline.language.rules import Rule, RulePage
from tests.docs.marking import MADE, marked

_WIDTH = 90
"""Columns of text that a page shows without scrolling."""

_INDEX = """{made}

# Rules

What `mudline lint` looks for. On the command line a code or a slug selects one rule, a prefix of codes all rules with
it: `--select SYN`, `--ignore CRV002`, `--ignore unsorted-points`. `mudline rules CODE` prints a page.

An *error* means that the deck is illegal or has no meaning. A *warning* is a likely mistake, or a place where the
meaning is our choice. An *info* is something to know. A rule that is *off* runs only where it is selected. `--fix`
makes a *safe* fix, `--fix --unsafe-fixes` also an *unsafe* one; column and pages show that of the example.

| code | slug | severity | fix | finds |
| --- | --- | --- | --- | --- |
{rows}

Ten more codes are not rules and cannot be ignored; they say why a file could not be used, changed or checked, or what
is doubtful in the results of one:

| code | slug | severity | says |
| --- | --- | --- | --- |
| [DOC001](DOC001.md) | `unreadable-document` | error | A deck in JSON or YAML is not valid JSON or YAML. |
| [DOC002](DOC002.md) | `schema-error` | error | A deck in JSON or YAML breaks the schema of decks. |
| [DAT001](DAT001.md) | `bad-data-file` | error | A file of positions or elements has a fault. |
| [EXP001](EXP001.md) | `cannot-expand` | error | The decks that a deck describes cannot be made. |
| [MIG001](MIG001.md) | `cannot-migrate` | error | The new family of seabed keywords cannot say what the deck says. |
| [RUN001](RUN001.md) | `cannot-evaluate` | error | The deck cannot be evaluated. |
| [RUN002](RUN002.md) | `rule-failed` | error | A rule of a plugin failed on the deck. |
| [RUN003](RUN003.md) | `no-equilibrium` | warning | Positions are far from an equilibrium. |
| [RUN004](RUN004.md) | `floating-pipe` | warning | Elements in contact float: their submerged weight is negative. |
| [RUN005](RUN005.md) | `rigid-reaction` | warning | A rigid seabed holds elements with a force that is not known. |
| [RUN006](RUN006.md) | `other-lengths` | warning | Positions whose distances are not the lengths of the elements. |
| [RUN007](RUN007.md) | `no-positions` | warning | Elements that get no position. |
| [RUN008](RUN008.md) | `rounded-positions` | warning | Coordinates rounded so much that it makes the friction. |
"""

_PAGE = """{made}

# {code} {slug}

{title}

Severity: {severity}{off}. Fix: {fix}. [All rules](README.md).

{why}

Bad{remark}:

```mudline
{bad}
```

What `mudline lint --output-format concise` says, wrapped:

```text
{says}
```

Good:

```mudline
{good}
```
"""


def rule_index(rules: Iterable[Rule]) -> str:
    """docs/rules/README.md."""
    return _INDEX.format(made=MADE, rows="\n".join(_row(rule) for rule in rules))


def _row(rule: Rule) -> str:
    code = rule.code
    severity = f"{code.severity}, off" if rule.off else code.severity
    fields = (f"[{code.code}]({code.code}.md)", f"`{code.slug}`", severity, _fix(rule), marked(rule.page.title))
    return f"| {' | '.join(fields)} |"


def _fix(rule: Rule) -> str:
    """Which fixes the findings of the bad deck have."""
    return ", ".join(sorted({found.fix.applicability for found in _found(rule) if found.fix})) or "none"


def _wrapped(found: Diagnostic) -> str:
    """A finding as concise text, in lines that a page shows whole."""
    return fill(str(found), _WIDTH, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)


def _found(rule: Rule) -> list[Diagnostic]:
    """What a rule finds in its bad deck."""
    return lint_bytes(rule.page.bad_bytes, rule.page.file, [rule], folder=Path("decks"), dialect=rule.page.dialect)


def rule_page(rule: Rule) -> str:
    """docs/rules/CODE.md."""
    return _PAGE.format(
        made=MADE,
        code=rule.code.code,
        slug=rule.code.slug,
        severity=rule.code.severity,
        off=", off unless selected" if rule.off else "",
        title=marked(rule.page.title),
        why=marked(rule.page.why),
        remark=f" ({remark})" if (remark := _remark(rule.page)) else "",
        bad=rule.page.bad.rstrip("\n"),
        says="\n".join(map(_wrapped, _found(rule))),
        fix=_fix(rule),
        good=rule.page.good.rstrip("\n"),
    )


def _remark(page: RulePage) -> str:
    """Return the property of the bad deck's file that its text does not show, or ""."""
    if page.dialect != "mudline":
        return f"with --dialect {page.dialect}"
    if page.encoding != "utf-8":
        return f"saved as {page.encoding.upper()}"
    return "" if page.bad.endswith("\n") else "the file ends without a line end"
