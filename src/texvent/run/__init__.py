"""A run: its options, how it is made ready, the files it writes, what is stored of it."""
