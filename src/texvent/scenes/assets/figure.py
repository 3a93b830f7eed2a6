"""A model as its file has it: meshes that hang on places, at any time of its animations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventError, one_line
from texvent.scenes.assets.glb_file import (
    GlbFile,
    Matrix,
    choose_animation,
    place_nodes,
    read_animations,
)
from texvent.scenes.mesh import (
    Colour,
    Float32Array,
    Float64Array,
    Mesh,
    SurfaceImage,
    deformed,
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


_TRIANGLES = 4
_CLEAR = 0.4
"""Surfaces less opaque than this are left out: panes of glass."""


@dataclass(frozen=True, eq=False)
class Skin:
    """How a mesh follows joints: linear blend skinning."""

    joints: NDArray[np.int64]
    """[j] node numbers."""
    inverse_binds: Matrix
    """[j, 4, 4] mesh → joint, in the pose that the mesh was bound in."""
    indices: NDArray[np.int64]
    """[v, 4] joints of each vertex, as indices into `joints`."""
    weights: Float64Array
    """[v, 4], which sum to 1."""
    places: Float64Array
    """[v, 3] vertices as bound, in the file's units."""
    normals: Float64Array
    """[t, 3, 3] corner normals as bound."""


@dataclass(frozen=True, eq=False)
class HungMesh:
    """A mesh on a node."""

    node: int
    mesh: Mesh
    to_node: Float64Array
    """[3, 4] mesh → node."""
    skin: Skin | None = None
    paints: dict[Colour, Mesh] = field(default_factory=dict)


class GltfFigure:
    """The model of a GLB file.

    Args:
        path: the file.

    Raises:
        FileFormatError: it is damaged, needs what is not read, or has no triangles.
    """

    def __init__(self, path: Path) -> None:
        file = GlbFile(path)
        try:
            self._nodes = file.items("nodes")
            self._animations = read_animations(file)
            self._roots = _roots(file)
            numbers = place_nodes(self._nodes, self._roots, None, 0.0)
            hung = (_hang(file, number) for number in numbers)
            self._hung = [one for one in hung if one is not None]
        except TexventError:
            raise
        except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
            raise FileFormatError(f"{path} is damaged: {one_line(error)}") from error
        if not self._hung:
            raise FileFormatError(f"{path} has no triangles")

    def place(
        self, time_s: float, activity: str, colour: Colour | None
    ) -> Sequence[tuple[Mesh, Float64Array]]:
        """Meshes with their [3, 4] maps to the file's coordinates; see `figure.Figure`."""
        animation = choose_animation(self._animations, activity)
        places = place_nodes(self._nodes, self._roots, animation, time_s)
        found = []
        for hung in self._hung:
            mesh = painted(hung.mesh, colour, hung.paints)
            if hung.skin is not None:
                found.append(_bend(mesh, hung.skin, places))
                continue
            node = places[hung.node]
            to_file = node[:3, :3] @ hung.to_node
            to_file[:, 3] += node[:3, 3]
            found.append((mesh, to_file))
        return found


def _bend(mesh: Mesh, skin: Skin, places: dict[int, Matrix]) -> tuple[Mesh, Float64Array]:
    """A skinned mesh with its joints where they are."""
    moves = np.stack([places[int(node)] for node in skin.joints]) @ skin.inverse_binds
    blend = np.einsum("vk,vkij->vij", skin.weights, moves[skin.indices])
    vertices = np.einsum("vij,vj->vi", blend[:, :3, :3], skin.places) + blend[:, :3, 3]
    corners = blend[mesh.triangles][..., :3, :3]
    normals = np.einsum("tcij,tcj->tci", corners, skin.normals)
    return deformed(mesh, vertices, normals.astype(np.float32))


def _roots(file: GlbFile) -> list[int]:
    scenes = file.items("scenes")
    if scenes:
        return list(scenes[file.json.get("scene", 0)].get("nodes", ()))
    children = {child for node in file.items("nodes") for child in node.get("children", ())}
    return [number for number in range(len(file.items("nodes"))) if number not in children]


def _hang(file: GlbFile, number: int) -> HungMesh | None:
    """The mesh of a node, if it has one with triangles."""
    node = file.items("nodes")[number]
    if "mesh" not in node:
        return None
    primitives = [
        one
        for one in file.items("meshes")[node["mesh"]]["primitives"]
        if one.get("mode", _TRIANGLES) == _TRIANGLES and _alpha(file, one) >= _CLEAR
    ]
    if not primitives:
        return None
    mesh, to_node = join_surfaces([_surface(file, one) for one in primitives])
    if "skin" not in node:
        return HungMesh(number, mesh, to_node)
    return HungMesh(number, mesh, to_node, _read_skin(file, node, primitives, mesh, to_node))


def _read_skin(
    file: GlbFile,
    node: dict[str, Any],
    primitives: Sequence[dict[str, Any]],
    mesh: Mesh,
    to_node: Float64Array,
) -> Skin:
    skin = file.items("skins")[node["skin"]]
    joints = np.array(skin["joints"], dtype=np.int64)
    binds = np.tile(np.eye(4), (len(joints), 1, 1))
    if "inverseBindMatrices" in skin:
        flat = np.asarray(file.array(skin["inverseBindMatrices"]), dtype=np.float64)
        binds = flat.reshape(-1, 4, 4).transpose(0, 2, 1)
    attributes = [one["attributes"] for one in primitives]
    indices = np.concatenate([file.array(one["JOINTS_0"]) for one in attributes])
    weights = np.concatenate([file.array(one["WEIGHTS_0"]) for one in attributes])
    weights = np.asarray(weights, dtype=np.float64)
    total = weights.sum(axis=1, keepdims=True)
    half = to_node[:, :3].diagonal()
    return Skin(
        joints,
        binds,
        indices.astype(np.int64),
        weights / np.where(total > 0.0, total, 1.0),
        mesh.vertices @ to_node[:, :3].T + to_node[:, 3],
        mesh.normals.astype(np.float64) / half,
    )


def _material(file: GlbFile, primitive: dict[str, Any]) -> dict[str, Any]:
    number = primitive.get("material")
    return {} if number is None else file.items("materials")[number]


def _base_colour(file: GlbFile, primitive: dict[str, Any]) -> list[float]:
    rough = _material(file, primitive).get("pbrMetallicRoughness", {})
    return [float(value) for value in rough.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0))]


def _alpha(file: GlbFile, primitive: dict[str, Any]) -> float:
    is_blended = _material(file, primitive).get("alphaMode") == "BLEND"
    return _base_colour(file, primitive)[3] if is_blended else 1.0


def _surface(file: GlbFile, primitive: dict[str, Any]) -> Surface:
    attributes = primitive["attributes"]
    vertices = np.asarray(file.array(attributes["POSITION"]), dtype=np.float64)
    if "indices" in primitive:
        triangles = np.asarray(file.array(primitive["indices"]), dtype=np.int64).reshape(-1, 3)
    else:
        triangles = np.arange(len(vertices)).reshape(-1, 3)
    texture = _material(file, primitive).get("pbrMetallicRoughness", {}).get("baseColorTexture", {})
    image = None
    if "index" in texture and f"TEXCOORD_{texture.get('texCoord', 0)}" in attributes:
        source = file.items("textures")[texture["index"]].get("source")
        image = None if source is None else file.images[source]
    uv_name = f"TEXCOORD_{texture.get('texCoord', 0)}"
    red, green, blue, _ = _base_colour(file, primitive)
    return Surface(
        vertices,
        triangles,
        normals=_floats(file, attributes, "NORMAL"),
        uv=_floats(file, attributes, uv_name) if image is not None else None,
        colours=_vertex_colours(file, attributes),
        colour=(red, green, blue),
        image=image,
    )


def _floats(file: GlbFile, attributes: dict[str, int], name: str) -> NDArray[np.float32] | None:
    return np.asarray(file.array(attributes[name]), np.float32) if name in attributes else None


def _vertex_colours(file: GlbFile, attributes: dict[str, int]) -> NDArray[np.float32] | None:
    """Linear RGB of vertices: integers are normalised, none are coded (specification 3.9.2)."""
    values = _floats(file, attributes, "COLOR_0")
    return None if values is None else values[:, :3]
