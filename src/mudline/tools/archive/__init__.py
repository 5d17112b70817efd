"""Archive of decks: a folder of Parquet files with the contents of many decks, to be queried in SQL."""
