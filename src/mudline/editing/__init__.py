"""Rewriting and comparing decks: format, migrate, set values, expand load cases, list differences."""
