"""Subjects of generators: a sentence, or a scene of the package that brings scenes.

Scenes come in by an entry point, as generators do: texvent itself knows their sentence alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Protocol, TypeAlias, cast

from texvent._registry import SCENES
from texvent._require import reinstall_command
from texvent.errors import ConfigError, MissingDependencyError, shown
from texvent.prompt_report import PromptReport, Substitution

SCENE_KEY = "scene"
"""Name of a scene's plain values in the metadata of videos and events."""


class SceneValue(Protocol):
    """A scene."""

    @property
    def prompt(self) -> str:
        """Sentence that describes it, or ""; stored with its events."""
        ...


Subject: TypeAlias = str | SceneValue
"""A prompt, or the scene itself."""


class ReadPrompt(Protocol):
    """A sentence that was read."""

    @property
    def scene(self) -> SceneValue:
        """The scene that it describes."""
        ...

    @property
    def substituted(self) -> tuple[Substitution, ...]:
        """Words that are shown as something else."""
        ...

    @property
    def not_understood(self) -> tuple[str, ...]:
        """Words that had no effect on the scene; those that stand together are one entry."""
        ...

    @property
    def open_words(self) -> tuple[str, ...]:
        """Words that only the drawn scene confirms or denies."""
        ...


class ScenePackage(Protocol):
    """Functions of scenes, as a module that an entry point in `texvent.scene_packages` names."""

    def is_scene(self, value: Any) -> bool:
        """Whether a value is a scene."""
        ...

    def is_scene_file(self, text: str) -> bool:
        """Whether a prompt is the name of a scene file."""
        ...

    def load_scene(self, path: str | Path) -> Any:
        """The scene of a file."""
        ...

    def save_scene(self, path: str | Path, scene: Any, *, overwrite: bool = False) -> None:
        """Write a scene to a file."""
        ...

    def scene_to_data(self, scene: Any) -> dict[str, Any]:
        """Plain values of a scene."""
        ...

    def scene_from_data(self, data: Any) -> Any:
        """A scene from plain values, checked."""
        ...

    def checked_scene(self, scene: Any) -> Any:
        """A scene that a program made, checked as one from a file."""
        ...

    def get_field(self, scene: Any, path: str) -> Any:
        """The value of a field by its path, such as `objects[0].colour`."""
        ...

    def with_fields(self, scene: Any, values: Mapping[str, Any]) -> Any:
        """The scene with other values of fields: path → value."""
        ...

    def check_words(self, scene: Any, assets: str | Path | None = None) -> Any:
        """The scene, if its words are shown by the generator or by models of a folder."""
        ...

    def list_nouns(self, assets: str | Path | None = None) -> Mapping[str, Any]:
        """The nouns that scenes can show, with models of a folder."""
        ...

    def list_vocabulary(self) -> Mapping[str, Any]:
        """The words of prompts: family → words, each with its other names."""
        ...

    def read(self, prompt: str, *, assets: str | Path | None = None) -> ReadPrompt:
        """The scene that a sentence describes."""
        ...

    def write_scene(self, prompt: str, url: str, model: str) -> tuple[Any, PromptReport]:
        """The scene that a language model writes, and what became of the prompt's words."""
        ...

    def files_of(self, subject: Subject, assets: Path | None = None) -> list[str]:
        """Files that a scene names, and the folder of its models; nothing is read."""
        ...

    def check_files(self, described: Any) -> None:
        """Refuse files that are gone or not as the metadata of a video describe them."""
        ...


def scenes() -> ScenePackage:
    """The package that brings scenes.

    Raises:
        MissingDependencyError: there is none.
    """
    for name in SCENES.entries():
        return cast(ScenePackage, SCENES.load(name))
    raise MissingDependencyError(
        "no package brings scenes, for the entry points of texvent or its package texvent_scenes "
        f"are missing; install it anew: {reinstall_command()}"
    )


def describe_subject(subject: Subject) -> dict[str, Any]:
    """A prompt or a scene in the metadata of its video: enough to make it again."""
    if isinstance(subject, str):
        return {"prompt": subject}
    return {"prompt": subject.prompt or None, SCENE_KEY: scenes().scene_to_data(subject)}


def prompt_of(subject: Subject) -> str | None:
    """The sentence that is stored with the events of a subject; None: a scene without one."""
    return subject if isinstance(subject, str) else subject.prompt or None


def check_takes(subject: Subject | None, generator_class: type, name: str) -> None:
    """Refuse a scene for a generator that takes sentences only.

    Args:
        subject: a sentence or a scene; None: any scene.
        generator_class: the generator.
        name: its name.

    Raises:
        ConfigError: with the generator's name.
    """
    if not isinstance(subject, str) and not getattr(generator_class, "takes_scenes", False):
        raise ConfigError(
            f"generator {shown(name)} takes a prompt, not a scene; leave `generator` out, or give "
            "a sentence"
        )


def stored_subject(metadata: Mapping[str, Any]) -> Subject | None:
    """The prompt or the scene that `describe_subject` wrote; None where there is neither.

    Raises:
        ConfigError: the scene is wrong.
    """
    if SCENE_KEY in metadata:
        return cast(Subject, scenes().scene_from_data(metadata[SCENE_KEY]))
    prompt = metadata.get("prompt")
    return prompt if isinstance(prompt, str) else None
