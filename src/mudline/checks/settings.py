"""Settings under which a deck is linted: its configuration, overridden by those of a caller."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.basics.patterns import matches
from mudline.checks.configuration import NO_OUTSIDE, CallerSettings, Configuration, Configured
from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.registry import code_fault, rules, select
from mudline.language.diagnostics import Severity


def _codes(words: list[str]) -> frozenset[str]:
    return frozenset(rule.code.code for rule in select(words)) if words else frozenset()


@dataclass
class Settings:
    """Settings of each deck, shared by decks with the same ones; methods raise ConfigurationError and UnknownRule."""

    configured: Configured
    given: CallerSettings
    fixing: Fixing = Fixing.NONE
    _made: dict[object, LintSettings] = field(default_factory=dict)

    def of(self, path: str) -> LintSettings:
        """Return the settings of a file, by its path or the name given for standard input."""
        found = self.configured.of(path)
        ignores = found.value("per-file-ignores").items()
        hidden = tuple(code for glob, codes in ignores if matches(found.relative(path), [glob]) for code in codes)
        if (found.path, hidden) not in self._made:
            self._made[found.path, hidden] = self.merged(found, hidden)
        return self._made[found.path, hidden]

    def merged(self, found: Configuration, hidden: tuple[str, ...] = ()) -> LintSettings:
        """Return a configuration overridden by the caller's settings; `hidden` are codes that it ignores in a file."""
        given, severity = self.given, found.value("severity")
        chosen = list(given.chosen) or found.value("select")
        ignored, also = [*given.ignored, *hidden], [*given.also]
        if not given.chosen:
            ignored += [*found.value("ignore"), *(code for code, word in severity.items() if word == "off")]
            also += found.value("extend-select")
        running = select(chosen, ignored, also)
        severities = {
            rule.code.code: Severity(word)
            for code, word in sorted(severity.items(), key=lambda item: len(item[0]))
            if word != "off"
            for rule in select([code])
        }
        unfixable, fixable = _codes(found.value("unfixable")), found.value("fixable")
        if fixable:
            unfixable |= {rule.code.code for rule in rules()} - _codes(fixable)
        return LintSettings(
            running,
            given.units,
            given.dialect or found.value("dialect"),
            severities,
            self.fixing,
            unfixable,
            given.no_outside or found.value(NO_OUTSIDE),
        )


def nearest_settings() -> Settings:
    """Return the settings of decks that depend on their configurations alone."""
    return Settings(Configured(code_fault=code_fault), CallerSettings())
