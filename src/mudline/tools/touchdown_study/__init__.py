"""Resting shape of a deck, and the study of its touchdown zone."""
