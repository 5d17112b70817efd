"""Command `mudline report`: a page about a deck to be signed, or an index with a page for each deck."""

from __future__ import annotations

import os
from contextlib import closing
from pathlib import Path

import click

from mudline.basics.overwriting import reading
from mudline.basics.short_repr import counted
from mudline.checks.configuration import CallerSettings
from mudline.checks.engine import LintSettings
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDecks, Input, many_files, takes_decks
from mudline.cli.lint_run import checked_settings
from mudline.cli.streams import emit_json, refusing, require, write_text
from mudline.cli.view import View
from mudline.language.deck.searching import is_in_any_form
from mudline.tools.reporting.content import BY_DEFAULT, SECTIONS, DeckFile, Look, LookError, PageHead
from mudline.tools.reporting.pages import Pages, Wanted, make_page


@options.command("report")
@options.output(
    group=options.OUTPUT,
    type=options.OUTPUT_TEXT,
    metavar="OUT.html",
    help="Write the page; for several decks or a folder the index, with the pages in a folder next to it.",
)
@options.output_format("html", "json")
@options.option(
    "--sections",
    metavar="NAME[,NAME...]",
    default=",".join(BY_DEFAULT),
    show_default=True,
    help="Write only these sections; study measures run times, which vary from run to run.",
)
@options.flag("--rest-shape", help="Evaluate contact at the resting shape of the deck.")
@options.option("--title", metavar="TEXT", help="Title of the page (default: the *TITLE of the deck).")
@options.option("--document", "number", metavar="TEXT", help="Number of the document.")
@options.option("--revision", metavar="TEXT", help="Revision of the document.")
@options.option(
    "--field", "fields", multiple=True, metavar="NAME=VALUE", help="Further entry of the head of the page. Repeatable."
)
@options.option("--date", metavar="TEXT", help="Date of the document.")
@options.option("--template", metavar="FILE", help='Use this jinja2 template, which may extend "page.html".')
@options.option("--logo", metavar="FILE.svg|png", help="Logo at the head of the page.")
@options.config
@options.isolated
@options.jobs
@takes_decks("DECKS...")
def command(
    *,
    decks: GivenDecks,
    output: str | None,
    output_format: str,
    sections: str,
    rest_shape: bool,
    fields: tuple[str, ...],
    template: str | None,
    logo: str | None,
    config: str | None,
    isolated: bool,
    jobs: int,
    view: View,
    **head: str | None,
) -> int:
    """Write a page about a deck for a checker to sign: verdict, findings, inputs, model, curves, contact, plan.

    The page stands alone: it has no script and no link to the network. A deck with errors also gets a page, without the
    parts that could not be computed. DECKS are files, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and
    for JSON and YAML files that begin as decks do), or - for standard input.
    """
    names = _sections(sections)
    document = PageHead(**head, fields=tuple(map(_field, fields)))
    html = output_format == "html"
    if html and not output:
        raise click.UsageError("-o OUT.html: give the file of the page, or print the content with --output-format json")
    if html:
        require("report", "report", "jinja2", "matplotlib")
    settings = checked_settings(config, CallerSettings(units=decks.units), isolated=isolated)
    inputs = decks.collect(is_in_any_form)
    for path in filter(None, (template, logo)) if html else ():
        reading(path)
    look = Look(*(None if file is None else Path(file) for file in (template, logo))) if html else None
    many = len(inputs.files) > 1 or any(os.path.isdir(each) for each in decks.paths)  # noqa: PTH112 - Path raises for a long name
    pages = Pages(Path(output) if html and output else None, lambda path, text: write_text(path, [text]), several=many)
    contents = []

    def prepared(file: Input) -> tuple[Input, tuple[DeckFile, LintSettings, Wanted]]:
        own = settings.of(file.place)
        return file, (DeckFile(file.read(), file.name, file.folder), own, (names, document, look, rest_shape))

    results = many_files(inputs, prepared, make_page, view, jobs=jobs)
    with refusing(LookError, kind=click.ClickException), closing(results):
        for file, page in results:
            if page is not None:
                pages.add(page, file.name)
                contents += [] if html else [page[0]]
        if look is not None and pages.rows:
            pages.finish(look)
    if not html:
        emit_json({"reports": contents}, output)
    elif pages.rows and pages.index is not None:
        faulty = f", {pages.faulty} of {counted(len(pages.rows), 'deck')} with errors" if pages.faulty else ""
        view.note(f"report -> {pages.index.as_posix()}{faulty}")
    return max(inputs.code, FOUND if pages.faulty else DONE)


def _sections(text: str) -> tuple[str, ...]:
    names = [name for each in text.split(",") if (name := each.strip().lower())]
    if wrong := [name for name in names if name not in SECTIONS]:
        raise click.UsageError(f"--sections: {wrong[0]!r} is not one of {', '.join(SECTIONS)}")
    return tuple(name for name in SECTIONS if name in names)


def _field(text: str) -> tuple[str, str]:
    """Return name and value of --field."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise click.UsageError(f"--field {text!r}: give NAME=VALUE")
    return name.strip(), value.strip()
