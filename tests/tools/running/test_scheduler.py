"""`batch --scheduler`: what it prints is what it prints without, by the workers of a scheduler on loopback."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from shutil import rmtree

import pytest

from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN, UNSORTED
from tests.helpers.processes import started

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
        batch = (
            "batch",
            "decks",
            "decks/missing.keyxm",
            "-o",
            "results",
            "--form",
            "csv",
            "--output-format",
            "json",
            "-q",
        )
        alone = run(*batch, "--no-cache")
        rmtree("results")
        assert run(*batch, "--no-cache", "--scheduler", address) == alone
        assert run(*batch) == alone  # takes over what the workers made
        assert alone.code == 2
    results = {path.name for path in (tmp_path / "here" / "results").iterdir()}
    assert {f"{number:02}.csv" for number in range(30) if number % 4 in {0, 2}} < results


def test_a_scheduler_that_is_not_there_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("mudline.tools.running.executors.CONNECTING", 0.2)
    (tmp_path / "a.keyxm").write_text(CLEAN, encoding="utf-8")
    done = run("batch", tmp_path, "-o", tmp_path / "results", "--scheduler", NOTHING)
    assert done.code == 2
    assert f"mudline: {NOTHING}: the scheduler cannot be reached: " in done.err


def test_options_that_do_not_fit_are_refused() -> None:
    done = run("batch", "decks", "-o", "results", "--scheduler", NOTHING, "--jobs", "2")
    assert done.code == 2
    assert "--jobs is for processes without --scheduler" in done.err


def test_a_scheduler_needs_its_library() -> None:
    program = (
        "import sys; sys.modules['distributed'] = None\n"
        "from mudline.__main__ import main; sys.exit(main(['batch', 'decks', '-o', 'results', '--scheduler', 'tcp://127.0.0.1:1']))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert 'mudline: --scheduler needs dask.distributed: python -m pip install "mudline[cluster]"' in done.stderr
