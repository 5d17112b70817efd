"""Limits against hostile or huge input and limits of what is displayed, each with its reason.

A number that belongs to a format, to physics or to the tuning of one algorithm stands where it is used.
"""

from __future__ import annotations

# -------------------------------------------------------------------------------------------------------- what is shown

LISTED = 10
"""Names, numbers or headings listed in a message; further ones are counted."""
SHOWN_LETTERS = 60
"""Characters of a name or a value in a message or a cell: names in decks may have any length."""
SHOWN_ROWS = 40
"""Rows of a table, errors or differences shown in a terminal, editor or notebook; further ones are counted."""
LONGEST_MESSAGE = 1000
"""Characters of a message or a line of a deck that are printed: nobody reads more."""
MOST_REPORTED = 1000
"""Findings of one code reported individually per deck: one slip in a script may damage every row of a table."""

# -------------------------------------------------------------------------------------------------------- text of decks

LARGEST_DECK = 500_000_000
"""Bytes of a deck: text, lines and values are in memory at the same time."""
MOST_LINES = 20_000_000
"""Lines of a deck: each unexpected row of numbers takes some hundred bytes."""
MOST_WORDED = 250_000
"""Lines of a deck that contain words: each record, comment or fault takes up to 6 kB."""
LONGEST_LINE = 10_000_000
"""Bytes of a line; reading stops after at most twice as many, since a stray file may have no line breaks."""
MOST_FIELDS = 100_000
"""Fields or brackets on one line: a stray file that is not a deck must not fill the memory."""
MOST_COLUMNS = 64
"""Fields of a table row that findings can point to: no keyword has as many columns."""
LONGEST_NUMBER = 400
"""Characters of a number: nobody writes longer ones, and the time to read one grows with its square."""
LONGEST_BLANK_SEPARATED = 10_000
"""Characters of a line without commas that is split at spaces: a stray file without commas may be one line."""
LONGEST_EQUATION = 10_000
"""Characters of an equation: parsing takes memory for each."""
LONGEST_TEXT = 10_000
"""Characters of a text joined by equations: parameters could double one another without end."""
DEEPEST = 30
"""Nesting of brackets, calls and signs in an equation, and of lists in a document: each level takes a dozen calls."""
MOST_KEYS = 100
"""Keys of a block in a document: every unknown key would be a finding."""
LONGEST_ASSIGNMENT = 2000
"""Characters of an assignment or a condition of `mudline set`: a longer text is a file given by mistake."""
LONGEST_MISSPELT = 256
"""Characters of a word for which a known name is suggested: the time to compare grows with both lengths."""
SPELLING_EFFORT = 250_000
"""Characters compared to suggest names in one deck: of very many misspelt words only the first get a suggestion."""

# --------------------------------------------------------------------------------------------- sizes that decks cause

MOST_GENERATED = 1_000_000
"""Nodes or elements made by all `GEN=` lines of a deck together: a mistyped digit must not fill the memory."""
LARGEST_COORDINATE = 1e150
"""Magnitude of a coordinate of a seabed: its differences and squares remain finite."""
MOST_CONTINUED = 20
"""Decks in a chain of `*RESTART`; a longer chain is not followed to its beginning."""
MOST_DECKS = 100_000
"""Decks described by the variations of one deck: a larger number is a mistake."""
MOST_PASSES = 20
"""Passes of `lint --fix`, each with repairs that do not overlap: two rules may undo each other's repairs."""
MOST_TRIES = 200
"""Times that a deck is read while it is fixed: bad repairs among good ones are found by bisection."""
MOST_MATCHED = 2000
"""Lines of two blocks whose longest common part is searched: the time grows with the square of their number."""

# ---------------------------------------------------------------------------------------------------------------- files

LARGEST_FILE = 200_000_000
"""Bytes of a file named in a deck; a larger file cannot be what the keyword expects."""
MOST_CELLS = 25_000_000
"""Cells of a seabed image: each takes some hundred bytes while the image is thinned."""
LARGEST_NEIGHBOUR = 50_000_000
"""Bytes of a file next to a deck that is hashed: it is read in every run."""
MOST_NEIGHBOURS = 20_000
"""Files of a folder that are compared with a name that may be written in another case."""

# --------------------------------------------------------------------------------------------------- remembered results

LONGEST_REMEMBERED = 100_000
"""Characters of a result that is remembered: a longer result is computed as quickly as it is read."""
MOST_REMEMBERED = 50_000
"""Results in a file of remembered results; the oldest are dropped first."""
LARGEST_MEMORY = 64_000_000
"""Bytes of a file of remembered results: it is read and written as a whole."""
MOST_MEMORIES = 40
"""Files of remembered results in the user's cache folder; the most recently written remain."""

# -------------------------------------------------------------------------------------------------------------- editors

LARGEST_OPEN = 20_000_000
"""Characters above which the language server reports nothing about an open deck: its check takes too long."""
LARGEST_AT_ONCE = 1_000_000
"""Characters above which help on an open deck waits for its check, and its outline has no names."""
MOST_OFFERED = 500
"""Names offered by completion; the editor asks again as more is typed."""
MOST_OUTLINED = 1000
"""Records of a block in the outline: editors become slow with more."""
MOST_HINTS = 2000
"""Inlay hints of a range of lines: more do not fit on a screen."""
