"""One value in many decks: paths to fields, conditions on them, and the change of a text that sets a value."""
