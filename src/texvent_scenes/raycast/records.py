"""One instant of a scene as the kernels read it: flat records, filled from the value types.

Records, not named tuples of arrays: a kernel passes them on as one pointer, without counting
references, which makes an image many times faster.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.camera import Rays
from texvent.lens import Lens, lens_limits
from texvent_scenes.mesh import MOST_LEVELS, Mesh, SurfaceImage
from texvent_scenes.raycast.surfaces.catalogue import SURFACE_COUNT, gloss_rows, surface_rows
from texvent_scenes.rendered_scene import (
    CEILING,
    CORRIDOR_HEIGHT_M,
    Environment,
    Ground,
    Primitives,
    Texture,
)

NIGHT_SKY = 0.06
"""Stars show where the sky at the zenith is darker than this (linear luma)."""
SUN_RADIUS = 0.022
"""Angular radius of the sun or moon, radians: about five times the real one, as in photographs."""

MOST_WINDOWS = 12
"""Windows that light a room at most."""
MAX_CROSSINGS = 4
"""Roads that may cross the main one."""

INSTANT_RECORD = np.dtype(
    [
        # Rays: see `texvent.camera.Rays`; `step` is the angle that one pixel covers, radians.
        ("origin", "f8", 3),
        ("corner", "f8", 3),
        ("right", "f8", 3),
        ("down", "f8", 3),
        ("step", "f8"),
        # Lens: number of its distortion, see lens.DISTORTIONS; fx, fy, cx, cy; coefficients, and
        # the furthest start of `lens_limits`. Places of shapes, and `corner`, `right` and `down`,
        # are in the image without distortion.
        ("distortion", "i8"),
        ("lens", "f8", 4),
        ("coefficients", "f8", 6),
        ("plane_corner", "f8", 2),  # where the screen tiles begin in that image, pixels
        # Lists of shapes: screen tile c owns lists[lists[c] : lists[c + 1]], front to back; the sun
        # grid's cells follow from `sun_cells` on; its last cell lists the big shapes.
        # `sun_plane`: two axes facing the sun; `sun_grid`: corner of the grid along them (metres),
        # then cells per metre.
        ("tile_columns", "i8"),
        ("tile_rows", "i8"),
        ("sun_cells", "i8"),
        # Where the cells of the lamps that cast shadows begin, and the screen tiles of media.
        ("lamp_cells", "i8"),
        ("medium_tiles", "i8"),
        ("window_edge", "f8"),  # rim of a shape's window that only a widened one reaches, pixels
        # Addresses of the arrays of `World` and of its meshes and images, and numbers of items.
        ("shapes", "i8"),
        ("shape_count", "i8"),
        ("lists", "i8"),
        ("nodes", "i8"),
        ("triangles", "i8"),
        ("images", "i8"),
        ("texels", "i8"),
        ("lamps", "i8"),
        ("lamp_count", "i8"),
        ("media", "i8"),
        ("medium_count", "i8"),
        ("glows", "i8"),
        ("glow_count", "i8"),
        ("mirrored", "i8"),
        ("mirrored_count", "i8"),
        ("shadow_lamps", "i8"),  # how many lamps, the first ones, cast shadows
        ("sun_plane", "f8", (2, 3)),
        ("sun_grid", "f8", 4),
        # Surroundings: see `rendered_scene.Environment`.
        ("ground", "i8"),
        ("colour", "f8", 3),
        ("second_colour", "f8", 3),
        ("ground_surface", "i8"),  # `Texture` of what lies beside the road, of the road, of walls
        ("road_surface", "i8"),
        ("wall_surface", "i8"),
        # Of each material in use, by `Texture` less `FIRST_SURFACE`: address of its tile and of its
        # large patches' tile; tiles per metre, strength of the large patches, and theirs.
        ("surface_tiles", "i8", (SURFACE_COUNT, 2)),
        ("surface_sizes", "f8", (SURFACE_COUNT, 3)),
        ("gloss", "f8", (SURFACE_COUNT, 3)),  # of `surfaces.catalogue.gloss_rows`
        ("wall_colour", "f8", 3),
        # Middles of a room's windows, metres, and how many there are: see `shading.ambient`.
        ("windows", "f8", (MOST_WINDOWS, 3)),
        ("window_count", "i8"),
        ("wetness", "f8"),
        ("crossing_count", "i8"),
        ("crossings", "f8", (MAX_CROSSINGS, 4)),  # point (x, y), cosine and sine
        ("road", "f8", 5),  # cosine and sine of its direction, half width, x and y on it
        ("sky_top", "f8", 3),
        ("sky_horizon", "f8", 3),
        ("clouds", "f8"),
        ("wave_height", "f8"),
        ("stars", "f8"),  # 0 by day .. 1 at night
        ("sun", "f8", 3),
        ("sun_colour", "f8", 3),
        ("sun_radius", "f8"),
        ("ambient", "f8", 3),
        ("shadows", "i8"),
        ("fog", "f8"),  # 1 / fog distance, per metre; 0 = clear
        ("fog_colour", "f8", 3),
        ("exposure", "f8"),
        ("highlights", "i8"),  # 1 = light above white is kept
        ("room", "f8"),  # half the side of the room, along y, metres
        ("room_x", "f8"),  # half its side along x
        ("ceiling", "f8"),  # its height
        ("is_corridor", "i8"),
        ("has_panels", "i8"),  # of the ceiling
        ("is_hall", "i8"),
        ("time", "f8"),
    ],
    align=True,
)
"""Camera, surroundings and where the lists of shapes are."""

Record = Any
"""One element of a record array; its fields are read as attributes in kernels."""

SHAPE_RECORD = np.dtype(
    [
        ("inverse", "f8", (3, 4)),  # world → unit-shape coordinates
        ("eye", "f8", 3),  # the camera's position in unit-shape coordinates
        ("sun", "f8", 3),  # direction towards the sun in unit-shape coordinates
        ("shrink", "f8", 3),  # factors <= 1 that make a thin shape wide enough to find
        ("window", "f8", 4),  # where it may be seen: lowest, highest x, lowest, highest y, pixels
        ("depth", "f8"),  # no point of the shape is nearer than this, metres
        # What its shadow may fall on: lowest and highest place along each axis of the plane facing
        # the sun, and highest place towards the sun, metres.
        ("sun_window", "f8", 5),
        ("kind", "i8"),
        ("instance", "i8"),
        ("is_thin", "i8"),
        ("texture", "i8"),
        ("texture_scale", "f8"),
        ("extent", "f8", 3),  # metres per local unit along each local axis
        ("emission", "f8"),
        ("colour", "f8", 3),
        ("second_colour", "f8", 3),
        ("root", "i8"),  # of a mesh: its first node
        ("image", "i8"),  # what a face shows, index into `images`; -1 = nothing
        ("image_fit", "f8", 2),  # face coordinates 0..1, from the middle, to those of the image
    ],
    align=True,
)
"""One shape: geometry and material."""

NODE_RECORD = np.dtype(
    [
        ("low", "f8", 3),
        ("high", "f8", 3),
        ("first", "i4"),  # of a leaf: its first triangle
        ("count", "i4"),  # its triangles; 0 = it has two children, the first is the next node
        ("skip", "i8"),  # the node after all that are in it
    ],
    align=True,
)
"""One box of a mesh's tree."""

TRIANGLE_RECORD = np.dtype(
    [
        ("corner", "f8", (3, 3)),
        ("normal", "f4", (3, 3)),
        ("colour", "f4", (3, 3)),
        ("uv", "f4", (3, 2)),
        ("image", "i4"),  # index into `images`, -1 = none
        ("code", "i4"),  # tells it apart from other parts of its mesh, see meshes.tree.FACE_CODES
    ],
    align=True,
)
"""One triangle of a mesh."""

IMAGE_RECORD = np.dtype(
    [
        ("width", "i8"),
        ("height", "i8"),
        ("levels", "i8"),
        ("repeats", "i8"),
        ("start", "i8", MOST_LEVELS),  # where each level begins in `texels`
    ],
    align=True,
)
"""One image of `scenes.mesh`."""

SEEN_MEDIUM_RECORD = np.dtype(
    [
        ("inverse", "f8", (3, 4)),  # world → unit sphere
        ("eye", "f8", 3),  # the camera's position there
        ("depth", "f8"),  # no point of it is nearer than this, metres
        ("window", "f8", 4),  # where it may be seen: lowest, highest x, lowest, highest y, pixels
        ("colour", "f8", 3),
        ("thickness", "f8"),  # optical depth per metre in its middle
        ("radius", "f8"),  # metres; the geometric mean of its half axes
        ("emission", "f8"),
        ("detail", "f8"),
        ("seed", "f8"),
    ],
    align=True,
)
"""One participating medium as the camera sees it."""

GLOW_RECORD = np.dtype(
    [
        ("place", "f8", 2),  # x, y in the image without distortion, pixels
        ("core", "f8"),  # standard deviation of the spot, pixels
        ("halo", "f8"),  # of the light that the lens scatters around it
        ("core_light", "f8", 3),  # exposed light of the spot, summed over pixels
        ("halo_light", "f8", 3),
        ("core_reach", "f8"),  # beyond this many pixels it adds nothing
        ("halo_reach", "f8"),
    ],
    align=True,
)
"""One lamp as the camera sees it: a bright spot with a halo."""


MIRRORED_RECORD = np.dtype(
    [
        ("inverse", "f8", (3, 4)),  # world → unit-shape coordinates
        ("middle", "f8", 3),
        ("radius", "f8"),  # of the sphere around it, metres
        ("light", "f8", 3),  # that it sends to all sides
        ("instance", "i8"),
        ("is_round", "i8"),  # 1 = an ellipsoid, 0 = a box
    ],
    align=True,
)
"""One shape as glossy surfaces mirror it: see `raycast.mirrored`."""


class PackedSurfaces(NamedTuple):
    """All meshes and images of an instant."""

    nodes: NDArray[Any]
    """`NODE_RECORD`: the trees of all meshes, one after the other."""
    triangles: NDArray[Any]
    """`TRIANGLE_RECORD`: the triangles of all meshes."""
    images: NDArray[Any]
    """`IMAGE_RECORD`."""
    texels: NDArray[np.float32]
    """Linear RGB of all images, level by level."""
    roots: dict[Mesh, int]
    """First node of each mesh."""
    numbers: dict[SurfaceImage, int]
    """Index of each image."""


class World(NamedTuple):
    """One instant of a scene; kernels get `instant`, which has the other arrays' addresses."""

    instant: NDArray[Any]
    """[1] `INSTANT_RECORD`."""
    shapes: NDArray[Any]
    """[n] `SHAPE_RECORD`."""
    lists: NDArray[np.int32]
    """Shape numbers by screen tile and by sun cell; see `INSTANT_RECORD`."""
    surfaces: PackedSurfaces
    """Meshes and images of the shapes."""
    lamps: NDArray[Any]
    """[m] `LAMP_RECORD`; those that cast shadows come first."""
    media: NDArray[Any]
    """[k] `SEEN_MEDIUM_RECORD`."""
    glows: NDArray[Any]
    """[g] `GLOW_RECORD`."""
    mirrored: NDArray[Any]
    """[r] `MIRRORED_RECORD`."""

    def addressed(self) -> World:
        """The same world, whose instant has the addresses of its arrays."""
        instant, surfaces = self.instant[0], self.surfaces
        for name in ("shapes", "lists", "lamps", "media", "glows", "mirrored"):
            instant[name] = getattr(self, name).ctypes.data
        for name in ("nodes", "triangles", "images", "texels"):
            instant[name] = getattr(surfaces, name).ctypes.data
        instant["shape_count"] = len(self.shapes)
        instant["medium_count"], instant["glow_count"] = len(self.media), len(self.glows)
        instant["lamp_count"], instant["mirrored_count"] = len(self.lamps), len(self.mirrored)
        return self


def describe_lens(instant: NDArray[Any], lens: Lens, corner: tuple[float, float]) -> None:
    """Write a lens into the record, and where the screen tiles begin."""
    instant["distortion"] = lens.number
    instant["lens"] = (lens.fx, lens.fy, lens.cx, lens.cy)
    instant["coefficients"], instant["plane_corner"] = (*lens.five, lens_limits(lens)[1]), corner


def describe_rays(instant: NDArray[Any], rays: Rays) -> None:
    """Write the camera into the record."""
    instant["origin"], instant["corner"] = rays.origin, rays.corner
    instant["right"], instant["down"] = rays.right, rays.down
    instant["step"] = np.linalg.norm(rays.right)


_GROUND_SURFACES = {
    Ground.PLAIN: (Texture.CONCRETE, Texture.ASPHALT),
    Ground.GRASS: (Texture.GRASS, Texture.ASPHALT),
    Ground.ROAD: (Texture.GRASS, Texture.ASPHALT),
    Ground.DIRT_ROAD: (Texture.GRASS, Texture.SOIL),
    Ground.SEA: (Texture.WATER, Texture.WATER),
    Ground.CITY: (Texture.PAVING, Texture.ASPHALT),
    Ground.FLOOR: (Texture.BOARDS, Texture.BOARDS),
    Ground.SAND: (Texture.SAND, Texture.SAND),
    Ground.SNOW: (Texture.SNOW, Texture.SNOW),
    Ground.UNDERWATER: (Texture.SAND, Texture.SAND),
    Ground.NONE: (Texture.PLAIN, Texture.PLAIN),
    Ground.RIVER: (Texture.GRASS, Texture.WATER),
    Ground.LAKE: (Texture.GRASS, Texture.WATER),
}
"""Usual materials of each ground, and of the road on it."""


def ground_surfaces(environment: Environment) -> tuple[int, int, int]:
    """Materials of the ground, of the road on it, and of the walls if it is a room's."""
    usual = _GROUND_SURFACES[environment.ground]
    ground = usual[0] if environment.ground_surface is None else environment.ground_surface
    wall = environment.wall_surface if environment.ground is Ground.FLOOR else Texture.PLAIN
    return int(ground), int(usual[1]), int(wall)


def describe_surroundings(instant: NDArray[Any], environment: Environment, shadows: bool) -> None:
    """Write the surroundings into the record; `shadows` False turns shadows off."""
    sun = np.asarray(environment.sun_direction, dtype=np.float64)
    luma = float(np.dot([0.2126, 0.7152, 0.0722], environment.sky_top))
    angle = float(environment.road_angle)
    instant["ground"] = int(environment.ground)
    surfaces = ground_surfaces(environment)
    instant["ground_surface"], instant["road_surface"], instant["wall_surface"] = surfaces
    instant["colour"] = environment.ground_colour
    instant["second_colour"] = environment.ground_second_colour
    instant["road"] = (
        math.cos(angle),
        math.sin(angle),
        environment.road_half_width,
        *environment.road_offset,
    )
    crossings = np.asarray(environment.road_crossings, dtype=np.float64)[:MAX_CROSSINGS]
    instant["crossing_count"] = len(crossings)
    for number, (x, y, direction) in enumerate(crossings):
        row = (x, y, math.cos(direction), math.sin(direction))
        instant["crossings"][number] = row
    stars = np.clip(1.5 * (1.0 - luma / NIGHT_SKY), 0.0, 1.0)
    instant["stars"] = stars if environment.has_stars else 0.0
    instant["sun"] = sun / np.linalg.norm(sun)
    instant["sun_radius"] = SUN_RADIUS
    instant["shadows"] = int(environment.shadows and shadows)
    instant["fog"] = 1.0 / float(environment.fog_distance)
    instant["room"] = instant["room_x"] = environment.room_half_size
    instant["ceiling"] = CEILING * environment.room_half_size
    instant["is_corridor"] = int(environment.corridor_half_width is not None)
    instant["has_panels"] = int(environment.has_ceiling_panels)
    instant["is_hall"] = int(environment.is_hall)
    if environment.corridor_half_width is not None:
        instant["room_x"], instant["ceiling"] = environment.corridor_half_width, CORRIDOR_HEIGHT_M
    instant["time"] = environment.time_s
    for name in (
        "sky_top",
        "sky_horizon",
        "clouds",
        "wave_height",
        "wetness",
        "sun_colour",
        "ambient",
        "fog_colour",
        "wall_colour",
    ):
        instant[name] = getattr(environment, name)
    instant["exposure"] = environment.exposure
    instant["highlights"] = int(environment.has_highlights)


def describe_materials(
    instant: NDArray[Any], shapes: NDArray[Any], primitives: Primitives, environment: Environment
) -> None:
    """Write what shapes are made of into their records, and where the tiles of that are.

    `Texture.MOTTLED` follows the size of its shape: it is a material at another fineness.
    """
    for name in ("texture", "texture_scale", "emission", "colour", "second_colour", "instance"):
        shapes[name] = getattr(primitives, name)
    shapes["extent"] = np.linalg.norm(primitives.to_world[:, :, :3], axis=1)
    mottled = primitives.texture == Texture.MOTTLED
    largest = np.maximum(shapes["extent"][mottled].max(axis=1, initial=0.0), 1e-9)
    shapes["texture"][mottled] = Texture.SPOTS
    shapes["texture_scale"][mottled] = 0.25 * primitives.texture_scale[mottled] / largest
    used = {*np.unique(shapes["texture"]).tolist(), *ground_surfaces(environment)}
    if environment.ground is Ground.FLOOR:
        used.add(Texture.PLASTER)  # the ceiling
    instant["surface_tiles"], instant["surface_sizes"] = surface_rows(frozenset(used))
    instant["gloss"] = gloss_rows()
