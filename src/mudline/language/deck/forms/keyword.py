"""A deck to keyword text; such a text is read by `read_source`."""

from __future__ import annotations

from mudline.language.deck.keyword_text import to_keyword

write = to_keyword  # as `dump` knows it
