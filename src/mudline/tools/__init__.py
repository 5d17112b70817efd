"""Work on decks that are read and checked: the language server, archive, reports, exports, the study, many files."""
