"""What made a recording: stored in every output, enough to make it again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent._version import full_version
from texvent.generate.scene_input import SCENE_KEY
from texvent.run.settings import Settings
from texvent.run.source_file import describe_source
from texvent.scenes.report import REPORT_KEY


def describe_run(
    settings: Settings, *, prompt: str | None, source: Mapping[str, Any]
) -> dict[str, Any]:
    """Prompt or scene, report, source, models, seed, options, version and weight files of a run.

    Args:
        settings: all options.
        prompt: what the video shows, if it was said.
        source: metadata of the video.
    """
    run = settings.run
    facts = describe_source(source)
    made_of = {key: facts.pop(key) for key in (SCENE_KEY, REPORT_KEY) if key in facts}
    return {
        "prompt": prompt,
        **made_of,
        "source": facts,
        "generator": settings.generator,
        "simulator": run.simulator,
        "preset": run.preset,
        "seed": run.seed,
        "settings": settings.as_tables(),
        "texvent_version": full_version(),
        **describe_weights(settings),
    }


def describe_weights(settings: Settings) -> dict[str, Any]:
    """Which files the models of a run read, such as network weights, under "weights".

    Nothing where they read none.

    Raises:
        InputError: such a file is missing.
    """
    interpolator = INTERPOLATORS.load(settings.interpolate.interpolate)
    simulator = SIMULATORS.load(settings.run.simulator)
    parts = {
        "interpolator": (interpolator, settings.interpolate),
        "simulator": (simulator, settings.simulate),
    }
    files = {
        role: facts
        for role, (part, config) in parts.items()
        if hasattr(part, "provenance") and (facts := part.provenance(config))
    }
    return {"weights": files} if files else {}
