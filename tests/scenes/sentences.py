"""Sentences as descriptions, for tests of what scenes show."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.generate.scene_input import understand
from texvent.scenes.description import SceneDescription
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Noun


def parse_prompt(prompt: str, nouns: Mapping[str, Noun] = NOUNS) -> SceneDescription:
    """The description of a sentence, with all that it leaves open decided."""
    return understand(prompt, nouns)
