"""Sentence → scene description: tokens, phrases with roles, objects and relations."""
