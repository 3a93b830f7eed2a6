"""Tokens to words with a part of speech."""
