"""Breaking: the instant at which a body goes to pieces, which particles show from then on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.spec.scene import Motion
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.tracks.phases import schedule

_SHARE, _LEAST_FALL, _TOUCHING, _FALLEN = 0.4, 0.5, 0.02, 0.8
"""Share of the clip after which what only breaks does so; least fall, in heights of the body, that
ends with it; height above its lowest place at which it touches the floor, in its own; share of the
fall after which it may: what tumbles touches it with an edge first."""
_RATE_HZ, _HALVINGS = 60.0, 14
"""Instants per second at which a contact is looked for, and steps that make it exact."""


def break_up(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> list[Actor]:
    """The actors, with the instant at which those that break do so."""
    return [
        replace(one, breaks_s=_find_instant(one, said, duration_s), pieces_pace=paces[0])
        if paces else one
        for one in actors
        for said in [description.objects[one.object_index].motions]
        for paces in [[each.pace for each in said if each.kind == "break"]]
    ]  # fmt: skip


def _find_instant(actor: Actor, said: Sequence[Motion], duration_s: float) -> float:
    """Instant of the first contact with the floor; without a fall, the beginning of its phase."""
    times = np.linspace(0.0, duration_s, max(int(_RATE_HZ * duration_s), 2) + 1)
    low = np.array([actor.lowest_m(float(at)) for at in times])
    size_m = actor.model.height
    if low[0] - low.min() < _LEAST_FALL * size_m:
        phases = [one for one in schedule(said, duration_s) if one.motion.kind == "break"]
        begin_s = phases[0].start_s if phases else duration_s
        return begin_s or _SHARE * duration_s
    deep = low <= low.min() + (1.0 - _FALLEN) * (low[0] - low.min())
    lowest = deep & (low <= np.roll(low, 1)) & (low <= np.roll(low, -1))
    level_m = float(low[np.argmax(lowest)]) + _TOUCHING * size_m
    later = int(np.argmax(low <= level_m))
    begin_s, end_s = float(times[max(later - 1, 0)]), float(times[later])
    for _ in range(_HALVINGS):
        middle_s = 0.5 * (begin_s + end_s)
        if actor.lowest_m(middle_s) <= level_m:
            end_s = middle_s
        else:
            begin_s = middle_s
    return end_s
