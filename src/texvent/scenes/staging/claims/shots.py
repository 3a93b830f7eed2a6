"""Whether the camera makes the moves that the prompt asks for."""

from __future__ import annotations

import numpy as np

from texvent.scenes.description import CameraMove, Shot
from texvent.scenes.evidence import Unmet
from texvent.scenes.scene import Camera
from texvent.scenes.staging.camera.camera_path import CameraPath

_LEAST_RAD = 0.015
_LEAST_RATIO = 1.03
_LEAST_SHARE = 0.01
"""Of the distance to what it looks at, for moves of its place."""
_STEADY = ("static", "handheld", "follow", "dutch")
_SIGNS = {"left": -1.0, "down": -1.0, "out": -1.0, "counter-clockwise": -1.0}


def list_moves_not_shown(shot: Shot, path: CameraPath, duration_s: float) -> list[Unmet]:
    """Moves that the camera does not make, such as "camera pan left".

    Of a move that has its phase for itself the direction counts; where moves add up, that the
    camera moves at all.
    """
    last = max((move.phase for move in shot.moves), default=0)
    missing = []
    for move in shot.moves:
        begin = path.at(duration_s * move.phase / (last + 1))
        end = path.at(duration_s * (move.phase + 0.98) / (last + 1))
        is_alone = sum(other.phase == move.phase for other in shot.moves) == 1
        amount = _progress(move, begin, end, path.framing.distance_m)
        if amount is None or path.journey is not None:
            is_shown = move.kind in _STEADY or _changes(begin, end)
        else:
            is_shown = amount > 1.0 if is_alone else _changes(begin, end)
        if not is_shown:
            words = (w for w in ("camera", move.kind, move.direction) if w)
            missing.append(Unmet(" ".join(words), move=move.kind))
    return missing


def _progress(move: CameraMove, begin: Camera, end: Camera, distance_m: float) -> float | None:
    """How far a move goes its own way, as a multiple of what can be seen; None: not measured."""
    sign = _SIGNS.get(move.direction or "", 1.0)
    right, down, forward = begin.rotation
    shift = (end.position - begin.position) / (_LEAST_SHARE * distance_m)
    measured = {
        "pan": float(end.rotation[2] @ right) / _LEAST_RAD,
        "tilt": float(np.arcsin(end.rotation[2, 2]) - np.arcsin(forward[2])) / _LEAST_RAD,
        "zoom": float(np.log(end.focal / begin.focal) / np.log(_LEAST_RATIO)),
        "dolly": float(shift @ forward),
        "truck": float(shift @ right),
        "pedestal": float(shift[2]),
        "crane": float(shift[2]),
        "roll": float(end.rotation[0] @ down) / _LEAST_RAD,
    }
    amount = measured.get(move.kind)
    return None if amount is None else sign * amount


def _changes(begin: Camera, end: Camera) -> bool:
    """Whether a camera moves, turns or zooms at all."""
    return bool(
        np.linalg.norm(end.position - begin.position) > 1e-3
        or np.abs(end.rotation - begin.rotation).max() > _LEAST_RAD
        or abs(end.focal / begin.focal - 1.0) > _LEAST_RATIO - 1.0
    )
