"""Ground truth that a specification asks for, checked before any work."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from texvent._registry import GENERATORS, suggest
from texvent.dataset.specification.items import Items
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, shown
from texvent.generate.scene_input import list_nouns
from texvent.truth.labels.reading import read_labels
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
        ConfigError, InputError: see above, and as `texvent.truth.labels.reading.read_labels`.
    """
    if "boxes" not in specification.truth and any(item.boxes is not None for item in items.all):
        raise ConfigError("a source has boxes, its labels, and truth does not name boxes")
    if not specification.truth:
        return
    if items.are_videos:
        _check_videos(specification, items)
        return
    check_generator(str(specification.options.get("generator", next(iter(GENERATORS.builtin)))))
    if is_stored:
        raise ConfigError(
            "truth is known while a scene is rendered, and store_videos simulates from stored "
            "videos; leave one of them out"
        )
    _check_classes(specification, items)


def _check_videos(specification: Specification, items: Items) -> None:
    truth, options = specification.truth, specification.options
    labelled = sum(item.boxes is not None for item in items.all)
    for part in truth:
        known = OPTIONS_OF_VIDEOS.get(part, ())
        is_labelled = part == "boxes" and labelled == len(items.all)
        if not is_labelled and not any(name in options for name in known):
            remedy = f"give option {' or '.join(known)}" if known else "leave it out"
            also = ", or each source `boxes`, its labels" if part == "boxes" else ""
            raise ConfigError(f"truth {part} is not known of videos; {remedy}{also}")
    if labelled:
        _check_labels(specification, items)
    elif specification.classes:
        raise ConfigError("classes are names of objects, and ids that come with frames have none")


def _check_labels(specification: Specification, items: Items) -> None:
    """Read the labels of all videos."""
    if not specification.classes:
        raise ConfigError(
            "labels of videos need `classes`, the names of those to keep in training order, such "
            "as classes = ['car', 'truck']"
        )
    for name in ("start", "camera"):
        if name in specification.options:
            raise ConfigError(
                f"boxes are labels of the frames of a whole video, and option {name} shows others; "
                "leave it out, and cut the video with its labels"
            )
    names = dict[str, None]()
    for item in items.all:
        labels = read_labels(Path(item.boxes or ""))
        if item.box_rate is not None and not labels.has_tracks:
            raise ConfigError(
                f"box_rate interpolates along tracks, and {labels.path} has boxes without one; "
                "leave box_rate out"
            )
        names |= dict.fromkeys(labels.names[one] for one in np.unique(labels.boxes["class_id"]))
    for name in specification.class_of:
        if name not in names:
            raise ConfigError(f"classes names {shown(name)}, which no label has; "
                              f"{suggest(name, tuple(names))}")  # fmt: skip


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
