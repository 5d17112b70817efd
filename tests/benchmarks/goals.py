"""The goals: what is measured, what it should come to. docs/benchmarks.md has a row for each."""

from __future__ import annotations

from typing import Literal, NamedTuple

Direction = Literal["at least", "at most"]

SPELLINGS = {
    "%.9g": ("`%.9g`, comma and blank", 0.92),
    "%.17g": ("`%.17g`, -1000 to 1000", 1.2),
    "no fraction": ("`12.`, without digits behind the point", 0.32),
    "D": ("`1.25D+03`, which np.loadtxt reads as E", 0.3),
    "blanks": ("blanks instead of commas", 0.22),
    "CRLF": ("CRLF line ends", 0.87),
}
"""Ways to spell a number or a row: what the page calls them, and how many times as fast as np.loadtxt the reader was
before it was rewritten in numpy (medians of the same benchmark)."""

BAD_FIELDS = (1, 500)


class Goal(NamedTuple):
    """A figure and its limit. `aim` is what we would like beyond it."""

    key: str
    subject: str
    what: str
    direction: Direction
    limit: float
    unit: str = ""
    aim: float | None = None

    def met(self, value: float) -> bool:
        """Whether a value is on the right side of the limit."""
        return value >= self.limit if self.direction == "at least" else value <= self.limit


_READING = "Reading a table of 10^6 rows"
_SPELLING = "Ways to write numbers, 10^5 rows of 2 columns: np.loadtxt / text to array"
_START = "One deck"
_DECKS = "Many decks"
_EDITOR = "The language server"
_CONTACT = "Contact with every law, compiled, on one thread"
_COMMANDS = "Commands on a table of 10^6 rows"

GOALS = (
    Goal("rows 2", _READING, "text to array, 2 columns: np.loadtxt / mudline", "at least", 1.8),
    Goal("rows 4", _READING, "text to array, 4 columns: np.loadtxt / mudline", "at least", 1.8),
    Goal("meshio 4", _READING, "file, 4 columns: meshio / `mudline.read`", "at least", 5.0),
    Goal("opm 2", _READING, "file, 2 columns: OPM / `mudline.read`", "at least", 0.9),
    Goal("opm 4", _READING, "file, 4 columns: OPM / `mudline.read`", "at least", 0.9),
    Goal("memory 2", _READING, "peak memory of the process, 2 columns", "at most", 140.0, "MB"),
    Goal("memory 4", _READING, "peak memory of the process, 4 columns", "at most", 210.0, "MB"),
    Goal("equations", _READING, "2 columns, an equation in every tenth row", "at most", 2.0, "s"),
    *(
        Goal(
            f"bad {count}",
            _READING,
            f"{count} bad field{'s' if count > 1 else ''}: time / that of the clean table",
            "at most",
            3.0,
        )
        for count in BAD_FIELDS
    ),
    *(Goal(f"spelling {key}", _SPELLING, what, "at least", before) for key, (what, before) in SPELLINGS.items()),
    Goal("cold", _START, "cold `mudline lint` / `import numpy, pydantic, lark`", "at most", 2.1),
    Goal("again", _START, "second `mudline lint`, unchanged and clean / the same imports", "at most", 0.6),
    Goal(
        "remembered",
        _START,
        "second `mudline lint`, unchanged: with findings (`samples/broken.keyxm`) / clean",
        "at most",
        1.3,
    ),
    Goal("version", _START, "`mudline --version` / `python -c pass`", "at most", 2.0),
    Goal("evaluate", _START, "`mudline evaluate` / cold `mudline lint`, both of the SCR sample", "at most", 1.0),
    Goal("apart", _DECKS, "1000 decks that share nothing: yamllint / mudline", "at least", 1.8, aim=3.0),
    Goal("alike", _DECKS, "1000 decks that share blocks: yamllint / mudline", "at least", 4.0, aim=6.0),
    Goal("each", _DECKS, "each further deck that shares nothing", "at most", 1.3, "ms"),
    Goal("linear", _DECKS, "each of 10 000 decks / each of 1000", "at most", 1.1),
    Goal("cached", _DECKS, "10 000 decks: first run / second run, from the cache", "at least", 15.0),
    Goal("flat", _DECKS, "peak memory: 40 000 decks / 10 000 decks", "at most", 1.25),
    Goal("format", _COMMANDS, "`mudline format`, 2 columns", "at most", 1.2, "s"),
    *(
        Goal(f"{form} {step}", _COMMANDS, f"{peer} / {form}, {step} 4 columns", "at least", limit)
        for form, step, peer, limit in (
            ("json", "write", "json.dumps of lists", 0.8),
            ("json", "read", "json.loads to an array", 0.6),
            ("yaml", "write", "yaml.dump in C", 5.0),
            ("yaml", "read", "yaml.load in C", 10.0),
            ("keyword", "write", "np.savetxt", 1.5),
        )
    ),
    Goal("typing 240", _EDITOR, "a deck of 240 lines", "at most", 100.0, "ms"),
    Goal("typing faults", _EDITOR, "the same with five faults", "at most", 100.0, "ms"),
    Goal("typing broken", _EDITOR, "`samples/broken.keyxm`", "at most", 100.0, "ms"),
    Goal("typing 20000", _EDITOR, "a deck of 20,000 lines", "at most", 500.0, "ms"),
    Goal("typing long", _EDITOR, "a deck of 800,000 lines", "at most", 2.0, "s"),
    *(
        Goal(
            f"step {nodes}",
            _CONTACT,
            f"`step(out=...)` of {nodes} nodes / copy and root of 16 numbers a node",
            "at most",
            limit,
        )
        for nodes, limit in ((1000, 4.5), (100, 20.0))
    ),
    Goal("in the air", _CONTACT, "series of 1000 nodes, 90 % of them in the air / all on the seabed", "at most", 0.5),
)
