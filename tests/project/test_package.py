"""What holds for the package as a whole: its version, its files, its dependencies, its wheel."""

from __future__ import annotations

import re
import subprocess
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

from hatch_build import description
from tests.helpers.checkout import build
from tests.helpers.lowest import constraints

ROOT = Path(__file__).parents[2]
GRAMMAR = sorted(path.name for path in (ROOT / "grammar").glob("*.lark"))


TABLES = ("deck.tables", "blocks.tables", "expression.tables")
LONGEST_FILE = 450


def contents(folder: Path) -> dict[str, bytes]:
    """The files in the wheel of a folder."""
    (wheel,) = folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture
def wheel_names(packages: Path) -> set[str]:
    return set(contents(packages))


@pytest.mark.slow
def test_the_source_archive_makes_the_same_wheel(packages: Path, tmp_path: Path) -> None:
    (source,) = packages.glob("*.tar.gz")
    with tarfile.open(source) as archive:
        archive.extraction_filter = getattr(tarfile, "data_filter", None)  # since Python 3.11.4
        archive.extractall(tmp_path / "unpacked")  # noqa: S202 - made by this test
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    build(unpacked, tmp_path / "archive", "wheel")
    one, other = contents(packages), contents(tmp_path / "archive")
    assert list(one) == list(other)
    differ = {Path(name).name for name, data in one.items() if data != other[name]}
    assert differ <= {"RECORD", *TABLES}  # lark numbers the states of a parser in another order each time


def test_wheel_holds_every_module(wheel_names: set[str]) -> None:
    source = ROOT / "src"
    modules = {path.relative_to(source).as_posix() for path in (source / "mudline").rglob("*.py")}
    assert modules <= wheel_names


def test_wheel_holds_the_grammar_and_the_marker_of_types(wheel_names: set[str]) -> None:
    assert {f"mudline/grammar/{name}" for name in (*GRAMMAR, *TABLES)} <= wheel_names
    assert {"mudline/py.typed", "mudline/language/keywords/index.json"} <= wheel_names


def test_wheel_holds_the_pages_of_rules_and_the_decks_that_examples_stand_on(wheel_names: set[str]) -> None:
    pages = {f"mudline/docs/rules/{path.name}" for path in (ROOT / "docs/rules").glob("*.md")}
    assert len(pages) > 100
    decks = {path.relative_to(ROOT / "src").as_posix() for path in (ROOT / "src").rglob("*.keyxm")}
    assert decks
    assert pages | decks <= wheel_names


# ----------------------------------------------------------------------------------------- what an index and users show


README = (ROOT / "README.md").read_text(encoding="utf-8")
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]*)\)")


def test_the_description_has_links_to_the_site_that_the_project_names() -> None:
    text = description(README, "https://mudline.example/docs/")
    assert PICTURE.findall(text) == ["https://mudline.example/docs/images/touchdown.png"]
    targets = re.findall(r"\]\(([^)]*)\)", text)
    assert len(targets) > 20
    assert [target for target in targets if not target.startswith("https://")] == []
    assert "https://mudline.example/docs/rules/index.html" in targets
    assert "https://mudline.example/docs/project/samples/index.html" in targets
    assert "](https://mudline.example/docs/tutorials/first-deck.html)" in text


def test_the_readme_is_short_and_has_a_picture() -> None:
    assert 5000 < len(README.encode()) < 9000
    assert len(PICTURE.findall(README)) == 1


def test_no_file_that_a_user_copies_has_an_address_to_fill_in_or_an_invented_one() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    own = {str(address) for address in project.get("urls", {}).values()}
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)  # noqa: S607
    copied = (".github/", "docs/", "editors/", "samples/", "action.yml", "Dockerfile", "README.md", "CONTRIBUTING.md")
    names = [
        name for name in listed.stdout.splitlines() if name.startswith((*copied, "CITATION", "SECURITY", "pyproj"))
    ]
    assert len(names) > 300
    found = []
    for name in names:
        text = (ROOT / name).read_bytes().decode("utf-8", "ignore")
        addresses = re.findall(r"(?:https?://|git@)[^\s\"')>]*/mudline[^\s\"')>]*", text)
        found += [f"{name}: {one}" for one in addresses if one not in own]
        found += [f"{name}: {one}" for one in re.findall(r"\bOWNER\b|YOUR[-_ ]?(?:ORG|NAME)\b", text)]
    assert found == []


def test_the_extras_are_few_and_each_has_its_row_on_the_page_that_installs() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    page = (ROOT / "docs/install.md").read_text(encoding="utf-8")
    assert re.findall(r"^\| `([a-z]+)` \|", page, re.MULTILINE) == [
        *(name for name in extras if name not in {"all", "archive", "cluster"}),
        *("all", "archive", "cluster"),
    ]
    named = {word for path in ROOT.rglob("docs/**/*.md") for word in _EXTRAS.findall(path.read_text(encoding="utf-8"))}
    named |= {word for path in ROOT.rglob("src/**/*.py") for word in _EXTRAS.findall(path.read_text(encoding="utf-8"))}
    assert {name for words in named for name in words.split(",")} <= extras.keys()


_EXTRAS = re.compile(r"\bmudline\[([a-z,]+)\]")


def test_dependencies_have_lower_bounds_only() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"].values()
    requirements = [*project["dependencies"], *(line for extra in extras for line in extra)]
    others = [line for line in requirements if not line.startswith("mudline[")]
    assert len(others) > 5
    assert [line for line in others if not re.fullmatch(r"[a-z0-9-]+>=[0-9.]+", line)] == []


def test_the_oldest_libraries_are_those_of_the_project() -> None:
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    found = constraints(text)
    assert "pydantic==2.11" in found
    assert all(re.fullmatch(r"[a-z0-9-]+==[0-9.]+", line) for line in found)
    assert {line.partition("==")[0] for line in found} >= {"click", "matplotlib", "numba", "pyarrow", "scipy"}


def test_no_file_is_too_long_to_read() -> None:
    files = [path for folder in ("src", "tests") for path in (ROOT / folder).rglob("*.py")]
    lengths = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8").count("\n") for path in files}
    assert len(lengths) > 5
    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE} == {}
