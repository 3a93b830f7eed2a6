"""A GLB file as a tool of its own writes it."""

from pathlib import Path

import trimesh


def write_bar(path: Path, height: float = 2.0) -> Path:
    """A red bar, 0.2 wide, on a node 3 aside."""
    bar = trimesh.creation.box((0.2, height, 0.2))
    paint = trimesh.visual.material.PBRMaterial(baseColorFactor=[0.8, 0.2, 0.0, 1.0])
    bar.visual = trimesh.visual.TextureVisuals(material=paint)
    scene = trimesh.Scene()
    scene.add_geometry(bar, transform=trimesh.transformations.translation_matrix((3.0, 0.0, 0.0)))
    scene.export(path)
    return path
