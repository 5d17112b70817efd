"""What differs between the meanings of two decks."""
