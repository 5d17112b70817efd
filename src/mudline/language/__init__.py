"""Language of decks: source text, grammar, equations, keywords and the deck they make; findings and rules."""
