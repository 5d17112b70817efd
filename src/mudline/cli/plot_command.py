"""`mudline plot`: the pictures of `mudline evaluate`, from a result file alone."""

from __future__ import annotations

from pathlib import Path

import click

from mudline.cli import DONE, FOUND, options, pictures
from mudline.cli.inputs import refuses_bad_decks
from mudline.cli.pictures import Pictures
from mudline.cli.streams import notify, reason
from mudline.cli.view import View
from mudline.diagnostics import DeckError
from mudline.files import suffix_of
from mudline.results.panels import ANIMATIONS, PICTURES
from mudline.results.plot_data import PlotData


@click.command("plot")
@click.option(
    "-o",
    "--output",
    required=True,
    metavar=f"FILE.{'|'.join((*PICTURES, *ANIMATIONS))}",
    help="Write the picture to this file; .gif and .html are animations of a series.",
)
@pictures.options
@click.argument("result", metavar="RESULT", shell_complete=options.complete_files)
@options.common
@refuses_bad_decks
def command(*, result: str, output: str, panels: str | None, plot_elements: str | None, view: View) -> int:
    """Draw a result file that evaluate wrote, without its deck (needs the extra mudline[plot])."""
    moving = suffix_of(output) in ANIMATIONS
    still, animation = (None, output) if moving else (output, None)
    wanted = Pictures.asked_for(still, animation, panels, plot_elements, option="-o with a picture")
    if not wanted.has_library():
        return FOUND
    from mudline.results.reading import read_result  # noqa: PLC0415 - help and faults of usage read nothing

    try:
        found = read_result(Path(result))
    except OSError as error:
        raise click.ClickException(f"{result}: {reason(error)}") from error
    except ImportError as error:
        notify(str(error))
        return FOUND
    except DeckError:
        raise
    except ValueError as error:
        raise click.UsageError(str(error)) from error
    data = wanted.data(lambda elements, frames: PlotData.of_result(found, elements, frames))
    if data is not None:
        wanted.draw(data, "", view)
    return DONE
