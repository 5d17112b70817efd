"""A page about a deck that a checker signs: what it says, its pictures, and its HTML. The HTML needs jinja2."""
