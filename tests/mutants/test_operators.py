"""Mutants of a few lines."""

from __future__ import annotations

import ast

from tests.mutants.operators import mutants

TEXT = '''
LIMIT = 3

def found(rows, limit=7):
    """Texts, defaults and what stands outside of functions are left alone."""
    rows: list[tuple[int, 1]]
    for row in rows:
        if not row or row.size <= limit and -row.size in rows:
            break
        rows.sort(key="a", reverse=True)
    return [2 * row for row in rows if row]
'''
MUTANTS = {
    8: [
        (
            "not row or (row.size <= limit and -row.size in rows)",
            "not (not row or (row.size <= limit and -row.size in rows))",
        ),
        (
            "not row or (row.size <= limit and -row.size in rows)",
            "not row and (row.size <= limit and -row.size in rows)",
        ),
        ("not row", "not not row"),
        ("row.size <= limit and -row.size in rows", "row.size <= limit or -row.size in rows"),
        ("row.size <= limit", "row.size < limit"),
        ("row.size <= limit", "row.size > limit"),
        ("-row.size in rows", "-row.size not in rows"),
        ("-row.size", "+row.size"),
    ],
    9: [("break", "continue")],
    10: [
        ("rows.sort(key='a', reverse=True)", "None"),
        ("rows.sort(key='a', reverse=True)", "rows.sort(reverse=True)"),
        ("rows.sort(key='a', reverse=True)", "rows.sort(key='a')"),
        ("True", "False"),
    ],
    11: [
        ("return [2 * row for row in rows if row]", "return"),
        ("2 * row", "2 / row"),
        ("2", "3"),
        ("[each for row in rows if row]", "[each for row in rows if not row]"),
    ],
}


def test_what_is_changed_and_that_it_is_put_back() -> None:
    tree = ast.parse(TEXT)
    before = ast.unparse(tree)
    made: dict[int, list[tuple[str, str]]] = {}
    texts = {before}
    for mutant in mutants(tree):
        made.setdefault(mutant.line, []).append((mutant.before, mutant.after))
        texts.add(ast.unparse(tree))
        compile(tree, "mutant", "exec")
        assert mutant.lines == range(mutant.line, mutant.line + 1)
    assert made == MUTANTS
    assert len(texts) == 1 + sum(map(len, made.values()))
    assert ast.unparse(tree) == before
