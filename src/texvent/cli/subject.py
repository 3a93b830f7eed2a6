"""Subjects of commands: a sentence, or the name of a scene file."""

from __future__ import annotations

from pathlib import Path

from texvent.generate.scene_input import Subject
from texvent.io.atomic import protect_inputs
from texvent.scenes.spec.files import is_scene_file, load_scene


def read_subject(prompt: str) -> Subject:
    """The prompt, or the scene of a file, which no output may replace."""
    if not is_scene_file(prompt):
        return prompt
    protect_inputs([prompt])
    return load_scene(prompt)


def subject_name(prompt: str) -> str:
    """Base of file names: the words of a prompt, or the name of a scene file."""
    return Path(prompt).stem if is_scene_file(prompt) else prompt
