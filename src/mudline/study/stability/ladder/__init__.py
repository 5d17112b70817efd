"""A ladder of extremes: small decks with numbers at the ends of what numbers can be, against exact arithmetic.

Every deck is text, and goes the whole way: read, resolved, evaluated. A result is right, within a stated bound, or it
is refused with a diagnostic that names a line of the deck; nothing else is let through.
"""
