"""Tables that the benchmarks read: python -m tests.benchmarks.inputs KIND COUNT FILE

A process of its own writes each, so that the one that measures stays small. All tables of a size hold the same numbers.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_PART = 100_000
CURVE_HEAD = "$MODEL\n*SEABED STIFFNESS\n CURVE=clay\n"
NODE_HEAD = "$MODEL\n*NODE\n"


def numbers(count: int, columns: int) -> Iterator[Floats]:
    """Numbers in parts: the first columns of a curve, or of nodes with ids, as they are written with nine digits."""
    rng = np.random.default_rng(1)
    last = np.zeros(2)
    for start in range(0, count, _PART):
        size = min(_PART, count - start)
        curve = last + np.cumsum(rng.random((size, 2)) + 1e-3, axis=0)
        last = curve[-1]
        ids = np.arange(start + 1.0, start + size + 1)
        yield curve if columns == 2 else np.column_stack((ids, curve, 100.0 * rng.random(size)))


def lines(row: str, parts: Iterator[Floats]) -> Iterator[str]:
    """The rows of each part, in a format."""
    for part in parts:
        yield row * len(part) % tuple(part.ravel().tolist())


def curve(count: int) -> Iterator[str]:
    """A curve of two columns."""
    yield CURVE_HEAD
    yield from lines("%.9g, %.9g\n", numbers(count, 2))


def nodes(count: int) -> Iterator[str]:
    """A table of four columns."""
    yield NODE_HEAD
    yield from lines("%d, %.9g, %.9g, %.9g\n", numbers(count, 4))


def elements(count: int) -> Iterator[str]:
    """Elements of a line."""
    yield "$MODEL\n*ELEMENT\n"
    for start in range(1, count + 1, _PART):
        yield "".join(f"{i}, {i}, {i + 1}\n" for i in range(start, min(start + _PART, count + 1)))


def abaqus(count: int) -> Iterator[str]:
    """The same nodes for meshio."""
    yield "*HEADING\n*NODE\n"
    yield from lines("%d, %.9g, %.9g, %.9g\n", numbers(count, 4))


def opm_curve(count: int) -> Iterator[str]:
    """The same curve for OPM, as the table of a keyword of two columns."""
    yield "RUNSPEC\nOIL\nGAS\nDISGAS\nMETRIC\nEQLDIMS\n 1 /\nSOLUTION\nRSVD\n"
    yield from lines("%.9g %.9g\n", numbers(count, 2))
    yield "/\n"


def opm_nodes(count: int) -> Iterator[str]:
    """The same four columns for OPM."""
    yield "RUNSPEC\nOIL\nWATER\nMETRIC\nTABDIMS\n 1 /\nPROPS\nSWOF\n"
    yield from lines("%d %.9g %.9g %.9g\n", numbers(count, 4))
    yield "/\n"


def equations(count: int) -> Iterator[str]:
    """A curve whose every tenth row has an equation."""
    yield "$PREPROCESSOR\n*PARAMETERS\n su, 2.5\n" + CURVE_HEAD
    plain = "%.9g, %.9g\n" * 9
    for part in numbers(count - count % 10, 2):
        yield (plain + "%.9g, =[%.9g*su]\n") * (len(part) // 10) % tuple(part.ravel().tolist())


def faulty(count: int, bad: int) -> Iterator[str]:
    """A curve in which so many fields, evenly spread, are not numbers."""
    yield CURVE_HEAD
    at, every = 0, max(1, count // bad)
    for part in lines("%.9g, %.9g\n", numbers(count, 2)):
        rows = part.splitlines(keepends=True)
        for place in range((every // 2 - at) % every, len(rows), every):
            rows[place] = rows[place].replace(", ", ", 9.8O", 1)
        at += len(rows)
        yield "".join(rows)


def spelling(count: int, name: str) -> Iterator[str]:
    """Rows of two numbers in a spelling, without a keyword."""
    rng = np.random.default_rng(2)
    ordinary = rng.uniform(-1000.0, 1000.0, 2 * count)
    positive = np.abs(ordinary)
    powers = np.exp(rng.uniform(np.log(1e-20), np.log(1e20), 2 * count))
    row, values = {
        "%.9g": ("%.9g, %.9g\n", ordinary),
        "%.3f": ("%.3f, %.3f\n", ordinary),
        "whole": ("%d, %d\n", np.floor(10 ** rng.uniform(0.0, 18.0, 2 * count))),
        "%.6E": ("%.6E, %.6E\n", powers),
        "%.17g": ("%.17g, %.17g\n", ordinary),
        "bits": ("%r, %r\n", _any_bits(rng, 2 * count)),
        "no fraction": ("%d., %d.\n", ordinary),
        "no whole": (".%06d, .%06d\n", 1000.0 * positive),
        "plus": ("+%.6f, +%.6f\n", positive),
        "D": ("%.6E, %.6E\n", powers),
        "blanks": ("%.9g %.9g\n", ordinary),
        "tabs": ("\t%14.6f\t,%14.6f\n", ordinary),
        "CRLF": ("%.9g, %.9g\r\n", ordinary),
        "tight": ("%.9g,%.9g\n", ordinary),
    }[name]
    text = row * count % tuple(values.tolist())
    yield text.replace("E", "D") if name == "D" else text


def _any_bits(rng: np.random.Generator, count: int) -> Floats:
    """Finite numbers of random bit patterns."""
    found = rng.integers(0, 2**64, 2 * count + 100, dtype=np.uint64).view(np.float64)
    return found[np.isfinite(found)][:count]


_KINDS: dict[str, Callable[[int], Iterator[str]]] = {
    "curve": curve,
    "nodes": nodes,
    "elements": elements,
    "abaqus": abaqus,
    "opm-curve": opm_curve,
    "opm-nodes": opm_nodes,
    "equations": equations,
}


def text(kind: str, count: int) -> Iterator[str]:
    """The parts of a table; `bad:K` is a curve with K bad fields, `spelling:NAME` rows in a spelling."""
    name, _, detail = kind.partition(":")
    if name == "bad":
        return faulty(count, int(detail))
    return spelling(count, detail) if name == "spelling" else _KINDS[kind](count)


def main(kind: str, count: str, file: str) -> None:
    """Write a table."""
    with Path(file).open("w", encoding="ascii", newline="") as stream:
        stream.writelines(text(kind, int(count)))


if __name__ == "__main__":
    main(*sys.argv[1:])
