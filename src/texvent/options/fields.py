"""Options of a config dataclass: names and help."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import itertools
import textwrap
from typing import cast


def option_names(config_type: type) -> tuple[str, ...]:
    """Names of the options of a config dataclass, in order."""
    return tuple(field.name for field in dataclasses.fields(config_type))


def option_help(config_type: type) -> dict[str, str]:
    """Option name → the text under its field, on one line; also what `--help` shows."""
    texts: dict[str, str] = {}
    for owner in reversed(config_type.__mro__):
        if not dataclasses.is_dataclass(owner):
            continue
        body = cast("ast.ClassDef", ast.parse(textwrap.dedent(inspect.getsource(owner))).body[0])
        for field, text in itertools.pairwise(body.body):
            if (
                isinstance(field, ast.AnnAssign)
                and isinstance(field.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
            ):
                texts[field.target.id] = " ".join(str(text.value.value).split())
    return texts
