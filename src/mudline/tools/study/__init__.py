"""The study of a deck: what accuracy costs, which steps are stable, and what the deck does not need.

It measures what depends on the deck; what holds for any deck is in the studies of the documentation. Drawing needs
matplotlib (extra `plot`), all else nothing beside numpy.
"""

from __future__ import annotations

from mudline.tools.study.report import PARTS, Study, jump_note, study

__all__ = ["PARTS", "Study", "jump_note", "study"]
