"""The notebooks of docs/tutorials, executed on a copy of the samples. `make tutorials` writes their outputs again."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode
from traitlets.config import Config

from tests.docs.refresh import copy_of_files

ROOT = Path(__file__).parents[2]
TUTORIALS = sorted((ROOT / "docs/tutorials").glob("*.ipynb"))

_KERNEL = "mudline-tutorials"
_SECONDS = 120
"""For a cell: what takes longer hangs."""
_METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
"""Of every notebook, whatever Jupyter it was edited in."""


def read(path: Path) -> NotebookNode:
    """Read a notebook as it is."""
    notebook: NotebookNode = nbformat.read(path, as_version=4)
    return notebook


def executed(path: Path) -> NotebookNode:
    """Return a notebook with the outputs of a run by this interpreter, beside a copy of the samples."""
    notebook = read(path)
    with TemporaryDirectory(prefix="mudline-") as name:
        folder = Path(name)
        copy_of_files(ROOT, folder / "checkout")
        place = folder / "checkout" / path.parent.relative_to(ROOT)
        place.mkdir(parents=True)
        with _kernel(folder / "jupyter"):
            client = NotebookClient(
                notebook,
                kernel_name=_KERNEL,
                timeout=_SECONDS,
                resources={"metadata": {"path": str(place)}},
                record_timing=False,
                coalesce_streams=True,
                config=Config({"KernelManager": _channels(folder / "channel")}),
            )
            return client.execute()


def text(notebook: NotebookNode) -> str:
    """Return a notebook as it is kept: nothing in it says where, when or by which version it was executed."""
    notebook.metadata = nbformat.from_dict(_METADATA)
    for number, cell in enumerate(notebook.cells, 1):
        cell.id, cell.metadata = f"cell-{number}", NotebookNode()
    written: str = nbformat.writes(notebook)
    return written.rstrip("\n") + "\n"


def shown(notebook: NotebookNode) -> list[list[str]]:
    """Return what each code cell shows: its texts, and for a picture the text that Jupyter has beside it."""
    return [
        [output.get("text") or output.data["text/plain"] for output in cell.outputs]
        for cell in notebook.cells
        if cell.cell_type == "code"
    ]


@contextmanager
def _kernel(folder: Path) -> Iterator[None]:
    """A kernel of this interpreter, in an environment that neither reads nor writes the user's settings."""
    place = folder / "kernels" / _KERNEL
    place.mkdir(parents=True)
    words = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    kernel = {"argv": words, "display_name": _KERNEL, "language": "python"}
    (place / "kernel.json").write_text(json.dumps(kernel), encoding="utf-8")
    changed = {
        "IPYTHONDIR": str(folder),
        "JUPYTER_CONFIG_DIR": str(folder),
        "JUPYTER_DATA_DIR": str(folder),
        "JUPYTER_RUNTIME_DIR": str(folder),
        "JUPYTER_PLATFORM_DIRS": "1",
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        "NO_COLOR": "1",
        "COLUMNS": "120",
    }
    with patch.dict(os.environ, changed):
        yield


def _channels(name: Path) -> dict[str, str]:
    """How a kernel is spoken to: through files, as a port that is free now may be another kernel's a moment later."""
    return {} if sys.platform == "win32" else {"transport": "ipc", "ip": str(name)}


def write() -> None:
    """Execute every notebook and write it."""
    for path in TUTORIALS:
        fresh = text(executed(path))
        path.write_text(fresh, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    write()
