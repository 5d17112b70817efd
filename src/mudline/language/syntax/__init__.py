"""Syntax of a deck: source text, lossless tree of lines and blocks, fields and rows. Meaning is not part of it."""
