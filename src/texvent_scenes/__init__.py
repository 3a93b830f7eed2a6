"""Scenes: values and files → 3-D scenes → frames with exact ground truth.

    from texvent_scenes import Motion, Scene, SceneObject, load_scene, save_scene

The parts of a scene, and the functions that read and write its files, load on first use.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent_scenes import rig
    from texvent_scenes.spec.files import load_scene, save_scene
    from texvent_scenes.spec.scene import (
        Camera,
        CameraMove,
        Effect,
        Lamp,
        Light,
        Motion,
        Picture,
        Place,
        Relation,
        Scene,
        SceneObject,
    )

__all__ = [
    "Camera",
    "CameraMove",
    "Effect",
    "Lamp",
    "Light",
    "Motion",
    "Picture",
    "Place",
    "Relation",
    "Scene",
    "SceneObject",
    "load_scene",
    "rig",
    "save_scene",
]


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name not in __all__:
        raise AttributeError(f"module 'texvent_scenes' has no attribute {name!r}")
    if name == "rig":
        return importlib.import_module("texvent_scenes.rig")
    home = "files" if name in ("load_scene", "save_scene") else "scene"
    return getattr(importlib.import_module(f"texvent_scenes.spec.{home}"), name)


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
