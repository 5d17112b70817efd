"""`mudline evaluate` on the terminal: touchdown of lines, and their least and largest figures over all steps."""

from __future__ import annotations

from tests.builders.decks import CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import run

BOUNDED = CLEAN + "*SEABED PLANES\n PLANE=Shelf\n POINT=0.0, 0.0, 0.0\n SLOPE=0.0\n BOUNDS=-5.0, 15.0, -5.0, 5.0\n"
LAID = "node,x,y,z\n1,-0.1,0.0,0.0\n2,-0.1,10.0,0.0\n3,-0.1,20.0,0.0\n"


def apart(elements: int) -> str:
    """A deck of elements of which no two share a node."""
    nodes = "".join(f" {node + 1}, -0.1, {10.0 * node}, 0.0\n" for node in range(2 * elements))
    rows = "".join(f" {row + 1}, {2 * row + 1}, {2 * row + 2}\n" for row in range(elements))
    return f"$MODEL\n*NODE\n{nodes}*ELEMENT\n{rows}*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1000.0\n"


def heaved(elements: int, *heights: float) -> str:
    rows = [
        f"{time},{node + 1},{height},{10.0 * node},0.0\n"
        for time, height in enumerate(heights)
        for node in range(2 * elements)
    ]
    return "time,node,x,y,z\n" + "".join(rows)


def test_a_line_is_all_on_the_seabed_only_where_all_of_it_is(place: Place) -> None:
    positions = ("--positions", place(LAID, "laid.csv"), "--table", "summary", "-q")
    assert "all on the seabed     20.008" in run("evaluate", place(CLEAN), *positions).out
    edge = run("evaluate", place(BOUNDED, "bounded.keyxm"), *positions).out
    assert edge.splitlines()[5].split()[:5] == ["1", "1", "to", "2", "10"], "where it leaves the seabed is not known"


def test_figures_of_many_lines_are_cut_unless_all_are_asked_for(place: Place) -> None:
    command = ("evaluate", place(apart(20)), "--positions", place(heaved(20, -0.1, -0.2), "heave.csv"), "-q")
    tables = run(*command).out.partition("Lines over all steps")[2]
    assert tables.count("total reaction") == 13
    assert "20 more rows: -v shows all" in tables
    assert run(*command, "-v").out.partition("Lines over all steps")[2].count("total reaction") == 20


def test_figures_stand_in_one_order_whenever_they_are_first_known(place: Place) -> None:
    heave = heaved(1, 0.5, -0.1).replace("1,2,-0.1", "1,2,0.1")
    tables = run("evaluate", place(apart(1)), "--positions", place(heave, "heave.csv"), "-q").out
    figures = [row[:17].strip() for row in tables.partition("Lines over all steps")[2].splitlines()[4:] if row]
    assert figures == ["touchdown point", "length in contact", "total reaction"]


def test_the_first_of_several_touchdown_points_is_called_so(place: Place) -> None:
    steps = [(0, 0.1, -0.3), (1, 0.1, -0.4)]
    sags = [f"{time},1,{up},0,0\n{time},2,{low},10,0\n{time},3,{up},20,0\n" for time, up, low in steps]
    both = "time,node,x,y,z\n" + "".join(sags)
    tables = run("evaluate", place(CLEAN), "--positions", place(both, "sag.csv"), "-q").out
    figures = [row[:22].strip() for row in tables.partition("Lines over all steps")[2].splitlines()[4:] if row]
    assert figures[:2] == ["first touchdown point", "last touchdown point"]


def test_a_summary_of_steps_ends_with_the_figures_over_all_of_them(place: Place) -> None:
    command = ("evaluate", place(apart(1)), "--positions", place(heaved(1, -0.1, -0.2), "heave.csv"), "-q")
    figures = run(*command).out.partition("Lines over all steps")[2]
    assert run(*command, "--table", "summary").out.partition("Lines over all steps")[2] == figures != ""
