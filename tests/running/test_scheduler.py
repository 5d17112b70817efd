"""`--scheduler`: what it prints is what it prints without, by the workers of a scheduler on loopback."""

from __future__ import annotations

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from shutil import rmtree

import pytest

from tests.archive.trial import contents
from tests.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.cli.runner import run
from tests.processes import started

pytest.importorskip("distributed", reason="distributed is not installed")

RESTART = "$LOAD CASE\n*RESTART\n LAST=00\n*NO FRICTION\n"
NOTHING = "tcp://127.0.0.1:9"
"""The address of no scheduler."""

CLUSTER = """
import sys
from distributed import LocalCluster

if __name__ == "__main__":
    options = {"host": "127.0.0.1", "dashboard_address": None, "worker_dashboard_address": None}
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, local_directory=sys.argv[1], **options) as one:
        print(one.scheduler_address, flush=True)
        sys.stdin.read()
"""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning")
def test_output_is_that_of_a_run_without_a_scheduler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "cluster.py"
    program.write_text(CLUSTER, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(path for path in sys.path if path))
    monkeypatch.setenv("MUDLINE_CACHE_DIR", str(tmp_path / "cache"))
    decks = tmp_path / "here" / "decks"
    decks.mkdir(parents=True)
    texts = [CLEAN, BAD_NUMBER, UNSORTED, RESTART]
    for number in range(30):
        (decks / f"{number:02}.keyxm").write_text(texts[number % 4], encoding="utf-8")
    with started(str(program), str(tmp_path)) as cluster:  # its workers stand in another folder
        address = cluster.out.readline().decode().strip()
        monkeypatch.chdir(decks.parent)
        for words in (
            ("lint", "decks", "missing.keyxm", "--output-format", "json", "--no-cache"),
            ("lint", "decks", "-", "--no-cache"),
            ("validate", "decks", "--output-format", "json", "-v"),
            ("batch", "decks", "-o", "results", "--form", "csv", "--output-format", "json", "--no-cache", "-q"),
        ):
            alone = run(*words, stdin=BAD_NUMBER.encode())
            rmtree("results", ignore_errors=True)
            assert run(*words, "--scheduler", address, stdin=BAD_NUMBER.encode()) == alone
            assert alone.code in (1, 2)
        if find_spec("duckdb") and find_spec("pyarrow"):
            index = ("index", "decks", "--isolated", "-o")
            assert run(*index, "far", "--scheduler", address).err.replace("far", "near") == run(*index, "near").err
            assert contents(Path("far")) == contents(Path("near"))
    results = {path.name for path in (tmp_path / "here" / "results").iterdir()}
    assert {f"{number:02}.csv" for number in range(30) if number % 4 in {0, 2}} < results


def test_a_scheduler_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("mudline.running.executors.CONNECTING", 0.2)
    (tmp_path / "a.keyxm").write_text(CLEAN, encoding="utf-8")
    done = run("validate", tmp_path, "--scheduler", NOTHING)
    assert done.code == 2
    assert f"mudline: {NOTHING}: the scheduler cannot be reached: " in done.err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--jobs", "2"), "--jobs is for processes without --scheduler"),
        (("--fix",), "--fix, --diff and --watch do not go with --scheduler"),
    ],
)
def test_options_that_do_not_fit_are_refused(words: tuple[str, ...], why: str) -> None:
    done = run("lint", "decks", "--scheduler", NOTHING, *words)
    assert done.code == 2
    assert why in done.err


def test_a_scheduler_needs_its_library() -> None:
    program = (
        "import sys; sys.modules['distributed'] = None\n"
        "from mudline.__main__ import main; sys.exit(main(['validate', 'decks', '--scheduler', 'tcp://127.0.0.1:1']))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "mudline: --scheduler needs dask.distributed: pip install 'mudline[cluster]'" in done.stderr
