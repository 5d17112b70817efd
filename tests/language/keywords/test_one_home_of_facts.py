"""No module outside `keywords/` lists keywords to know a fact about them: facts are declared in the keywords' classes.

A module may ask for the one block that it reads: the name is then an argument of one of `ASKING`, a key of what is
found by keyword, one side of an `in`, or a constant KEYWORD. Anything else needs a reason in `EXCEPTIONS`.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest

import mudline
from mudline.language.keywords import catalogue
from mudline.language.keywords.names_only import NAMES
from tests.language.keywords.index import INDEX, index_text
from tests.language.keywords.stubs import stubs

ROOT = Path(mudline.__file__).parent

ASKING = frozenset(
    {
        *("blocks", "possible_definition", "misplaced", "missing", "report_missing", "has_unread_line_after"),
        *("misread", "records", "report_label", "rule_of_extension"),
        *("get", "add", "setdefault", "written"),
    }
)
CONSTANTS = frozenset({"KEYWORD", "_KEYWORD"})

EXCEPTIONS = {
    "editing/anonymizing.py": "what is given away; a deck that needs more has other forces, and is refused",
    "editing/comparison/comparing.py": "asks for the labels in the blocks of nodes and of elements",
    "tools/exporting/line_model.py": "the blocks that a line of another program says",
    "tools/exporting/report.py": "says in words what becomes of a keyword in another program",
    "tools/exporting/soil.py": "says which settings of a law another program has not",
    "editing/migration/refusals.py": "what a seabed or a deck before has instead, and whose laws a surface would meet",
    "editing/migration/rewriting.py": "writes these blocks",
    "model/results/evaluation.py": "says what may make the elements, or the nodes, that a deck lacks",
    "model/scene/laws_in_use.py": "inner pipes need no law of the seabed",
    "model/scene/weights.py": "what a deck gives to the weight of a line, and what of it is left out",
    "tools/reporting/content.py": "the title of a deck is that of its page",
    "tools/reporting/inputs.py": "the blocks that a checker asks for, in their order",
    "model/scene/curves.py": "the curves that elements on the seabed follow, by name and by set",
    "model/scene/sections.py": "curves of which it takes a slope",
    "model/scene/rules/extensions.py": "names the laws that it refuses beside a soil",
    "model/scene/rules/fields.py": "leaves the geometry of a trench to EXT003, which has words of its own for it",
    "model/scene/context.py": "a lost line of lines defines a set, as it names one",
    "model/results/stage_times.py": "the blocks that give the stages of a plan, whose lines it shows",
    "editing/variations/names.py": "asks whether the blocks that it reads may stand elsewhere",
}
"""Modules that name keywords in another way, and why."""


def _named(tree: ast.AST) -> Iterator[tuple[ast.Constant, ast.AST]]:
    """Every literal that is the name of a keyword, with what it stands in."""
    known = set(catalogue.keywords())
    for outer in ast.walk(tree):
        for inner in ast.iter_child_nodes(outer):
            if isinstance(inner, ast.Constant) and isinstance(inner.value, str) and inner.value in known:
                yield inner, outer


def _asks(named: ast.Constant, outer: ast.AST) -> bool:
    match outer:
        case ast.Call(func=ast.Attribute(attr=called) | ast.Name(id=called)):
            return called in ASKING
        case ast.Subscript(slice=index):
            return index is named
        case ast.Compare(ops=[ast.In() | ast.NotIn()], left=left):
            return left is named
        case ast.Assign(targets=[ast.Name(id=constant)]):
            return constant in CONSTANTS
    return False


def _others(module: Path) -> list[str]:
    tree = ast.parse(module.read_text(encoding="utf-8"))
    return [f"{named.lineno} {named.value!r}" for named, outer in _named(tree) if not _asks(named, outer)]


@pytest.mark.covered
def test_no_module_lists_keywords_to_know_a_fact() -> None:
    modules = (path for path in sorted(ROOT.rglob("*.py")) if "keywords" not in path.relative_to(ROOT).parts)
    found = {path.relative_to(ROOT).as_posix(): others for path in modules if (others := _others(path))}
    assert {module: others for module, others in found.items() if module not in EXCEPTIONS} == {}
    assert set(EXCEPTIONS) <= set(found), "an exception that is not needed"


def test_the_index_of_the_catalogue_says_what_the_classes_say() -> None:
    for block in catalogue.block_classes():
        name = block.model_fields["keyword"].default
        assert get_args(block.model_fields["keyword"].annotation) == (name,)
        assert block in catalogue.declarations(name)
        assert all(catalogue.block_class(section, name) is block for section in block.sections)
        assert set(block.sections) <= set(catalogue.SECTIONS)


def test_the_index_is_made_of_the_declarations() -> None:
    assert (ROOT.parents[1] / INDEX).read_text(encoding="utf-8") == index_text(), "make index"


def test_the_stubs_are_made_of_the_declarations() -> None:
    for path, text in stubs().items():
        assert (ROOT.parents[1] / path).read_text(encoding="utf-8") == text, "make index"


def test_a_keyword_is_declared_once_for_a_section() -> None:
    declared = [(section, entry.keyword) for entry in catalogue.index() for section in entry.sections]
    named = [(section, keyword) for keyword, sections in NAMES.items() for section in sections]
    assert len(declared + named) == len({*declared, *named})


def test_a_keyword_of_which_only_the_name_is_known_imports_nothing() -> None:
    script = (
        "import sys; from mudline.language.keywords import catalogue as c; [c.sections_of(k) for k in c.keywords()]; "
        "print([name for name in sys.modules if '.library.' in name])"
    )
    ran = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    assert ran.stdout == "[]\n"


def test_a_keyword_may_mean_other_things_in_other_sections() -> None:
    of_load_case, of_summary = (catalogue.block_class(name, "TIME") for name in ("LOAD CASE", "SUMMARY POSTPROCESSING"))
    assert of_load_case is not None
    assert of_summary is not None
    assert of_load_case is not of_summary
    assert catalogue.declarations("TIME") == [of_load_case, of_summary]
    assert catalogue.block_class("MODEL", "TIME") is None
    assert catalogue.declared("TIME", "SUMMARY POSTPROCESSING") is of_summary
    assert set(catalogue.sections_of("TIME") or ()) == {*of_load_case.sections, *of_summary.sections}
