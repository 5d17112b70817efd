"""The language server: what an editor asks about decks, answered by what the commands use, too."""
