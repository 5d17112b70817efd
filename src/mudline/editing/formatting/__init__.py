"""Canonical layout of a deck's text, as edits that do not change its meaning."""
