"""A description staged for an image of some size, with the report of what is in view."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from texvent.prompt_report import PromptReport
from texvent.sensor import SensorSize
from texvent_scenes.assets.nouns import list_files
from texvent_scenes.checks.caption import caption
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.in_view import Unseen, find_unseen, without_words
from texvent_scenes.checks.words import find_held
from texvent_scenes.description import STANDING, SceneDescription
from texvent_scenes.meanings import list_meanings
from texvent_scenes.models.nouns import NOUNS, VARIANTS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.staging.compose import ComposedScene, compose_scene

_ALIKE = (
    *((one, "day") for one in (None, "sunny", "overcast", "stormy", "morning", "afternoon")),
    *((one, "sunny") for one in (None, "morning", "afternoon", "dusk", "dawn")),
    *((one, "overcast") for one in (None, "stormy", "morning", "afternoon")),
    ("night", "moonlight"), ("aerial", "top"), ("rain", "storm"),
)  # fmt: skip
"""Lights, weathers and views of which words say the same."""


def stage(
    description: SceneDescription,
    said: PromptReport,
    named: Mapping[str, Noun],
    *,
    seed: int,
    size: SensorSize,
    duration_s: float,
) -> tuple[ComposedScene, PromptReport, list[dict[str, str]]]:
    """The scene of a description, the report of its words, and the files that it is made of.

    Args:
        description: the scene.
        said: the report before the scene is built.
        named: nouns that it can name.
        seed: decides the layout.
        size: of the image, pixels.
        duration_s: length of the clip, s.
    """
    files = list_files(description, named)
    nouns = tuple(named[one.noun] for one in description.objects)
    contents = tuple(tuple(one.values()) for one in files)
    scene, unseen, held, failed, drawn = _staged(
        description, nouns, contents, seed, size, duration_s
    )
    faults = (*unseen.violations, *_list_manners(description, unseen.violations))
    faults = (*faults, *(one._replace(value=VARIANTS[str(one.value)]) for one in faults
                         if one.kind == "noun" and one.value in VARIANTS))  # fmt: skip
    fewer = (re.fullmatch(r".* \(\d+ of (\d+)\)", one) for one in unseen.out_of_view)
    faults += tuple(Violation("count", float(one[1]), "") for one in fewer if one)
    others = {*_list_others(said.shown, description)}
    if any(one.kind == "light" for one in faults):
        others |= {*filter(_tells_light, said.shown)}  # "a sunny morning" in a hall
    shown = without_words([one for one in said.shown if one not in failed | others], faults)
    shown = (*shown, *sorted(held - {*said.shown}))
    lines = (*said.not_shown, *scene.not_shown,
             *filter(None, (one.line for one in unseen.violations)))  # fmt: skip
    enough = {
        one for one in unseen.out_of_view if description.is_sentence and _are_enough(one, shown)
    }
    out_of_view = tuple(one for one in unseen.out_of_view if one not in enough)
    told = " ".join((*lines, *out_of_view, *unseen.too_small)).casefold()
    told = re.sub(r"\([^)]*\)", "", told)  # "table (cut off)" does not tell of "off"
    claimed = (one for one in sorted(failed) if one not in said.shown)
    lost = (one for one in (*said.shown, *claimed) if one not in shown
            and not re.search(rf"\b{re.escape(one)}\b", told))  # fmt: skip
    uncertain = _find_uncertain(description, said, shown, unseen, failed)
    report = replace(
        said,
        shown=tuple(one for one in shown if one not in uncertain),
        uncertain=tuple(one for one in shown if one in uncertain),
        notes=_as_said((*said.notes, *scene.notes, *scene.camera_path.notes, *unseen.notes,
               *(f"out of view: {one}, of which no number is said" for one in sorted(enough)))),
        not_shown=(*_as_said(lines), *lost),
        out_of_view=_as_said(out_of_view),
        too_small=_as_said(unseen.too_small),
        caption=drawn,
    )  # fmt: skip
    return scene, report, files


def _find_uncertain(
    description: SceneDescription, said: PromptReport, shown: Collection[str], unseen: Unseen,
    failed: Collection[str],
) -> set[str]:  # fmt: skip
    """Words that depend on others that are not understood, or that the clip does not show."""
    unknown = {*said.not_understood}
    cut = {one.noun for n, one in enumerate(description.objects) if n not in unseen.gone}
    lost = {one for one in said.shown if one not in shown and not _names(one, cut)}
    missing = unknown | lost | {*failed}
    return {word for one in description.dependences for word in one.words
            if not (missing if one.is_staged else unknown).isdisjoint(one.on)}  # fmt: skip


def _list_others(words: Sequence[str], description: SceneDescription) -> Iterator[str]:
    """Words of a light, weather, view or framing that is not that of the scene, which has one."""
    light, place, shot = description.light, description.place, description.camera
    one_of = {"light": light.kind, "weather": place.weather, "view": shot.view,
              "framing": shot.framing}  # fmt: skip
    for word in words:
        said = [*list_meanings(word)]
        if said and all(kind in one_of and not _are_alike(one_of[kind], value)
                        for kind, value in said):  # fmt: skip
            yield word


def _tells_light(word: str) -> bool:
    """Whether a word tells of nothing but the light."""
    said = [kind for kind, _ in list_meanings(word)]
    return bool(said) and set(said) == {"light"}


def _names(word: str, nouns: Collection[str]) -> bool:
    """Whether a word means one of some nouns."""
    return any(kind == "noun" and value in nouns for kind, value in list_meanings(word))


def _are_alike(one: object, other: object) -> bool:
    """Whether two values of a light, a weather, a view or a framing may be of the same picture."""
    return one == other or any({one, other} == {*pair} for pair in _ALIKE)


def _as_said(lines: Sequence[str]) -> tuple[str, ...]:
    """Lines with nouns in place of their variants: "goose" for "flying goose"."""
    variants = "|".join(VARIANTS)
    return tuple(
        re.sub(rf"\b({variants})\b", lambda found: VARIANTS[found[1]], one) for one in lines
    )


def _are_enough(line: str, shown: Sequence[str]) -> bool:
    """Whether most copies of what is partly out of view are seen, two at least.

    "Trees" are so; of "three trees" each is to be seen.
    """
    found = re.fullmatch(r".* \((\d+) of (\d+)\)", line)
    lost, count = map(int, found.groups()) if found else (1, 1)
    is_counted = any(("count", count) in list_meanings(word) for word in shown)
    return not is_counted and 2 * lost <= count and count - lost > 1


def _list_manners(
    description: SceneDescription, faults: Sequence[Violation]
) -> Iterator[Violation]:
    """Rates, speeds and directions, where all motions that have some are not seen."""
    lost = {one.value for one in faults if one.kind == "motion"}
    motions = [one for each in description.objects for one in each.motions]
    seen = [one for one in motions if one.kind not in lost] if lost else []
    for names in (("direction",), ("pace", "speed_m_s", "rate_hz")):
        usual = {getattr(STANDING, name) for name in names}
        if lost and all({getattr(one, name) for name in names} <= usual for one in seen):
            yield from (Violation(name, "", "") for name in names)


@lru_cache(maxsize=4)
def _staged(
    description: SceneDescription,
    named: tuple[Noun, ...],
    contents: tuple[tuple[str, ...], ...],
    seed: int,
    size: SensorSize,
    duration_s: float,
) -> tuple[ComposedScene, Unseen, frozenset[str], frozenset[str], tuple[str, ...]]:
    """A scene, what it does not show, words whose claims hold or do not, and its caption.

    They are kept, since one scene is often simulated several times.
    Assets are shown where the prompt names them, not as scenery.

    Args:
        description: the scene.
        named: the noun of each of its objects.
        contents: states of the files that it is made of: with others it is another scene.
        seed: decides the layout.
        size: of the image, pixels.
        duration_s: length of the clip, s.
    """
    del contents
    shown = {one.noun: noun for one, noun in zip(description.objects, named, strict=True)}
    scene = compose_scene(
        description, seed=seed, size=size, duration_s=duration_s, nouns={**NOUNS, **shown}
    )
    unseen = find_unseen(scene, description, size, duration_s)
    held = find_held(description.claims, scene, description, unseen.gone, size, duration_s)
    clip = StagedClip(scene, description, size, duration_s)
    shows_light = all(one.kind != "light" for one in unseen.violations)
    return scene, unseen, *held, caption(clip, unseen.views, shows_light=shows_light)
