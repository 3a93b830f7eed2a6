"""Tokens of set phrases, names and styles, before words get their parts of speech."""
