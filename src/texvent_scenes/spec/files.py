"""Scene files: scenes as TOML or JSON, and their JSON Schema."""

from __future__ import annotations

import inspect
import json
import tomllib
from collections.abc import Mapping
from dataclasses import is_dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

from texvent.errors import ConfigError, FileFormatError, InputError, one_line, shown
from texvent.options.values import option_help
from texvent.runtime.files.file_names import usable_path
from texvent.runtime.files.yaml_text import keys_once
from texvent_scenes.colours import PALETTES
from texvent_scenes.spec.data import of_file, scene_from_data, scene_to_data
from texvent_scenes.spec.limits import Vocabulary
from texvent_scenes.spec.scene import Scene, SceneObject
from texvent_scenes.spec.tables import field_types, inner_type, required_fields

LONGEST_LINE = 100
"""Characters of a list on one line; the items of a longer one have lines of their own."""


def toml_text(data: Mapping[str, Any]) -> str:
    """TOML 1.0 of tables, lists, text, numbers and booleans.

    Example:
        >>> print(toml_text({"objects": [{"noun": "car", "motions": [{"kind": "drive"}]}]}))
        [[objects]]
        noun = "car"
        motions = [{ kind = "drive" }]
        <BLANKLINE>
    """
    plain, blocks = dict[str, Any](), list[str]()
    for name, one in data.items():
        if isinstance(one, Mapping):
            blocks.append(f"[{name}]\n{_fields(one)}")
        elif isinstance(one, list) and one and all(isinstance(each, Mapping) for each in one):
            blocks += [f"[[{name}]]\n{_fields(each)}" for each in one]
        else:
            plain[name] = one
    return "\n".join([_fields(plain), *blocks] if plain else blocks)


def _fields(table: Mapping[str, Any]) -> str:
    return "".join(_field(name, value) for name, value in table.items())


def _field(name: str, value: Any) -> str:
    line = f"{name} = {inline_text(value)}\n"
    if len(line) <= LONGEST_LINE or not isinstance(value, list):
        return line
    items = "".join(f"    {inline_text(one)},\n" for one in value)
    return f"{name} = [\n{items}]\n"


def inline_text(value: Any) -> str:
    """A value of TOML on one line."""
    if isinstance(value, Mapping):
        return f"{{ {', '.join(f'{name} = {inline_text(one)}' for name, one in value.items())} }}"
    if isinstance(value, list):
        return f"[{', '.join(map(inline_text, value))}]"
    # JSON and TOML write booleans, numbers and text alike, but for one control character.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


ENDINGS = (".toml", ".json")
"""Endings of the names of scene files."""


def load_scene(path: str | Path) -> Scene:
    """The scene of a file.

    Paths of pictures and models are relative to the file's folder; the scene has absolute ones.

    Args:
        path: a .toml or .json file, as `save_scene` writes it or as written by hand.

    Raises:
        InputError: the file cannot be read.
        FileFormatError: it is no valid TOML or JSON.
        ConfigError: a field is wrong; the message names the file and the path of the field.
    """
    path = usable_path(path)
    if path.suffix.lower() not in ENDINGS:
        raise ConfigError(f"{path} is no scene file; its name must end in {' or '.join(ENDINGS)}")
    try:
        scene = parse_scene(_read(path), path.suffix)
    except FileFormatError as error:
        raise FileFormatError(f"scene file {path} {error}") from error
    except ConfigError as error:
        raise ConfigError(f"{path}: {error}") from None
    return of_file(_with_files_of(path.parent.resolve(), scene), str(path))


def parse_scene(text: str, ending: str) -> Scene:
    """The scene of the text of a file whose name ends so: ".toml" or ".json".

    Raises:
        FileFormatError: it is no valid TOML or JSON.
        ConfigError: a field is wrong; the message begins with the path of the field.
    """
    try:
        is_json = ending.lower() == ".json"
        document = json.loads(text, object_pairs_hook=keys_once) if is_json else tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise FileFormatError(f"is not valid: {one_line(error)}") from error
    return scene_from_data(document)


def save_scene(path: str | Path, scene: Scene, *, overwrite: bool = False) -> None:
    """Write a scene to a file; `load_scene` reads an equal one.

    Args:
        path: ends in .toml or .json.
        scene: what to write; fields at their defaults are left out.
        overwrite: whether an existing file may be replaced.

    Raises:
        ConfigError: the name has another ending, or the scene holds a wrong field.
        OutputError: the file exists, or cannot be written.
    """
    from texvent.io.atomic import atomic_file  # beside scenes, which else need no writer

    path = usable_path(path)
    text = scene_text(scene_from_data(scene_to_data(scene)), path.suffix)
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_text(text, encoding="utf-8")


def scene_text(scene: Scene, ending: str) -> str:
    """A scene as the text of a file whose name ends so: ".toml" or ".json".

    Raises:
        ConfigError: it is another ending.
    """
    data = scene_to_data(scene)
    if ending.lower() not in ENDINGS:
        raise ConfigError(f"scene files end in {' or '.join(ENDINGS)}, not in {shown(ending)}")
    if ending.lower() == ".json":
        return json.dumps(data, indent=2, ensure_ascii=False) + "\n"
    return toml_text(data)


def is_scene_file(text: str) -> bool:
    """Whether a prompt is the name of a scene file: one word with the ending of one."""
    return Path(text).suffix.lower() in ENDINGS and not set(text) & set("\n\r")


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"cannot read scene file {path}: {reason}; check its name") from error
    except UnicodeDecodeError as error:
        raise FileFormatError(f"scene file {path} is not UTF-8 text: {one_line(error)}") from error


def _with_files_of(folder: Path, scene: Scene) -> Scene:
    """The scene with absolute paths of the pictures and models that lie in a folder."""

    def absolute(one: SceneObject) -> SceneObject:
        picture = one.picture
        if picture is not None and picture.kind == "file":
            picture = replace(picture, value=str(folder / picture.value))
        model = None if one.model is None else str(folder / one.model)
        return replace(one, picture=picture, model=model)

    return replace(scene, objects=tuple(map(absolute, scene.objects)))


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
    if is_dataclass(hint):
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
