"""A description staged for an image of some size, with the report of what is in view."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from texvent.prompt_report import PromptReport
from texvent.sensor import SensorSize
from texvent_scenes.assets.nouns import list_files
from texvent_scenes.description import SceneDescription
from texvent_scenes.in_view import Unseen, find_unseen, without_words
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.staging.compose import ComposedScene, compose_scene


def stage(
    description: SceneDescription,
    said: PromptReport,
    named: Mapping[str, Noun],
    *,
    seed: int,
    size: SensorSize,
    duration_s: float,
) -> tuple[ComposedScene, PromptReport, list[dict[str, str]]]:
    """The scene of a description, the report of its words, and the files that it is made of.

    Args:
        description: the scene.
        said: the report before the scene is built.
        named: nouns that it can name.
        seed: decides the layout.
        size: of the image, pixels.
        duration_s: length of the clip, s.
    """
    files = list_files(description, named)
    nouns = tuple(named[one.noun] for one in description.objects)
    contents = tuple(tuple(one.values()) for one in files)
    scene, unseen = _staged(description, nouns, contents, seed, size, duration_s)
    shown = without_words(said.shown, unseen.violations)
    lines = (*said.not_shown, *scene.not_shown,
             *filter(None, (one.line for one in unseen.violations)))  # fmt: skip
    told = " ".join((*lines, *unseen.out_of_view, *unseen.too_small)).casefold()
    lost = (one for one in said.shown if one not in shown
            and not re.search(rf"\b{re.escape(one)}\b", told))  # fmt: skip
    report = replace(
        said,
        shown=shown,
        notes=(*said.notes, *scene.notes, *scene.camera_path.notes, *unseen.notes),
        not_shown=(*lines, *lost),
        out_of_view=unseen.out_of_view,
        too_small=unseen.too_small,
    )  # fmt: skip
    return scene, report, files


@lru_cache(maxsize=4)
def _staged(
    description: SceneDescription,
    named: tuple[Noun, ...],
    contents: tuple[tuple[str, ...], ...],
    seed: int,
    size: SensorSize,
    duration_s: float,
) -> tuple[ComposedScene, Unseen]:
    """A scene and what it does not show; kept, since one is often simulated several times.

    Assets are shown where the prompt names them, not as scenery.

    Args:
        description: the scene.
        named: the noun of each of its objects.
        contents: states of the files that it is made of: with others it is another scene.
        seed: decides the layout.
        size: of the image, pixels.
        duration_s: length of the clip, s.
    """
    del contents
    shown = {one.noun: noun for one, noun in zip(description.objects, named, strict=True)}
    scene = compose_scene(
        description, seed=seed, size=size, duration_s=duration_s, nouns={**NOUNS, **shown}
    )
    return scene, find_unseen(scene, description, size, duration_s)
