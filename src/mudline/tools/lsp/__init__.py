"""Language server: requests of an editor about decks, answered by the functions behind the commands."""
