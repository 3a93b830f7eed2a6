"""What a close-up is of, and who looks in a first-person view, by the words beside them."""

from __future__ import annotations

import re

from texvent.generate.seen_words.picture import Picture
from texvent.scenes.description import SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.camera.main_actor import choose_main

_PARTS = {
    form: lemma
    for lemma, forms in {
        "hand": "hand hands fist fists palm palms", "finger": "finger fingers fingertip fingertips",
        "thumb": "thumb thumbs", "eye": "eye eyes", "mouth": "mouth lips lip teeth",
        "face": "face faces", "head": "head", "nose": "nose", "ear": "ear ears",
        "foot": "foot feet toe toes", "leg": "leg legs", "arm": "arm arms wrist wrists",
        "hoof": "hoof hooves hoofs", "paw": "paw paws", "tail": "tail", "beak": "beak",
    }.items()
    for form in forms.split()
}  # fmt: skip
"""Parts of bodies → the noun of a model that is one alone."""
_OF_HEAD = frozenset({"face", "head"})
_LOOKERS = frozenset({"someone", "somebody", "one", "hand", "hands", "finger", "fingers",
                      "fingertips", "arms", "fists"})  # fmt: skip
"""Words for who looks through the camera, or for what that one sees of itself."""
_OF_VIEW = re.compile(r"\b(?:first person|pov|point of view)(?: \w+)? (?:of|from) ((?:\w+ ?){1,3})")
_CLOSE_UP_OF = re.compile(
    r"\b(?:close ?up|macro|insert|detail)(?: (?:shot|view|video|footage))? (?:of|on) ([^,.;:]+)"
)
_END = re.compile(
    r" (?:of|under|in|on|with|as|while|at|by|through|against|over|from|inside|into|near|behind|"
    r"beside|across|along|to)\b"
)
_ARTICLE = re.compile(r"^(a|an|the) ")
_OWNER = re.compile(r"^.*?(?:'s|s'|\bhis|\bher|\bits|\btheir) ")


def find_close_up(picture: Picture, description: SceneDescription) -> tuple[Actor, str | None]:
    """What a close-up is of.

    Args:
        picture: of the staged scene, with things in it.
        description: what it was staged from.

    Returns:
        The actor that must fill the picture; and what is named and nowhere shown alone:
        a part of a body or of a thing, such as "hands", or None.
    """
    prompt = _plain(description.prompt)
    main = choose_main(description, picture.scene.actors)
    found = _CLOSE_UP_OF.search(prompt)
    if found is None:
        parts = [one for one in prompt.split() if one in ("hands", "fingers", "fingertips")]
        is_whole = main.noun.name in PERSON_NOUNS
        return main, parts[0] if parts and is_whole else None
    end = _END.search(found.group(1))
    phrase = found.group(1)[: end.start()] if end else found.group(1)
    owned = _OWNER.sub("", phrase)
    actor = _find_named(picture, description, owned)
    part = next((one for one in owned.split() if one in _PARTS), None)
    if part is not None:
        is_alone = actor is not None and actor.noun.name == _PARTS[part]
        return actor or main, None if is_alone else part
    is_of_other = owned != phrase or (end is not None and end.group(0) == " of")
    if actor is None and is_of_other and not _is_of_scene(description, owned):
        return main, _ARTICLE.sub("", owned).strip()
    return actor or main, None


def is_of_head(part: str) -> bool:
    """Whether it is the head of a person, which a near portrait shows."""
    return part in _OF_HEAD


def find_looker(picture: Picture, description: SceneDescription) -> str | None:
    """Noun of who looks in a first-person view and is in the picture itself, or None."""
    found = _OF_VIEW.search(_plain(description.prompt))
    own = set(found.group(1).split()) if found else set()
    for claim in description.claims:
        if claim.aspect != "name" or not {*claim.word.split()} & (own | _LOOKERS):
            continue
        for actor in picture.scene.actors:
            if actor.object_index in claim.things and actor.noun.name in PERSON_NOUNS:
                return actor.noun.name
    return None


def _plain(prompt: str) -> str:
    return prompt.casefold().replace("-", " ").replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")


def _find_named(picture: Picture, description: SceneDescription, phrase: str) -> Actor | None:
    """The first thing that a phrase names."""
    first: tuple[int, Actor] | None = None
    for claim in description.claims:
        at = re.search(rf"\b{re.escape(claim.word)}\b", phrase)
        if claim.aspect != "name" or at is None:
            continue
        for actor in picture.scene.actors:
            if actor.object_index in claim.things and (first is None or at.start() < first[0]):
                first = at.start(), actor
    return None if first is None else first[1]


def _is_of_scene(description: SceneDescription, phrase: str) -> bool:
    """As in "a close-up of drops of rain"."""
    words = [one.word for one in description.claims if not one.things and one.move is None]
    return any(re.search(rf"\b{re.escape(word)}\b", phrase) for word in words)
