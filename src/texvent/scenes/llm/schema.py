"""The JSON Schema that a language model fills: the fields that a sentence can name, all bounded."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, Literal, get_args, get_origin

from texvent.options.fields import option_help
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.data import field_types, inner_type

FIELDS: dict[type, tuple[str, ...]] = {
    spec.Scene: ("place", "light", "camera", "objects", "effects"),
    spec.SceneObject: ("noun", "count", "colour", "material", "motions", "relations"),
    spec.Motion: ("kind", "direction"),
    spec.Relation: ("kind", "to"),
    spec.Effect: ("kind", "source"),
    spec.Camera: ("view", "moves"),
    spec.CameraMove: ("kind", "direction"),
    spec.Light: ("kind",),
    spec.Place: ("name", "weather"),
}
"""Class of `spec.scene` → its fields that a model fills. An object is called by its noun."""
MOST_ITEMS = {"objects": 8, "motions": 2, "relations": 2, "to": 3, "moves": 2, "effects": 2}
LONGEST_WORD = 40
"""Characters of a free text."""
MOST_COUNT = 20


def model_schema() -> dict[str, Any]:
    """The schema of an answer.

    Every field is required, so that none is forgotten, and null says that the prompt leaves it
    open. Nouns, places, colours and motions are free texts: a closed list would force a word that
    it lacks to the one that begins alike.
    """
    return _of_class(spec.Scene)


def _of_class(owner: type) -> dict[str, Any]:
    types, texts, names = field_types(owner), option_help(owner), FIELDS[owner]
    properties = {
        name: {**_of_type(types[name], name), "description": texts[name]} for name in names
    }
    return {
        "type": "object",
        "properties": properties,
        "required": list(names),
        "additionalProperties": False,
    }


def _of_type(hint: Any, name: str) -> dict[str, Any]:
    plain = inner_type(hint)
    is_open = plain is not hint
    if get_origin(plain) is Annotated:
        plain = get_args(plain)[0]
    if get_origin(plain) is Literal:
        return {"enum": [*get_args(plain), *([None] if is_open else [])]}
    if get_origin(plain) is tuple:
        items = _of_type(get_args(plain)[0], name)
        return {"type": "array", "items": items, "maxItems": MOST_ITEMS[name]}
    if dataclasses.is_dataclass(plain):
        return _of_class(plain)  # type: ignore[arg-type]
    if plain is int:
        return {"type": "integer", "minimum": 1, "maximum": MOST_COUNT}
    return {"type": ["string", "null"] if is_open else "string", "maxLength": LONGEST_WORD}
