"""Scene as the renderer takes it: shapes, a camera and surroundings at one instant.

World: metres, right-handed, x right (east), y away from the viewer (north), z up; the ground is
z = 0. Colours are linear-light RGB, 1.0 = a white surface in full daylight. Time is in seconds
here, because scenes are continuous functions of time; the generator converts to µs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.camera import PosedCamera

Float64Array = NDArray[np.float64]
Float32Array = NDArray[np.float32]
Colour = tuple[float, float, float]
"""Linear-light RGB, 1.0 = white."""


class Shape(IntEnum):
    """Unit shapes, centred on the origin; `Primitives.to_world` scales, turns and places them."""

    ELLIPSOID = 0
    """Unit sphere."""
    BOX = 1
    """|x|, |y|, |z| <= 1."""
    CYLINDER = 2
    """x² + y² <= 1, |z| <= 1, with caps."""
    CONE = 3
    """Apex at z = 1, base of radius 1 at z = -1, with base."""
    MESH = 4
    """Triangles within |x|, |y|, |z| <= 1; see `scenes.mesh`."""


class Texture(IntEnum):
    """Variation of colour over a surface, in its own coordinates (so it moves with it)."""

    PLAIN = 0
    MOTTLED = 1
    """Patches as large as 1 / `texture_scale` of the shape."""
    STRIPES = 2
    """Bands along local z: a zebra, a barrier, planks."""
    CHECKS = 3
    """3-D checker: tiles, a football, windows."""

    # Materials: textures at life size, from the tiles in `raycast.surfaces`.
    VARIATION = 16
    CRACKED = 17
    WORN = 18
    """Nearly even: paint, plastic."""
    ASPHALT = 19
    GRASS = 20
    SOIL = 21
    SAND = 22
    LEAVES = 24
    SNOW = 25
    PAVING = 26
    TILES = 27
    BOARDS = 28
    CARPET = 29
    WATER = 30
    STONE = 31
    CONCRETE = 32
    PLASTER = 33
    BRICK = 34
    ROOFING = 35
    WOOD = 37
    BARK = 38
    FOLIAGE = 39
    NEEDLES = 40
    FUR = 41
    FEATHERS = 42
    CLOTH = 43
    SKIN = 44
    METAL = 45
    RUST = 46
    LEATHER = 47
    SCALES = 48
    SPOTS = 49
    LACQUER = 50
    """Paint under a clear coat, on crowned sheet metal."""
    PANE = 51
    """Window glass, and what is dark behind it."""
    MIRROR = 52
    PRINT = 53
    """Headings, lines of letters and pictures in the second colour: labels, covers, adverts."""
    BOOKS = 54
    """Spines of books that stand side by side, of two hues and many shades."""
    PAPER = 55
    """Even but for fibres: paper, cardboard, a studio's backdrop."""


FIRST_SURFACE = Texture.VARIATION
"""Textures from here on are materials; see `raycast.surfaces.catalogue.SURFACES`."""


@dataclass(frozen=True)
class Primitives:
    """All shapes of a scene at one instant, structure of arrays over n primitives.

    A primitive keeps its index over time, so the same index at two instants is the same piece of
    surface: that is what makes optical flow exact.
    """

    shape: NDArray[np.int8]
    """[n] `Shape`."""
    to_world: Float64Array
    """[n, 3, 4] affine map from unit-shape coordinates to the world."""
    colour: Float32Array
    """[n, 3] linear RGB."""
    second_colour: Float32Array
    """[n, 3] linear RGB of the other part of the texture."""
    texture: NDArray[np.int8]
    """[n] `Texture`."""
    texture_scale: Float32Array
    """[n] repeats per local unit."""
    emission: Float32Array
    """[n] light given off, added to what is reflected, as a multiple of colour (lamps)."""
    instance: NDArray[np.int32]
    """[n] id of the object it belongs to: 1, 2, ...; 0 is scenery without an id of its own."""
    mesh: NDArray[np.object_] | None = None
    """[n] `Mesh` of each `Shape.MESH`, None elsewhere; None: there are no meshes. `colour`
    multiplies its own."""
    image: NDArray[np.object_] | None = None
    """[n] `SurfaceImage` that a box shows on its side +x, or None; None: there are no images."""


class Ground(IntEnum):
    """Material of the plane z = 0."""

    PLAIN = 0
    GRASS = 1
    ROAD = 2
    """A road along `Environment.road_angle` through grass."""
    DIRT_ROAD = 3
    SEA = 4
    """Moving waves."""
    CITY = 5
    """A road with pavement on both sides."""
    FLOOR = 6
    """Indoor boards or tiles; no sky above: a wall stands around."""
    SAND = 7
    SNOW = 8
    UNDERWATER = 9
    """Sea bed; everything fades into blue, light ripples on it."""
    NONE = 10
    """No ground: only sky (objects in the air or in space)."""
    RIVER = 11
    """Water that flows along the road's line, `road_half_width` to each side, through grass."""
    LAKE = 12
    """Water to the left of the road's line, grass to its right."""


LAMP_RECORD = np.dtype(
    [
        ("place", "f8", 3),  # metres
        ("light", "f8", 3),  # linear RGB on a surface that faces the lamp at 1 m
        ("reach", "f8"),  # metres
        ("beam", "f8", 3),  # direction of its beam, unit vector
        # Cosines of the angles from the beam's middle at which it begins to fade and has faded; -2
        # and -2: it shines to all sides.
        ("full", "f8"),
        ("dark", "f8"),
        ("radius", "f8"),  # metres
        ("casts", "f8"),  # 1 = it casts shadows; at most four lamps do
        ("glows", "f8"),  # 1 = the camera sees it as a glow
    ]
)
"""One lamp."""
MEDIUM_RECORD = np.dtype(
    [
        ("to_world", "f8", (3, 4)),  # unit sphere → world
        ("colour", "f8", 3),  # linear RGB
        ("optical_depth", "f8"),  # through its middle
        ("emission", "f8"),  # light given off, as a multiple of the colour
        ("detail", "f8"),  # share of the density that finer structure modulates, 0..1
        ("seed", "f8"),  # of that structure
    ]
)
"""One participating medium: a translucent ellipsoid of smoke, steam, mist or flame."""


CORRIDOR_HEIGHT_M = 2.7
"""Height of a corridor, metres."""
CEILING = 0.6
"""Height of the ceiling of a room, as a share of half its width."""


@dataclass(frozen=True)
class Environment:
    """Surroundings and light at one instant."""

    ground: Ground
    ground_colour: Float32Array
    """[3] linear RGB."""
    ground_second_colour: Float32Array
    """[3] linear RGB of its texture (or of the road)."""
    road_angle: float
    """Direction of the road on the ground, radians from x towards y."""
    road_half_width: float
    """Metres."""
    road_offset: Float64Array
    """[2] a point (x, y) on the road's centre line, metres."""
    sky_top: Float32Array
    """[3] linear RGB at the zenith."""
    sky_horizon: Float32Array
    """[3] linear RGB at the horizon."""
    clouds: float
    """0 = none .. 1 = covered; they drift slowly."""
    sun_direction: Float64Array
    """[3] unit vector towards the sun or moon."""
    sun_colour: Float32Array
    """[3] linear RGB of direct light (flicker is already in it)."""
    ambient: Float32Array
    """[3] linear RGB of light from all around (flicker is already in it)."""
    shadows: bool
    """Whether direct light casts shadows."""
    fog_distance: float
    """Metres at which colours have faded to 37 % into `fog_colour`; inf = clear."""
    fog_colour: Float32Array
    """[3] linear RGB."""
    exposure: float
    """Multiplies linear light before gamma coding."""
    lamps: NDArray[Any]
    """[m] `LAMP_RECORD`."""
    time_s: float
    """For waves, clouds and grass."""
    room_half_size: float = 9.0
    """Half the side of the square room around (0, 0) that `Ground.FLOOR` stands in, metres; half
    the length of a corridor, which lies along y."""
    corridor_half_width: float | None = None
    """Half the width of a corridor, metres; None = the room is square."""
    road_crossings: Float64Array = field(default_factory=lambda: np.zeros((0, 3)))
    """[k, 3] straight roads that cross the main one: x, y of a point on the centre line (metres)
    and direction (radians)."""
    ground_surface: Texture | None = None
    """Material of the ground; None = the usual one of `ground`."""
    wall_surface: Texture = Texture.PLASTER
    """Material of a room's walls."""
    media: NDArray[Any] = field(default_factory=lambda: np.zeros(0, MEDIUM_RECORD))
    """[k] `MEDIUM_RECORD`: participating media."""
    wetness: float = 0.0
    """Share of rain water on roads and paving, 0..1: they are darker, and mirror."""
    wave_height: float = 1.0
    """Height of waves on water, 1 = those of a light breeze; above 1 their crests foam."""
    has_stars: bool = True
    """Whether a dark sky has stars."""
    wall_colour: Colour = (0.75, 0.69, 0.61)
    """Linear RGB of a room's walls."""
    has_ceiling_panels: bool = False
    """Whether a room's ceiling is hung: panels in a grid of rails, some of them luminous."""
    is_hall: bool = False
    """Whether a room's walls have piers, and no windows and pictures."""
    has_highlights: bool = False
    """Whether light above white is kept; else it is compressed, so that none is brighter."""

    @property
    def ceiling_m(self) -> float:
        """Height of the ceiling, m; inf = there is none."""
        if self.ground is not Ground.FLOOR:
            return math.inf
        is_corridor = self.corridor_half_width is not None
        return CORRIDOR_HEIGHT_M if is_corridor else CEILING * self.room_half_size


class RenderedScene(Protocol):
    """A scene as a continuous function of time."""

    def primitives(self, time_s: float) -> Primitives:
        """All shapes at that instant; same length and order at every instant."""
        ...

    def camera(self, time_s: float) -> PosedCamera:
        """The camera at that instant."""
        ...

    def environment(self, time_s: float) -> Environment:
        """Surroundings and light at that instant."""
        ...

    @property
    def class_names(self) -> dict[int, str]:
        """Instance id → noun, such as {1: "car", 2: "tree"}."""
        ...


def decode_hex(code: str) -> Colour:
    """Linear-light RGB of an sRGB code such as "ff8000" (IEC 61966-2-1).

    Example:
        >>> decode_hex("ffffff")
        (1.0, 1.0, 1.0)
    """
    red, green, blue = (_linearise(int(code[i : i + 2], 16) / 255.0) for i in (0, 2, 4))
    return (red, green, blue)


def _linearise(value: float) -> float:
    return value / 12.92 if value <= 0.04045 else float(((value + 0.055) / 1.055) ** 2.4)
