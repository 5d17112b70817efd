"""The README and docs/: what they show is what the program prints, what they name is there, what is made is fresh."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import click
import pytest

from mudline.checks.registry import RUN002, rules
from mudline.cli.main import COMMANDS, mudline
from mudline.language.codes import all_codes
from mudline.language.expression.evaluation import FORMS, FUNCTIONS
from tests.docs.blocks import Page, agree
from tests.docs.commands import output, run
from tests.docs.make import BY_HAND, ROOT, documents, made_files, pages
from tests.docs.refresh import copy_of_files
from tests.helpers.processes import TIMEOUT
from tests.helpers.shared import ALL

DECKS = sorted(path.name for path in (ROOT / "samples").glob("*.keyx?"))[:: 1 if ALL else 5]
JSON = {
    "lint": ("lint samples", "lint samples/flowline-gen.keyxm", "lint samples/missing.yaml"),
    "validate": ("validate samples",),
    "show": tuple(f"show samples/{name}" for name in DECKS),
    "sheet": tuple(f"show --sheet samples/{name}" for name in DECKS),
    "curves": (
        "curves samples/legacy-flowline.keyxm --at -1 --at 0.2 --at 3 --weight 400",
        "curves samples/flowline-gen.keyxm",
    ),
    "evaluate": (
        *("evaluate -q samples/legacy-flowline.keyxm", "evaluate -q samples/flowline-gen.keyxm --plan"),
        "evaluate -q samples/scr-touchdown.keyxm --positions samples/positions.csv",
        "evaluate -q samples/linear.keyxm --tension cut",
        "evaluate -q samples/full-cycle.keyxm --positions samples/full-cycle.csv",
        "evaluate -q samples/slope-friction.keyxm --positions samples/slope-friction.csv",
    ),
    "series": ("evaluate -q samples/scr-touchdown.keyxm --positions samples/positions.csv --summary-only",),
    "cases": ("batch -q samples -o results", "batch -q samples -o results --positions samples/{name}.csv"),
    "diff": (
        "diff samples/parametric.keyxm samples/variations.keyxm",
        "diff samples/variations.keyxm samples/variations.keyxm",
        "diff samples docs/examples",
        "diff samples/scr-soil.keyxm samples/scr-touchdown.keyxm samples/scr-vessel.keyxm --matrix",
        "diff samples/scr-soil.keyxm samples/scr-soil.keyxm --matrix",
    ),
    "export": (
        "export -q samples/legacy-flowline.keyxm --to moordyn -o model.txt",
        "export -q samples/imperial-riser.keyxi --to orcaflex -o model.yml",
        "export -q samples/scr-vessel.keyxm --to orcaflex -o model.yml",
    ),
    "report": ("report samples/scr-vessel.keyxm samples/broken.keyxm",),
    "expand": ("expand samples/variations.keyxm --dry-run", "expand -q samples/parametric.keyxm -o study"),
    "rules": ("rules",),
}
"""Commands that print each form of JSON, by the name of its schema."""

PAGES = documents()


def identity(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def with_blocks(*languages: str) -> list[Path]:
    return [path for path in PAGES if any(block.language in languages for block in Page.read(path).blocks)]


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder in which the commands of a page find the files that they name, and may write."""
    copy_of_files(ROOT, tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("NO_COLOR", raising=False)
    return tmp_path


@pytest.fixture
def no_diameter(checkout: Path) -> None:
    """A deck whose elements have nothing but a linear bed: no diameter, no ratio, no slope. And a file that is none."""
    deck = "$MODEL\n*NODE\n 1, -0.1, 0\n 2, -0.1, 1\n*ELEMENT\n 1, 1, 2\n*ELASTIC SURFACE\n 5000\n"
    (checkout / "samples/linear.keyxm").write_text(deck, encoding="utf-8")
    (checkout / "samples/missing.yaml").write_text("a: [", encoding="utf-8")


@pytest.mark.parametrize("path", with_blocks("console"), ids=identity)
@pytest.mark.usefixtures("checkout")
def test_commands_print_what_the_page_shows(path: Path) -> None:
    code = 0
    for block in Page.read(path).blocks:
        if block.title:
            Path(block.title).write_text(block.text, encoding="utf-8")
        commands = block.commands() if block.language == "console" else []
        if not any(command.words.startswith("mudline") for command in commands):
            continue
        for command in commands:
            if command.words == "echo $?":
                assert command.shown == [str(code)], f"{identity(path)}:{command.line}"
                continue
            code, printed = run(command.words)
            assert agree(command.shown, printed), f"{identity(path)}:{command.line} printed\n" + "\n".join(printed)


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, id=identity(path), marks=pytest.mark.nightly if path.parent.name == "studies" else ())
        for path in with_blocks("python", "pycon")
    ],
)
def test_programs_run_and_sessions_answer_what_the_page_shows(path: Path, checkout: Path) -> None:
    for language, interpreter in (("python", [sys.executable]), ("pycon", [sys.executable, "-m", "doctest"])):
        for block in Page.read(path).blocks:
            if block.title:
                (checkout / block.title).write_text(block.text, encoding="utf-8")
        program = checkout / f"{language}.txt"
        program.write_text("\n".join(block.text for block in Page.read(path).blocks if block.language == language))
        ran = subprocess.run(
            [*interpreter, program.name], cwd=checkout, capture_output=True, text=True, timeout=TIMEOUT, check=False
        )
        assert (ran.returncode, ran.stdout + ran.stderr if ran.returncode else "") == (0, "")


@pytest.mark.covered
@pytest.mark.parametrize("path", PAGES, ids=identity)
def test_links_lead_somewhere(path: Path) -> None:
    for target in Page.read(path).links():
        file, _, heading = target.partition("#")
        other = (path.parent / file).resolve() if file else path
        assert other.exists(), target
        assert not heading or heading in Page.read(other).anchors, target


@pytest.mark.covered
@pytest.mark.parametrize("path", PAGES, ids=identity)
def test_named_files_are_there(path: Path) -> None:
    missing = [name for name in Page.read(path).named_files() if not (ROOT / name).exists()]
    assert missing == []


def test_the_newcomers_map_names_files_that_are_there() -> None:
    text = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    names = set(re.findall(r"`([a-z_/]+/[a-z_]*(?:\.py|/)|[a-z_]+\.py)`", text))
    assert len(names) > 30
    folders = (ROOT, ROOT / "src/mudline")
    assert [name for name in sorted(names) if not any((folder / name).exists() for folder in folders)] == []


@pytest.mark.covered
def test_made_pages_are_fresh() -> None:
    wanted = pages()
    stale = [path for path, text in wanted.items() if not (ROOT / path).exists() or (ROOT / path).read_text() != text]
    assert stale == [], "run make docs"


def test_every_made_page_is_still_made() -> None:
    assert made_files() <= pages().keys(), "run make docs"


def test_every_code_has_a_page() -> None:
    known = {code.code for code in (*all_codes(), RUN002)}
    assert known - {rule.code.code for rule in rules()} == BY_HAND
    assert [code for code in BY_HAND if not (ROOT / f"docs/rules/{code}.md").exists()] == []


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_of_a_command_is_described(name: str) -> None:
    command = mudline.get_command(click.Context(mudline), name)
    assert command is not None
    text = (ROOT / "docs/cli.md").read_text(encoding="utf-8")
    section = re.split(rf"^## mudline {name}$", text, flags=re.MULTILINE)[1].partition("\n## ")[0]
    common = {"--color", "--quiet", "--verbose", "--units", "--stdin-filename", "--no-gitignore", "--config"}
    common |= {"--isolated", "--jobs", "--encoding", "--output", "--plot", "--no-outside", "--force-exclude"}
    options = {max(option.opts, key=len) for option in command.params if isinstance(option, click.Option)}
    for option in options - common:
        assert f"`{option}" in section, option
    for option in options & common:
        assert f"`{option}" in text, option


@pytest.mark.covered
@pytest.mark.parametrize(("schema", "words"), [(name, words) for name, given in JSON.items() for words in given])
@pytest.mark.usefixtures("no_diameter")
def test_json_has_the_form_that_is_described(schema: str, words: str) -> None:
    form = json.loads((ROOT / "docs/schemas" / f"{schema}.json").read_text(encoding="utf-8"))
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator.check_schema(form)
    printed = output(f"mudline {words} --output-format json")
    jsonschema.validate(json.loads(printed), form, jsonschema.Draft202012Validator)


def test_findings_of_a_verdict_are_those_of_lint(checkout: Path) -> None:
    del checkout
    form = json.loads((ROOT / "docs/schemas/lint.json").read_text(encoding="utf-8"))
    printed = output("mudline validate samples/broken.keyxm --output-format json")
    findings = json.loads(printed)["decks"][0]["findings"]
    assert findings
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.validate(findings, form, jsonschema.Draft202012Validator)


def test_every_schema_is_held() -> None:
    of_files = {"baseline", "config", "study"}  # held by their own tests
    assert {path.stem for path in (ROOT / "docs/schemas").glob("*.json")} == JSON.keys() | of_files


def test_every_function_of_equations_is_described() -> None:
    text = (ROOT / "docs/language.md").read_text(encoding="utf-8")
    undescribed = [name for name in (*FUNCTIONS, *FORMS) if f"`{name}(" not in text]
    assert undescribed == []
