"""Places of a scene: which words name them, and what is said of them."""

from __future__ import annotations

from texvent_scenes.description import SEEN
from texvent_scenes.models.places import is_room
from texvent_scenes.models.tables import read_table
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.groups import Group
from texvent_scenes.read.parsing.lexicon import Sense, word_set
from texvent_scenes.read.parsing.tokens import Token


def names_place(head: Token, relation: str) -> bool:
    """Whether a noun is a place: "in a park", and not "a park bench"."""
    place, is_thing = head.first("place"), head.has("noun", "pose")
    if place is None or (head.is_liquid and relation in ("", "with", "from", "off")):
        return False
    if relation in word_set("things", "outside"):  # "behind a library": where is that?
        return not is_thing and not is_room(place.value)
    return bool(relation) or not is_thing


def set_place(draft: SceneDraft, group: Group, head: Token, relation: str) -> None:
    """As "on a snowy road", "a red sky", "a mountain road"; a second place is far off."""
    place = draft.parts["place"]
    name = head.all("place")[0].value
    is_it = name in ("sky", place.get("name", name))
    for token in group.modifiers:
        field, value = (token.first("field") or Sense("", ("", ""))).value
        if token.text == "dark":
            draft.parts["light"].setdefault("kind", "night")
            if name == "plain":
                place |= {"colour": "black", "sky": "black"}
        elif field == "colour" and is_it and not is_room(name):
            place["sky" if name == "sky" else "colour"] = value
        elif not (token.has("partitive") or draft.set_scene(token)):
            continue
        draft.show(token)
    if name == "plain":  # "a plain black background": alone, the word has several senses
        said = (one for one in draft.tokens if one.text == name and one.at < head.at)
        draft.show(*(one for one in said if head.at - one.at <= len(group.modifiers) + 1))
    draft.show_inherent(group.unknown, name)
    for token in group.unknown:
        _fill_place(draft, token, name)
    draft.set_scene(head)
    is_said = bool(group.modifiers) and relation not in ("in", "on", "through")
    if not is_it and name in word_set("things", "backdrops") and not is_room(place["name"]):
        place["backdrops"] = list(dict.fromkeys([*place.get("backdrops", ()), name]))
        draft.show(head)
    elif (name == "sky" and is_said) or place.setdefault("name", name) == name or (
        head.is_liquid and place["name"] in word_set("things", "waters")
    ):  # fmt: skip
        draft.mark(head, name if head.text in word_set("things", "stand_ins") else "shown")


def _fill_place(draft: SceneDraft, token: Token, place: str) -> None:
    """Add those of whom a place is full: "a busy street"."""
    full = read_table("words", "read")["brings"]
    brought = full.get(f"{token.text} {place}") or full.get(token.text, {})
    for noun, count in brought.items():
        draft.show(token)
        draft.claim(token, SEEN, "", [draft.add(noun, count)])
