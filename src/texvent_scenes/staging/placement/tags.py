"""Ids of AprilTags: each copy has its own, so that a detector tells them apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from texvent_scenes.models.tables import nouns_with
from texvent_scenes.pictures import LAST_TAG, read_tag
from texvent_scenes.spec.scene import Picture, SceneObject

_IDS = LAST_TAG + 1


def list_pictures(objects: Sequence[SceneObject], index: int) -> list[Picture | None]:
    """The picture of each copy of an object.

    The copies of a tag count on from its id. Tags whose id is not stated have the first free ones,
    in the order of the scene.
    """
    one = objects[index]
    if one.picture is not None and one.picture.kind == "tag":
        return [replace(one.picture, value=str(tag)) for tag in _stated(one)]
    if not _is_open(one):
        return [one.picture] * one.count
    taken = {tag for each in objects for tag in _stated(each)}
    free = [tag for tag in range(_IDS) if tag not in taken] or [*range(_IDS)]
    first = sum(each.count for each in objects[:index] if _is_open(each))
    tags = (free[(first + copy) % len(free)] for copy in range(one.count))
    return [Picture(kind="tag", value=str(tag)) for tag in tags]


def note_tags(label: str, one: SceneObject, pictures: Sequence[Picture | None]) -> Iterator[str]:
    """The ids of tags of which the scene states none."""
    if _is_open(one):
        ids = ", ".join(each.value for each in pictures if each is not None)
        yield f"the {label} shows AprilTag {ids} of the family 36h11, as no id is stated"


def _stated(one: SceneObject) -> list[int]:
    """Ids of the copies of an object whose id is stated."""
    if one.picture is None or one.picture.kind != "tag":
        return []
    return [(read_tag(one.picture.value) + copy) % _IDS for copy in range(one.count)]


def _is_open(one: SceneObject) -> bool:
    return one.picture is None and one.noun in nouns_with("tag")
