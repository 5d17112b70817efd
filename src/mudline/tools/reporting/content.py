"""Content of the page about a deck, as in JSON, and the data of its pictures.

Only the data of requested sections are computed. A part that cannot be computed for a faulty deck is None; `missing`
gives the reason.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from functools import reduce
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any, NamedTuple

import numpy as np

from mudline.basics.quantities import as_json, finite
from mudline.basics.version import __version__
from mudline.checks.context import LintContext
from mudline.checks.engine import LintSettings, joined_problems, naming_causes
from mudline.checks.fixing import lint_one
from mudline.checks.output.json import as_object
from mudline.checks.registry import rules
from mudline.checks.suppression import suppressions
from mudline.checks.verdict import Verdict, judge, refused
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import DeckError, Diagnostic, Where
from mudline.language.syntax.source import Source
from mudline.model.contact.input import LawKind
from mudline.model.results.curve_rows import curve_rows
from mudline.model.results.evaluation import Tension, evaluate_scene, prepare
from mudline.model.results.forms import plan_rows
from mudline.model.results.plot_data import PlotData
from mudline.model.results.summary import summarise
from mudline.model.results.totals import line_steps, reaction, states, totals
from mudline.model.results.warnings import ContactWatch, caption
from mudline.model.scene.model import Scene, resolve
from mudline.model.scene.sheet import Sheet, sheet_of
from mudline.tools.reporting.inputs import inferences, inputs_of, laws_of
from mudline.tools.touchdown_study.rest_shape import rest_shape
from mudline.tools.touchdown_study.study import Study, study

FORMAT = "mudline-report/1"
SECTIONS = ("verdict", "findings", "inputs", "model", "curves", "contact", "study", "plan")
BY_DEFAULT = tuple(name for name in SECTIONS if name != "study")
"""Sections by default; a study takes seconds and measures run times, which vary from run to run."""


class DeckFile(NamedTuple):
    """A file: its content, its name in messages, and the folder of files that it names."""

    data: bytes
    name: str
    folder: Path | None


class PageHead(NamedTuple):
    """Head of a document.

    Attributes:
        title: title of the page; None for that of the deck.
        number: number of the document.
        revision: its revision.
        date: its date.
        fields: further names and values.
    """

    title: str | None = None
    number: str | None = None
    revision: str | None = None
    date: str | None = None
    fields: tuple[tuple[str, str], ...] = ()


class Look(NamedTuple):
    """Look of a page: a template in place of the default, and a logo."""

    template: Path | None = None
    logo: Path | None = None


class LookError(ValueError):
    """Fault of a template or a logo; the message names the file."""


@dataclass
class PageContent:
    """The content of a page.

    Attributes:
        json: the content as JSON; only requested sections are among its keys.
        source: the text of the deck, whose lines are shown next to findings.
        scene, drawn, study: data of the pictures, None if missing.
        doubt: warning below the title of a picture.
        sheet: the sheet of the elements.
        at_rest: True if contact is evaluated at the resting shape.
    """

    json: dict[str, Any]
    source: Source
    scene: Scene | None = None
    drawn: PlotData | None = None
    doubt: str = ""
    study: Study | None = None
    sheet: Sheet | None = None
    at_rest: bool = False
    named: dict[str, str] = field(default_factory=dict)
    """Titles of the rules behind the findings, by code."""


def report_on(
    given: DeckFile,
    settings: LintSettings,
    requested: Collection[str],
    document: PageHead,
    *,
    rest_shape: bool = False,
) -> PageContent:
    """Read, judge and evaluate a deck as far as the requested sections need it; `document` is written on the page.

    Never raises for content. Contact is evaluated at the resting shape with `rest_shape`, else at the deck's own
    coordinates. The content names no folders of this computer.
    """
    verdict, deck, context = _judged(given, settings)
    head = _head(given, deck, verdict, document)
    head["shown"] = [name for name in SECTIONS if name in requested]
    content = PageContent(head, Source.from_bytes(given.data, given.name), at_rest=rest_shape)
    sections = head["sections"]
    if "findings" in requested:
        sections["findings"] = _findings(given, settings, context)
        codes = sorted({row["code"] for rows in sections["findings"].values() for row in rows})
        titles = {rule.code.code: rule.page.title for rule in rules()} if codes else {}
        content.named = {code: titles.get(code, "") for code in codes}
    of_scene = [name for name in SECTIONS[2:] if name in requested]
    content.scene, missing = _scene(deck) if of_scene or "verdict" in requested else (None, "")
    if content.scene is not None:
        head["continues"] = [base.deck.file for base in content.scene.deck.bases]
    for name in of_scene:
        sections[name], why = _section(name, content, missing)
        if why:
            head["missing"][name] = why
    head["inferred"] = [] if deck is None else inferences(deck)
    for stage in (sections.get("plan") or {}).get("stages", ()):
        if stage["active"] and "(inferred)" in stage["why"]:
            head["inferred"].append({"keyword": "", "fields": [stage["stage"]], "inferred": stage["why"], "blocks": 1})
    if "verdict" in requested:
        contact, why = sections.get("contact"), ""
        if contact is None:
            contact, why = _section("contact", content, missing)
        head["figures"] = _figures(contact, why)
    content.json = _without_folders(head, given)
    return content


def _figures(contact: dict[str, Any] | None, missing: str) -> dict[str, Any]:
    """Return the five numbers of the contact next to the verdict; without them, `missing` as the reason."""
    if contact is None:
        return {"missing": missing}
    lines = contact["lines"]
    return {
        "touchdown": [point["arc_length"] for line in lines for point in line["touchdown"]],
        "contact_length": finite(sum(line["contact_length"] or 0.0 for line in lines)),
        "length": finite(sum(line["length"] or 0.0 for line in lines)),
        "depth": None if contact["deepest"] is None else contact["deepest"]["depth"],
        "reaction": contact["reaction"],
        "ratio": contact["ratio"],
        "positions": contact["positions"],
        "weights_without": contact["weights_without"],
        "contents_case": contact["contents_case"],
        "warnings": sorted({warning["code"] for warning in contact["warnings"]}),
        "missing": "",
    }


def _without_folders(value: Any, given: DeckFile) -> Any:  # noqa: ANN401 - whatever JSON holds
    """Return a value in which files have their names only: folders differ from computer to computer."""
    words = {given.name: PurePath(given.name).name}
    if given.folder is not None and given.folder.name:
        whole = given.folder.absolute().as_posix()
        words |= {f"{whole}/": "", whole: "the folder of the deck", f"{given.folder.as_posix()}/": ""}
    longest_first = sorted(words.items(), key=lambda pair: -len(pair[0]))

    def plain(each: Any) -> Any:  # noqa: ANN401 - as above
        if isinstance(each, dict):
            return {key: plain(item) for key, item in each.items()}
        if isinstance(each, list):
            return [plain(item) for item in each]
        if isinstance(each, str):
            return reduce(lambda text, pair: text.replace(*pair), longest_first, each)
        return each

    return plain(value)


def _section(name: str, content: PageContent, missing: str) -> tuple[dict[str, Any] | None, str]:
    """Return a section, or the reason why it cannot be computed, which is `missing` without a scene."""
    try:
        return (None if content.scene is None else as_json(_computed(name, content.scene, content))), missing
    except DeckError as error:
        return None, _reason(error)


def _computed(name: str, scene: Scene, content: PageContent) -> dict[str, Any]:
    if name == "contact":
        return _contact(scene, content)
    if name == "study":
        content.study = study(scene)
        return content.study.json() | {"notes": content.study.notes}
    if name == "inputs":
        content.sheet = sheet_of(scene)
        rows, without = list(content.sheet.rows), list(content.sheet.left_out)
        return {"inputs": inputs_of(scene), "sheet": rows, "weights_without": without}
    if name == "plan":
        _, model, _ = prepare(scene, None, _tension(scene))
        return {"stages": plan_rows(model.plan), "steps": model.plan.steps}
    return _model(scene) if name == "model" else _curves(scene)


def _judged(given: DeckFile, settings: LintSettings) -> tuple[Verdict, Deck | None, LintContext | None]:
    try:
        deck = load_bytes(given.data, given.name, units=settings.units, folder=given.folder)
    except DeckError as error:
        return refused(given.name, error), None, None
    context = LintContext(deck, dialect=settings.dialect)
    return judge(context).verdict, deck, context


def _head(given: DeckFile, deck: Deck | None, verdict: Verdict, document: PageHead) -> dict[str, Any]:
    """Return the head of the content: deck, state, program. The first line of a `*TITLE` is its title."""
    sections = [] if deck is None else deck.own_sections
    titles = (block for section in sections for block in section.blocks if block.keyword == "TITLE")
    lines = (line.strip() for block in titles for line in getattr(block, "lines", ()))
    return {
        "format": FORMAT,
        "deck": given.name,
        "sha256": sha256(given.data).hexdigest(),
        "bytes": len(given.data),
        "version": __version__,
        "document": document._asdict()
        | {
            "title": document.title or next(filter(None, lines), ""),
            "fields": [{"name": name, "value": value} for name, value in document.fields],
        },
        "units": None if deck is None else deck.units,
        "continues": [],
        "verdict": verdict.row() | {"sentence": verdict.keywords.sentence()},
        "shown": [],
        "sections": {},
        "missing": {},
    }


def _scene(deck: Deck | None) -> tuple[Scene | None, str]:
    """Return the scene of a deck that can be evaluated, or the reason why there is none."""
    if deck is None:
        return None, "the file holds no deck"
    try:
        with naming_causes(deck):
            return resolve(deck).require(), ""
    except DeckError as error:
        return None, _reason(error)


def _reason(error: DeckError) -> str:
    first, more = error.diagnostics[0], len(error.diagnostics) - 1
    return f"line {first.line}: {first.code} {first.message}" + (f", and {more} more" if more else "")


# ------------------------------------------------------------------------------------------------------------- findings

Heads = list[tuple[int, str]]
"""Lines of the file where sections of the deck begin, with their names."""


def _findings(given: DeckFile, settings: LintSettings, context: LintContext | None) -> dict[str, Any]:
    """Return the findings of `mudline lint`, and those hidden by comments, each with its section of the deck."""
    deck = Deck(given.name) if context is None else context.deck
    heads = [(deck.place(Where(at)).line, f"${section.name}") for at, section in enumerate(deck.sections)]
    findings = lint_one(given.name, given.data, settings, given.folder).found
    reported = [_finding(finding, heads) for finding in findings]
    hidden = [] if context is None else _hidden(context, settings, heads)
    return {"reported": reported, "hidden": hidden}


def _finding(finding: Diagnostic, heads: Heads) -> dict[str, Any]:
    row = as_object(finding) | {"section": next((name for line, name in reversed(heads) if line <= finding.line), "")}
    del row["url"], row["file"]
    return row


def _hidden(context: LintContext, settings: LintSettings, heads: Heads) -> list[dict[str, Any]]:
    comments = suppressions(context)
    if comments is None:
        return []
    rows = []
    for problem in joined_problems(context, settings.rules, suppress=False):
        if comment := comments.hiding(problem):
            (finding,) = context.deck.diagnose([problem])
            rows.append(_finding(finding, heads) | {"reason": comment.reason})
    return rows


# ----------------------------------------------------------------------------------------------------- model and curves


def _model(scene: Scene) -> dict[str, Any]:
    summary = summarise(scene)
    names = ("nodes", "elements", "length", "sets", "diameters", "floor", "static_embedment", "extensions")
    return {name: summary[name] for name in (*names, "weights_without", "contents_case")} | {
        "keywords": summary["sections"]
    }


def _curves(scene: Scene) -> dict[str, Any]:
    """Return every curve as evaluated, and the laws of each set of elements with their lines in the deck."""
    return {"curves": curve_rows(scene, (), None), "laws": list(laws_of(scene))}


# ------------------------------------------------------------------------------------------ contact, study and plan


def _contact(scene: Scene, content: PageContent) -> dict[str, Any]:
    """Return the contact at the deck's own coordinates, or at its resting shape."""
    if content.at_rest:
        shape = rest_shape(scene)
        evaluation = evaluate_scene(scene, shape.positions, _tension(scene), at_rest=shape.sentences(scene.units))
    else:
        evaluation = evaluate_scene(scene, tension=_tension(scene))
    content.drawn = PlotData.of_evaluation(evaluation)
    watch = ContactWatch(evaluation)
    (part,) = evaluation.parts()
    for consumer in (content.drawn, watch):
        consumer.take(part)
    warnings = watch.warnings()
    content.doubt = caption(warnings)
    result = part.result.step(0)
    lying = scene.law != LawKind.NONE  # elements without a law may be held in soil
    depth = np.where(lying & result.evaluated & ~np.isnan(result.depth), result.depth, -np.inf)
    deepest = int(depth.argmax()) if depth.size else -1
    touches = deepest >= 0 and depth[deepest] > 0.0
    return {
        "laws": totals(evaluation, result),
        "reaction": finite(reaction(evaluation, result)),
        "weight": finite(watch.balance.weight),
        "empty_weight": finite(watch.balance.empty),
        "weights_without": evaluation.weights_without,
        "contents_case": evaluation.contents_case,
        "ratio": finite(watch.balance.ratio),
        "deepest": {"depth": float(depth[deepest]), "element": int(scene.element_ids[deepest])} if touches else None,
        "positions": evaluation.source,
        "notes": [*evaluation.notes, *filter(None, [watch.note()])],
        "lines": [row.row() for row in line_steps(evaluation, part)],
        "states": states(evaluation, result),
        "warnings": [warning.row() for warning in warnings],
    }


def _tension(scene: Scene) -> Tension:
    """Return "cut" if the tension of curves prevents evaluation, else "keep"."""
    return "cut" if scene.blocking("keep") else "keep"
