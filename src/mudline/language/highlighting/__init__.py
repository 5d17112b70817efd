"""Colours for decks: the words of the language, and the lexer for Pygments, which only this package imports."""
