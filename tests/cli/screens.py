"""What is left on a terminal after all that was written to it."""

from __future__ import annotations

import re

_PIECE = re.compile(r"\x1b\[(\?)?([\d;]*)([A-Za-z])|(\r)|(\n)|([^\x1b\r\n]+)")


def screen(written: str) -> list[str]:
    """The lines on the screen: understands line ends, erased lines, steps up; colours and the cursor are nothing."""
    lines, row, column = [""], 0, 0
    for match in _PIECE.finditer(written):
        _, number, letter, back, end, text = match.groups()
        if back:
            column = 0
        elif end:
            row, column = row + 1, 0
            lines += [""] * (row + 1 - len(lines))
        elif text:
            lines[row] = lines[row][:column].ljust(column) + text + lines[row][column + len(text) :]
            column += len(text)
        elif letter == "A":
            row -= int(number or 1)
        elif letter == "K":
            assert number == "2"
            lines[row] = ""
        else:
            assert letter in "mhl", match[0]
    return lines
