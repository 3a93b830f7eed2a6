"""`texvent dataset`: data sets made, looked at, checked, exported."""
