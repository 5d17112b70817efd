"""Syntax highlighting of decks: the words of the language, and the lexer for Pygments."""
