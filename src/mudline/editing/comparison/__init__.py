"""Semantic comparison of two decks."""
