"""Reading tables: rows to arrays, files, spellings, bad fields, equations, memory, beside other programs."""

from __future__ import annotations

from tests.benchmarks.bench import Bench, Maker, Work
from tests.benchmarks.goals import BAD_FIELDS, SPELLINGS
from tests.benchmarks.runner import Job, cpu, figure, ratio

ROWS = 10**6
SPELLED = 10**5
_HEADS = {"curve": 3, "nodes": 2}
"""Lines in front of the rows."""
SIZES = tuple(10**power for power in range(2, 8))

_OURS = Work("import mudline", "return mudline.read(path)")
LINT = Work("import mudline", "return mudline.lint(path)")
_ARRAYS = (
    "import mudline\nfrom mudline.language.diagnostics import Span\nfrom mudline.language.syntax.rows import read_rows"
)


def run(bench: Bench) -> None:
    """Measure whole files, arrays, and bad fields."""
    _files(bench)
    _arrays(bench)
    _faults(bench)


def growth(bench: Bench) -> None:
    """Measure files of growing sizes."""
    sizes = SIZES[:2] if bench.quick else SIZES
    for panel, kinds in (("rows of a curve", CURVE), ("nodes", NODES)):
        bench.grow(panel, sizes, readers(bench, kinds))


CURVE = {"mudline": "curve", "np.loadtxt": "curve", "opm": "opm-curve"}
NODES = {"mudline": "nodes", "np.loadtxt": "nodes", "opm": "opm-nodes", "meshio": "abaqus"}
"""The kind of table that each program reads."""

_PROGRAMS = {
    "meshio": Work("import meshio", "return meshio.read(path, file_format='abaqus')"),
    "opm": Work("from opm.io.parser import Parser", "return Parser().parse(path)"),
}


def readers(bench: Bench, kinds: dict[str, str]) -> dict[str, Maker]:
    """What makes the job of a size, for each program that is there."""

    def maker(name: str, work: Work, peer: str = "") -> Maker:
        return lambda count: bench.timed(work, kinds[name], count, peer)

    head = _HEADS[kinds["np.loadtxt"]]
    loadtxt = Work("import numpy as np", f"return np.loadtxt(path, delimiter=',', skiprows={head})")
    makers = {"mudline": maker("mudline", _OURS), "np.loadtxt": maker("np.loadtxt", loadtxt)}
    there = {name: work for name, work in _PROGRAMS.items() if name in kinds and bench.has(name)}
    return makers | {name: maker(name, work, name) for name, work in there.items()}


def _files(bench: Bench) -> None:
    """Whole files, and what memory they take."""
    count, figures = bench.size(ROWS), bench.results.figures
    for columns, kinds in ((2, CURVE), (4, NODES)):
        jobs = {name: maker(count) for name, maker in readers(bench, kinds).items()}
        found = bench.costs(jobs, 5)
        ours = cpu(found["mudline"])
        figures[f"memory {columns}"] = figure([cost.memory for cost in found["mudline"]])
        if "meshio" in found:
            figures[f"meshio {columns}"] = ratio(cpu(found["meshio"]), ours)
        if "opm" in found:
            figures[f"opm {columns}"] = ratio(cpu(found["opm"]), ours)


def _arrays(bench: Bench) -> None:
    """Text in memory to an array, and reading with equations."""
    count, figures = bench.size(ROWS), bench.results.figures
    for columns, kind in ((2, "curve"), (4, "nodes")):
        found = bench.costs(_pair(bench, kind, count), 5)
        figures[f"rows {columns}"] = ratio(cpu(found["np.loadtxt"]), cpu(found["mudline"]))
    found = bench.costs({"mudline": bench.timed(_OURS, "equations", count)}, 5)
    figures["equations"] = figure(cpu(found["mudline"]))


def _pair(bench: Bench, kind: str, count: int, spelling: str = "") -> dict[str, Job]:
    """Our reader and np.loadtxt on the same text; np.loadtxt knows no exponent D, and reads E."""
    head = _HEADS.get(kind, 0)
    prepare = f"text = open(path, newline='').read().split('\\n', {head})[-1]"
    delimiter = "None" if spelling == "blanks" else "','"
    changed = "; text = text.replace('D', 'E')" if spelling == "D" else ""
    ours = Work(_ARRAYS, "return read_rows(text, Span(0, len(text)), 4)", prepare)
    loadtxt = f"return np.loadtxt(io.StringIO(text), delimiter={delimiter})"
    theirs = Work("import io, numpy as np", loadtxt, f"{prepare}{changed}")
    return {"mudline": bench.timed(ours, kind, count), "np.loadtxt": bench.timed(theirs, kind, count)}


def spellings(bench: Bench) -> None:
    """Measure text in memory to an array, in each spelling."""
    count = bench.size(SPELLED)
    for spelling in SPELLINGS:
        kind = f"spelling:{spelling}"
        found = bench.costs(_pair(bench, kind, count, spelling), 5)
        bench.results.figures[f"spelling {spelling}"] = ratio(cpu(found["np.loadtxt"]), cpu(found["mudline"]))


def _faults(bench: Bench) -> None:
    """A table with bad fields, beside the clean one."""
    count = bench.size(ROWS)
    setup = "import mudline\nfrom contextlib import suppress"
    work = Work(setup, "with suppress(mudline.DeckError): return mudline.read(path)")
    kinds = {"clean": "curve"} | {f"bad {bad}": f"bad:{bad}" for bad in BAD_FIELDS}
    found = bench.costs({name: bench.timed(work, kind, count) for name, kind in kinds.items()}, 3)
    for bad in BAD_FIELDS:
        bench.results.figures[f"bad {bad}"] = ratio(cpu(found[f"bad {bad}"]), cpu(found["clean"]))
