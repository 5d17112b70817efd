"""A mutant in a function that others hold, also where it leaves the function fewer variables."""

from __future__ import annotations

import ast
from types import FunctionType

from tests.mutants.__main__ import PACKAGES, SOURCE, codes, forked, modules_of, named
from tests.mutants.operators import mutants

TEXT = "def total(rows, *, limit=2):\n    share = limit\n    return [row + share for row in rows]\n"


def test_a_function_gets_the_code_of_each_mutant() -> None:
    space: dict[str, object] = {}
    exec(compile(TEXT, "made", "exec"), space)  # noqa: S102 - our own text
    function = space["total"]
    assert isinstance(function, FunctionType)
    assert function([1, 2]) == [3, 4]
    found = []
    tree = ast.parse(TEXT)
    for mutant in mutants(tree):
        old = function.__code__
        function.__code__ = codes(compile(tree, "made", "exec"))[named(old)]
        found.append((mutant.after, function([1, 2])))
        function.__code__ = old
    assert found == [("return", None), ("row - share", [-1, 0])]


def test_what_a_process_of_its_own_gives() -> None:
    assert forked(lambda: (1, "a")) == (0, (1, "a"))
    assert forked(lambda: 3) == (3, 3)


def test_every_package_has_modules_and_tests() -> None:
    for parts, tests in PACKAGES.values():
        for part in parts:
            assert (SOURCE / part).is_dir() or (SOURCE / f"{part}.py").is_file()
        assert all((SOURCE.parents[1] / test).exists() for test in tests)
    (path,), _ = modules_of("model/curves/points")
    assert path.name == "points.py"
