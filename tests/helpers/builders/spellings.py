"""Strategies for the pieces of a deck's lines: numbers in every spelling, equations, names, comments, blanks."""

from __future__ import annotations

import math

from hypothesis import strategies as st

from mudline.language.syntax.rows import read_number
from mudline.language.syntax.source import CONTROLS

pads = st.sampled_from(["", "", "", " ", "  ", "\t"])
"""Blanks where they do not count."""

EXOTIC = "\u00e9\u00df\u00b0\u2013\u2028\x85\xa0\ufeff\U0001f30a\u0130"
"""Letters of other scripts, and marks that some readers take for line ends or blanks."""

PLAIN = "abcXYZ019 .,;:=[]{}()/\"'%&@#!?<>|\\^~`+-_*$\t" + EXOTIC
texts = st.text(PLAIN, max_size=12)
"""What may stand on a line that nobody reads."""


def no_head(text: str) -> str:
    """A text as a line that begins no section, no keyword (unseen characters prevent neither) and no merge conflict."""
    begins = text.lstrip(f" \t{CONTROLS}")[:1] in ("$", "*") or text.startswith(("<<<<<<<", ">>>>>>>"))
    return f"x{text}" if begins else text


def _spelled(value: float, spelling: str) -> str:
    match spelling:
        case "exponent":
            return f"{value:.17e}"
        case "upper":
            return f"{value:.16E}"
        case "fortran":
            return f"{value:.16e}".replace("e", "D")
        case "signed":
            return ("+" if not math.copysign(1, value) < 0 else "") + repr(value)
        case _:
            return repr(value)


_SPELLINGS = ["repr", "repr", "exponent", "upper", "fortran", "signed"]
_finite = st.floats(allow_nan=False, allow_infinity=False) | st.floats(-1e4, 1e4)
ODD_NUMBERS = [
    *("0", "-0", "-0.0", "1.", ".5", "+1", "01", "-.5", "1.E3"),
    *("1d3", "007.250", "4.9e-324", "2.5E-310", "1" * 25),
]
numbers = st.builds(_spelled, _finite, st.sampled_from(_SPELLINGS)) | st.sampled_from(ODD_NUMBERS)
"""Any finite double, as people and programs spell it."""

EQUATIONS = [
    *("=[od]", "=[ 0.5*(OD - 2*wt) ]", "=[if(a > b, 1.0, list[2])]", '=["a, ] b"]'),
    *("=[]", "=[Tiefe \u00fc\u00e9^2]", "=[{x, y}]"),
]
equations = st.sampled_from(EQUATIONS)
labels = st.sampled_from(["{Seabed End}", "{a, b}", "{}", "{1}", "{\u00e9 \xa0}", '{"}', "{=[x]}"])

_names = st.text("abcXYZ019 ._%+-:;()'\u00e9\u00df\xa0\u2028", min_size=1, max_size=10).map(
    lambda name: name.strip(" ") or "n"
)
NAMES = [
    *("ALL", "Flow Line", "12", "1e5", "no", "null", "~", "0x1F", '"a, b"'),
    *("{lab, el}", "C", "- x", "true", "C x", "2001-01-01"),
]
names = _names | st.sampled_from(NAMES)
"""Names of sets, curves and parameters, those that look like something else included."""

_rules = st.sampled_from(["C", "c", "C ", "C------", "C***", "C====", "C~~", "C\t", "C.. ..", "C##"])
comments = (
    st.builds(lambda mark, text: mark + text, st.sampled_from(["C ", "c ", "C\t", "C--", "C"]), texts).filter(
        lambda line: line[1:2] in (" ", "\t") or line[1:3] == "--" or len(line) == 1
    )
    | _rules
)
"""Comment lines of every kind."""

gaps = st.sampled_from(["", " ", "\t", "  \t "])
"""Blank lines."""


@st.composite
def cased(draw: st.DrawFn, word: str) -> str:
    """A word in upper, lower or mixed case, its blanks widened."""
    shape = draw(st.sampled_from([str.upper, str.lower, str.title, str.swapcase]))
    return shape(word).replace(" ", draw(st.sampled_from([" ", "  ", "\t"])))


@st.composite
def rows(draw: st.DrawFn, fields: list[str], *, spare: bool = False) -> str:
    """Fields as a row: blanks around them, commas behind the last (`spare`), or numbers parted by blanks alone."""
    numeric = all(read_number(field) is not None for field in fields)
    if numeric and len(fields) > 1 and draw(st.integers(0, 3)) == 0:
        return draw(pads) + draw(st.sampled_from([" ", "\t", "  "])).join(fields) + draw(pads)
    end = draw(st.sampled_from(["", "", ",", " , ,"])) if spare else ""
    text = ",".join(draw(pads) + field + draw(pads) for field in fields) + end
    return " " + text if text.lstrip(" \t")[:1] not in set("0123456789+-.,") or text.startswith("\t") else text


@st.composite
def setting(draw: st.DrawFn, key: str, value: str) -> str:
    """A line `KEY=value`."""
    return f"{draw(pads)}{draw(cased(key))}{draw(pads)}={draw(pads)}{value}{draw(pads)}"
