"""`mudline expand` and links."""

from __future__ import annotations

from pathlib import Path

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.cli.test_expand_command import STUDY, files


def test_links_are_not_followed_out_of_the_folder(place: Place, folder: Path) -> None:
    name = place(STUDY)
    (folder / "outside").mkdir()
    (folder / "out").mkdir()
    (folder / "out/Near").symlink_to(folder / "outside")
    outcome = run("expand", name, "-o", "out", "--force")
    assert outcome.code == 2
    assert "out/Near/at 50.keyxm: a link in its path leads out of the folder" in outcome.err
    (folder / "out/Near").unlink()
    (folder / "out/Near").mkdir()
    (folder / "out/Near/at 50.keyxm").symlink_to(folder / "outside/file")
    outcome = run("expand", name, "-o", "out", "--force")
    assert outcome.code == 2
    assert "exists already and is not a regular file: it is not overwritten" in outcome.err
    assert files(folder) == ["deck.keyxm"]
