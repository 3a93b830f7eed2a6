"""The JSON Schema of scene files, by which editors complete and check them."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Annotated, Any, Literal, get_args, get_origin

from texvent.options.fields import option_help
from texvent.scenes.colours import PALETTES
from texvent.scenes.spec.data import field_types, inner_type, required_fields
from texvent.scenes.spec.limits import Vocabulary
from texvent.scenes.spec.scene import Scene

DIALECT = "https://json-schema.org/draft/2020-12/schema"
_TYPES = {str: "string", float: "number", int: "integer", bool: "boolean"}


def json_schema(words: Vocabulary) -> dict[str, Any]:
    """The schema of a scene.

    Args:
        words: kind → the words that editors offer. Others pass the schema: a folder of models
            brings nouns of its own, and colours may be codes.
    """
    named = {**words, **{f"{name} colour": colours for name, colours in PALETTES.items()}}
    return {
        "$schema": DIALECT,
        "title": "Scene of texvent",
        **_of_type(Scene),
        "$defs": {kind: {"type": "string", "examples": list(one)} for kind, one in named.items()},
    }


def _of_type(hint: Any) -> dict[str, Any]:
    hint = inner_type(hint)
    arguments = get_args(hint)
    if get_origin(hint) is Annotated:
        plain, limit = arguments
        return {**_of_type(plain), **limit.schema()}
    if get_origin(hint) is tuple:
        items = {"type": "array", "items": _of_type(arguments[0])}
        size = (
            {}
            if arguments[-1] is Ellipsis
            else dict.fromkeys(("minItems", "maxItems"), len(arguments))
        )
        return {**items, **size}
    if get_origin(hint) is Literal:
        return {"enum": list(arguments)}
    if dataclasses.is_dataclass(hint):
        return _of_class(hint)
    return {"type": _TYPES[hint]}


def _of_class(owner: Any) -> dict[str, Any]:
    texts = option_help(owner)
    return {
        "type": "object",
        "description": inspect.cleandoc(owner.__doc__ or ""),
        "properties": {
            name: {**_of_type(hint), "description": texts[name]}
            for name, hint in field_types(owner).items()
        },
        "required": required_fields(owner),
        "additionalProperties": False,
    }
