"""The settings of every run of a data set: the options of the data set, a variant and a clip."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from texvent.batch.identity import derived_seed
from texvent.config import InterpolateConfig
from texvent.dataset.specification.clips import Clip
from texvent.dataset.specification.option_ranges import draw_options, extreme_options
from texvent.dataset.specification.specification import Specification, Variant
from texvent.errors import ConfigError
from texvent.options.fields import option_names
from texvent.run.prepare import check_run
from texvent.settings.config_files import Command
from texvent.settings.resolution import Settings, resolve


def check_options(specification: Specification, command: Command, *, is_stored: bool) -> None:
    """Refuse options that some run would refuse, and options of a variant that change the video.

    Args:
        specification: of the data set.
        command: whose options it has.
        is_stored: whether videos are stored before they are simulated.

    Raises:
        ConfigError, InputError, MissingDependencyError: as `texvent.run.prepare.check_run`.
    """
    for variant in specification.variants:
        for options in extreme_options(_options(specification, variant, is_stored)):
            settings = resolve(command, options)
            check_run(settings)
            if command == "generate":
                _refuse_video_options(settings, variant)


def _refuse_video_options(settings: Settings, variant: Variant) -> None:
    of_video = {"generator", *option_names(type(settings.source))}
    for name in variant.options:
        if name in of_video:
            raise ConfigError(
                f"variant {variant.name} sets {name}, which changes the video; all variants are "
                "simulated from the same one: set it in options"
            )


def video_settings(specification: Specification, clip: Clip, command: Command) -> Settings:
    """Settings of a clip's video, at the size of its generator."""
    options = draw_options(specification.options, specification.seed, clip.key)
    settings = resolve(command, {**options, "seed": clip.seed})
    return dataclasses.replace(settings, run=dataclasses.replace(settings.run, sensor=None))


def clip_settings(
    specification: Specification, variant: Variant, clip: Clip, command: Command, *, is_stored: bool
) -> Settings:
    """Settings of a clip in a variant; the seed is that of the video.

    What is drawn depends on the clip alone, so that all variants of a clip share it.
    """
    options = draw_options(
        _options(specification, variant, is_stored), specification.seed, clip.key
    )
    return resolve(command, {**options, "seed": clip.seed})


def simulation_seed(clip: Clip, number: int) -> int:
    """Seed of the simulation `number` of a clip; the first is the clip's own."""
    return clip.seed if number == 0 else derived_seed(clip.seed, "simulation", number)


def _options(specification: Specification, variant: Variant, is_stored: bool) -> Mapping[str, Any]:
    # A stored video cannot be rendered at any instant, whatever its generator could do.
    basis = {"interpolate": InterpolateConfig.interpolate} if is_stored else {}
    return {**basis, **specification.options, **variant.options}
