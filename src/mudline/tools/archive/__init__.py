"""An archive of decks: a folder of Parquet files with what is in many decks, and questions about it in SQL."""
