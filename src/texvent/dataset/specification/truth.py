"""Ground truth that a specification asks for, checked before any work."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from texvent._registry import DEFAULT_GENERATOR, suggest
from texvent.dataset.specification.items import Items
from texvent.dataset.specification.specification import Specification, extreme_options
from texvent.errors import ConfigError, InputError, shown
from texvent.frames import FrameStream
from texvent.generation.subjects import scenes
from texvent.settings.resolution import resolve
from texvent.truth.layout import check_generator

if TYPE_CHECKING:
    from texvent.truth.labels import Labels

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
        ConfigError, InputError: see above, and as `texvent.truth.labels.read_labels`.
    """
    are_labelled = items.all[0].boxes is not None
    if any((item.boxes is not None) != are_labelled for item in items.all):
        raise ConfigError("some sources have boxes, labels of their videos; give all some, or none")
    if are_labelled and "boxes" not in specification.truth:
        raise ConfigError("sources have boxes, labels of videos, and truth does not name boxes")
    if not specification.truth:
        return
    if items.are_videos:
        _check_videos(specification, are_labelled=are_labelled)
        known = _names_of_labels(specification, items) if are_labelled else ()
    else:
        name = specification.options.get("generator", DEFAULT_GENERATOR)
        check_generator(str(name))
        if is_stored:
            raise ConfigError(
                "truth is known while a scene is rendered, and store_videos simulates from stored "
                "videos; leave one of them out"
            )
        nouns = scenes().list_nouns(specification.options.get("assets"))
        known = (*nouns, *_check_models(specification, items))
        _check_synonyms(specification, nouns, known)
    for name in specification.class_of:
        if name not in known:
            raise ConfigError(
                f"classes names {shown(name)}, which no source shows; {suggest(name, known)}"
            )


def _check_synonyms(
    specification: Specification, nouns: Mapping[str, Any], known: Iterable[str]
) -> None:
    """Refuse another word of a noun, such as pedestrian, and say how the class is written."""
    for name, wanted in specification.class_of.items():
        meant = next((noun for noun, one in nouns.items() if name in one.synonyms), None)
        if meant is not None and name not in known:
            raise ConfigError(
                f"classes names {shown(name)}, which boxes call {shown(meant)}; write a table of "
                f"object = class, such as {{ car = 'car', {meant} = '{wanted}' }}"
            )


def _check_models(specification: Specification, items: Items) -> Iterable[str]:
    """Names of models of scene files; refused without classes, because their ids are not fixed."""
    objects = (one for item in items.all for one in (item.scene or {}).get("objects", ()))
    own = sorted({str(one["noun"]) for one in objects if one.get("model") is not None})
    has_own = own or "assets" in specification.options
    if has_own and "boxes" in specification.truth and not specification.classes:
        raise ConfigError(
            "boxes of models of your own need `classes`, such as classes = ['car', 'bus']: the "
            "class ids of their names differ from clip to clip"
        )
    return own


def _check_videos(specification: Specification, *, are_labelled: bool) -> None:
    for part in specification.truth:
        options = OPTIONS_OF_VIDEOS.get(part, ())
        is_known = any(name in specification.options for name in options)
        if not is_known and not (are_labelled and part == "boxes"):
            given = f"give option {' or '.join(options)}, with files of your renderer"
            remedy = given if options else "leave it out"
            also = ", or sources `boxes`, labels of their videos" if part == "boxes" else ""
            raise ConfigError(f"truth {part} is not known of videos; {remedy}{also}")


def _check_frames(labels: Labels, video: FrameStream, count: int) -> None:
    """Refuse labels that do not fit to the frames; where `count` says so, frames are counted."""
    try:
        labels.place(np.arange(count), labels.size, {})
    except InputError:
        labels.place(np.arange(sum(1 for _ in video)), labels.size, {})


def _names_of_labels(specification: Specification, items: Items) -> tuple[str, ...]:
    """Read the labels of all videos: the names of their classes, all where no video can be opened.

    Raises:
        ConfigError, InputError: they cannot be used.
    """
    from texvent.capture.open import open_frames  # brings OpenCV
    from texvent.truth.labels import read_labels

    options = extreme_options(specification.options)[0]
    if not specification.classes:
        raise ConfigError(
            "boxes of videos need `classes`, the names of those to keep in training order, such "
            "as classes = ['car', 'truck']"
        )
    given = {*options, *(name for one in specification.variants for name in one.options)}
    for name in ("start", "camera"):
        if name in given:
            raise ConfigError(
                f"boxes are labels of the frames of a whole video, and option {name} shows others; "
                "leave it out, and cut the video with its labels"
            )
    capture: Any = resolve("simulate", options).source
    names = dict[str, None]()
    for item in items.all:
        try:
            video = open_frames(item.video, capture)
        except InputError:
            continue  # which its sample says
        labels = read_labels(Path(item.boxes or ""), video.size)
        if video.frame_count is not None and capture.stop is None:
            _check_frames(labels, video, video.frame_count)
        if item.box_rate is not None and not labels.boxes["track_id"].all():
            raise ConfigError(
                f"box_rate interpolates along tracks, and {labels.path} has boxes without one; "
                "leave box_rate out"
            )
        names |= dict.fromkeys(labels.names)
    return tuple(names) or tuple(specification.class_of)
