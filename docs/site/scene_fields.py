"""Tables of the fields of scene files, made from the dataclasses of `texvent_scenes.spec.scene`.

python docs/site/scene_fields.py    # writes them into docs/scenes.md
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

from texvent.options.values import option_help
from texvent_scenes.spec import scene as spec
from texvent_scenes.spec.limits import Between
from texvent_scenes.spec.tables import field_types, inner_type

PAGE = Path(__file__).parents[1] / "scenes.md"
BEGIN, END = "<!-- fields: made by docs/site/scene_fields.py -->", "<!-- end of fields -->"
"""Lines of the page that the tables stand between."""
TABLES = {
    "Scene": spec.Scene,
    "objects": spec.SceneObject,
    "objects.motions": spec.Motion,
    "objects.relations": spec.Relation,
    "objects.parts": spec.OwnPart,
    "objects.picture": spec.Picture,
    "effects": spec.Effect,
    "camera": spec.Camera,
    "camera.moves": spec.CameraMove,
    "light": spec.Light,
    "light.lamps": spec.Lamp,
    "place": spec.Place,
}
_NAMES = {str: "text", float: "number", int: "whole number", bool: "true or false"}


def with_tables(page: str) -> str:
    """The page with the tables between its marks."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n\n{chr(10).join(field_tables())}{END}{after}"


def field_tables() -> Iterator[str]:
    """Lines of Markdown: a heading and a table for each class."""
    for title, owner in TABLES.items():
        texts = option_help(owner)
        yield from (f"### {title}", "", "| field | takes | what it is |", "|---|---|---|")
        for name, hint in field_types(owner).items():
            yield f"| `{name}` | {_takes(hint)} | {_cell(texts[name])} |"
        yield ""


def _takes(hint: Any) -> str:
    """What a field takes, in words."""
    hint, limit = inner_type(hint), None
    if get_origin(hint) is Annotated:
        hint, limit = get_args(hint)
    if get_origin(hint) is Literal:
        return _cell(", ".join(map(str, get_args(hint))))
    if get_origin(hint) is tuple:
        first, *rest = get_args(hint)
        if rest != [Ellipsis]:
            return f"{len(rest) + 1} numbers"
        taken = _takes(first)
        return "tables" if taken == "table" else f"list: {taken}"
    if isinstance(limit, Between):
        return f"{_NAMES[hint]}, {limit.low:g} to {limit.high:g}"
    return _NAMES.get(hint, "table")


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
