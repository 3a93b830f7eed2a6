"""Signatures that name every option: what `help`, notebooks and completion show of a function."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, TypeVar

AnyFunction = TypeVar("AnyFunction", bound=Callable[..., Any])


def naming_options(keywords: type) -> Callable[[AnyFunction], AnyFunction]:
    """A decorator that puts the keys of a TypedDict into the signature, before `**options`.

    Type checkers read `Unpack[...]` themselves; IPython and `inspect.signature` do not.

    Example:
        >>> from typing import TypedDict
        >>> class Options(TypedDict, total=False):
        ...     seed: int | None
        >>> @naming_options(Options)
        ... def run(source, **options): ...
        >>> inspect.signature(run)
        <Signature (source, *, seed: 'int | None' = None, **options)>
    """

    def name(function: AnyFunction) -> AnyFunction:
        plain = inspect.signature(function)
        *given, rest = plain.parameters.values()
        options = [
            inspect.Parameter(
                option,
                inspect.Parameter.KEYWORD_ONLY,
                default=None,
                annotation=getattr(hint, "__forward_arg__", hint),
            )
            for option, hint in keywords.__annotations__.items()
        ]
        shown = plain.replace(parameters=[*given, *options, rest])
        function.__signature__ = shown  # type: ignore[attr-defined]
        return function

    return name
