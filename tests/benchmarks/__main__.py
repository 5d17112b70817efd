"""Run the benchmarks and write their page: python -m tests.benchmarks [--quick] [--only SUBJECT ...]

What is measured, and against what, is in `goals`; `runner` says how. Results are kept in .bench/results.json, so that a
run of some subjects leaves what the others had; `--page` writes the page from them without measuring.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from tests.benchmarks import commands, decks, editor, evaluation, reading, start
from tests.benchmarks.bench import Bench, Results
from tests.benchmarks.page import QUICK, write
from tests.benchmarks.peers import FOLDER, PEERS, Environment, installed
from tests.benchmarks.runner import ROOT, Job, environment

SUBJECTS: dict[str, Callable[[Bench], None]] = {
    "reading": reading.run,
    "spellings": reading.spellings,
    "start": start.run,
    "decks": decks.run,
    "commands": commands.run,
    "evaluation": evaluation.run,
    "editor": editor.run,
}

_COMPILE = """
import compileall, mudline, sysconfig
compileall.compile_dir(mudline.__path__[0], quiet=2)
compileall.compile_dir(sysconfig.get_path("purelib"), quiet=2)
"""


def main() -> None:
    """Install the peers, measure, and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="small inputs and single rounds, to try it out")
    parser.add_argument("--only", nargs="+", choices=SUBJECTS, default=list(SUBJECTS), help="these subjects only")
    parser.add_argument(
        "--rounds", type=int, default=100, metavar="N", help="at most so many rounds of each comparison"
    )
    parser.add_argument("--no-peers", action="store_true", help="install and run no other program")
    parser.add_argument("--page", action="store_true", help="measure nothing, write the page again")
    parser.add_argument("--check", action="store_true", help="compare a few ratios with those stored (see `check`)")
    parser.add_argument("--store", action="store_true", help="with --check: store the ratios as they are now")
    parser.add_argument("--output", type=Path, help="folder of the page (default docs; with --quick .bench/quick)")
    given = parser.parse_args()
    kept = FOLDER / ("quick/results.json" if given.quick else "results.json")
    folder: Path = given.output or (FOLDER / "quick" if given.quick else ROOT / "docs")
    if given.no_peers:
        places = {peer.name: Environment(peer, "left out of this run") for peer in PEERS}
    else:
        places = {peer.name: installed(peer) for peer in PEERS}
    results = Results() if given.quick else Results.load(kept)
    if not given.page:
        few = f", rounds limited to {given.rounds}" if given.rounds < 100 else ""
        words = [sys.executable, "-c", _COMPILE]
        subprocess.run(words, check=False, cwd=ROOT, env=environment(Job(words)))
        with tempfile.TemporaryDirectory() as name:
            bench = Bench(Path(name), given.quick, places, results, given.rounds)
            if given.check:
                from tests.benchmarks import check  # noqa: PLC0415 - it imports mudline, and the runner stays small

                raise SystemExit(check.run(bench, store=given.store))
            for subject in given.only:
                begun, load = time.perf_counter(), os.getloadavg()[0]
                SUBJECTS[subject](bench)
                took = time.perf_counter() - begun
                full = f"a full run{few}, {took:.0f} s; load of the machine before it {load:.1f}"
                results.runs[subject] = QUICK if given.quick else full
                results.save(kept)
                print(f"{subject}: {took:.0f} s", flush=True)
    write(results, places, folder)
    print(f"written: {folder / 'benchmarks.md'}")


if __name__ == "__main__":
    main()
