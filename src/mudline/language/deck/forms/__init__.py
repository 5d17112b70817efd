"""The forms of a deck, a module each: `write` makes a text of a deck, `read` a deck of the bytes of a file."""
