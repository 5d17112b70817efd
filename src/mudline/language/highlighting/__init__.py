"""Syntax highlighting of decks: the lexer for Pygments."""
