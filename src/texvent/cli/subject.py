"""Subjects of commands: a sentence, or the name of a scene file."""

from __future__ import annotations

from pathlib import Path

from texvent.errors import ConfigError
from texvent.generate.scene_input import Subject, check_words
from texvent.io.atomic import protect_inputs
from texvent.scenes.spec.files import is_scene_file, load_scene


def read_subject(prompt: str, assets: Path | None = None) -> Subject:
    """The prompt, or the scene of a file, which no output may replace.

    Raises:
        ConfigError: a field is wrong or a word is not shown, also with models of `assets`; the
            message begins with the name of the file.
    """
    if not is_scene_file(prompt):
        return prompt
    protect_inputs([prompt])
    scene = load_scene(prompt)
    try:
        return check_words(scene, assets)
    except ConfigError as error:
        raise ConfigError(f"{prompt}: {error}") from None


def subject_name(prompt: str) -> str:
    """Base of file names: the words of a prompt, or the name of a scene file."""
    return Path(prompt).stem if is_scene_file(prompt) else prompt
