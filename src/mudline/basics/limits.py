"""Limits that guard against hostile or huge input, and how much a message shows; each with its reason.

A number that belongs to a format, to physics or to the tuning of one algorithm is where it is used.
"""

from __future__ import annotations

# -------------------------------------------------------------------------------------------------------- what is shown

LISTED = 10
"""Names, numbers or headings that a message lists; the others are counted."""
SHOWN_LETTERS = 60
"""Characters of a name or a value in a message or a cell: a deck's names are of any length."""
SHOWN_ROWS = 40
"""Rows of a table, errors or differences on a terminal, in an editor or a notebook; the others are counted."""
LONGEST_MESSAGE = 1000
"""Characters of a message or a line of a deck that are printed: nobody reads more."""
MOST_REPORTED = 1000
"""Findings of one code in a deck that are reported one by one: one slip in a script damages every row of a table."""

# -------------------------------------------------------------------------------------------------------- text of decks

LARGEST_DECK = 500_000_000
"""Bytes of a deck: the text, its lines and its values are in the memory together."""
MOST_LINES = 20_000_000
"""Lines of a deck: each row of numbers that is not as expected takes some hundred bytes."""
MOST_WORDED = 250_000
"""Lines of a deck that hold more than numbers: a record, a comment or a fault takes up to 6 kB."""
LONGEST_LINE = 10_000_000
"""Bytes within which a line ends, after twice as many at the latest: a stray file may have no lines."""
MOST_FIELDS = 100_000
"""Fields or brackets on one line: a stray file that is no deck must not fill the memory."""
MOST_COLUMNS = 64
"""Fields of a row of a table that have a place of their own in findings: no keyword has as many columns."""
LONGEST_NUMBER = 400
"""Characters of a number: nobody writes longer ones, and reading one takes time that grows with their square."""
LONGEST_BLANK_SEPARATED = 10_000
"""Characters of a line without commas that is read as several numbers: a stray file without commas is one line."""
LONGEST_EQUATION = 10_000
"""Characters of an equation: the grammar takes memory for each."""
LONGEST_TEXT = 10_000
"""Characters of a text that equations join: parameters can double one another without end."""
DEEPEST = 30
"""Levels of brackets, calls and signs in an equation, and of lists in a document: each takes a dozen calls."""
MOST_KEYS = 100
"""Keys of a block in a document: every unknown one would be a finding."""
LONGEST_ASSIGNMENT = 2000
"""Characters of an assignment or a condition of `mudline set`: what is longer is a file given by mistake."""
LONGEST_MISSPELT = 256
"""Characters of a word for which a known one is suggested: comparing takes time that grows with both."""
SPELLING_EFFORT = 250_000
"""Characters compared to suggest names in one deck: with very many misspelt words only the first get a suggestion."""

# --------------------------------------------------------------------------------------------------- what decks ask for

MOST_GENERATED = 1_000_000
"""Nodes or elements that the `GEN=` lines of a deck make together: a slip of a digit must not fill the memory."""
LARGEST_COORDINATE = 1e150
"""Magnitude of a coordinate of a seabed: differences and squares stay finite."""
MOST_CONTINUED = 20
"""Decks in a chain of `*RESTART`; a longer one is not followed to its beginning."""
MOST_DECKS = 100_000
"""Decks that the variations of one deck describe: more are a mistake."""
MOST_PASSES = 20
"""Times that `lint --fix` makes repairs, each time those that do not overlap: two rules may undo each other's."""
MOST_TRIES = 200
"""Times that a deck is read while it is fixed: bad repairs among good ones are found by halving."""
MOST_MATCHED = 2000
"""Lines of two blocks whose longest common part is searched: the time grows with their square."""

# ---------------------------------------------------------------------------------------------------------------- files

LARGEST_FILE = 200_000_000
"""Bytes of a file that a deck names; a larger one is not what the keyword expects."""
MOST_CELLS = 25_000_000
"""Cells of a picture of the seabed: each takes some hundred bytes while it is thinned."""
LARGEST_NEIGHBOUR = 50_000_000
"""Bytes of a file beside a deck whose content is looked at: it is read in each run."""
MOST_NEIGHBOURS = 20_000
"""Files of a folder that are looked through for a name in another case."""

# --------------------------------------------------------------------------------------------------- remembered results

LONGEST_REMEMBERED = 100_000
"""Characters of a result that is remembered: computing a longer one again is as fast as reading it."""
MOST_REMEMBERED = 50_000
"""Results in a file of remembered ones; the oldest go first."""
LARGEST_MEMORY = 64_000_000
"""Bytes of a file of remembered results: it is read and written as a whole."""
MOST_MEMORIES = 40
"""Files of remembered results in the user's folder for caches; those written last stay."""

# -------------------------------------------------------------------------------------------------------------- editors

LARGEST_OPEN = 20_000_000
"""Characters of an open deck from which on the language server says nothing of it: its check takes too long."""
LARGEST_AT_ONCE = 1_000_000
"""Characters of an open deck from which on help waits for its check, and its outline has no names."""
MOST_OFFERED = 500
"""Names that completion offers; the editor asks again when more is typed."""
MOST_OUTLINED = 1000
"""Records of a block in the outline: editors become slow with more."""
MOST_HINTS = 2000
"""Hints of a range of lines: more than fit on a screen."""
