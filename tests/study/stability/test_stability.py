"""The study as a whole: tables, notes, omissions, pictures."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

import numpy as np
import pytest

from mudline.scene.model import Scene
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.motion import Scheme
from mudline.study.precision.contacts import contacts_of
from mudline.study.report import Cell, StudyOptions, StudyReport
from mudline.study.schemes import SCHEMES
from mudline.study.stability import deck_steps, ladder, landings, own_laws, run, statics
from mudline.study.stability.contacts import Contact
from mudline.study.stability.critical import Measured
from mudline.study.stability.families import AnyCell, all_cells, judge
from mudline.study.stability.judging import Judgement, Verdict
from mudline.study.stability.landings import Landing
from mudline.study.stability.statics import CycleCount
from tests.builders.scenes import legal_scene
from tests.study.stability.conftest import STEPPED

FEW = np.array([0.1, 0.25, 0.5, 1.0, 1.9])
"""omega dt of landings."""

pytestmark = pytest.mark.usefixtures("_shared")

TABLES = [
    *("contacts", "critical-steps", "deck-steps", "deck-landings", "steep-segments", "advice"),
    *("landings", "landing-limits", "landing-envelopes"),
    *("newton-cycles", "newton-halvings", "newton-path", "release", "ladder", "ladder-cells", "machine"),
]


@pytest.fixture(scope="module")
def progress() -> list[str]:
    return []


@pytest.fixture(scope="module")
def _shared(landed: list[Landing], cycles: list[CycleCount]) -> Iterator[None]:
    """What does not depend on the deck is not computed again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(landings, "landings", lambda: landed)
        patch.setattr(statics, "cycle_counts", lambda: cycles)
        patch.setattr(statics, "HALVED_RATIOS", (1e2, 1e4))
        for part in (landings, deck_steps):
            patch.setattr(part, "TRIED", FEW)
        yield


@pytest.fixture(scope="module")
def report(
    progress: list[str], measured: dict[tuple[str, str], Measured], judged: dict[tuple[str, str], Judgement]
) -> StudyReport:
    """The study of the sample; what the tests of its parts need too is not computed again."""

    def measure(_scene: Scene, contact: Contact, scheme: Scheme) -> Measured:
        return measured[contact.name, scheme.name]

    def verdict(cell: AnyCell) -> Judgement:
        return judged.get((cell.family, cell.value)) or judge(cell)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(deck_steps, "measure", measure)
        patch.setattr(deck_steps, "STEPPED", STEPPED)
        patch.setattr(ladder, "judge", verdict)
        patch.setattr(own_laws, "POWERS", (0,))
        return run(sample_scene(), StudyOptions(progress=progress.append))


def test_the_sample_is_studied(report: StudyReport, progress: list[str]) -> None:
    assert [table.name for table in report.tables] == TABLES
    assert [picture.name for picture in report.pictures] == [
        "critical-steps",
        "landings",
        "landing-gain",
        "ladder",
        "ladder-deck",
    ]
    assert report.omissions == ()
    assert progress[0] == "steps on suction damping on Clay"
    assert progress[-1] == "ladder of extremes, linear on Sand: coefficients"
    assert json.loads(report.json())["study"] == "stability"


def test_the_notes_say_what_follows(report: StudyReport) -> None:
    runs, agree, never, cycles = report.notes[:4]
    assert runs.startswith("30 of 30 runs")
    assert agree.startswith("33 of 33 landings")
    assert f"{SCHEMES['generalised-alpha-0'].title} (1.0000755 at most), backward Euler (0.9" in never
    assert "has the iterates 1, -5, 15, -5, 15, -5, 15, ... without end" in cycles
    assert cycles.endswith("0.05: 3 iterations.")


def test_one_sentence_says_what_to_do(report: StudyReport) -> None:
    """With few steps tried the soft clay allows omega dt = 0.25 on 29.74 rad/s."""
    start = (
        "Use generalised-alpha (0.5) with a step of 0.0084 s or less, because of curve:Soft Clay on Clay (deck line 32)"
    )
    assert report.advice.startswith(start)
    assert report.advice.endswith(
        "central difference needs 0.000309 s or less, because of suction damping on Clay (deck line 43): above it a "
        "small motion there grows."
    )


def test_the_deck_has_the_least_step_of_its_contacts(report: StudyReport) -> None:
    def rows(name: str) -> list[dict[str, Cell]]:
        (table,) = (one for one in report.tables if one.name == name)
        return [dict(zip((column.name for column in table.columns), row, strict=True)) for row in table.rows]

    def least(values: Iterable[Cell]) -> float:
        known = [float(value) for value in values if isinstance(value, float) and not np.isnan(value)]
        return min(known, default=np.inf)

    contacts, landed = rows("contacts"), rows("deck-landings")
    for row in rows("deck-steps"):
        scheme = next(one for one in SCHEMES.values() if one.title == row["scheme"])
        if f"critical step, {scheme.name}" in contacts[0]:
            assert row["critical step"] == least(one[f"critical step, {scheme.name}"] for one in contacts)
        title = SCHEMES["velocity-verlet"].title if scheme.name == "central-difference" else scheme.title
        for heading in ("landings below 1.01", "landings within 1 %"):
            own = [one[heading] for one in landed if one["scheme"] == title]
            assert least([row[heading]]) == least(own), (scheme.name, heading)


def test_the_page_says_it_with_the_numbers_of_the_tables(report: StudyReport) -> None:
    assert f"**{report.advice}**" in report.page
    assert "1.1653" in report.page
    assert "The secant without the point in line 32 has 106 667" in report.page
    assert "All 30 runs behaved as predicted: 14 of a scheme with a critical step" in report.page


def test_rows_are_as_wide_as_their_tables(report: StudyReport) -> None:
    for table in report.tables:
        assert table.rows
        assert {len(row) for row in table.rows} == {len(table.columns)}


def test_pictures_are_drawn(report: StudyReport) -> None:
    for picture in report.pictures:
        assert picture.png().startswith(b"\x89PNG")


def test_a_deck_without_mass_or_suction_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(own_laws, "POWERS", ())
    monkeypatch.setattr(ladder, "RANDOM_DECKS", 5)
    text = SAMPLE_TEXT.partition("*SEABED CONTACT")[0].replace("7850.0", "0.0")
    progress: list[str] = []
    found = run(legal_scene(text, "deck.keyx", "user"), StudyOptions(full=True, progress=progress.append))
    assert found.notes[0] == "No contact of this deck has a frequency: no section has a mass."
    assert {one.what for one in found.omissions} >= {"release of suction", "linear on Sand"}
    assert "force/length2" in found.tables[0].columns[2].unit
    assert progress[-1] == "5 random decks"
    assert [picture.name for picture in found.pictures] == ["landings", "landing-gain", "ladder"]


@pytest.mark.parametrize(
    ("blocks", "why"), [(" TYPE=RIGID\n", "the seabed is rigid"), ("", "no element has a seabed law")]
)
def test_a_deck_without_springs_says_why(blocks: str, why: str) -> None:
    head = SAMPLE_TEXT.partition("*SEABED PROPERTIES")[0]
    scene = legal_scene(head + (f"*SEABED PROPERTIES\n{blocks} SET=ALL\n" if blocks else ""))
    found = deck_steps.study_steps(scene, StudyOptions())
    assert found.notes == [f"No contact of this deck has a frequency: {why}."]
    assert contacts_of(scene).notes == [f"Only the reference case was run: {why}."]


def test_only_the_fastest_contacts_are_stepped_by_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deck_steps, "MOST_CONTACTS", 1)
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    found = run(sample_scene(), StudyOptions(only=("steps",)))
    assert len(found.omissions) == 5
    assert {one.reason for one in found.omissions} == {"not stepped: slower than those that were (--full)"}


def test_a_segment_too_narrow_to_oscillate_in_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    text = SAMPLE_TEXT.replace(" 0.02,  640.0\n", " 0.0100000000001,  640.0\n")
    found = run(legal_scene(text), StudyOptions(only=("steps",)))
    assert [tuple(one) for one in found.omissions] == [
        ("curve:Soft Clay on Clay", "not stepped: a small oscillation there is below rounding")
    ]


def test_unacceptable_verdicts_are_in_the_notes(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = Judgement("softness", "1E9", Verdict.WRONG, 3, 99.0, 8.0, "the force is off")
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "judge", lambda cell: wrong if cell.value == "1E-2" else judge(cell))
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(own_laws, "POWERS", ())
    found = run(sample_scene(), StudyOptions(only=("ladder",)))
    assert found.notes[-1] == "softness 1E9: WRONG: the force is off"
    assert found.notes[-2].startswith("2 of 3 cells")
    assert {table.name: table for table in found.tables}["ladder"].rows[-1][5] == 1


def test_a_curve_that_starts_with_a_force_asks_for_a_smaller_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """The soft clay begins at 300 N/m: one percent needs a far smaller step than omega dt = 0.25."""
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    monkeypatch.setattr(deck_steps, "LANDING_SCHEMES", ("newmark", "generalised-alpha-0.5"))
    monkeypatch.setattr(deck_steps, "_FINER", np.array([0.003, 0.006]))
    text = SAMPLE_TEXT.replace(" 0.00,    0.0\n", " 0.00,    300.0\n").replace(" 0.01,  450.0\n", " 0.01,  500.0\n")
    found = run(legal_scene(text), StudyOptions(only=("steps",)))
    rows = {table.name: table for table in found.tables}["deck-landings"].rows
    within = {str(row[0]): float(str(row[6])) for row in rows}
    assert within["linear on Sand"] == pytest.approx(0.25)
    assert within["curve:Soft Clay on Clay"] <= 0.1
    assert "because of curve:Soft Clay on Clay" in found.advice
