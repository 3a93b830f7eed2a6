"""`texvent generate PROMPT`: events, film, picture and page from a text prompt."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from texvent._registry import GENERATORS
from texvent.cli.command import resolve_command
from texvent.cli.options import REQUIRED
from texvent.cli.run import execute, print_settings
from texvent.pipeline import text_to_events

DESCRIPTION = """Turn a sentence into the events a camera would see.

The embedded generator needs no weights and no download: it draws the scene with simple 3-D shapes
and says which words it did not understand."""


@dataclass(frozen=True, kw_only=True)
class PromptOptions:
    """What to show."""

    positional: ClassVar[tuple[str, ...]] = ("prompt",)

    prompt: str = REQUIRED
    """What to show, in plain English, quoted."""
    generator: str = next(iter(GENERATORS.builtin))
    """Text-to-video generator."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    settings, own, output = resolve_command(
        "generate", arguments, PromptOptions(), description=DESCRIPTION
    )
    if output.print_config:
        return print_settings(settings)
    return execute(text_to_events(own.prompt, settings), output, subject=own.prompt)
