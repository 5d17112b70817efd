"""The pictures of docs/images/, drawn by the program from the samples. `make pictures` writes them."""

from __future__ import annotations

from pathlib import Path

from tests.docs import soil_loop
from tests.docs.commands import output
from tests.docs.full_cycle import cycle, draw

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs" / "images"


def write(folder: Path = IMAGES) -> None:
    """Draw all of them into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "full-cycle.svg").open("wb") as stream:
        draw(cycle(ROOT / "samples"), "svg", stream)
    with (folder / "soil-loop.svg").open("wb") as stream:
        soil_loop.draw(soil_loop.loop(ROOT / "samples"), "svg", stream)
    samples = ROOT / "samples"
    output(
        f"mudline evaluate '{samples / 'scr-touchdown.keyxm'}' --positions '{samples / 'positions.csv'}'"
        f" -q --plot '{folder / 'touchdown.png'}'"
    )


if __name__ == "__main__":
    write()
