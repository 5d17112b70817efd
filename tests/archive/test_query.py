"""Questions in SQL: what they may do, and the forms of answers."""

from __future__ import annotations

import csv
import io
import signal
import sys
from pathlib import Path

import pytest

if sys.platform == "linux":
    import resource

from mudline.archive import database
from tests.archive.trial import deck, index, write
from tests.cli.runner import assert_fits, run
from tests.processes import TIMEOUT, started

OUTSIDE = "a question reads the tables of the archive and nothing else"


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("place")
    decks = write(folder / "decks", a=deck("a"), b=deck("b", depth=600.0, curve="O'Neil; DROP TABLE decks --"))
    index(decks, archive=folder / "archive")
    return folder / "archive"


@pytest.mark.parametrize(
    ("sql", "why"),
    [
        ("SELECT * FROM read_text('/etc/passwd')", OUTSIDE),
        ("SELECT * FROM read_csv('/etc/passwd')", OUTSIDE),
        ("SELECT * FROM read_blob('../decks/a.keyxm')", OUTSIDE),
        ("SELECT * FROM glob('/etc/*')", OUTSIDE),
        ("SELECT * FROM read_parquet('https://localhost/x.parquet')", OUTSIDE),
        ("SELECT * FROM read_json('/etc/passwd')", OUTSIDE),
        ("SELECT * FROM read_blob('data/../../decks/a.keyxm')", OUTSIDE),
        ("SELECT * FROM sniff_csv('/etc/passwd')", OUTSIDE),
        ("SELECT * FROM parquet_metadata('/etc/passwd')", OUTSIDE),
        ("SELECT * FROM query('SELECT * FROM read_text(''/etc/passwd'')')", OUTSIDE),
        ("SELECT * FROM duckdb_secrets()", OUTSIDE),
        ("SELECT getenv('HOME')", "does not exist"),
        ("EXPLAIN COPY decks TO '/tmp/out.csv'", OUTSIDE),
        ("PREPARE x AS COPY decks TO 'out.csv'", "PREPARE is not allowed"),
        ("CALL pragma_version()", "CALL is not allowed"),
        ("VACUUM", "VACUUM is not allowed"),
        ("SELECT * FROM '/etc/passwd'", "does not exist"),
        ("COPY decks TO 'out.csv'", "COPY is not allowed"),
        ("COPY decks TO '/tmp/out.csv'", "COPY is not allowed"),
        ("EXPLAIN ANALYZE COPY decks TO 'out.csv'", "EXPLAIN is not allowed"),
        ("EXPLAIN /* */ ANALYSE COPY decks TO 'out.csv'", "EXPLAIN is not allowed"),
        ("ATTACH 'other.db'", "ATTACH is not allowed"),
        ("INSTALL httpfs", "LOAD is not allowed"),
        ("LOAD httpfs", "LOAD is not allowed"),
        ("SET enable_external_access = true", "SET is not allowed"),
        ("RESET lock_configuration", "SET is not allowed"),
        ("DROP VIEW decks", "DROP is not allowed"),
        ("INSERT INTO decks VALUES (1)", "INSERT is not allowed"),
        ("CREATE TABLE t AS SELECT 1", "CREATE is not allowed"),
        ("PRAGMA database_list", "PRAGMA is not allowed"),
        ("EXPORT DATABASE 'out'", "EXPORT is not allowed"),
        ("SELECT * FROM archive", "archive does not exist"),
        ("SELECT 1; SELECT 2", "found 2"),
        ("/* nothing */", "found 0"),
    ],
)
def test_a_question_reads_the_archive_only(archive: Path, sql: str, why: str) -> None:
    before = sorted(archive.rglob("*"))
    outcome = run("query", archive, sql)
    assert outcome.code == 2
    assert why in outcome.err
    assert outcome.out == ""
    assert sorted(archive.rglob("*")) == before


def test_the_locks_hold_without_the_look_at_the_statement(archive: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(database, "_READING", ("SELECT", "EXPLAIN", "COPY", "ATTACH", "LOAD", "SET", "EXPORT"))
    for sql in (
        "COPY decks TO '/tmp/mudline-out.csv'",
        "ATTACH '/tmp/mudline-other.db'",
        "INSTALL httpfs",
        "LOAD httpfs",
        "SET enable_external_access = true",
        "SET allowed_directories = ['/']",
        "SET autoload_known_extensions = true",
        "EXPORT DATABASE '/tmp/mudline-out'",
    ):
        outcome = run("query", archive, sql)
        assert (outcome.code, outcome.out) == (2, ""), sql
        assert OUTSIDE in outcome.err or "locked" in outcome.err or "disabled" in outcome.err, outcome.err


@pytest.mark.parametrize(
    ("sql", "place"),
    [
        ("SELECT nothing FROM decks", "line 1, column 8 of the SQL: "),
        ("SELECT *\nFROM nothing", "line 2, column 6 of the SQL: "),
        ("SELEC 1", "line 1, column 1 of the SQL: "),
        ("SELECT file FROM decks\nWHERE 'x'::INTEGER = 1", "line 2, column 10 of the SQL: "),
        ("SELECT 'é', nothing FROM decks", "line 1, column 13 of the SQL: "),
    ],
)
def test_an_error_has_its_place(archive: Path, sql: str, place: str) -> None:
    outcome = run("query", archive, sql)
    assert outcome.code == 2
    assert place in outcome.err
    assert outcome.err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (["SELECT $x"], "Values were not provided for the following parameters: x"),
        (["SELECT 1", "--memory-limit", "much"], "Memory"),
        (["SELECT 1", "-o", "out.xyz"], "unknown file format"),
        (["SELECT 1", "--output-format", "parquet"], "give -o OUT.parquet"),
        ([], "Missing argument 'SQL'"),
    ],
)
def test_wrong_usage(archive: Path, words: list[str], why: str) -> None:
    outcome = run("query", archive, *words)
    assert outcome.code == 2
    assert why in outcome.err


def test_forms_of_an_answer(archive: Path, tmp_path: Path) -> None:
    values = "'nan'::DOUBLE AS lost, 1.5::DECIMAL(4, 2) AS part, [1, 2] AS list, TRUE AS yes"
    sql = f"SELECT file, depth, {values} FROM decks ORDER BY file"  # noqa: S608 - names of ours
    text = run("query", archive, sql).out
    assert text.splitlines()[0] == "Answer"
    assert text.splitlines()[-2] == "2 rows"
    assert text.splitlines()[3].split() == ["decks/a.keyxm", "500", "1.5", "[1,", "2]", "true"]
    rows = run("query", archive, sql, "--output-format", "json").json()
    assert rows[1] == {"file": "decks/b.keyxm", "depth": 600.0, "lost": None, "part": 1.5, "list": [1, 2], "yes": True}
    assert_fits(rows, "query")
    table = list(csv.reader(io.StringIO(run("query", archive, sql, "--output-format", "csv").out)))
    assert table[0] == ["file", "depth", "lost", "part", "list", "yes"]
    assert table[2] == ["decks/b.keyxm", "600.0", "", "1.5", "[1, 2]", "true"]
    for name in ("out.parquet", "out.csv", "out.json"):
        outcome = run("query", archive, sql, "-o", tmp_path / name)
        assert (outcome.code, outcome.out) == (0, "")
    parquet = pytest.importorskip("pyarrow.parquet")
    assert parquet.read_table(tmp_path / "out.parquet").column("depth").to_pylist() == [500.0, 600.0]
    assert run("query", archive, sql, "--output-format", "csv").output == (tmp_path / "out.csv").read_bytes()


def test_an_empty_answer(archive: Path) -> None:
    sql = "SELECT file FROM decks WHERE false"
    assert run("query", archive, sql, "--output-format", "json").json() == []
    assert run("query", archive, sql, "--output-format", "csv").out.split() == ["file"]
    assert run("query", archive, sql).out.splitlines()[-2] == "0 rows"


def test_most_rows_of_a_table_need_v(archive: Path) -> None:
    sql = "SELECT range AS n FROM range(100)"
    assert "60 more rows: -v shows all" in run("query", archive, sql).out
    assert run("query", archive, sql, "-v").out.splitlines()[-3] == "99"


@pytest.mark.parametrize(
    "sql",
    [
        "SELECT list(range) FROM range(100000000)",
        "SELECT a.file || r FROM decks AS a, decks AS b, (SELECT range AS r FROM range(3000000)) ORDER BY 1 DESC",
    ],
)
def test_a_question_that_needs_too_much_memory_ends(archive: Path, sql: str) -> None:
    outcome = run("query", archive, sql, "--memory-limit", "60MB")
    assert outcome.code == 2
    assert "raise --memory-limit" in outcome.err


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux holds a process to so much memory")
@pytest.mark.parametrize(
    "sql",
    [
        "SELECT repeat('x', 3000000000)",
        "SELECT string_agg(repeat('x', 1000000), '') FROM range(3000)",
        "WITH RECURSIVE r AS (SELECT repeat('x', 1000) AS t UNION ALL SELECT t || t FROM r) SELECT length(t) FROM r",
    ],
)
def test_memory_is_limited_also_where_duckdb_does_not_count_it(archive: Path, sql: str) -> None:
    limits = resource.getrlimit(resource.RLIMIT_DATA)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    outcome = run("query", archive, sql, "--memory-limit", "60MB")
    assert outcome.code == 2
    assert "needs more memory than it may use" in outcome.err
    assert resource.getrlimit(resource.RLIMIT_DATA) == limits
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < before + 700_000


def test_a_question_that_is_too_deep_ends(archive: Path) -> None:
    outcome = run("query", archive, f"SELECT {'(' * 5000}1{')' * 5000}")
    assert outcome.code == 2
    assert outcome.err == "mudline: Max expression depth limit of 1000 exceeded.\n"


@pytest.mark.parametrize(
    ("sql", "words", "why"),
    [
        ("SELECT 1 AS a, 2 AS a", "--output-format json", "several columns of the answer are called 'a': name them"),
        ("SELECT 1 AS a, 2 AS a", "-o a.parquet", "several columns of the answer are called 'a': name them with AS"),
        ("SELECT 'infinity'::DATE AS d", "", "column d: days=2147483647; must have magnitude <= 999999999: cast it"),
        ("SELECT '290309-12-22'::DATE AS d", "--output-format json", "column d: date value out of range: cast it to V"),
        ("SELECT INTERVAL '1 month' AS i", "-o a.parquet", "Parquet has no such type: cast the column in the SQL: "),
    ],
)
def test_values_that_a_form_cannot_hold(archive: Path, tmp_path: Path, sql: str, words: str, why: str) -> None:
    outcome = run("query", archive, sql, *words.replace("a.parquet", str(tmp_path / "a.parquet")).split())
    assert outcome.code == 2
    assert why in outcome.err
    assert not list(tmp_path.iterdir())


INTERRUPTED = """
import os, signal, sys, threading
from mudline.__main__ import main
from mudline.archive.database import Database
plain = Database.ask
def ask(self, sql):
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    return plain(self, sql)
Database.ask = ask
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_ctrl_c_ends_a_long_question(archive: Path) -> None:
    sql = "SELECT count(*) FROM range(100000000) x, range(100000000) y WHERE (x.range + y.range) % 7 = 3"
    with started("-c", INTERRUPTED, "query", str(archive), sql, "--jobs", "1") as running:
        assert running.process.wait(TIMEOUT) == 128 + signal.SIGINT
        assert b"Traceback" not in running.err.read()


def test_a_missing_extra_is_named(archive: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.cli.index_command.find_spec", lambda _: None)
    for words in (("query", archive, "SELECT 1"), ("index", tmp_path, "-o", tmp_path / "x")):
        outcome = run(*words)
        assert outcome.code == 2
        assert f"mudline {words[0]} needs duckdb and pyarrow: pip install 'mudline[archive]'" in outcome.err
