"""Joints of nouns: how a group of parts moves, bends or shines with time and distance.

docs/nouns.md lists them. A joint is its kind, an axis, numbers with units, and named values. Its
rate is "2hz" (cycles per second) or "1.5/m" (cycles per metre travelled); "start NAME" lets the
seed choose where the cycle begins, "from .25" or "from 90deg" begins it later.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from texvent_scenes.models.activities import ANIMAL_ACTIVITIES, TRAVELLING
from texvent_scenes.models.materials import shade
from texvent_scenes.models.protocol import ModelPart, Pose, between, fraction
from texvent_scenes.models.shapes import Affine, Point, affine, compose, moved, shift, turn_about

RESTING = frozenset({"stand", "sit", "lie", *ANIMAL_ACTIVITIES}) - TRAVELLING
"""Activities of a body that stays where it is."""
_RESTING_VIGOUR = 0.3
"""Undulation of a swimmer at rest."""
_HEAD_X, _HEAD_REACH, _WAVE_LAG = 0.45, 0.12, 3.6
"""Place of a swimmer's head, its swing relative to the tail's, and the lag of the wave along its
body, rad: for a body of length 1."""


@dataclass(frozen=True)
class Instant:
    """A body at an instant: all that its joints follow."""

    pose: Pose
    seed: int
    channels: Mapping[str, float] = field(default_factory=dict)
    """Channels of its activity and its gait; one that is missing is 0."""
    strides: float = 0.0
    """Strides so far, of what walks."""


Cycle = Callable[[Instant], float]
"""Cycles so far."""
Amount = Callable[[Instant], float]
JointMotion = Callable[[Instant], Affine]
"""[3, 4] map."""


@dataclass(frozen=True)
class Joint:
    """Motion of parts in their body."""

    motion: JointMotion
    rolls: bool = False
    """Whether it turns with the distance travelled."""
    channels: tuple[str, ...] = ()
    """Channels that it follows."""


@dataclass(frozen=True)
class LightModulation:
    """Modulation of the light of parts over time."""

    level: Callable[[Instant], float]
    """Instant → 0..1."""
    dim: float | None = None
    """Share of their colour that is left when they are dark; None = all of it."""
    afterglow: float = 0.0
    """Share of their light that is left then."""

    def shine(self, parts: Sequence[ModelPart], now: Instant) -> list[ModelPart]:
        """The parts as bright as they are at that instant."""
        level = self.level(now)
        share = 1.0 if self.dim is None else self.dim + (1.0 - self.dim) * level
        light = self.afterglow + (1.0 - self.afterglow) * level
        return [
            replace(one, emission=light * one.emission, colour=shade(one.colour, share))
            for one in parts
        ]


def place(joints: Sequence[Joint], instant: Instant) -> Affine:
    """The map of parts on a chain of joints, the outermost first."""
    motion = joints[0].motion(instant)
    for joint in joints[1:]:
        motion = compose(motion, joint.motion(instant))
    return motion


def read_number(word: str, unit: str = "") -> float:
    """A number with that unit.

    Raises:
        ValueError: it is none, not finite, or has another unit.
    """
    if not word.endswith(unit):
        raise ValueError(f"{word!r} needs the unit {unit!r}")
    value = float(word.removesuffix(unit))
    if not math.isfinite(value):
        raise ValueError(f"numbers must be finite but one is {word!r}")
    return value


def rolling(axis: str, pivot: Point, radius: float) -> Joint:
    """Turning with the distance travelled, without slipping."""
    if radius == 0.0:
        raise ValueError("what rolls needs a radius that is not 0")
    return Joint(lambda now: turn_about(axis, now.pose.distance_m / radius, pivot), rolls=True)


_OPTIONS = frozenset(
    {"at", "start", "from", "above", "below", "sink", "within", "between", "dim", "by"}
)
"""Names of values."""
_Options = Mapping[str, Sequence[str]]


def _split_options(words: Sequence[str]) -> tuple[list[str], _Options]:
    """The words before the first named value, and name → its words."""
    plain: list[str] = []
    options: dict[str, list[str]] = {}
    words_of = plain
    for word in words:
        if word in _OPTIONS and words_of[-1:] != ["start"]:
            words_of = options[word] = []
        else:
            words_of.append(word)
    return plain, options


_COUNTS: Mapping[str, Callable[[Instant], float]] = {
    "hz": lambda now: now.pose.time_s,
    "/m": lambda now: now.pose.distance_m,
    "step": lambda now: now.strides,
}
"""Unit of a rate → count of the units so far: seconds, metres or strides."""


def _cycle(rate: str, options: _Options) -> Cycle:
    """Cycles of a rate, by its "start" and "from"."""
    unit = next((one for one in _COUNTS if rate.endswith(one)), None)
    if unit is None:
        raise ValueError(f"rate {rate!r} needs the unit 'hz' or '/m'")
    pace, word, count = read_number(rate, unit), options.get("from", ["0"])[0], _COUNTS[unit]
    late = read_number(word, "deg") / 360.0 if word.endswith("deg") else read_number(word)
    label, times = [*options.get("start", [""]), "1"][:2]
    most = read_number(times)

    def cycle(now: Instant) -> float:
        begun = most * fraction(now.seed, label) if label else 0.0
        return pace * count(now) + begun + late

    return cycle


def read_cycle(words: Sequence[str]) -> Cycle:
    """Cycles from the words of a rate, such as ("2hz", "start", "flap").

    Raises:
        ValueError: they are none.
    """
    (rate, *more), options = _split_options(words)
    if more or options.keys() - {"start", "from"}:
        raise ValueError(f"unknown words after rate {rate!r}; there are 'start' and 'from'")
    return _cycle(rate, options)


def sine(cycle: Cycle, now: Instant) -> float:
    """The sine of a cycle at one instant."""
    return math.sin(2.0 * math.pi * cycle(now))


def _angle(word: str) -> float:
    return (
        read_number(word, "rad") if word.endswith("rad") else math.radians(read_number(word, "deg"))
    )


def _amount(options: _Options) -> Amount:
    """Product of the channels after "by"; 1 where there is none."""
    names = options.get("by", ())
    return lambda now: math.prod(now.channels.get(name, 0.0) for name in names)


def _still(motion: Affine) -> JointMotion:
    """The same map at every instant."""
    return lambda now: motion


def _spin(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Steady turning: rate."""
    cycle = _cycle(words[0], options)
    return lambda now: turn_about(axis, 2.0 * math.pi * cycle(now), pivot)


def _swing(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Turning to and fro: greatest angle, rate; between two angles where it is stopped."""
    reach, cycle, amount = _angle(words[0]), _cycle(words[1], options), _amount(options)
    low = _angle(options["above"][0]) if "above" in options else -math.inf
    high = _angle(options["below"][0]) if "below" in options else math.inf
    return lambda now: turn_about(
        axis, min(max(amount(now) * reach * sine(cycle, now), low), high), pivot
    )


def _turn(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Turned by an angle: once and for all, or as far as channels say."""
    angle, amount = _angle(words[0]), _amount(options)
    if "by" not in options:
        return _still(turn_about(axis, angle, pivot))
    return lambda now: turn_about(axis, amount(now) * angle, pivot)


def _bow(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Turned down while the mouth is at the ground: angle."""
    return _turn(axis, pivot, words, {"by": ["down"]})


def _pulse(axes: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Stretched along axes and shrunk: greatest share, rate."""
    share, cycle = read_number(words[0]), _cycle(words[1], options)
    return lambda now: _stretch_along(axes, 1.0 + share * sine(cycle, now), pivot)


def _grow(axes: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """From a share of its size to the whole, again and again: least share, rate."""
    least, cycle = read_number(words[0]), _cycle(words[1], options)
    return lambda now: _stretch_along(axes, least + (1.0 - least) * (cycle(now) % 1.0), pivot)


def _fold(axes: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Drawn in along axes as far as channels say: least factor."""
    least, amount = read_number(words[0]), _amount(options)
    return lambda now: _stretch_along(axes, 1.0 - (1.0 - least) * amount(now), pivot)


def _vary(axes: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Stretched once and for all: least and greatest factor, name of the seed's choice."""
    low, high, name = read_number(words[0]), read_number(words[1]), words[2]
    return lambda now: _stretch_along(axes, between(now.seed, name, low, high), pivot)


def _belt(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Along a belt, then from its start again: length, speed; sinking by a depth at its ends."""
    length, speed = read_number(words[0], "m"), read_number(words[1], "m/s")
    first, depth, edge = (
        read_number(options.get(name, ["0"])[0]) for name in ("from", "sink", "within")
    )

    def motion(now: Instant) -> Affine:
        along = (speed * now.pose.time_s + first) % length
        sunk = max(0.0, 1.0 - min(along, length - along) / edge) if edge else 0.0
        carried = shift(**{axis: along - 0.5 * length})
        carried[2, 3] -= depth * sunk
        return np.asarray(carried)

    return motion


def _sway(axis: str, pivot: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """To and fro along an axis: greatest distance, rate."""
    reach, cycle, amount = read_number(words[0]), _cycle(words[1], options), _amount(options)
    return lambda now: shift(**{axis: amount(now) * reach * sine(cycle, now)})


def _shift(axis: str, way: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Shifted by a vector: once and for all, or as far as channels say."""
    amount = _amount(options)
    if "by" not in options:
        return _still(shift(*way))
    return lambda now: shift(*(amount(now) * one for one in way))


def _stretch(axis: str, factors: Point, words: Sequence[str], options: _Options) -> JointMotion:
    """Stretched once and for all along x, y and z."""
    return _still(np.diag(factors) @ np.eye(3, 4))


_Maker = Callable[[str, Point, Sequence[str], _Options], JointMotion]
_ABOUT_PIVOT: Mapping[str, _Maker] = {
    "spin": _spin, "swing": _swing, "turn": _turn, "bow": _bow,
    "pulse": _pulse, "grow": _grow, "vary": _vary, "fold": _fold,
}  # fmt: skip
"""Joints with axis and pivot."""
_ALONG: Mapping[str, _Maker] = {"belt": _belt, "sway": _sway}
_BY_VECTOR: Mapping[str, _Maker] = {"shift": _shift, "stretch": _stretch}
_STRETCHING = ("pulse", "grow", "vary", "fold")
"""Joints of several axes, such as "yz"."""


def _stretch_along(axes: str, factor: float, pivot: Point) -> Affine:
    """A stretching along axes such as "yz" that leaves a point where it is."""
    factors = np.array([factor if axis in axes else 1.0 for axis in "xyz"])
    return affine(np.diag(factors), (1.0 - factors) * np.array(pivot))


def read_joint(text: str) -> Joint:
    """A joint from its text, such as "swing x 0 0 1.17 22.9deg .541hz".

    Raises:
        ValueError: it cannot be read; the message has the text.
    """
    try:
        kind, *rest = text.split()
        axis = "" if kind in _BY_VECTOR else rest.pop(0)
        if not set(axis) <= set("xyz") or (len(axis) > 1 and kind not in _STRETCHING):
            raise ValueError(f"its axis is {axis!r}; it must be x, y or z")
        words, options = _split_options(rest)
        channels = tuple(options.get("by", ()))
        if kind in _ALONG:
            return Joint(_ALONG[kind](axis, (0.0, 0.0, 0.0), words, options), channels=channels)
        x, y, z = map(read_number, words[:3])
        if kind == "roll":
            return rolling(axis, (x, y, z), read_number(words[3], "m"))
        makers = {**_ABOUT_PIVOT, **_BY_VECTOR}
        if kind not in makers:
            raise ValueError(f"it must begin with {', '.join(['roll', *makers, *_ALONG])}")
        return Joint(makers[kind](axis, (x, y, z), words[3:], options), channels=channels)
    except (ValueError, IndexError) as error:
        raise ValueError(f"joint {text!r}: {error}") from None


def read_joints(text: str) -> tuple[Joint, ...]:
    """Joints with commas between them, the outermost first."""
    return tuple(map(read_joint, filter(None, map(str.strip, text.split(",")))))


_RAMP = 0.01
"""Share of a cycle in which a lamp comes on or goes off: a filament's glow."""


def read_light(text: str) -> LightModulation:
    """A light from its text, such as "sine at 1hz start blink" or "switched at 2hz between 0 .5".

    With "by signal 2" it is on while that channel is 2, and cycles while it is 0. After "dim" are
    the shares of the parts' colour and, if said, of their light that are left when it is off.

    Raises:
        ValueError: it cannot be read; the message has the text.
    """
    try:
        (kind,), options = _split_options(text.split())
        cycle = _cycle(options.get("at", [""])[0], options)
        low, high = map(read_number, options.get("between", ["0", "1"]))
        dim, afterglow = [*map(read_number, options.get("dim", ())), None, None][:2]
        channel, *on = options.get("by", [""])
        state = read_number(on[0]) if channel else 0.0
        if kind not in ("sine", "switched"):
            raise ValueError("it must begin with sine or switched")
    except (ValueError, IndexError) as error:
        raise ValueError(f"light {text!r}: {error}") from None

    def level(now: Instant) -> float:
        if told := now.channels.get(channel, 0.0):
            return max(0.0, 1.0 - 2.0 * abs(told - state))
        phase = cycle(now) % 1.0
        if kind == "sine":
            return 0.5 + 0.5 * math.sin(2.0 * math.pi * phase)
        inside = min(phase - low, high - phase)
        if low == 0.0 and phase > 1.0 - _RAMP:
            inside = phase - 1.0
        return min(1.0, max(0.0, 0.5 + inside / _RAMP))

    return LightModulation(level, dim, afterglow or 0.0)


def read_wave(text: str) -> Callable[[ModelPart, Instant], ModelPart]:
    """A swimmer's wave from text such as "y .07 2hz start beat": axis, reach of the tail, rate.

    It runs from the head, .5 ahead of the origin, to the tail, .5 behind it, and takes each part
    along where that part is.

    Raises:
        ValueError: it cannot be read.
    """
    axis, reach, *rate = text.split()
    cycle, far = read_cycle(rate), read_number(reach)
    axle, sign = ("y", -1.0) if axis == "z" else ("z", 1.0)

    def waved(part: ModelPart, now: Instant) -> ModelPart:
        x = float(part.to_body[0, 3])
        vigour = _RESTING_VIGOUR if now.pose.activity in RESTING else 1.0
        swing = vigour * far * (_HEAD_REACH + (1.0 - _HEAD_REACH) * ((_HEAD_X - x) / 0.95) ** 2)
        phase = 2.0 * math.pi * cycle(now) + _WAVE_LAG * x
        slant = sign * math.atan(_WAVE_LAG * swing * math.cos(phase))
        offset = shift(**{axis: swing * math.sin(phase)})
        return moved([part], compose(offset, turn_about(axle, slant, (x, 0.0, 0.0))))[0]

    return waved
