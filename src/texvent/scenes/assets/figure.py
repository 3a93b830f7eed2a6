"""A model as its file has it: meshes that hang on places, at any time of its animations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from texvent.scenes.image import SurfaceImage
from texvent.scenes.mesh import (
    Colour,
    Float32Array,
    Float64Array,
    Mesh,
    make_mesh,
    recoloured,
    smooth_normals,
)


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles with one material, per corner where needed; units and axes are the file's."""

    vertices: Float64Array
    """[v, 3]."""
    triangles: np.ndarray
    """[t, 3]."""
    normals: Float32Array | None = None
    """[v, 3]; None: to be found."""
    uv: Float32Array | None = None
    """[v, 2], v down."""
    colours: Float32Array | None = None
    """[v, 3] linear RGB, multiplies `colour`."""
    colour: Colour = (0.5, 0.5, 0.5)
    image: SurfaceImage | None = None


class Figure(Protocol):
    """What a file of a model holds."""

    def place(
        self, time_s: float, activity: str, colour: Colour | None
    ) -> Sequence[tuple[Mesh, Float64Array]]:
        """Meshes with their [3, 4] maps to the file's coordinates.

        Args:
            time_s: time of the animation, s.
            activity: chooses among animations, see `models.protocol.Pose`.
            colour: paint of all of it; None: its own.
        """
        ...


class RigidFigure:
    """A model without animations: one mesh."""

    def __init__(self, surfaces: Sequence[Surface]) -> None:
        self._mesh, self._to_file = join_surfaces(surfaces)
        self._painted: dict[Colour, Mesh] = {}

    def place(
        self, time_s: float, activity: str, colour: Colour | None
    ) -> Sequence[tuple[Mesh, Float64Array]]:
        """The mesh, wherever and whenever."""
        del time_s, activity
        return [(painted(self._mesh, colour, self._painted), self._to_file)]


def painted(mesh: Mesh, colour: Colour | None, known: dict[Colour, Mesh]) -> Mesh:
    """The mesh in a colour, made once."""
    if colour is None:
        return mesh
    if colour not in known:
        known[colour] = recoloured(mesh, colour)
    return known[colour]


def join_surfaces(surfaces: Sequence[Surface]) -> tuple[Mesh, Float64Array]:
    """All surfaces as one mesh, and the [3, 4] map from it to the file's coordinates.

    Raises:
        InputError: there is no triangle with an area.
    """
    images = list(dict.fromkeys(one.image for one in surfaces if one.image is not None))
    vertices, triangles, normals, colours, uv, image = [], [], [], [], [], []
    first = 0
    for one in surfaces:
        corners = np.asarray(one.triangles, dtype=np.int64).reshape(-1, 3)
        places = np.asarray(one.vertices, dtype=np.float64).reshape(-1, 3)
        shape = (len(corners), 3, 3)
        vertices.append(places)
        triangles.append(corners + first)
        if one.normals is None:
            normals.append(smooth_normals(places, corners.astype(np.int32)))
        else:
            normals.append(np.asarray(one.normals, dtype=np.float32)[corners])
        tint = np.asarray(one.colour, dtype=np.float32)
        own = np.ones(shape, np.float32) if one.colours is None else one.colours[corners]
        colours.append(own * tint)
        uv.append(np.zeros((*shape[:2], 2), np.float32) if one.uv is None else one.uv[corners])
        has_image = one.image is not None and one.uv is not None
        number = images.index(one.image) if has_image and one.image is not None else -1
        image.append(np.full(len(corners), number))
        first += len(places)
    return make_mesh(
        np.concatenate(vertices),
        np.concatenate(triangles),
        normals=np.concatenate(normals),
        colours=np.concatenate(colours),
        uv=np.concatenate(uv),
        image=np.concatenate(image),
        images=images,
    )
