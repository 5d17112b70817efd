"""Scenes for the tests of studies."""

from __future__ import annotations

from mudline.deck.loading import load_bytes
from mudline.scene.model import Scene, resolve


def scene_of(text: str, name: str = "deck.keyxm", units: str | None = None) -> Scene:
    """The scene of a deck that can be evaluated."""
    return resolve(load_bytes(text.encode(), name, units=units)).require()
