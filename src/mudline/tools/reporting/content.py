"""What the page about a deck says, as JSON has it, and what its pictures are drawn from.

Only what a wanted section needs is computed. A part that a faulty deck does not allow is None, and `missing` says why.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from functools import reduce
from hashlib import sha256
from pathlib import Path, PurePath
from typing import Any, NamedTuple

import numpy as np

from mudline.basics.quantities import as_json, finite
from mudline.basics.version import __version__
from mudline.checks.context import LintContext
from mudline.checks.engine import LintSettings, joined_problems, named_causes
from mudline.checks.fixing import lint_one
from mudline.checks.output.json import as_object
from mudline.checks.registry import rules
from mudline.checks.suppression import suppressions
from mudline.checks.verdict import Verdict, judge, refused
from mudline.language.codes.contact import SBD025
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import DeckError, Diagnostic, Problem, Where
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
from mudline.model.scene.numbering import Mask
from mudline.model.scene.sheet import Sheet, sheet_of
from mudline.tools.reporting.inferred import inferences
from mudline.tools.reporting.inputs import inputs_of
from mudline.tools.touchdown_study.rest_shape import rest_shape
from mudline.tools.touchdown_study.study import Study, study

FORMAT = "mudline-report/1"
SECTIONS = ("verdict", "findings", "inputs", "model", "curves", "contact", "study", "plan")
BY_DEFAULT = tuple(name for name in SECTIONS if name != "study")
"""A study takes seconds, and measures run times, which differ from run to run."""

_NO_DECK = "the file holds no deck"


class Given(NamedTuple):
    """A file: its content, its name in messages, and where files are that it names."""

    data: bytes
    name: str
    folder: Path | None


class Document(NamedTuple):
    """What a company calls a page: title (None for that of the deck), number, revision, date, and further fields."""

    title: str | None = None
    number: str | None = None
    revision: str | None = None
    date: str | None = None
    fields: tuple[tuple[str, str], ...] = ()


NO_DOCUMENT = Document()


class Look(NamedTuple):
    """What a company gives a page: a template instead of ours, and a logo."""

    template: Path | None = None
    logo: Path | None = None


class LookError(ValueError):
    """A template or a logo that cannot be used; the message names the file."""


@dataclass
class Report:
    """The content of a page.

    Attributes:
        json: as it is printed; a section that is not wanted is not among its keys.
        source: the text of the deck, of which lines are shown beside findings.
        scene, drawn, doubt, study: what the pictures show, None where there is none; `doubt` goes below a title.
        at_rest: whether contact is that of the resting shape.
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
    """The titles of the rules behind the findings, by code."""


def report_on(
    given: Given,
    settings: LintSettings,
    wanted: Collection[str],
    document: Document = NO_DOCUMENT,
    *,
    rest_shape: bool = False,
) -> Report:
    """Read, judge and evaluate a deck as far as the wanted sections need it; `document` is written on the page.

    Never raises for content. With `rest_shape` contact is that of the resting shape, else of the deck's own
    coordinates. Folders of this computer do not stand in it.
    """
    verdict, deck, context = _judged(given, settings)
    head = _head(given, deck, verdict, document)
    head["shown"] = [name for name in SECTIONS if name in wanted]
    made = Report(head, Source.from_bytes(given.data, given.name), at_rest=rest_shape)
    found = head["sections"]
    if "findings" in wanted:
        found["findings"] = _findings(given, settings, context)
        made.named = _titles([one["code"] for one in (*found["findings"]["reported"], *found["findings"]["hidden"])])
    of_scene = [name for name in SECTIONS[2:] if name in wanted]
    made.scene, missing = _scene(deck) if of_scene or "verdict" in wanted else (None, "")
    if made.scene is not None:
        head["continues"] = [base.deck.file for base in made.scene.deck.bases]
    for name in of_scene:
        why = missing
        try:
            found[name] = None if made.scene is None else as_json(_section(name, made.scene, made))
        except DeckError as error:
            found[name], why = None, _reason(error)
        if why:
            head["missing"][name] = why
    head["inferred"] = [] if deck is None else inferences(deck)
    for one in (found.get("plan") or {}).get("stages", ()):
        if one["active"] and "(inferred)" in one["why"]:
            head["inferred"].append({"keyword": "", "fields": [one["stage"]], "inferred": one["why"], "blocks": 1})
    if "verdict" in wanted:
        head["figures"] = _figures(made, found.get("contact"), missing)
    made.json = _without_folders(head, given)
    return made


def _figures(made: Report, contact: dict[str, Any] | None, missing: str) -> dict[str, Any]:
    """The five numbers of the contact that stand beside the verdict; `missing` says why there are none."""
    if contact is None and made.scene is not None:
        try:
            contact = as_json(_contact(made.scene, made))
        except DeckError as error:
            missing = _reason(error)
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
        "warnings": sorted({one["code"] for one in contact["warnings"]}),
        "missing": "",
    }


def _without_folders(value: Any, given: Given) -> Any:  # noqa: ANN401 - whatever JSON holds
    """A value in which files stand by their names alone: where they are differs from computer to computer."""
    words = {given.name: PurePath(given.name).name}
    if given.folder is not None and given.folder.name:
        whole = given.folder.absolute().as_posix()
        words |= {f"{whole}/": "", whole: "the folder of the deck", f"{given.folder.as_posix()}/": ""}
    longest_first = sorted(words.items(), key=lambda one: -len(one[0]))

    def plain(each: Any) -> Any:  # noqa: ANN401 - as above
        if isinstance(each, dict):
            return {key: plain(one) for key, one in each.items()}
        if isinstance(each, list):
            return [plain(one) for one in each]
        if isinstance(each, str):
            return reduce(lambda text, one: text.replace(*one), longest_first, each)
        return each

    return plain(value)


def _section(name: str, scene: Scene, made: Report) -> dict[str, Any]:
    if name == "contact":
        return _contact(scene, made)
    if name == "study":
        made.study = study(scene)
        return made.study.json() | {"notes": made.study.notes}
    if name == "inputs":
        made.sheet = sheet_of(scene)
        rows, without = list(made.sheet.rows), list(made.sheet.left_out)
        return {"inputs": inputs_of(scene), "sheet": rows, "weights_without": without}
    return {"model": _model, "curves": _curves, "plan": _plan}[name](scene)


def _judged(given: Given, settings: LintSettings) -> tuple[Verdict, Deck | None, LintContext | None]:
    try:
        deck = load_bytes(given.data, given.name, units=settings.units, folder=given.folder)
    except DeckError as error:
        return refused(given.name, error), None, None
    context = LintContext(deck, dialect=settings.dialect)
    return judge(context).verdict, deck, context


def _head(given: Given, deck: Deck | None, verdict: Verdict, document: Document) -> dict[str, Any]:
    """Which deck, in which state, by which program."""
    return {
        "format": FORMAT,
        "deck": given.name,
        "sha256": sha256(given.data).hexdigest(),
        "bytes": len(given.data),
        "version": __version__,
        "document": document._asdict()
        | {
            "title": document.title or ("" if deck is None else _title(deck)),
            "fields": [{"name": name, "value": value} for name, value in document.fields],
        },
        "units": None if deck is None else deck.units,
        "continues": [] if deck is None else [base.deck.file for base in deck.bases],
        "verdict": verdict.row() | {"sentence": verdict.keywords.sentence()},
        "shown": [],
        "sections": {},
        "missing": {},
    }


def _title(deck: Deck) -> str:
    """The first line of a `*TITLE`; "" without one."""
    blocks = (block for section in deck.own_sections for block in section.blocks if block.keyword == "TITLE")
    lines = (line.strip() for block in blocks for line in getattr(block, "lines", ()))
    return next(filter(None, lines), "")


def _scene(deck: Deck | None) -> tuple[Scene | None, str]:
    """The scene of a deck that can be evaluated, or why there is none."""
    if deck is None:
        return None, _NO_DECK
    try:
        return resolve(deck).require(), ""
    except DeckError as error:
        return None, _reason(DeckError(named_causes(deck, error.diagnostics, rules())))


def _reason(error: DeckError) -> str:
    first, more = error.diagnostics[0], len(error.diagnostics) - 1
    return f"line {first.line}: {first.code} {first.message}" + (f", and {more} more" if more else "")


# ------------------------------------------------------------------------------------------------------------- findings


def _findings(given: Given, settings: LintSettings, context: LintContext | None) -> dict[str, Any]:
    """What `mudline lint` reports, and what comments hide, each with the section of the deck that it lies in."""
    found = lint_one(given.name, given.data, settings, given.folder).found
    sections = _section_lines(context)
    reported = [_finding(one, sections) for one in found]
    hidden = [] if context is None else _hidden(context, settings, sections)
    return {"reported": reported, "hidden": hidden}


def _section_lines(context: LintContext | None) -> list[tuple[int, str]]:
    """The first line of each section of a text, with its name."""
    origin = None if context is None else context.deck.origin
    if context is None or not isinstance(origin, TextOrigin):
        return []
    places = (origin.source.position(one.head.span.start)[0] for one in origin.tree.sections if one.head)
    return list(zip(places, (f"${one.name}" for one in context.deck.own_sections), strict=False))


def _finding(found: Diagnostic, sections: Sequence[tuple[int, str]]) -> dict[str, Any]:
    section = next((name for line, name in reversed(sections) if line <= found.line), "")
    row = as_object(found) | {"section": section}
    del row["url"], row["file"]
    return row


def _hidden(context: LintContext, settings: LintSettings, sections: list[tuple[int, str]]) -> list[dict[str, Any]]:
    comments = suppressions(context)
    if comments is None:
        return []
    rows = []
    for problem in comments.split(joined_problems(context, settings.rules, suppress=False), ())[1]:
        comment = comments.hiding(problem)
        (found,) = context.deck.diagnose([problem])
        rows.append(_finding(found, sections) | {"reason": "" if comment is None else comment.reason})
    return rows


def _titles(codes: Collection[str]) -> dict[str, str]:
    found = {rule.code.code: rule for rule in rules()} if codes else {}
    return {code: found[code].page.title if code in found else "" for code in sorted(set(codes))}


# ----------------------------------------------------------------------------------------------------- model and curves


def _model(scene: Scene) -> dict[str, Any]:
    found = summarise(scene)
    names = ("nodes", "elements", "length", "sets", "diameters", "floor", "static_embedment", "extensions")
    return {name: found[name] for name in (*names, "weights_without")} | {"keywords": found["sections"]}


def _curves(scene: Scene) -> dict[str, Any]:
    """Every curve as it is evaluated; what each set of elements follows, with the lines of the deck that give it."""
    laws = []
    for index, grant in enumerate(scene.laws.set_laws):
        values: dict[str, Any] = {} if np.isnan(grant.stiffness) else {"stiffness": finite(grant.stiffness)}
        laws.append(
            _law(scene, scene.law_name(grant), grant.set_.name, values, scene.laws.of_element == index, grant.where)
        )
    for index, (given, where) in enumerate(zip(scene.resistance.values, scene.resistance.places, strict=True)):
        values = {key.replace("_", " "): read for key, one in given._asdict().items() if (read := _given(one))}
        entry: Any = scene.deck.sections[where.section].blocks[where.block]
        name: str | None = entry.sets[where.path[1]].set_name if where.path[0] == "sets" else None
        if values:
            laws.append(_law(scene, "resistance", name, values, scene.resistance.of_element == index, where))
    for keyword, extension in scene.extensions.items():
        for index, (record, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
            values = record.model_dump(mode="json", by_alias=True, exclude_none=True, exclude_defaults=True)
            of_set = values.pop("set", None)
            laws.append(_law(scene, f"*{keyword}", of_set, values, extension.of_element == index, where))
    return {"curves": curve_rows(scene, (), None), "laws": laws}


def _law(
    scene: Scene, law: str, set_name: str | None, values: dict[str, Any], follow: Mask, where: Where
) -> dict[str, Any]:
    (found,) = scene.deck.diagnose([Problem(SBD025, "", where=where)])
    name = set_name or "ALL"
    known = scene.set_table.find(name)
    counts = {"elements": int(follow.sum()), "open": known is not None and known.open}
    place = {"file": found.file, "line": found.line}
    return {"law": law, "set": name} | counts | {"values": values} | place


def _given(value: Any) -> Any:  # noqa: ANN401 - a number, or one for each direction
    """What the deck gives of a value; None for nothing."""
    if isinstance(value, tuple):
        numbers = [finite(float(one)) for one in value]
        return None if all(one is None for one in numbers) else numbers
    return finite(float(value))


# ------------------------------------------------------------------------------------------ contact, study and plan


def _contact(scene: Scene, made: Report) -> dict[str, Any]:
    """The contact of the deck's own coordinates, or of its resting shape."""
    if made.at_rest:
        shape = rest_shape(scene)
        evaluation = evaluate_scene(scene, shape.positions, _tension(scene), at_rest=shape.sentences(scene.units))
    else:
        evaluation = evaluate_scene(scene, tension=_tension(scene))
    made.drawn = PlotData.of_evaluation(evaluation)
    watch = ContactWatch.of(evaluation)
    (part,) = evaluation.parts()
    for one in (made.drawn, watch):
        one.take(part)
    warnings = watch.warnings()
    made.doubt = caption(warnings)
    result = part.result.step(0)
    lying = scene.law != LawKind.NONE  # others may be held in soil
    lying = lying if lying.any() else ~lying
    depth = np.where(lying & result.evaluated & ~np.isnan(result.depth), result.depth, -np.inf)
    deepest = int(depth.argmax()) if depth.size else -1
    touches = deepest >= 0 and depth[deepest] > 0.0
    return {
        "laws": [each._asdict() for each in totals(evaluation, part)],
        "reaction": finite(reaction(evaluation, result)),
        "weight": None if watch.balance is None else finite(watch.balance.weight),
        "empty_weight": None if watch.balance is None else finite(watch.balance.empty),
        "weights_without": evaluation.weights_without,
        "ratio": None if watch.balance is None else finite(watch.balance.ratio),
        "deepest": {"depth": float(depth[deepest]), "element": int(scene.element_ids[deepest])} if touches else None,
        "positions": evaluation.source,
        "notes": [*evaluation.notes, *filter(None, [watch.note()])],
        "lines": [row.row() for row in line_steps(evaluation, part)],
        "states": [{"law": law, "state": state, "count": count} for law, state, count in states(evaluation, result)],
        "warnings": [one.row() for one in warnings],
    }


def _plan(scene: Scene) -> dict[str, Any]:
    plan = prepare(scene, None, _tension(scene)).model.plan
    return {"stages": plan_rows(plan), "steps": plan.steps}


def _tension(scene: Scene) -> Tension:
    """Curves that pull are cut where the deck could not be evaluated otherwise."""
    return "cut" if scene.blocking("keep") else "keep"
