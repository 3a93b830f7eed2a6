"""Joints that bend: how a group of parts is stretched, grows, undulates or sways.

They join those of `models.joints` in the entries of bodies. RATE is "2hz" (cycles per second) or
"1.5/m" (cycles per metre travelled); "start NAME" lets the seed choose where the cycle begins,
"from .25" begins it later by a share of a cycle.

    pulse yz PIVOT .1 RATE         stretched along axes by up to a share, and shrunk
    grow  yz PIVOT .1 RATE         from a share of its size to the whole, again and again
    sway  y .05 RATE               to and fro along an axis, m
    bow   y PIVOT 60               turned down while the mouth is at the ground, degrees
    vary  xyz PIVOT .9 1.1 NAME    stretched by a factor that the seed chooses, once and for all
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from texvent.scenes.models.animals.acts import ANIMAL_ACTS, act_stance
from texvent.scenes.models.joints import Joint, read_joint, read_number
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import Affine, Point, compose, moved, shift, turn_about
from texvent.scenes.models.variation import between, fraction

RESTING = frozenset({"stand", "sit", "lie", *ANIMAL_ACTS})
"""Activities of a body that stays where it is."""
_RESTING_VIGOUR = 0.3
"""How far a swimmer at rest undulates."""
_HEAD_X, _HEAD_REACH, _WAVES = 0.45, 0.12, 3.6
"""Where a swimmer's head is, how far it swings compared with its tail, and how much the wave lags
along its body, rad: for a body of length 1."""

Cycle = Callable[[Pose, int], float]
"""Pose and seed → cycles so far."""


def read_cycle(words: Sequence[str]) -> Cycle:
    """Cycles from the words of a rate, such as ("2hz", "start", "flap").

    Raises:
        ValueError: they are none.
    """
    rate, *more = words
    options = dict(zip(more[::2], more[1::2], strict=True))
    late, label = read_number(options.pop("from", "0")), options.pop("start", None)
    if options:
        raise ValueError(f"unknown words {' '.join(options)!r}; there are 'start' and 'from'")
    unit = next((one for one in ("hz", "/m") if rate.endswith(one)), None)
    if unit is None:
        raise ValueError(f"rate {rate!r} needs the unit 'hz' or '/m'")
    pace = read_number(rate.removesuffix(unit))

    def cycle(pose: Pose, seed: int) -> float:
        begun = fraction(seed, label) if label is not None else 0.0
        return pace * (pose.time_s if unit == "hz" else pose.distance_m) + begun + late

    return cycle


def read_body_joint(text: str) -> Joint:
    """A joint of a body from its text.

    Raises:
        ValueError: it cannot be read; the message has the text.
    """
    kind, *words = text.split() or [""]
    if kind not in _COUNTS:
        return read_joint(text)
    count = _COUNTS[kind]
    try:
        axes, *rest = words
        numbers = [read_number(one) for one in rest[:count]]
        if kind == "bow":
            return Joint(_bow(axes, numbers))
        if kind == "vary":
            return Joint(_vary(axes, numbers, rest[count]))
        return Joint(_CYCLING[kind](axes, numbers, read_cycle(rest[count:])))
    except (ValueError, IndexError) as error:
        raise ValueError(f"joint {text!r}: {error}") from None


Motion = Callable[[Pose, int], Affine]


def sine(cycle: Cycle, pose: Pose, seed: int) -> float:
    """The sine of a cycle at one instant."""
    return math.sin(2.0 * math.pi * cycle(pose, seed))


def _pulse(axes: str, numbers: Sequence[float], cycle: Cycle) -> Motion:
    x, y, z, share = numbers
    return lambda pose, seed: _stretch(axes, 1.0 + share * sine(cycle, pose, seed), (x, y, z))


def _grow(axes: str, numbers: Sequence[float], cycle: Cycle) -> Motion:
    x, y, z, least = numbers
    return lambda pose, seed: _stretch(
        axes, least + (1.0 - least) * (cycle(pose, seed) % 1.0), (x, y, z)
    )


def _sway(axis: str, numbers: Sequence[float], cycle: Cycle) -> Motion:
    (reach,) = numbers
    return lambda pose, seed: shift(**{axis: reach * sine(cycle, pose, seed)})


def read_wave(text: str) -> Callable[[ModelPart, Pose, int], ModelPart]:
    """A swimmer's wave from text such as "y .07 2hz start beat": axis, reach of the tail, rate.

    It runs from the head, .5 ahead of the origin, to the tail, .5 behind it, and takes each part
    along where that part is.

    Raises:
        ValueError: it cannot be read.
    """
    axis, reach, *rate = text.split()
    cycle, far = read_cycle(rate), read_number(reach)
    axle, sign = ("y", -1.0) if axis == "z" else ("z", 1.0)

    def waved(part: ModelPart, pose: Pose, seed: int) -> ModelPart:
        x = float(part.to_body[0, 3])
        vigour = _RESTING_VIGOUR if pose.activity in RESTING else 1.0
        swing = vigour * far * (_HEAD_REACH + (1.0 - _HEAD_REACH) * ((_HEAD_X - x) / 0.95) ** 2)
        phase = 2.0 * math.pi * cycle(pose, seed) + _WAVES * x
        slant = sign * math.atan(_WAVES * swing * math.cos(phase))
        offset = shift(**{axis: swing * math.sin(phase)})
        return moved([part], compose(offset, turn_about(axle, slant, (x, 0.0, 0.0))))[0]

    return waved


def _bow(axis: str, numbers: Sequence[float]) -> Motion:
    x, y, z, reach = numbers
    far = math.radians(reach)
    return lambda pose, seed: turn_about(
        axis, far * act_stance(pose.activity, pose.time_s).head_down, (x, y, z)
    )


def _vary(axes: str, numbers: Sequence[float], name: str) -> Motion:
    x, y, z, low, high = numbers
    return lambda pose, seed: _stretch(axes, between(seed, name, low, high), (x, y, z))


_CYCLING: Mapping[str, Callable[[str, Sequence[float], Cycle], Motion]] = {
    "pulse": _pulse, "grow": _grow, "sway": _sway,
}  # fmt: skip
_COUNTS = {"pulse": 4, "grow": 4, "sway": 1, "bow": 4, "vary": 5}
"""Kind of joint → its count of numbers."""


def _stretch(axes: str, factor: float, pivot: Point) -> Affine:
    """A stretching along axes such as "yz" that leaves a point where it is."""
    factors = np.array([factor if axis in axes else 1.0 for axis in "xyz"])
    return np.column_stack([np.diag(factors), (1.0 - factors) * np.array(pivot)])
