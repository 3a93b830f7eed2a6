"""The camera of another take: nearer, further away, or aimed at things that were lost."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.take import Take

_INSTANTS = 5


def retake(path: CameraPath, take: Take, actors: Sequence[Actor]) -> CameraPath:
    """The usual camera at the distance of a take, turned to what it aims at."""
    framing = replace(path.framing, distance_m=take.distance * path.framing.distance_m)
    times = np.linspace(0.0, path.duration_s, _INSTANTS)
    middles = [
        actor.middle(float(time))
        for actor in actors
        if actor.object_index in take.aim
        for time in times
    ]
    if middles:
        framing = replace(framing, target=np.mean(middles, axis=0))
    return replace(path, framing=framing)
