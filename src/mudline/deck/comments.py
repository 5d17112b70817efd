"""Comments of a document find the places that they would have in keyword text."""

from __future__ import annotations

from mudline.deck.model import Deck, Opaque, Section
from mudline.keywords.model import Comment


def settle(deck: Deck) -> None:
    """Move comments so that they belong to what keyword text gives them to; what is written of the deck is the same.

    Before the first section they are lines of the preamble, behind a block without a model they are lines of it, and
    at the end of a section they stand before the next one. An index beyond the last item means behind it.
    """
    waiting = sorted(deck.comments, key=lambda comment: comment.before)[::-1]
    deck.comments = []
    while waiting and (waiting[-1].before == 0 or not deck.sections):
        deck.preamble.append(f"C{waiting.pop().text}")
    for number, section in enumerate(deck.sections, 1):
        following = _settle_section(section)
        while waiting and (waiting[-1].before <= number or number == len(deck.sections)):
            following.append(waiting.pop().text)
        last = section.blocks[-1] if section.blocks else None
        if last is None:
            section.comments += [Comment(before=0, text=text) for text in following]
        elif isinstance(last, Opaque):
            last.lines += [f"C{text}" for text in following]
        else:
            deck.comments += [Comment(before=number, text=text) for text in following]


def _settle_section(section: Section) -> list[str]:
    """The texts of the comments behind the last block."""
    following: list[str] = []
    comments = sorted(section.comments, key=lambda comment: comment.before)
    section.comments = []
    for comment in comments:
        before = min(comment.before, len(section.blocks))
        owner = section.blocks[before - 1] if before else None
        if before and before == len(section.blocks):
            following.append(comment.text)
        elif isinstance(owner, Opaque):
            owner.lines.append(f"C{comment.text}")
        else:
            section.comments.append(Comment(before=before, text=comment.text))
    return following
