"""Input of the embedded generator: a sentence, which is read, or a scene."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import MOST_WORDS, ConfigError, InputError, few, shown
from texvent.generation.subjects import Subject
from texvent.prompt_report import PromptReport
from texvent_scenes.spec.data import checked_scene, naming_file, scene_to_data
from texvent_scenes.spec.limits import Vocabulary
from texvent_scenes.spec.scene import Light, Place, Scene

if TYPE_CHECKING:
    from texvent_scenes.description import Claim, SceneDescription
    from texvent_scenes.models.protocol import Noun
    from texvent_scenes.read import Reading
    from texvent_scenes.staging.idle_surroundings import Idle

_NEAR, _SHORT = 0.8, 4
"""Likeness of a misspelled word to a noun, and letters of words that are too short to judge."""
_MOST_PASSES = 3
"""Passes that leave out fields without effect: one left out may leave another without."""


def read(prompt: str, *, assets: str | Path | None = None) -> Reading:
    """The scene that a sentence describes.

    What the sentence leaves open stays open: place, motions and light are decided when the scene
    is generated. Nothing is drawn: what is out of view is not found here, and words that only the
    drawn scene confirms or denies ("four times") are `open_words`.

    Args:
        prompt: an English sentence, such as "a red car drives left past two trees at dusk".
        assets: a folder of models of your own.

    Raises:
        InputError: the prompt is no text or empty, or nothing in it is understood.

    Example:
        >>> import texvent
        >>> reading = texvent.read("a red car drives left")
        >>> reading.scene.objects[0].colour, reading.not_understood
        ('red', ())
    """
    if not isinstance(prompt, str):
        raise InputError(f"the prompt is {shown(prompt)}; give a text, such as 'a car drives left'")
    from texvent_scenes.defaults import complete
    from texvent_scenes.description import to_description
    from texvent_scenes.staging.surroundings.lighting import DARK

    nouns = list_nouns(assets)
    reading, idle = _read(prompt, nouns)
    scene = reading.scene
    decided = complete(replace(to_description(scene), words=_words_of(reading)), nouns)
    if scene.light.kind is None and decided.light.kind in DARK:
        scene = replace(scene, light=replace(scene.light, kind=decided.light.kind))
    lost = tuple(one for one in (*reading.not_understood, *idle) if one not in reading.open_words)
    return replace(reading, scene=scene, not_understood=lost)


def _read(prompt: str, nouns: Mapping[str, Noun]) -> tuple[Reading, dict[str, str]]:
    """The reading of a prompt, without fields that change nothing.

    With the words that stand for such fields, each with the reason.
    """
    # Imported here and below: the vocabulary and all models are only needed to make a scene.
    from texvent_scenes import read as reader
    from texvent_scenes.sentence_defaults import settle_words

    if not prompt.strip() or re.fullmatch(r"\S+\.[A-Za-z]\w{0,4}", prompt.strip()):
        what = shown(prompt) if prompt.strip() else "empty"
        raise InputError(
            f"the prompt is {what}; describe a scene, or name its .toml or .json file (videos: "
            "texvent simulate, or the column `video` of a list)"
        )
    reading = reader.read(prompt, nouns)
    reading = replace(reading, scene=settle_words(reading.scene, _words_of(reading), nouns))
    if not _has_subject(reading):
        words = few(reading.not_understood, MOST_WORDS)
        read = few(reading.shown, MOST_WORDS)
        what = f"the prompt names no thing or place to show; understood: {read}"
        what += f"; not understood: {words}" if words else ""
        what = what if read else f"nothing in the prompt was understood: {words}"
        raise InputError(
            f"{what}; {_hint(reading)}"
            "texvent scenes lists the words of the embedded generator, texvent generators lists "
            "models that take any text"
        )
    return _without_idle(reading, nouns)


def _words_of(reading: Reading) -> PromptReport:
    """The words of a sentence, whatever became of them."""
    return PromptReport(shown=reading.shown, not_understood=reading.not_understood)


def _hint(reading: Reading) -> str:
    """A hint for a prompt whose words are known, but not as they are put together."""
    from texvent_scenes.read.parsing.lexicon import lexicon_of
    from texvent_scenes.read.parsing.tokens import split_prompt

    words = (split_prompt(one, lexicon_of(None)) for one in reading.not_understood)
    known = [one.text for tokens in words for one in tokens if one.has("noun")]
    return f"known alone: {few(known, MOST_WORDS)}; say it in a plainer sentence; " if known else ""


def _without_idle(reading: Reading, nouns: Mapping[str, Noun]) -> tuple[Reading, dict[str, str]]:
    from texvent_scenes.meanings import list_meanings
    from texvent_scenes.staging.idle_fields import leave_out

    scene, shown = reading.scene, list(reading.shown)
    claims: list[Claim] = []
    lost = dict[str, str]()
    for _ in range(_MOST_PASSES):
        # "rain on a wet road" is wet; of an object, what is so anyway must be seen.
        idle = [one for one in _list_idle(scene, nouns)
                if not (one.is_usual and one.path.startswith("place"))]  # fmt: skip
        if not idle:
            break
        scene_before = scene
        before, scene = set(_list_fields(scene)), leave_out(scene, idle)
        after = {(name, value) for path, name, value in _list_fields(scene)}
        for one in idle:
            said = {(name, value) for path, name, value in before if path == one.path}
            words = [word for word in shown if not said.isdisjoint(list_meanings(word))]
            if one.path.endswith("pace"):  # "land", which has a pace of its own, "smoothly"
                words = words or [word for word in shown if "pace" in dict(list_meanings(word))]
            for word in words if said.isdisjoint(after) or one.path.endswith("pace") else ():
                shown.remove(word)
                lost[word] = one.why
                claims += _claim_anyway(one, word, scene_before)
    claimed = (*reading.claims, *claims)
    return replace(reading, scene=scene, shown=tuple(shown), claims=claimed), lost


def _claim_anyway(idle: Idle, word: str, scene: Scene) -> Iterator[Claim]:
    """Claim of what a thing may be or do anyway: "a wooden table", "swings to and fro"."""
    from texvent_scenes.description import Claim
    from texvent_scenes.spec.data import steps_of

    first, *way = steps_of(idle.path)
    if first != "objects":
        return
    one, last = scene.objects[int(way[0])], str(way[-1])
    value = getattr(one.motions[int(way[2])] if way[1] == "motions" else one, last, None)
    if last == "material" or value in ("to and fro", "fall"):
        yield Claim(word, str(value) if last == "kind" else last, str(value), int(way[0]))


def _list_fields(scene: Scene) -> Iterator[tuple[str, str, object]]:
    """Path, name and value of each field of a scene; that of a motion's kind is "motion"."""

    def walk(path: str, name: str, value: Any) -> Iterator[tuple[str, str, object]]:
        if isinstance(value, dict):
            for key, each in value.items():
                kind = name.removesuffix("s") if key in ("kind", "name") else key
                yield from walk(f"{path}.{key}" if path else key, kind, each)
        elif isinstance(value, list):
            for number, each in enumerate(value):
                yield from walk(f"{path}[{number}]", name, each)
        else:
            yield path, name, value

    return walk("", "", scene_to_data(scene))


def _list_idle(scene: Scene, nouns: Mapping[str, Noun]) -> list[Idle]:
    from texvent_scenes.defaults import complete
    from texvent_scenes.description import to_description
    from texvent_scenes.staging.idle_fields import list_idle

    return list(list_idle(scene, complete(to_description(scene), nouns), nouns))


def _has_subject(reading: Reading) -> bool:
    """Whether there is a thing, a place, weather or a way to show, or a light and no other word."""
    from texvent_scenes.models.tables import nouns_with

    scene = reading.scene
    place, lost = replace(scene.place, is_empty=False), reading.not_understood
    backgrounds = nouns_with("only a background")
    is_still = all(one.noun in backgrounds and not one.motions for one in scene.objects)
    is_still &= not scene.camera.is_moving  # "zoom in on a wall"
    is_way = any(one.means is not None for one in scene.camera.moves)
    is_light = scene.light != Light() and not lost
    is_thing = bool(scene.objects) and not (is_still and lost)
    return is_thing or bool(scene.effects) or place != Place() or is_way or is_light


def list_nouns(assets: str | Path | None = None) -> Mapping[str, Noun]:
    """The nouns that scenes can show, with models of a folder."""
    from texvent_scenes.assets.index import read_folder
    from texvent_scenes.assets.nouns import merge_nouns
    from texvent_scenes.models.nouns import NOUNS

    return NOUNS if assets is None else merge_nouns(read_folder(Path(assets)))


def nouns_of(subject: Subject, nouns: Mapping[str, Noun]) -> Mapping[str, Noun]:
    """The nouns that a subject can name: those of a scene's own models too.

    Raises:
        ConfigError: a field of the scene is wrong.
        InputError: a model does not exist.
    """
    from texvent_scenes.assets.nouns import with_models

    if not isinstance(subject, Scene):
        return nouns
    scene = checked_scene(subject, {})
    models = {one.noun: one.model for one in scene.objects if one.model is not None}
    return with_models(nouns, models) if models else nouns


def check_words(scene: Scene, assets: str | Path | None = None) -> Scene:
    """The scene, if its words are shown by the generator or by models of a folder.

    Raises:
        ConfigError: a word is not shown, or a field has no effect.
        InputError: a model does not exist.
    """
    with naming_file(scene):
        nouns = nouns_of(scene, list_nouns(assets))
        return _refuse_idle(checked_scene(scene, list_words(nouns)), nouns)


def _refuse_idle(scene: Scene, nouns: Mapping[str, Noun]) -> Scene:
    from texvent_scenes.staging.idle_acts import list_idle_acts
    from texvent_scenes.staging.idle_in_acts import list_idle_in_acts

    # In a sentence, and in a file written from it, an act and a word for how its parts go tell the
    # same: "turns and picks up".
    of_acts: tuple[Iterator[Idle], ...] = ()
    if not scene.prompt:
        of_acts = list_idle_acts(scene), list_idle_in_acts(scene, nouns)
    for idle in chain(_list_idle(scene, nouns), *of_acts):
        if not idle.is_usual:
            raise ConfigError(f"{idle.path} has no effect: {idle.why}")
    return scene


@dataclass(frozen=True)
class _Kind:
    """A kind of motion, whose verbs are looked up where they are asked for."""

    name: str

    @property
    def names(self) -> tuple[str, ...]:
        """Verbs of sentences that mean it."""
        return _verbs().get(self.name, ())


@lru_cache(maxsize=1)
def _verbs() -> Mapping[str, tuple[str, ...]]:
    """Kind of motion → its verbs."""
    from texvent_scenes.meanings import meanings_of
    from texvent_scenes.read.parsing.lexicon import lexicon_of

    found: dict[str, list[str]] = {}
    for phrase, senses in lexicon_of(None).items():
        base = tuple(one for one in senses if one.form in ("", "base"))
        for kind, value in meanings_of(base):
            if kind == "motion":
                found.setdefault(str(value), []).append(" ".join(phrase))
    return {kind: tuple(verbs) for kind, verbs in found.items()}


def _usual_motions(nouns: Mapping[str, Noun]) -> frozenset[str]:
    return frozenset(kind for noun in nouns.values() for kind in (noun.motion, *noun.acts))


@lru_cache(maxsize=1)
def _embedded_motions() -> frozenset[str]:
    from texvent_scenes.models.nouns import NOUNS

    return _usual_motions(NOUNS)


def list_words(nouns: Mapping[str, Noun]) -> Vocabulary:
    """The words of scenes, by kind: nouns, motions and activities, places, effects."""
    from texvent_scenes.models.activities import ACTIVITIES, HAND_GESTURES
    from texvent_scenes.models.effects import EFFECTS
    from texvent_scenes.models.nouns import MOTIONS, NOUNS
    from texvent_scenes.models.places import PLACES

    usual = _embedded_motions() if nouns is NOUNS else _usual_motions(nouns)
    return {
        "noun": nouns,
        "motion": {
            kind: _Kind(kind) for kind in sorted({*MOTIONS, *ACTIVITIES, *HAND_GESTURES, *usual})
        },
        "place": PLACES,
        "effect": EFFECTS,
    }


def understand(subject: Subject, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description of a prompt, with the report of its words, or of a scene.

    Raises:
        InputError: the prompt is empty or not understood, or a picture cannot be shown.
        ConfigError: a field of the scene is wrong, or a word of it is not shown.
    """
    if isinstance(subject, Scene):
        return describe_scene(subject, nouns)
    reading, lost = _read(str(subject), nouns)
    open_words = reading.open_words
    unread = tuple(one for one in reading.not_understood if one not in open_words)
    words = PromptReport(
        shown=reading.shown,
        substituted=reading.substituted,
        not_understood=unread,
        meant=tuple(_meant(unread, nouns)),
        not_shown=tuple(f"{word} ({why})" for word, why in lost.items() if word not in open_words),
    )
    description = describe_scene(reading.scene, nouns, words)
    return replace(description, claims=reading.claims, dependences=reading.dependences)


def _meant(words: Iterable[str], nouns: Mapping[str, Noun]) -> Iterator[str]:
    """Unknown words that are spelt nearly as a noun with the same initial, each with it."""
    from texvent_scenes.read.parsing.lexicon import lexicon_of

    known, initials = lexicon_of(nouns), dict[str, set[str]]()
    every = dict.fromkeys(one for phrase in words for one in phrase.split())
    if not every:
        return
    for key, noun in nouns.items():
        for name in (key, *noun.synonyms):
            initials.setdefault(name[0], set()).add(name)
    for word in every:
        is_open = len(word) > _SHORT and (word.lower(),) not in known
        names = initials.get(word[0].lower(), ()) if is_open else ()
        near = get_close_matches(word.lower(), names, 1, _NEAR)
        yield from (f"{word}: {name}" for name in near)


def describe_scene(
    scene: Scene, nouns: Mapping[str, Noun], words: PromptReport | None = None
) -> SceneDescription:
    """The description of a scene, checked, with what the scene leaves open decided.

    `words` are those of the sentence that it is read from.

    Raises:
        ConfigError: a field is wrong, or a word is not shown.
        InputError: a picture cannot be shown.
    """
    from texvent_scenes.defaults import complete
    from texvent_scenes.description import to_description

    scene = checked_scene(scene, list_words(nouns))
    _check_pictures(scene)
    _refuse_idle(scene, nouns)
    description = to_description(scene)
    return complete(description if words is None else replace(description, words=words), nouns)


def _check_pictures(scene: Scene) -> None:
    from texvent_scenes.pictures import can_show, check_picture

    for n, one in enumerate(scene.objects):
        if one.picture is None:
            continue
        if not can_show(one.noun):
            raise ConfigError(f"objects[{n}].picture is given, but a {one.noun} shows none")
        try:
            check_picture(one.picture)
        except InputError as error:
            raise ConfigError(f"objects[{n}].picture: {error}") from error
