"""Page about a deck that a checker signs: its content, its pictures, and its HTML, which needs jinja2."""
