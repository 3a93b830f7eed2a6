"""Clothes that hang or lie alone: the nouns of `data/nouns/clothes.toml`."""

from __future__ import annotations

from importlib.resources import files

from texvent.scenes.models.parts import read_nouns

NOUNS = read_nouns(files("texvent.scenes.models") / "data" / "nouns" / "clothes.toml")
