"""Registry of all rules: of reading and resolving, of advice, and of plugins; selection among them.

Rules of other packages are found through the entry point group `mudline.rules`, and loaded when rules are first used.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, cast

from mudline.basics.installed import may_declare
from mudline.basics.resources import modules_of
from mudline.basics.spelling import nearest
from mudline.checks.context import LintContext
from mudline.checks.pages import GROUP, ORIGINS
from mudline.language.codes import all_codes
from mudline.language.diagnostics import Code, PluginError, Problem, Severity, Where
from mudline.language.rules import RULES, Check, Rule, add

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

RUN002 = Code("RUN002", "rule-failed", Severity.ERROR)

STRIPPED = (
    "rules are described by docstrings, which python -OO and PYTHONOPTIMIZE=2 strip: run Python with -O or without"
)
"""Reason why there are no rules."""

RESERVED = {"DOC", "DAT", "EXP", "MIG", "RUN"}
"""Letters of mudline's codes that no rule has; they are reserved, as are those of its rules."""

_FEW = 4
"""Number of rules, at most, that are listed for a word in their names."""


class UnknownRule(ValueError):  # noqa: N818 - the name of the fault, as callers catch it
    """Word that names no rule."""


@cache
def _collected() -> tuple[tuple[Rule, ...], tuple[str, ...]]:
    if sys.flags.optimize > 1:
        raise RuntimeError(STRIPPED)
    for code in all_codes():
        if code.page:
            add(Rule(code, None, code.page))
    modules_of("mudline.model.scene.rules")
    modules_of("mudline.checks.rules")
    faults = load(RULES)
    return tuple(RULES[code] for code in sorted(RULES)), faults


def rules() -> tuple[Rule, ...]:
    """Return all rules, by code, including those of installed plugins.

    Raises PluginError if a plugin cannot be used: a run with fewer rules than expected is worse than no run.
    """
    all_rules, faults = _collected()
    if faults:
        raise PluginError(faults)
    return all_rules


def find(word: str) -> list[Rule]:
    """Return the rules that a code, a prefix of a code or a slug names, in any case."""
    stripped = word.strip()
    code, slug = stripped.upper(), stripped.lower()
    exact = [rule for rule in rules() if code == rule.code.code or slug == rule.code.slug]
    if exact or not stripped.isalnum():
        return exact
    return [rule for rule in rules() if rule.code.code.startswith(code)]


def select(chosen: Iterable[str] = (), ignored: Iterable[str] = (), also: Iterable[str] = ()) -> tuple[Rule, ...]:
    """Return the rules that codes, prefixes of codes or slugs choose, and `also`, without those ignored; by code.

    If nothing is chosen, all rules run except those that are off. A rule that is off runs if a word in `chosen` or
    `also` names it, even by a prefix. Ignored rules are left out, whatever else names them.

    Raises UnknownRule, with a suggestion, for a word that names no rule.
    """
    codes = _named(chosen) or {rule.code.code for rule in rules() if not rule.off}
    codes = (codes | _named(also)) - _named(ignored)
    return tuple(rule for rule in rules() if rule.code.code in codes)


def _named(words: Iterable[str]) -> set[str]:
    codes: set[str] = set()
    for word in words:
        named = find(word)
        if not named:
            raise UnknownRule(f"{word!r} names no rule{_hint(word)}")
        codes |= {rule.code.code for rule in named}
    return codes


def _hint(word: str) -> str:
    codes = [rule.code.code for rule in rules()]
    if word.isalpha():  # a code has digits: this was to be a beginning
        codes = sorted({code.rstrip("0123456789") for code in codes})
    slugs = [rule.code.slug for rule in rules()]
    near = nearest(word, slugs) or nearest(word, codes)
    holding = [slug for slug in slugs if word.casefold() in slug.split("-")]
    if not near and 0 < len(holding) <= _FEW:
        near = " or ".join(holding)
    return f": did you mean {near}?" if near else ": `mudline rules` lists all rules"


# ------------------------------------------------------------------------------------------- rules of other packages


def load(known: dict[str, Rule]) -> tuple[str, ...]:
    """Add the rules of every installed plugin to the known rules; return the faults of plugins that cannot be used.

    A plugin with a fault adds nothing. Added rules cannot end a run: see `Guarded`.
    """
    own = RESERVED | {code.rstrip("0123456789") for code in known}
    faults: list[str] = []
    for entry in sorted(_entries(), key=lambda entry: (entry.name, entry.value)):
        before = dict(known)
        package = f"{entry.dist.name} {entry.dist.version}" if entry.dist else entry.value
        fault = _run(entry) or _fault_of([rule for code, rule in known.items() if code not in before], own)
        if fault:
            known.clear()
            known.update(before)
            faults.append(f"the plugin {entry.name} of {package} cannot be used: {fault}, or uninstall the package")
        for code in known.keys() - before.keys():
            known[code] = known[code]._replace(check=Guarded(cast("Check", known[code].check), code, package))
            ORIGINS[code] = package
    return tuple(faults)


def _entries() -> Sequence[EntryPoint]:
    """Return the entry points of the group, each once even if its package is several times on the path."""
    if not may_declare(GROUP):
        return ()
    from importlib.metadata import entry_points  # noqa: PLC0415 - only plugins need it

    return list({(entry.name, entry.value): entry for entry in entry_points(group=GROUP)}.values())


def _run(entry: EntryPoint) -> str:
    """Import the object of an entry point, and call it unless it is a module; return the fault, or ""."""
    try:
        loaded = entry.load()
        if not isinstance(loaded, ModuleType):
            loaded()
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # noqa: BLE001 - the code of others may fail in any way, and end nothing
        return f"{_said(error)}: report it to its authors"
    return ""


def _fault_of(added: Sequence[Rule], own: set[str]) -> str:
    """Return the fault of the rules that a plugin added, or ""."""
    if not added:
        return "it adds no rule: use the decorator mudline.plugins.rule in it"
    if blocking := [rule.code.code for rule in added if rule.blocks]:
        return f"{blocking[0]} is declared to block evaluation, and rules of other packages only advise: leave it out"
    for code in (rule.code for rule in added):
        if not re.fullmatch(r"[A-Z]{2,8}[0-9]{3}", code.code):
            return f"the code {code.code!r} must be 2 to 8 capital letters and 3 digits, as ACM001: change it"
        if code.code.rstrip("0123456789") in own:
            return f"codes like {code.code} belong to mudline: choose other letters"
        if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", code.slug):
            return f"the name {code.slug!r} of {code.code} must be words in lower case with hyphens: change it"
    try:
        for rule in added:
            rule.page  # noqa: B018 - own rules are read in tests
    except ValueError as error:
        return f"{_said(error)}: report it to its authors"
    return ""


@dataclass(frozen=True, slots=True)
class Guarded:
    """Function of a plugin's rule: if it fails on a deck, the failure is a finding, and the run goes on."""

    check: Check
    code: str
    package: str

    def __call__(self, context: LintContext) -> Iterator[Problem]:
        """Yield the rule's findings as far as they come, then RUN002 if it failed, even by ending the program."""
        try:
            for problem in self.check(context):
                self._examine(problem, context)
                yield problem
        except (KeyboardInterrupt, GeneratorExit):
            raise
        except BaseException as error:  # noqa: BLE001 - the code of others may fail in any way, and end nothing
            message = (
                f"the rule {self.code} of {self.package} failed on this deck ({_said(error)}): report it to "
                f"its authors, or leave it out with --ignore {self.code}; add what it checks by hand"
            )
            yield Problem(RUN002, message, where=Where())

    def _examine(self, problem: Problem, context: LintContext) -> None:
        """Raise now, in the guard, for faults that would show later: another rule's code, a place outside the deck."""
        if problem.code.code != self.code:
            raise ValueError(f"it gave a finding of {problem.code.code}")
        context.deck.diagnose([problem])


def _said(error: BaseException) -> str:
    """Return an error in one line."""
    words = " ".join(str(error).split())[:200]
    return f"{type(error).__name__}: {words}" if words else type(error).__name__


# --------------------------------------------------------------------------------------------------- what callers ask


def code_fault(word: str) -> str:
    """Return the fault of a word that names rules, with a suggestion, or ""."""
    try:
        _named([word])
    except UnknownRule as error:
        return str(error)
    return ""


def plugin_files() -> tuple[str, ...]:
    """Return the files of every module that a plugin's package has imported: its rules may change with them."""
    packages = {rule.check.check.__module__.partition(".")[0] for rule in rules() if isinstance(rule.check, Guarded)}
    modules = [module for name, module in sys.modules.items() if name.partition(".")[0] in packages]
    return tuple(sorted(path for module in modules if (path := getattr(module, "__file__", None))))
