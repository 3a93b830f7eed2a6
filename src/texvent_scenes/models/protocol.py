"""Interface of models: articulated objects built from unit shapes.

Body coordinates: metres, origin on the ground below the middle, facing +x, y to its left, z up.
An object that flies, swims or is thrown has its origin at its middle instead (`Noun.habitat`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Protocol, TypeVar
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.mesh import Mesh, SurfaceImage
from texvent_scenes.rendered_scene import Colour, Shape, Texture

Habitat = Literal["ground", "air", "water", "fixed"]
"""Medium of an object's motion: on the ground, in the air, in the water; or it does not move."""


@dataclass(frozen=True)
class ModelPart:
    """One unit shape of a model at one instant."""

    shape: Shape
    to_body: NDArray[np.float64]
    """[3, 4] affine map from unit-shape to body coordinates."""
    colour: Colour
    second_colour: Colour = (0.0, 0.0, 0.0)
    texture: Texture = Texture.PLAIN
    texture_scale: float = 1.0
    emission: float = 0.0
    mesh: Mesh | None = None
    """Its triangles, for `Shape.MESH`; `colour` multiplies their own."""
    image: SurfaceImage | None = None
    """Image that a box shows on its side +x now."""

    def at(self, to_body: NDArray[np.float64]) -> ModelPart:
        """The same part at another place; ten times as fast as `dataclasses.replace`."""
        part = object.__new__(ModelPart)
        part.__dict__.update(self.__dict__, to_body=to_body)
        return part


@dataclass(frozen=True)
class Pose:
    """State that decides a model's limbs, wheels and wings."""

    time_s: float
    """Time, s."""
    distance_m: float
    """Distance travelled so far, m: turns wheels and swings legs without sliding."""
    speed_m_s: float
    """Speed along its path, m/s; 0 = standing."""
    activity: str = "move"
    """Activity: "stand", "move" (walk, drive, fly or swim), "run", "sit", "swing", ...; for people
    and hands a name of `models.activities`."""
    before: str | None = None
    """Activity of a body with limbs until a moment ago; None = the same."""
    share: float = 1.0
    """Progress of the transition from that to `activity`, 0..1."""
    act_s: float | None = None
    """Time since the instant of contact of a single act such as a kick, s; None = it repeats."""
    grips: tuple[tuple[str, tuple[float, float, float]], ...] = ()
    """Points that hold "left hand", "right hand", "left foot", "right foot" or "hips", m, in body
    coordinates."""


class Model(Protocol):
    """One object, with its size and colours decided."""

    length: float
    """Extent along x, m."""
    width: float
    """Extent along y, m."""
    height: float
    """Extent along z, m."""

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose: the same number in the same order at every pose."""
        ...


class ModelBuilder(Protocol):
    """Makes a model of one noun."""

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> Model:
        """Build it; colour None means its usual colour, scale 1 its usual size."""
        ...


@dataclass(frozen=True)
class PartChoice:
    """Parts of a noun whose number or colour may be said."""

    name: str
    """In the plural if there may be several, such as "candles"."""
    usual: int
    """Number of them where none is said."""
    most: int
    """Greatest number of them; 0 = only their colour may be said."""
    is_coloured: bool = False
    """Whether they have a colour of their own."""
    others: tuple[str, ...] = ()
    """Other names of them."""

    def is_named(self, word: str) -> bool:
        """Whether a word, or its plural, names them."""
        return not {word, f"{word}s"}.isdisjoint((self.name, *self.others))


@dataclass(frozen=True)
class Noun:
    """One object the generator can show."""

    name: str
    """Singular; also the class name of its ground-truth boxes."""
    build: ModelBuilder
    habitat: Habitat
    speed_m_s: float
    """Usual speed when it moves, m/s."""
    motion: str
    """Motion if the prompt does not say, such as "walk", "drive", "fly", "swim", "stand"."""
    synonyms: tuple[str, ...] = ()
    """Other singular names, such as ("automobile", "sedan")."""
    plurals: tuple[str, ...] = ()
    """Irregular plurals, such as ("people",)."""
    place: str = ""
    """Place where it usually is, such as "indoor"; empty = no usual place of its own."""
    acts: frozenset[str] = frozenset()
    """Activities of an animal in place: names of `activities.ANIMAL_ACTIVITIES`."""
    is_working: bool = False
    """Whether it stays in place and moves by itself, as a metronome does."""
    choices: tuple[PartChoice, ...] = ()
    """Parts whose number or colour may be said."""

    def find_choice(self, word: str) -> PartChoice | None:
        """The parts that a word names, if their number or colour may be said."""
        return next((one for one in self.choices if one.is_named(word)), None)


T = TypeVar("T")

_MASK = (1 << 64) - 1


def fraction(seed: int, detail: str) -> float:
    """A number in [0, 1) that depends on nothing but the seed and the detail's name."""
    bits = (seed * 0x9E3779B97F4A7C15 + crc32(detail.encode())) & _MASK
    # SplitMix64's finaliser (Steele, Lea, Flood 2014): neighbouring seeds look unrelated.
    bits = ((bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9) & _MASK
    bits = ((bits ^ (bits >> 27)) * 0x94D049BB133111EB) & _MASK
    bits ^= bits >> 31
    return (bits >> 11) / float(1 << 53)


def between(seed: int, detail: str, low: float, high: float) -> float:
    """A number in [low, high)."""
    return low + (high - low) * fraction(seed, detail)


def paint(colour: Colour | None, seed: int, detail: str, usual: Sequence[Colour]) -> Colour:
    """The colour asked for, or one of the usual ones."""
    return colour if colour is not None else choose(seed, detail, usual)


def choose(seed: int, detail: str, options: Sequence[T]) -> T:
    """One of the options."""
    return options[int(fraction(seed, detail) * len(options))]
