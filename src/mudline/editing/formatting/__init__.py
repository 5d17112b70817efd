"""The canonical layout of a deck's text, as edits that change nothing of its meaning."""
