"""Joints of nouns: how a group of parts moves, bends or shines with time and distance.

docs/nouns.md lists them. RATE is "2hz" (cycles per second) or, of what bends, "1.5/m" (cycles per
metre travelled); "start NAME" lets the seed choose where the cycle begins, "from .25" begins it
later by a share of a cycle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.models.animals.acts import ANIMAL_ACTS, act_stance
from texvent.scenes.models.materials import shade
from texvent.scenes.models.protocol import ModelPart, Pose, between, fraction
from texvent.scenes.models.shapes import Affine, Point, compose, moved, shift, turn_about

_UNITS = {"": 1.0, "deg": math.radians(1.0), "hz": 1.0, "m/s": 1.0, "m": 1.0}

RESTING = frozenset({"stand", "sit", "lie", *ANIMAL_ACTS})
"""Activities of a body that stays where it is."""
_RESTING_VIGOUR = 0.3
"""How far a swimmer at rest undulates."""
_HEAD_X, _HEAD_REACH, _WAVE_LAG = 0.45, 0.12, 3.6
"""Where a swimmer's head is, how far it swings compared with its tail, and how much the wave lags
along its body, rad: for a body of length 1."""

Cycle = Callable[[Pose, int], float]
"""Pose and seed → cycles so far."""


@dataclass(frozen=True)
class Joint:
    """How parts move in their body."""

    motion: Callable[[Pose, int], Affine]
    """Pose and seed → [3, 4] map."""
    rolls: bool = False
    """Whether it turns with the distance travelled."""


@dataclass(frozen=True)
class Light:
    """How parts get brighter and darker."""

    level: Callable[[float, int], float]
    """Time in seconds and seed → 0..1."""
    dim: float | None = None
    """Share of their colour that is left when they are dark; None = all of it."""

    def shine(self, parts: Sequence[ModelPart], pose: Pose, seed: int) -> list[ModelPart]:
        """The parts as bright as they are at that pose."""
        level = self.level(pose.time_s, seed)
        share = 1.0 if self.dim is None else self.dim + (1.0 - self.dim) * level
        return [
            replace(one, emission=level * one.emission, colour=shade(one.colour, share))
            for one in parts
        ]


def place(joints: Sequence[Joint], pose: Pose, seed: int) -> Affine:
    """The map of parts on a chain of joints, the outermost first."""
    motion = joints[0].motion(pose, seed)
    for joint in joints[1:]:
        motion = compose(motion, joint.motion(pose, seed))
    return motion


def read_number(word: str) -> float:
    """A number, perhaps with a unit; degrees become radians only in joints.

    Raises:
        ValueError: it is none, or not finite.
    """
    value = float(word)
    if not math.isfinite(value):
        raise ValueError(f"numbers must be finite but one is {word!r}")
    return value


def rolling(axis: str, pivot: Point, radius: float) -> Joint:
    """Turning with the distance travelled, without slipping."""
    if radius == 0.0:
        raise ValueError("what rolls needs a radius that is not 0")
    return Joint(lambda pose, seed: turn_about(axis, pose.distance_m / radius, pivot), rolls=True)


def read_joint(text: str) -> Joint:
    """A joint from its text, such as "swing x 0 0 1.17 22.9deg .541hz".

    Raises:
        ValueError: it cannot be read; the message has the text.
    """
    try:
        kind, axis, *rest = text.split()
        axes = axis if kind in _STRETCHING else [axis]
        if kind not in _JOINTS or not set(axes) <= set("xyz"):
            raise ValueError(f"it must begin with {', '.join(_JOINTS)} and an axis x, y or z")
        return _JOINTS[kind](axis, rest)
    except (ValueError, IndexError) as error:
        raise ValueError(f"joint {text!r}: {error}") from None


def read_light(text: str) -> Light:
    """A light from its text, such as "sine 1hz start blink".

    Raises:
        ValueError: it cannot be read; the message has the text.
    """
    try:
        kind, *rest = text.split()
        options = _Options(rest)
        rate, lag, start = options.number("at"), options.angle("from"), options.start()
        low, high = options.pair("between")
        dim = options.number("dim") if "dim" in rest else None
        if kind not in _WAVES:
            raise ValueError(f"it must begin with {', '.join(_WAVES)}")
    except (ValueError, IndexError) as error:
        raise ValueError(f"light {text!r}: {error}") from None
    wave = _WAVES[kind]

    def level(time_s: float, seed: int) -> float:
        phase = (rate * time_s + lag / (2.0 * math.pi) + start(seed)) % 1.0
        return wave(phase, low, high)

    return Light(level, dim)


def _sine(phase: float, low: float, high: float) -> float:
    return 0.5 + 0.5 * math.sin(2.0 * math.pi * phase)


_RAMP = 0.01
"""Share of a cycle in which a lamp comes on or goes off: a filament's glow."""


def _switched(phase: float, low: float, high: float) -> float:
    """On from one share of the cycle to another."""
    inside = min(phase - low, high - phase)
    if low == 0.0 and phase > 1.0 - _RAMP:
        inside = phase - 1.0
    return min(1.0, max(0.0, 0.5 + inside / _RAMP))


_WAVES: Mapping[str, Callable[[float, float, float], float]] = {
    "sine": _sine, "switched": _switched,
}  # fmt: skip


class _Options:
    """The words of a joint after its axis: numbers with units, and named values."""

    def __init__(self, words: Sequence[str]) -> None:
        self._words = list(words)

    def point(self) -> Point:
        """The pivot: the first three numbers."""
        x, y, z = (read_number(one) for one in self._words[:3])
        self._words = self._words[3:]
        return x, y, z

    def first(self, unit: str) -> float:
        """The next number, which must have that unit."""
        word = self._words.pop(0)
        if not word.endswith(unit):
            raise ValueError(f"{word!r} needs the unit {unit!r}")
        return _UNITS[unit] * read_number(word.removesuffix(unit))

    def number(self, name: str, usual: float = 0.0) -> float:
        """The number after a name, without its unit."""
        if name not in self._words:
            return usual
        return read_number(self._words[self._words.index(name) + 1].rstrip("hzdegm/s"))

    def angle(self, name: str, usual: float = 0.0) -> float:
        """The angle after a name, radians."""
        return math.radians(self.number(name, math.degrees(usual)))

    def pair(self, name: str) -> tuple[float, float]:
        """The two numbers after a name."""
        if name not in self._words:
            return 0.0, 1.0
        at = self._words.index(name)
        return read_number(self._words[at + 1]), read_number(self._words[at + 2])

    def start(self) -> Callable[[int], float]:
        """Turns at the beginning, from 0 up to a number of them, by the seed."""
        if "start" not in self._words:
            return lambda seed: 0.0
        label, *rest = self._words[self._words.index("start") + 1 :]
        times = read_number(rest[0]) if rest and not rest[0].isalpha() else 1.0
        return lambda seed: times * fraction(seed, label)


def _spin(axis: str, words: Sequence[str]) -> Joint:
    """Steady turning: pivot, rate."""
    options = _Options(words)
    pivot, rate, start = options.point(), options.first("hz"), options.start()
    return Joint(
        lambda pose, seed: turn_about(
            axis, 2.0 * math.pi * (rate * pose.time_s + start(seed)), pivot
        )
    )


def _swing(axis: str, words: Sequence[str]) -> Joint:
    """Turning to and fro: pivot, greatest angle, rate; between two angles where it is stopped."""
    options = _Options(words)
    pivot, reach, rate = options.point(), options.first("deg"), options.first("hz")
    lag, start = options.angle("from"), options.start()
    low, high = options.angle("above", -math.inf), options.angle("below", math.inf)

    def motion(pose: Pose, seed: int) -> Affine:
        phase = 2.0 * math.pi * (rate * pose.time_s + start(seed)) + lag
        return turn_about(axis, min(max(reach * math.sin(phase), low), high), pivot)

    return Joint(motion)


def _roll(axis: str, words: Sequence[str]) -> Joint:
    """Turning with the distance travelled: pivot, radius."""
    options = _Options(words)
    return rolling(axis, options.point(), options.first("m"))


def _turn(axis: str, words: Sequence[str]) -> Joint:
    """Turned once and for all: pivot, angle."""
    options = _Options(words)
    pivot, angle = options.point(), options.first("deg")
    return Joint(lambda pose, seed: turn_about(axis, angle, pivot))


def _lie(axis: str, words: Sequence[str]) -> Joint:
    """Turned unless it is carried: pivot, angle."""
    options = _Options(words)
    pivot, angle = options.point(), options.first("deg")
    return Joint(
        lambda pose, seed: turn_about(axis, 0.0 if pose.activity == "move" else angle, pivot)
    )


def _belt(axis: str, words: Sequence[str]) -> Joint:
    """Along a belt, then from its start again: length, speed; sinking by a depth at its ends."""
    options = _Options(words)
    length, speed = options.first("m"), options.first("m/s")
    first, depth, edge = (options.number(name) for name in ("from", "sink", "within"))

    def motion(pose: Pose, seed: int) -> Affine:
        along = (speed * pose.time_s + first) % length
        sunk = max(0.0, 1.0 - min(along, length - along) / edge) if edge else 0.0
        moved = shift(**{axis: along - 0.5 * length})
        moved[2, 3] -= depth * sunk
        return np.asarray(moved)

    return Joint(motion)


def _pulse(axes: str, words: Sequence[str]) -> Joint:
    """Stretched along axes and shrunk: pivot, greatest share, rate."""
    options, cycle = _Options(words), read_cycle(words[4:])
    pivot, share = options.point(), options.first("")
    return Joint(lambda pose, seed: _stretch(axes, 1.0 + share * sine(cycle, pose, seed), pivot))


def _grow(axes: str, words: Sequence[str]) -> Joint:
    """From a share of its size to the whole, again and again: pivot, least share, rate."""
    options, cycle = _Options(words), read_cycle(words[4:])
    pivot, least = options.point(), options.first("")
    return Joint(
        lambda pose, seed: _stretch(axes, least + (1.0 - least) * (cycle(pose, seed) % 1.0), pivot)
    )


def _vary(axes: str, words: Sequence[str]) -> Joint:
    """Stretched once and for all: pivot, least and greatest factor, name of the seed's choice."""
    options, name = _Options(words), words[5]
    pivot, low, high = options.point(), options.first(""), options.first("")
    return Joint(lambda pose, seed: _stretch(axes, between(seed, name, low, high), pivot))


def _sway(axis: str, words: Sequence[str]) -> Joint:
    """To and fro along an axis: greatest distance, rate."""
    reach, cycle = read_number(words[0]), read_cycle(words[1:])
    return Joint(lambda pose, seed: shift(**{axis: reach * sine(cycle, pose, seed)}))


def _bow(axis: str, words: Sequence[str]) -> Joint:
    """Turned down while the mouth is at the ground: pivot, degrees."""
    options = _Options(words)
    pivot, reach = options.point(), math.radians(options.first(""))
    return Joint(
        lambda pose, seed: turn_about(
            axis, reach * act_stance(pose.activity, pose.time_s).head_down, pivot
        )
    )


_JOINTS: Mapping[str, Callable[[str, Sequence[str]], Joint]] = {
    "spin": _spin, "swing": _swing, "roll": _roll, "turn": _turn, "lie": _lie,
    "belt": _belt, "bow": _bow, "sway": _sway, "pulse": _pulse, "grow": _grow, "vary": _vary,
}  # fmt: skip
_STRETCHING = ("pulse", "grow", "vary")
"""Joints of several axes, such as "yz"."""


def _stretch(axes: str, factor: float, pivot: Point) -> Affine:
    """A stretching along axes such as "yz" that leaves a point where it is."""
    factors = np.array([factor if axis in axes else 1.0 for axis in "xyz"])
    return np.column_stack([np.diag(factors), (1.0 - factors) * np.array(pivot)])


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


def sine(cycle: Cycle, pose: Pose, seed: int) -> float:
    """The sine of a cycle at one instant."""
    return math.sin(2.0 * math.pi * cycle(pose, seed))


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
        phase = 2.0 * math.pi * cycle(pose, seed) + _WAVE_LAG * x
        slant = sign * math.atan(_WAVE_LAG * swing * math.cos(phase))
        offset = shift(**{axis: swing * math.sin(phase)})
        return moved([part], compose(offset, turn_about(axle, slant, (x, 0.0, 0.0))))[0]

    return waved
