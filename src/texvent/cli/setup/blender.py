"""`texvent blender`: where the script for Blender is."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import texvent.capture.motion_vectors
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs

DESCRIPTION = """Print the path of a script that Blender runs: it renders a .blend with the passes
that texvent simulate takes.

  blender --background scene.blend --python "$(texvent blender)" -- OUT
  texvent simulate OUT -o out.h5"""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    parse_configs(arguments, {}, prog="texvent blender", description=DESCRIPTION)
    # Found, not imported: it belongs to Blender's Python.
    folder = Path(texvent.capture.motion_vectors.__path__[0])
    write_out(f"{folder / 'blender_script.py'}\n")
    return 0
