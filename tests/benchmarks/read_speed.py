"""MB/s of reading long tables: python tests/benchmarks/read_speed.py

Each table is read by mudline.read, by mudline's own reader of rows, and by numpy.loadtxt and Python's float on the same
text, in turns in one run; meshio (nodes as an Abaqus deck) and OPM (numbers of an AQUTAB) take part where they are
installed. Printed are MB/s of the least processor time of the rounds, and how many times as fast as each peer
mudline.read is. `--peak` reads each deck in a process of its own and prints the most memory that it took (Linux).

`--spellings` times the reader of rows on the spellings of numbers, with float for comparison.
"""

from __future__ import annotations

import argparse
import io
import multiprocessing
import tempfile
import time
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import mudline
from mudline.diagnostics import Span
from mudline.syntax.rows import read_rows

HEADS = {"curve": "$MODEL\n*SEABED STIFFNESS\n CURVE=clay\n", "nodes": "$MODEL\n*NODE\n"}
SPELLINGS: dict[str, Callable[[float], str]] = {
    "%.3f": "{:.3f}".format,
    "%.9g": "{:.9g}".format,
    "17 digits": repr,
    "%.6E": "{:.6E}".format,
    "%.16E": "{:.16E}".format,
    "integers": lambda value: str(int(value * 1e15)),
    ".5": lambda value: f"{value:.6f}"[1:] if 0 <= value < 1 else f"{value:.6f}",
    "5.": "{:.0f}.".format,
    "+1": "{:+.4f}".format,
    "1D3": lambda value: f"{value:.6E}".replace("E", "D"),
}


def table(name: str, count: int) -> NDArray[np.float64]:
    """The numbers of a table: a curve of two columns, or nodes of four."""
    rng = np.random.default_rng(1)
    points = np.cumsum(rng.random((count, 2)) + 1e-3, axis=0)
    return points if name == "curve" else np.column_stack((np.arange(1.0, count + 1), points, rng.random(count)))


def rows(values: NDArray[np.float64], form: Callable[[float], str], comma: str = ", ") -> str:
    """The rows of a table as text."""
    return "".join(f" {comma.join(map(form, row))}\n" for row in values.tolist())


def floats(text: str) -> list[float]:
    """The numbers of a text as Python reads them."""
    return list(map(float, text.replace(",", " ").split()))


def least(rounds: int, runs: dict[str, Callable[[], Any]]) -> dict[str, float]:
    """The least processor seconds of each run, which are made in turns."""
    taken: dict[str, float] = {}
    for _ in range(rounds):
        for name, run in runs.items():
            start = time.process_time()
            run()
            taken[name] = min(time.process_time() - start, taken.get(name, np.inf))
    return taken


def peers(name: str, text: str, folder: Path) -> dict[str, Callable[[], Any]]:
    """What reads the rows of a table beside mudline."""
    found: dict[str, Callable[[], Any]] = {
        "np.loadtxt": lambda: np.loadtxt(io.StringIO(text), delimiter=","),
        "float": partial(floats, text),
    }
    try:
        parser = import_module("opm.io.parser").Parser()
    except ImportError:
        pass
    else:
        count = text.count("\n") * (1 if name == "curve" else 2) + 1
        deck = folder / "opm.data"
        deck.write_text(
            f"RUNSPEC\nDIMENS\n 1 1 1 /\nAQUDIMS\n 0 0 2 {count} /\nPROPS\nAQUTAB\n{text.replace(',', ' ')}/\n",
            encoding="ascii",
        )
        found["OPM"] = lambda: parser.parse(str(deck))
    if name == "nodes":
        try:
            meshio = import_module("meshio")
        except ImportError:
            return found
        file = folder / "nodes.inp"
        file.write_text(f"*NODE\n{text}*ELEMENT, TYPE=B31\n1, 1, 2\n", encoding="ascii")
        found["meshio"] = lambda: meshio.read(file)
    return found


def peak(file: Path) -> None:
    """Read a deck and print the most memory that this process took."""
    mudline.read(file)
    status = Path("/proc/self/status").read_text(encoding="ascii")
    most = int(status.partition("VmHWM:")[2].split()[0])
    print(f"{file.stem:>10} peak {most * 1024 / 1e6:.0f} MB", flush=True)


def spelled(count: int, rounds: int) -> None:
    """Time the spellings of numbers."""
    values = np.random.default_rng(2).random((count, 2)) * 1000.0
    texts = {name: rows(values, form) for name, form in SPELLINGS.items()}
    texts["blanks"] = rows(values, "{:.6f}".format, " ")
    patterns = np.random.default_rng(3).integers(0, 2**64, (count, 2), dtype=np.uint64).view(np.float64)
    texts["any bits"] = rows(patterns[np.isfinite(patterns).all(axis=1)], repr)
    for name, text in texts.items():
        runs: dict[str, Callable[[], Any]] = {
            "mudline": partial(read_rows, text, Span(0, len(text)), 2),
            "float": partial(floats, text.replace("D", "E")),
        }
        taken = least(rounds, runs)
        speeds = "".join(f"{run:>12} {len(text) / 1e6 / seconds:6.1f}" for run, seconds in taken.items())
        print(f"{name:>10}{speeds}", flush=True)


def main() -> None:
    """Time each table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=int, default=10**6, help="rows of each table (default 10^6)")
    parser.add_argument("--rounds", type=int, default=3, help="rounds to take the least of (default 3)")
    parser.add_argument("--peak", action="store_true", help="print the peak of memory too")
    parser.add_argument("--spellings", action="store_true", help="time the spellings of numbers instead")
    arguments = parser.parse_args()
    if arguments.spellings:
        spelled(arguments.rows // 10, arguments.rounds)
        return
    with tempfile.TemporaryDirectory() as folder:
        for name, head in HEADS.items():
            text = rows(table(name, arguments.rows), "{:.9g}".format)
            file = Path(folder, f"{name}.keyxm")
            file.write_text(head + text, encoding="ascii")
            if arguments.peak:
                process = multiprocessing.get_context("spawn").Process(target=peak, args=(file,))
                process.start()
                process.join()
            ours: dict[str, Callable[[], Any]] = {
                "mudline.read": partial(mudline.read, file),
                "rows alone": partial(read_rows, text, Span(0, len(text)), 4),
            }
            taken = least(arguments.rounds, ours | peers(name, text, Path(folder)))
            for run, seconds in taken.items():
                times = " ".join(f"{one} x {seconds / taken[one]:5.2f}" for one in ours)
                print(f"{name:>10} {run:>13} {len(text) / 1e6 / seconds:>7.1f} MB/s  {times}", flush=True)


if __name__ == "__main__":
    main()
