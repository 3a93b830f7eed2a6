"""Defaults of sentences: fields that their words say otherwise than those of files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.prompt_report import PromptReport
from texvent_scenes.default_work import stands_still
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.protocol import Noun
from texvent_scenes.spec.scene import Scene


def settle_words(scene: Scene, words: PromptReport, nouns: Mapping[str, Noun]) -> Scene:
    """The scene of a sentence with fields that its words say otherwise than those of files.

    A room at night is lit, "an empty street" is one without people and traffic, and a fan that
    stands somewhere works there.
    """
    objects = tuple(replace(one, motions=()) if stands_still(one, nouns[one.noun]) else one
                    for one in scene.objects)  # fmt: skip
    scene = replace(scene, objects=objects)
    place, absent = scene.place, scene.absent
    decided = complete(replace(to_description(scene), words=words), nouns)
    model = PLACES[decided.place.name or "grass"]
    if place.is_empty and not model.is_cleared and model.scenery:
        place = replace(place, is_empty=False)
        movers = (one.noun for one in model.scenery if nouns[one.noun].speed_m_s > 0.0)
        absent = tuple(dict.fromkeys((*absent, *movers)))
    is_lit = decided.light.kind in ("night", "moonlight") and model.is_room
    return replace(scene, place=replace(place, is_lit=is_lit), absent=absent)
