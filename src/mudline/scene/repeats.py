"""Numbers that are defined twice."""

from __future__ import annotations

import numpy as np

from mudline.codes.references import REF007
from mudline.diagnostics import Blocks, Problem, Severity
from mudline.scene.context import MOST_TOLD, Context
from mudline.scene.numbering import Indices, Numbered


def tell_repeats(context: Context, numbered: Numbered, repeats: Indices, thing: str) -> None:
    """Tell of definitions (rows) whose number an earlier one has: each row of a table, a generator once."""
    if not repeats.size:
        return
    batches, begins = np.unique(numbered.batches_of(repeats), return_index=True)
    ends = [*begins.tolist()[1:], len(repeats)]
    for batch, begin, end in zip(batches.tolist(), begins.tolist(), ends, strict=True):
        if numbered.batches[batch].table:
            for row in repeats[begin : min(end, begin + MOST_TOLD + 1)].tolist():
                _tell(context, numbered, row, thing, 1)
        else:
            _tell(context, numbered, int(repeats[begin]), thing, end - begin)


def _tell(context: Context, numbered: Numbered, row: int, thing: str, count: int) -> None:
    where = numbered.where_row(row)
    number = numbered.ids_of(np.array([row]))
    first = numbered.where_row(int(numbered.firsts[numbered.indices(number)[0]]))
    what = f"{thing} {number[0]} is" if count == 1 else f"{count} {thing}s (first: {number[0]}) are"
    message = f"{what} defined twice: the later definition holds; remove one"
    if first.section == where.section:
        context.note(Problem(REF007, message, where=where, blocks=Blocks.NEVER))
    else:
        message += " (inferred: the $MODEL sections of a file make one model)"
        context.tell(REF007, message, where, Severity.WARNING)
