"""Which backend evaluates a query: numpy alone, or compiled loops.

Loading numba takes about a second, so the compiled loops are loaded by the first query that is large enough to make
more of them likely; once they are there, they also serve smaller ones.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from typing import Literal, cast

from mudline.curves.knots import Knots
from mudline.curves.law import Law, NumpyLaw
from mudline.curves.search import search_for
from mudline.curves.work import Work

Backend = Literal["auto", "numpy", "fast"]

_COMPILED = "mudline.curves.compiled"

_WORTH_LOADING = 2**22
_WORTH_CALLING = 2**12


def law_for(knots: Knots, total: int, work: Work, backend: Backend = "auto") -> Law:
    """Return the way to evaluate a query of `total` ratios.

    Raises:
        ImportError: `backend` is "fast", but the extra `mudline[fast]` is not installed.
        ValueError: there is no such backend.
    """
    if backend not in ("auto", "numpy", "fast"):
        raise ValueError(f"backend must be auto, numpy or fast, not {backend!r}")
    if backend == "fast" or (backend == "auto" and _pays(total)):
        return cast("Law", import_module(_COMPILED).compiled_law(knots))
    return NumpyLaw(knots, search_for(knots, total, work), work)


def _pays(total: int) -> bool:
    return total >= _WORTH_CALLING and (_COMPILED in sys.modules or (total >= _WORTH_LOADING and _loads()))


@cache
def _loads() -> bool:
    try:
        import_module(_COMPILED)
    except ImportError:
        return False
    return True
