"""Scenes as texvent asks for them: functions of `texvent.generation.subjects.ScenePackage`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from texvent_scenes.named_files import check_files, files_of
from texvent_scenes.scene_input import check_words, list_nouns, read
from texvent_scenes.spec.data import (
    checked_scene,
    get_field,
    scene_from_data,
    scene_to_data,
    with_fields,
)
from texvent_scenes.spec.files import is_scene_file, load_scene, save_scene
from texvent_scenes.spec.scene import Scene

if TYPE_CHECKING:
    from texvent.prompt_report import PromptReport

__all__ = [
    "check_files",
    "check_words",
    "checked_scene",
    "files_of",
    "get_field",
    "is_scene",
    "is_scene_file",
    "list_nouns",
    "list_vocabulary",
    "load_scene",
    "read",
    "save_scene",
    "scene_from_data",
    "scene_to_data",
    "with_fields",
    "write_scene",
]


def is_scene(value: Any) -> bool:
    """Whether a value is a scene."""
    return isinstance(value, Scene)


def list_vocabulary() -> dict[str, list[tuple[str, ...]]]:
    """The words of prompts: family → words, each with its other names."""
    from texvent_scenes import vocabulary  # brings the lexicon

    return vocabulary.list_vocabulary()


def write_scene(prompt: str, url: str, model: str) -> tuple[Scene, PromptReport]:
    """The scene that a language model writes, and its report; errors as `llm.write_scene`."""
    from texvent_scenes import llm  # most runs do not need it

    return llm.write_scene(prompt, url, model)
