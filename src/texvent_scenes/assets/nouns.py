"""Assets as nouns: sized, turned to the front, and in place of the embedded noun of their name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from texvent.errors import InputError, shown
from texvent_scenes.assets.index import ENDINGS, Asset
from texvent_scenes.assets.model_file import KEPT_FILES, load_mesh
from texvent_scenes.description import SceneDescription
from texvent_scenes.mesh import Colour, Float64Array, Mesh, recoloured
from texvent_scenes.models.nouns import AFLOAT, NOUNS
from texvent_scenes.models.parts import read_nouns
from texvent_scenes.models.protocol import Model, ModelPart, Noun, Pose, choose
from texvent_scenes.named_files import describe_file
from texvent_scenes.rendered_scene import Shape

_UNITS = ((20.0, 0.01), (1000.0, 0.001))
"""Longest side of a file above which its unit is taken to be this many metres: cm, mm."""


@dataclass(eq=False)
class AssetModel:
    """A model from a file; implements `models.protocol.Model`."""

    mesh: Mesh
    to_body: Float64Array
    """[3, 4] mesh → body."""
    length: float
    width: float
    height: float
    is_centred: bool = False

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """Its mesh, at any pose."""
        del pose
        return [ModelPart(Shape.MESH, self.to_body, (1.0, 1.0, 1.0), mesh=self.mesh)]


@lru_cache(maxsize=KEPT_FILES)
def _read_parts(path: Path, changed_ns: int) -> Mapping[str, Noun]:
    del changed_ns
    return {noun.name: noun for noun in read_nouns(path)}


def _part_noun(asset: Asset) -> Noun | None:
    """The noun of an asset that is a list of parts; None: it is a mesh."""
    if asset.path.suffix.lower() != ".toml":
        return None
    return _read_parts(asset.path, _changed_ns(asset))[asset.noun]


def load_model(
    asset: Asset, *, colour: Colour | None = None, scale: float = 1.0, is_centred: bool = False
) -> AssetModel:
    """An asset's model, sized, standing on the ground or centred, facing +x.

    Raises:
        FileFormatError: the file is damaged.
        MissingDependencyError: trimesh is needed and not installed.
    """
    mesh, to_file = load_mesh(asset.path, _changed_ns(asset))
    turn = _axes(asset)
    used = mesh.vertices[np.unique(mesh.triangles)]
    places = (used @ to_file[:, :3].T + to_file[:, 3]) @ turn.T
    low, high = places.min(axis=0), places.max(axis=0)
    factor = scale * _scale(asset, high - low)
    extents, middle = (high - low) * factor, 0.5 * (low + high) * factor
    foot = middle[2] if is_centred else low[2] * factor
    to_body = factor * turn @ to_file
    to_body[:, 3] -= [middle[0], middle[1], foot]
    length, width, height = (max(float(extent), 1e-3) for extent in extents)
    shown = mesh if colour is None else recoloured(mesh, colour)
    return AssetModel(shown, to_body, length, width, height, is_centred)


def _changed_ns(asset: Asset) -> int:
    """Time of the last change of an asset's file.

    Raises:
        InputError: it is gone.
    """
    try:
        return asset.path.stat().st_mtime_ns
    except OSError as error:
        raise InputError(f"the asset {asset.path} cannot be read: {error.strerror}") from error


def _axes(asset: Asset) -> Float64Array:
    """[3, 3] the file's axes → body: x ahead, y left, z up."""
    is_ply = asset.path.suffix.lower() == ".ply"
    up = _axis(asset.up or ("z" if is_ply else "y"))
    ahead = _axis(asset.forward or ("-y" if is_ply else "z"))
    if abs(float(up @ ahead)) > 0.5:
        raise InputError(
            f"{asset.path}: up is {asset.up} and forward {asset.forward}; they must be two axes"
        )
    return np.stack([ahead, np.cross(up, ahead), up])


def _axis(name: str) -> Float64Array:
    sign = -1.0 if name.startswith("-") else 1.0
    return np.asarray(sign * np.eye(3)["xyz".index(name[-1])])


def _scale(asset: Asset, extents: Float64Array) -> float:
    """Metres per unit of the file: as the index says, or usual."""
    sides = np.maximum(extents, 1e-9)
    if asset.scale is not None:
        return asset.scale
    if asset.height is not None:
        return float(asset.height / sides[2])
    if asset.length is not None:
        return float(asset.length / sides.max())
    if asset.path.suffix.lower() == ".glb":
        return 1.0  # metres, as glTF says
    usual = usual_noun(asset.noun)
    if usual is not None:
        model = usual.build(colour=None, scale=1.0, seed=0)
        longest = max(model.length, model.width, model.height)
        return float(longest / sides.max())
    unit = 1.0
    for above, metres in _UNITS:
        unit = metres if sides.max() > above else unit
    return unit


def usual_noun(name: str) -> Noun | None:
    """The embedded noun of that name, of its last words, or one that it is a synonym or kind of."""
    words = name.split()
    for first in range(len(words)):
        said = " ".join(words[first:])
        if said in NOUNS:
            return NOUNS[said]
        for noun in NOUNS.values():
            if said in noun.synonyms:
                return noun
    return None


@dataclass(frozen=True)
class _ModelBuilder:
    """Makes a model of one of several assets with the same noun; the seed chooses."""

    assets: tuple[Asset, ...]
    is_centred: bool

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> Model:
        asset = choose(seed, "asset", self.assets)
        listed = _part_noun(asset)
        if listed is not None:
            return listed.build(colour=colour, scale=scale, seed=seed)
        return load_model(asset, colour=colour, scale=scale, is_centred=self.is_centred)


def merge_nouns(assets: Iterable[Asset]) -> Mapping[str, Noun]:
    """All nouns, those of the assets first: they take the place of embedded ones of their name."""
    groups: dict[str, list[Asset]] = {}
    for asset in assets:
        groups.setdefault(asset.noun, []).append(asset)
    own = {name: _noun(name, tuple(group)) for name, group in groups.items()}
    taken = set(own) | {word for noun in own.values() for word in noun.synonyms}
    embedded = {
        name: replace(noun, synonyms=tuple(one for one in noun.synonyms if one not in taken))
        for name, noun in NOUNS.items()
        if name not in own
    }
    return MappingProxyType(own | embedded)


def with_models(nouns: Mapping[str, Noun], models: Mapping[str, str]) -> Mapping[str, Noun]:
    """All nouns, some of them as the model of a file: noun → path.

    Raises:
        InputError: a path is no model, or there is no such file.
    """
    for noun, path in models.items():
        if Path(path).suffix.lower() not in ENDINGS:
            raise InputError(f"the model {path} of {shown(noun)} must end in {', '.join(ENDINGS)}")
        if not Path(path).is_file():
            raise InputError(f"the model {path} of {shown(noun)} does not exist")
    own = {noun: _noun(noun, (Asset(Path(path), noun),)) for noun, path in models.items()}
    return MappingProxyType({**nouns, **own})


def _noun(name: str, assets: tuple[Asset, ...]) -> Noun:
    listed = _part_noun(assets[0])
    if listed is not None:
        return replace(listed, build=_ModelBuilder(assets, is_centred=False))
    first, usual = assets[0], usual_noun(name)
    habitat = first.habitat or (usual.habitat if usual is not None else "fixed")
    is_fixed = habitat == "fixed"
    motion = first.motion or (usual.motion if usual is not None else "stand")
    if usual is not None and is_fixed != (usual.habitat == "fixed") and first.motion is None:
        motion = "stand" if is_fixed else "move"
    speed = first.speed if first.speed is not None else (usual.speed_m_s if usual else 1.0)
    synonyms = dict.fromkeys(word for asset in assets for word in asset.synonyms)
    if usual is not None and usual.name == name:
        synonyms.update(dict.fromkeys(usual.synonyms))
    is_centred = habitat in ("air", "water") and name not in AFLOAT
    return Noun(
        name,
        _ModelBuilder(assets, is_centred),
        habitat,
        0.0 if is_fixed else speed,
        motion,
        tuple(synonyms),
        usual.plurals if usual is not None and usual.name == name else (),
        place=first.place or (usual.place if usual is not None else ""),
    )


def assets_of(noun: Noun) -> tuple[Asset, ...]:
    """The assets that a noun's models come from; none for an embedded noun."""
    return noun.build.assets if isinstance(noun.build, _ModelBuilder) else ()


def list_files(description: SceneDescription, nouns: Mapping[str, Noun]) -> list[dict[str, str]]:
    """The files of assets and pictures that a scene is made of, each once."""
    files = {asset.path for one in description.objects for asset in assets_of(nouns[one.noun])}
    for one in description.objects:
        if one.picture is not None and one.picture.kind == "file":
            files.add(Path(one.picture.value))
    return [describe_file(path) for path in sorted(files)]
