"""Decks that `*VARIATION` and `*COMBINATIONS` describe: planned as a whole, then written one by one."""
