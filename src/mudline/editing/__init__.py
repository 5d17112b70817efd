"""Rewriting and comparing decks: format, migrate, set values, expand load cases, tell differences."""
