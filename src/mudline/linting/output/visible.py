"""Text of a deck made harmless: nothing in it can act on a terminal."""

from __future__ import annotations

_REPLACEMENT = "\ufffd"
LONGEST = 1000


def visible(text: str, encoding: str = "utf-8") -> str:
    """The text with a blank for a tab and a replacement mark for every other character that does not print.

    What a terminal's encoding lacks is escaped, so that the text is as long here as it is there. A text that nobody
    would read to its end is cut.
    """
    shown = text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."
    if not shown.isprintable():
        shown = "".join(char if char.isprintable() else " " if char == "\t" else _REPLACEMENT for char in shown)
    if encoding.startswith("utf"):
        return shown
    return shown.encode(encoding, "backslashreplace").decode(encoding)


def visible_lines(text: str) -> str:
    """The same for a text of several lines, whose line ends and tabs stay."""
    kept = "\n\t"
    if all(char.isprintable() or char in kept for char in text):
        return text
    return "".join(char if char.isprintable() or char in kept else _REPLACEMENT for char in text)
