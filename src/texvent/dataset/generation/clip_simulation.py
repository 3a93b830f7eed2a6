"""The simulation of a clip whose video is recorded, or generated now."""

from __future__ import annotations

from dataclasses import replace

from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.clips import Clip
from texvent.pipeline import Simulation, text_to_video
from texvent.run.prepare import prepare_source, prepare_video
from texvent.settings.resolution import Settings


def prepare_clip(recipe: Recipe, clip: Clip, settings: Settings) -> Simulation:
    """A clip made ready; its video has the clip's seed, its simulation that of the settings.

    Raises:
        TexventError: the video cannot be read or made.
    """
    prompt = clip.item.prompt
    if recipe.items.are_videos:
        return prepare_source(clip.item.video, settings, prompt=prompt, video_seed=clip.seed)
    video = text_to_video(clip.item.subject, with_seed(settings, clip.seed))
    return prepare_video(video, settings, prompt=prompt)


def with_seed(settings: Settings, seed: int) -> Settings:
    """The same settings with another seed."""
    return replace(settings, run=replace(settings.run, seed=seed))
