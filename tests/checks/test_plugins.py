"""Rules of other packages: the example package, plugins with a fault, and rules that fail."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

import pytest

import mudline
from mudline.checks import registry
from mudline.checks.pages import ORIGINS, origin
from mudline.checks.registry import rules
from mudline.language.rules import RULES, Rule
from tests.checks.made_rules import NO_FRICTION
from tests.cli.runner import Outcome, run
from tests.helpers.processes import TIMEOUT

ROOT = Path(__file__).parents[2]
SOURCE = Path(mudline.__file__).parents[1]
FRICTION = f"{NO_FRICTION} FRICTION=0.3, 0.6\n"

RULE = '''
"""A rule."""

from mudline.plugins import Code, Problem, Severity, rule


@rule(Code("{code}", "{slug}", Severity.WARNING))
def found(context):
    """A deck has a model.

    Why not.

    Example:
        -$MODEL
        +$PREPROCESSOR

    Finds: 1:1
    """
    {body}
'''


@dataclass(frozen=True)
class Site:
    """A folder of installed packages that stands before all others."""

    folder: Path

    def run(self, *arguments: str, deck: str = NO_FRICTION) -> subprocess.CompletedProcess[str]:
        (self.folder / "deck.keyxm").write_text(deck)
        return subprocess.run(
            [sys.executable, "-m", "mudline", *arguments],
            capture_output=True,
            text=True,
            check=False,
            cwd=self.folder,
            env={**os.environ, "PYTHONPATH": os.pathsep.join([str(SOURCE), str(self.folder)])},
            timeout=60,
        )

    def add(self, text: str, *, module: str = "corp_rules", value: str = "corp_rules") -> None:
        """Install a package with one module, as an installer would leave it."""
        (self.folder / f"{module}.py").write_text(text)
        info = self.folder / f"{module}-2.1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {module}\nVersion: 2.1\n")
        (info / "entry_points.txt").write_text(f"[mudline.rules]\n{module} = {value}\n")


@pytest.fixture
def site(tmp_path: Path) -> Site:
    return Site(tmp_path)


@pytest.fixture
def lint_here(site: Site, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Outcome]]:
    """Runs the command in this process, with the rules that there are with the plugins of the site."""
    with _here(site, monkeypatch) as here:
        yield partial(here, "lint")


@pytest.fixture
def example_here(example: Site, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Outcome]]:
    """Runs a command in this process, with the rules that there are with the example package."""
    with _here(example, monkeypatch) as here:
        yield here


@contextmanager
def _here(site: Site, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Outcome]]:
    @cache
    def loaded() -> tuple[tuple[Rule, ...], tuple[str, ...]]:
        faults = registry.load(RULES)
        return tuple(RULES[code] for code in sorted(RULES)), faults

    def command(name: str, *arguments: str, deck: str = NO_FRICTION) -> Outcome:
        monkeypatch.setattr(registry, "_collected", loaded)
        (site.folder / "deck.keyxm").write_text(deck)
        return run(name, *arguments)

    rules()
    own, origins, modules = dict(RULES), dict(ORIGINS), set(sys.modules)
    monkeypatch.syspath_prepend(str(site.folder))
    monkeypatch.chdir(site.folder)
    yield command
    RULES.clear()
    RULES.update(own)
    ORIGINS.clear()
    ORIGINS.update(origins)
    for name in sys.modules.keys() - modules:
        if name.startswith(("corp_", "acme_mudline")):
            del sys.modules[name]


@pytest.fixture(scope="module")
def example(tmp_path_factory: pytest.TempPathFactory) -> Site:
    """The example package, installed beside nothing and without a network."""
    folder = tmp_path_factory.mktemp("site")
    options = ["--quiet", "--no-deps", "--no-index", "--no-build-isolation", "--disable-pip-version-check"]
    install = [sys.executable, "-m", "pip", "install", *options, "--target", str(folder)]
    subprocess.run([*install, str(ROOT / "samples" / "plugin")], capture_output=True, timeout=TIMEOUT, check=True)
    return Site(folder)


def test_the_example_finds_what_it_is_for(example: Site) -> None:
    done = example.run("lint", "--output-format", "concise", "deck.keyxm")
    assert done.returncode == 1
    assert done.stdout.startswith("deck.keyxm:4:2: ACM001 the friction coefficients of set ALL")
    assert example.run("lint", "deck.keyxm", deck=FRICTION).returncode == 0


def test_the_example_is_chosen_left_out_and_suppressed_as_any_rule(example_here: Callable[..., Outcome]) -> None:
    assert example_here("lint", "--select", "ACM", "deck.keyxm").code == 1
    assert example_here("lint", "--ignore", "friction-not-given", "deck.keyxm").code == 0
    hidden = NO_FRICTION.replace(" SET=ALL", "C mudline: ignore ACM001\n SET=ALL")
    assert example_here("lint", "deck.keyxm", deck=hidden).code == 0


def test_rules_names_the_package_of_a_rule(example_here: Callable[..., Outcome]) -> None:
    assert "A rule of acme-mudline 1.0.0." in example_here("rules", "ACM001").out
    assert "[acme-mudline 1.0.0]" in " ".join(example_here("rules").out.split())
    assert '"origin": "acme-mudline 1.0.0"' in example_here("rules", "ACM001", "--output-format", "json").out
    assert origin("CRV001") == "mudline"


def test_commands_that_run_no_rules_load_no_plugin(site: Site) -> None:
    site.add("raise SystemExit(5)")
    assert site.run("convert", "deck.keyxm", "--to", "json").returncode == 0


FAULTS = {
    "fails at import": ("import nowhere_at_all", "ModuleNotFoundError: No module named 'nowhere_at_all': report"),
    "ends the program": ("raise SystemExit(5)", "SystemExit: 5: report it to its authors"),
    "adds nothing": ("", "it adds no rule: use the decorator mudline.plugins.rule"),
    "letters of mudline": (RULE.format(code="CRV900", slug="model", body="yield"), "CRV900 belong to mudline"),
    "code of mudline": (
        RULE.format(code="CRV001", slug="model", body="yield"),
        "there is already a rule CRV001 or model",
    ),
    "docstring in no form": (
        RULE.format(code="COR001", slug="model", body="yield").replace("Example:", "Bad:"),
        "ValueError: the docstring of COR001 must have Example: report it to its authors",
    ),
    "blocks evaluation": (
        RULE.format(code="COR001", slug="model", body="yield").replace("WARNING)", "WARNING), blocks=True"),
        "COR001 is declared to block evaluation, and rules of other packages only advise: leave it out",
    ),
    "code in no form": (RULE.format(code="cor-1", slug="model", body="yield"), "the code 'cor-1' must be"),
    "name in no form": (RULE.format(code="COR001", slug="The Model", body="yield"), "the name 'The Model' of COR001"),
}


@pytest.mark.parametrize(("text", "told"), FAULTS.values(), ids=FAULTS)
def test_a_plugin_with_a_fault_stops_the_run_in_words(
    site: Site, lint_here: Callable[..., Outcome], text: str, told: str
) -> None:
    site.add(text)
    done = lint_here("deck.keyxm")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("mudline: the plugin corp_rules of corp_rules 2.1 cannot be used: ")
    assert told in done.err
    assert done.err.endswith("or uninstall the package\n")
    assert "Traceback" not in done.err


FAILURES = {
    "ends the program": ("raise SystemExit(0)", "SystemExit: 0"),
    "raises": ("raise ZeroDivisionError('by zero')", "ZeroDivisionError: by zero"),
    "finds a string": ("yield 'model'", "AttributeError: 'str' object has no attribute 'code'"),
    "gives nothing": ("return None", "TypeError: 'NoneType' object is not iterable"),
    "finds of another rule": (
        "yield Problem(Code('COR002', 'other', Severity.ERROR), 'x')",
        "ValueError: it gave a finding of COR002",
    ),
}


@pytest.mark.parametrize(("body", "told"), FAILURES.values(), ids=FAILURES)
def test_a_rule_that_fails_is_a_finding_and_the_run_goes_on(
    site: Site, lint_here: Callable[..., Outcome], body: str, told: str
) -> None:
    site.add(RULE.format(code="COR001", slug="model", body=body))
    (site.folder / "other.keyxm").write_text("$MODEL\n*SEABED PROPERTIES\n SET=ALL\n")
    done = lint_here("--output-format", "concise", "deck.keyxm", "other.keyxm")
    lines = done.out.splitlines()
    assert done.code == 1
    assert [line.partition(":")[0] for line in lines if "RUN002" in line] == ["deck.keyxm", "other.keyxm"]
    assert all("the rule COR001 of corp_rules 2.1 failed on this deck" in line for line in lines if "RUN002" in line)
    assert told in lines[0]
    assert any("SBD003" in line for line in lines)


def test_an_entry_point_may_name_a_function(site: Site) -> None:
    inner = RULE.format(code="COR001", slug="model", body="yield Problem(MODEL, 'write no model', Span(0, 1))")
    inner = inner.replace("Severity, rule", "Severity, Span, rule").replace(
        "@rule", 'MODEL = Code("COR001", "model", Severity.WARNING)\n\n\n@rule'
    )
    site.add(inner, module="corp_inner", value="corp_door:register")
    (site.folder / "corp_door.py").write_text("def register():\n    import corp_inner\n")
    done = site.run("lint", "--select", "COR", "--output-format", "concise", "deck.keyxm")
    assert done.stdout == "deck.keyxm:1:1: COR001 write no model\n"
