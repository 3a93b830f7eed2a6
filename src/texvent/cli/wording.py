"""Messages of a command name its flags: `--white-level 1`, where Python says `white_level=1`."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterable, Iterator
from typing import Any

from texvent.errors import KEPT, worded
from texvent.options.fields import option_names

OTHER_NAMES = {"size": ("sensor",), "without_label": ("drop_label", "no_label_noise")}
"""Arguments and methods of Python → flags, of which a command has one, that do the same."""
_NAME = re.compile(
    KEPT + r"|(?<![\w.'\"/=-])(?P<name>[a-z]\w*)(?P<sets>=(?P<value>'[^']*'|[\w./-]*\w)?|\(\))?"
)
_flags: set[str] = set()
"""Names of the options that the running command has."""


@contextlib.contextmanager
def flags_in_messages() -> Iterator[None]:
    """Let errors and warnings inside the block name the flags of the command that runs there."""
    _flags.clear()
    with worded(in_flags):
        yield


def name_flags(groups: Iterable[Any]) -> None:
    """Note the options of a command: config instances, as `parse_options` takes them."""
    for config in groups:
        _flags.update(set(option_names(type(config))) - {*getattr(config, "positional", ())})


def in_flags(text: str) -> str:
    """A message whose options are written as the flags of the running command.

    What is an option: a name with an underscore, with a value, with parentheses, or of one word at
    the beginning ("seed is ..."). What a config file sets is named as there.
    """

    def flag(found: re.Match[str]) -> str:
        name, sets, value = found["name"], found["sets"], (found["value"] or "").strip("'")
        is_first = found.start() == 0 and text.startswith(" is ", found.end())
        if name is None or not (sets or "_" in name or is_first):
            return found[0]
        names = (name, *(OTHER_NAMES.get(name, ()) if sets else ()))
        known = next((one for one in names if one.removeprefix("no_") in _flags), None)
        if known is None:
            return found[0]
        known = f"no_{known}" if value == "False" else known
        given = "" if value in ("", "True", "False") else f" {value}"
        return f"--{known.replace('_', '-')}{given}"

    return text if text.startswith("config file ") else _NAME.sub(flag, text)
