"""`mudline report`: a page about a deck to be signed, or an index with a page a deck."""

from __future__ import annotations

import os
import re
from contextlib import closing
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import click

from mudline import __version__
from mudline.basics.overwriting import reading
from mudline.basics.paths import relative_path
from mudline.basics.short_repr import counted
from mudline.checks.configuration import Given as GivenRules
from mudline.checks.engine import LintSettings
from mudline.cli import DONE, FOUND, WRONG_USAGE, options
from mudline.cli.inputs import GivenDecks, Input, takes_decks
from mudline.cli.lint_run import checked_settings
from mudline.cli.many_files import many_files
from mudline.cli.streams import emit_json, notify, notify_missing, write_text
from mudline.cli.view import Progress, View
from mudline.language.deck.searching import is_in_any_form
from mudline.tools.reporting.content import BY_DEFAULT, SECTIONS, Document, Given, Look, report_on

_LEGAL = "legal"


@options.command("report")
@options.output_option(
    "-o",
    "--output",
    type=options.OUTPUT_FILE,
    metavar="OUT.html",
    help="Write the page into this file; of several decks or a folder the index, with the pages in a folder beside it.",
)
@options.output_format("html", "json")
@options.option(
    "--sections",
    metavar="NAME[,NAME...]",
    default=",".join(BY_DEFAULT),
    show_default=True,
    help="Write these sections only; study measures run times, which differ from run to run.",
)
@click.option("--rest-shape", is_flag=True, help="Evaluate contact at the resting shape, not at the deck's own places.")
@options.option("--title", metavar="TEXT", help="Call the page so; else by the *TITLE of the deck.")
@options.option("--document", "number", metavar="TEXT", help="Write this number of the document on the page.")
@options.option("--revision", metavar="TEXT", help="Write this revision on the page.")
@options.option(
    "--field", "fields", multiple=True, metavar="NAME=VALUE", help="Write this beside them; may be repeated."
)
@options.option("--date", metavar="TEXT", help="Write this date on the page.")
@options.option("--template", metavar="FILE", help='Use this jinja2 template, which may extend "page.html".')
@options.option("--logo", metavar="FILE.svg|png", help="Put this logo at the head of the page.")
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
    title: str | None,
    number: str | None,
    revision: str | None,
    fields: tuple[str, ...],
    date: str | None,
    template: str | None,
    logo: str | None,
    config: str | None,
    isolated: bool,
    jobs: int,
    view: View,
) -> int:
    """Write a page about a deck for a checker to sign: verdict, findings, inputs, model, curves, contact, plan.

    The page stands alone: no script, no address of the network. A deck with errors gets one too, without what could
    not be computed. DECKS are files, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML
    files that begin as decks do), or - for standard input.
    """
    names = _sections(sections)
    document = Document(title, number, revision, date, tuple(map(_field, fields)))
    html = output_format == "html"
    if html and output is None:
        raise click.UsageError("-o OUT.html: give the file of the page, or print the content with --output-format json")
    if html and (missing := next((one for one in ("jinja2", "matplotlib") if find_spec(one) is None), None)):
        notify_missing("report", missing, "report")
        return WRONG_USAGE
    settings = checked_settings(config, GivenRules(units=decks.units), "none", isolated=isolated, fail_on=None)
    inputs = decks.collect(is_in_any_form)
    for path in filter(None, (template, logo)) if html else ():
        reading(path)
    look = Look(*(None if one is None else Path(one) for one in (template, logo))) if html else None
    wanted = Wanted(names, document, look, rest_shape)
    several = len(inputs.files) > 1 or any(os.path.isdir(each) for each in decks.paths)  # noqa: PTH112 - Path raises for a long name
    target = None if output is None or not html else Target(Path(output), several)
    rows, contents = [], []

    def prepared(file: Input) -> tuple[Input, tuple[Given, LintSettings, Wanted]]:
        return file, (Given(file.read(), file.name, file.folder), settings.of(file), wanted)

    with closing(many_files(inputs, prepared, make_report, Progress(len(inputs.files), view), jobs=jobs)) as results:
        for file, made in results:
            if made is not None:
                if made.fault:
                    raise click.ClickException(made.fault)
                page = target.page(file.name) if target is not None else None
                if page is not None and made.html is not None:
                    write_text(page, [made.html])
                rows.append(_row(made.content, file.name, page, target))
                contents += [] if html else [made.content]
    if not html:
        _print(contents, output)
    elif target is not None and rows:
        _finish(target, rows, wanted.look, view)
    return max(inputs.code, FOUND if _illegal(rows) else DONE)


def _sections(text: str) -> tuple[str, ...]:
    names = [name for each in text.split(",") if (name := each.strip().lower())]
    if wrong := [name for name in names if name not in SECTIONS]:
        raise click.UsageError(f"--sections: {wrong[0]!r} is not one of {', '.join(SECTIONS)}")
    return tuple(name for name in SECTIONS if name in names)


def _field(text: str) -> tuple[str, str]:
    """Name and value of --field."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise click.UsageError(f"--field {text!r}: give NAME=VALUE")
    return name.strip(), value.strip()


class Wanted(NamedTuple):
    """The sections of a page, what it is called, how it looks (None for JSON), and whether contact is that at rest."""

    sections: tuple[str, ...]
    document: Document
    look: Look | None
    rest_shape: bool = False


class Made(NamedTuple):
    """The content of a page, the page, None where it is not wanted, and why it could not be made."""

    content: dict[str, Any]
    html: str | None
    fault: str = ""


def make_report(given: Given, settings: LintSettings, wanted: Wanted) -> Made:
    """Make the page about a deck, in any process."""
    report = report_on(given, settings, wanted.sections, wanted.document, rest_shape=wanted.rest_shape)
    if wanted.look is None:
        return Made(report.json, None)
    from mudline.tools.reporting.page import LookError, page  # noqa: PLC0415 - needs jinja2
    from mudline.tools.reporting.pictures import pictures_of  # noqa: PLC0415 - needs matplotlib

    try:
        return Made(report.json, page(report, *pictures_of(report), wanted.look))
    except LookError as error:
        return Made(report.json, None, str(error))


# --------------------------------------------------------------------------------------------------------------- files


class Target:
    """Where pages go: one file, or the index with a folder beside it, which has its name without the suffix."""

    def __init__(self, path: Path, several: bool) -> None:
        self.index = path if not several or path.suffix.lower() in {".html", ".htm"} else path / "index.html"
        self.folder = None if not several else path if self.index.parent == path else path.with_suffix("")
        self._names: set[str] = set()

    def page(self, deck: str) -> Path:
        """The file of the page about a deck; no two of a run are the same."""
        if self.folder is None:
            return self.index
        self.folder.mkdir(parents=True, exist_ok=True)
        stem = re.sub(r"[^\w.-]+", "-", deck).strip("-.")[-100:] or "deck"
        name, count = f"{stem}.html", 1
        while name.lower() in self._names or name.lower() == "index.html":
            count += 1
            name = f"{stem}-{count}.html"
        self._names.add(name.lower())
        return self.folder / name


def _row(content: dict[str, Any], name: str, page: Path | None, target: Target | None) -> dict[str, Any]:
    """A row of the index; decks of the folder that the run was started in have their paths from there."""
    verdict = content["verdict"]
    words = verdict["verdict"].partition(":")[0]
    kind = "as far as read" if words.startswith("legal as far") else words.partition(",")[0]
    address = "" if page is None or target is None else relative_path(page, target.index.parent)
    counts = {name: verdict[name] for name in ("errors", "warnings")}
    keywords = verdict["keywords"]
    read = {"read": keywords["read"], "total": keywords["total"]}
    deck = content["deck"] if os.path.isabs(name) else name  # noqa: PTH117 - Path raises for a long name
    return {"deck": deck, "page": address, "verdict": words, "kind": kind} | counts | read


def _illegal(rows: list[dict[str, Any]]) -> int:
    """How many decks are not legal."""
    return sum(row["kind"] not in {_LEGAL, "as far as read"} for row in rows)


def _finish(target: Target, rows: list[dict[str, Any]], look: Look | None, view: View) -> None:
    if target.folder is not None and look is not None:
        from mudline.tools.reporting.page import index_page  # noqa: PLC0415 - needs jinja2

        write_text(target.index, [index_page(rows, __version__, look)])
    if not view.quiet:
        illegal = f", {_illegal(rows)} of {counted(len(rows), 'deck')} not legal" if _illegal(rows) else ""
        notify(f"report -> {target.index.as_posix()}{illegal}")


def _print(contents: list[dict[str, Any]], output: str | None) -> None:
    found = {"reports": contents}
    if output is None:
        emit_json(found)
    else:
        import json  # noqa: PLC0415 - pages do without

        write_text(Path(output), [json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False), "\n"])
