"""Ground truth that a specification asks for, checked before any work."""

from __future__ import annotations

from collections.abc import Iterator

from texvent._registry import GENERATORS, suggest
from texvent.dataset.specification.items import Items
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, shown
from texvent.generate.scene_input import list_nouns
from texvent.truth.layout import check_generator

OPTIONS_OF_VIDEOS = {
    "flow": ("motion",),
    "depth": ("motion", "depth"),
    "ids": ("motion", "instances"),
    "boxes": ("motion", "instances"),
}
"""Part of the truth → options of `texvent simulate` that may bring it with the frames."""


def check_truth(specification: Specification, items: Items, *, is_stored: bool) -> None:
    """Refuse truth that the sources do not know, and classes that they do not show.

    Args:
        specification: of the data set.
        items: its prompts or videos.
        is_stored: whether videos are stored before they are simulated.

    Raises:
        ConfigError: see above.
    """
    if not specification.truth:
        return
    if items.are_videos:
        _check_videos(specification)
        return
    check_generator(str(specification.options.get("generator", next(iter(GENERATORS.builtin)))))
    if is_stored:
        raise ConfigError(
            "truth is known while a scene is rendered, and store_videos simulates from stored "
            "videos; leave one of them out"
        )
    _check_classes(specification, items)


def _check_videos(specification: Specification) -> None:
    for part in specification.truth:
        options = OPTIONS_OF_VIDEOS.get(part, ())
        if not any(name in specification.options for name in options):
            remedy = f"give option {' or '.join(options)}, or leave it out" if options else ""
            raise ConfigError(
                f"truth {part} is not known of videos; {remedy or 'leave it out of truth'}"
            )
    if specification.classes:
        raise ConfigError("classes are names of objects, and ids that come with frames have none")


def _check_classes(specification: Specification, items: Items) -> None:
    assets = specification.options.get("assets")
    own = set(_own_nouns(items))
    if not specification.classes:
        if "boxes" in specification.truth and (own or assets is not None):
            raise ConfigError(
                "boxes of models of your own need `classes`, such as classes = ['car', 'bus']: the "
                "class ids of their names are not the same in every clip"
            )
        return
    known = tuple(dict.fromkeys([*list_nouns(assets), *sorted(own)]))
    for name in specification.class_of:
        if name not in known:
            raise ConfigError(f"classes names {shown(name)}, which no scene shows; "
                              f"{suggest(name, known)}")  # fmt: skip


def _own_nouns(items: Items) -> Iterator[str]:
    """Names of the objects of scene files that have models of their own."""
    for item in items.all:
        for one in (item.scene or {}).get("objects", ()):
            if one.get("model") is not None:
                yield str(one["noun"])
