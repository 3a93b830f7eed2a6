"""Setting of a scene: its place, light and weather, and which words name them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from texvent_scenes.models.nouns import AFLOAT
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.read.draft.scene_draft import SceneDraft, split_move
from texvent_scenes.read.parsing.groups import Group
from texvent_scenes.read.parsing.lexicon import word_set, word_table
from texvent_scenes.read.parsing.tokens import Token


def names_place(head: Token, relation: str) -> bool:
    """Whether a noun is a place: "in a park", and not "a park bench"."""
    place, is_thing = head.first("place"), head.has("noun", "pose")
    if place is None or (head.is_liquid and relation in ("", "with", "from", "off")):
        return False
    if relation in word_set("things", "outside"):  # "behind a library": where is that?
        return not (is_thing and relation != "past") and not is_room(place.value)
    return bool(relation) or not is_thing


def set_scene(draft: SceneDraft, token: Token, things: Sequence[Any] = ()) -> bool:
    """Apply a word of light, weather, place or camera; of things, "wet" is theirs alone."""
    if things and token.text in word_set("things", "own"):
        return False
    for sense in token.all("shot"):
        draft.add_move({**split_move(sense.value), **_pace_before(draft, token)})
    said = [sense.value for sense in token.all("scene")]
    if draft.phases and any(part in ("light", "place") for part, _, _ in said):
        return False  # "then it rains"
    if _leaves_place(draft, token):
        draft.mark(token, "lost")
        return True
    for part, name, value in said:
        if name == "name" and value in ("sky", "indoor") and draft.parts[part].get(name):
            continue  # "in a kitchen, indoors"
        if name != "kind" or _tells_more(value, draft.parts[part].get(name)):
            draft.parts[part][name] = value
    is_near = token.text.split()[0] in word_set("things", "nearest")
    draft.claim(token, "macro", "", [None] if is_near else [])
    is_above = not word_set("things", "overhead").isdisjoint(token.text.split())
    draft.claim(token, "sky", "", [None] if is_above and said else [])
    is_said = token.has("shot", "scene")
    lights = [value for part, name, value in said if (part, name) == ("light", "kind")]
    is_sun = bool(lights) and token.text in word_set("things", "suns")
    is_low = "sun" in token.text.split() and bool({*lights} & {*_LOW_SUNS}) and not is_sun
    draft.claim(token, "sun", "", [None] if is_low else [])
    draft.mark(token, lights[0]) if is_sun else draft.show(*([token] if is_said else []))
    return is_said


_LOW_SUNS = ("dusk", "dawn")
"""Lights whose sun is so low that a word for it is one for a thing to be seen: "low sun"."""
_DAYLIGHTS = ("day", "sunny", "morning", "afternoon", "overcast", "stormy")
"""Lights of the day, from that which tells least: of "an overcast morning" no sun is seen."""


def _tells_more(light: str, said: str | None) -> bool:
    """Whether a light takes the place of one that is said: not the sun that of "dusk"."""
    if said is None or light not in _DAYLIGHTS:
        return True
    return said in _DAYLIGHTS and _DAYLIGHTS.index(light) >= _DAYLIGHTS.index(said)


def _leaves_place(draft: SceneDraft, token: Token) -> bool:
    """Whether a phrase names another place than the one that is said: "dives under water"."""
    said = [sense.value[2] for sense in token.all("scene") if sense.value[1] == "name"]
    name = draft.parts["place"].get("name", "")
    if not (said and name) or name in said or token.text == "underwater":
        return False
    return said != ["sky"] and not (is_room(said[0]) and is_room(name))


def _pace_before(draft: SceneDraft, token: Token) -> dict[str, Any]:
    """The pace that the word before says, if of nothing else: "fast yaw rotation"."""
    before = draft.beside(token, -1)
    name, value = before.value("adverb")
    if name != "pace" or draft.shows(before):
        return {}
    draft.show(before)
    return {"pace": value}


def _is_room_again(draft: SceneDraft, head: Token) -> bool:
    """Whether "the room" is the one that was named: "a robot in a laboratory. The room is dark"."""
    is_floor = head.text == "floor" and not draft.last.was_camera
    return (head.text == "room" or is_floor) and is_room(draft.parts["place"].get("name", "plain"))


def set_place(draft: SceneDraft, group: Group, head: Token, relation: str) -> None:
    """As "on a snowy road", "a red sky", "a mountain road"; a second place is far off."""
    place = draft.parts["place"]
    name = head.all("place")[0].value
    name = place["name"] if _is_room_again(draft, head) else name
    name = _in_the_open(draft, group, name)
    is_it = name in ("sky", place.get("name", name))
    for token in group.modifiers:
        _say_of_place(draft, token, name, is_it=is_it)
    if name == "plain":  # "a plain black background": alone, the word has several senses
        said = (one for one in draft.tokens if one.text == name and one.at < head.at)
        draft.show(*(one for one in said if head.at - one.at <= len(group.modifiers) + 1))
    draft.show_inherent(group.unknown, name)
    for token in group.unknown:
        _fill_place(draft, token, (head.text, name))
    set_scene(draft, head)
    is_said = bool(group.modifiers) and relation not in ("in", "on", "through")
    is_crossed = "across" in (draft.beside(head, -1).text, draft.beside(head, -2).text)
    is_crossed &= "name" in place  # the sky above it
    after = [draft.beside(head, step) for step in (1, 2, 3, 4)]
    is_left = relation in ("out of", "from") and after[0].text in ("onto", "into", "across")
    is_left &= any(one.has("place") for one in after)  # "out of a forest onto a road"
    if name == "sky" and not relation and "name" not in place and _is_overhead(draft):
        draft.show(head)
    elif name in word_set("things", "backdrops") and (
        is_left if is_it else not is_room(place["name"])
    ):
        far = "city" if name == "skyline" else name
        place["backdrops"] = list(dict.fromkeys([*place.get("backdrops", ()), far]))
        draft.mark(head, far if head.text in word_set("things", "stand_ins") else "shown")
        draft.show(*(one for one in group.modifiers if one.says("adverb", "placement")))
    elif is_room(name) and place.get("name") == "indoor":
        place["name"] = name
        draft.show(head)
    elif (name == "sky" and (is_said or is_crossed)) or (
        place.setdefault("name", name) == name or place["name"] in _true_of(head)
    ):  # "grass" in a park
        draft.mark(head, name if head.text in word_set("things", "stand_ins") else "shown")
    for token in group.unknown:  # "a mountain road", "a museum hall"
        said_too = {one.value for one in token.all("place")}
        if said_too & word_set("things", "backdrops") or (said_too and name == "indoor"):
            set_place(draft, Group(token), token, "in")


def _say_of_place(draft: SceneDraft, token: Token, name: str, *, is_it: bool) -> None:
    """Apply an adjective of a place: a colour, "dark" or a word of light and weather."""
    place, (field, value) = draft.parts["place"], token.value("field")
    if any(one.value[1:] == ("name", "indoor") for one in token.all("scene")):
        draft.mark(token, "shown" if is_room(name) else "lost")  # "an indoor pool" is outside
        return
    if token.text == "dark":
        draft.parts["light"].setdefault("kind", "night")
        if name == "plain":
            place |= {"colour": "black", "sky": "black"}
    elif field == "colour" and is_it and not is_room(name):
        place["sky" if name == "sky" else "colour"] = value
    elif not (token.has("partitive") or _is_so_large(token, name)
              or set_scene(draft, token) or name in _true_of(token)):  # fmt: skip
        return
    draft.show(token)


def _is_so_large(token: Token, name: str) -> bool:
    """Whether a size is that of a place: "a large warehouse", "a small kitchen", "a huge lake"."""
    field, size = token.value("field")
    is_large = PLACES[name].hall_m > 0.0 or name in word_table("inherent")["wide"]
    return field == "size" and (is_large if size > 1.0 else is_room(name) and not is_large)


def _in_the_open(draft: SceneDraft, group: Group, name: str) -> str:
    """The place itself, or the same in the open: "an outdoor court"."""
    for token in (*group.modifiers, *group.unknown):
        if token.text in word_set("things", "in_the_open"):
            name = word_table("outdoors").get(name, name)
            draft.show(*([] if is_room(name) else [token]))
    return name


def _true_of(token: Token) -> Sequence[str]:
    """Nouns and places of which an adjective is true anyway: "a narrow corridor"."""
    said: Sequence[str] = word_table("inherent").get(token.text, ())
    return said


def go_inside(draft: SceneDraft, group: Group, relation: str, owners: Sequence[int]) -> bool:
    """Show a room for the building in which some are who walk; whether it does.

    As in "a man prays in a church", where no place is said and the building is no thing yet.
    """
    head, rooms = group.head, word_table("interiors")
    noun = group.noun.noun if group.noun is not None else ""
    is_open = relation == "in" and noun in rooms and "name" not in draft.parts["place"]
    is_open &= head is not None and not head.has("place")  # "in a museum"
    if head is None or not (is_open and owners) or draft.find([noun]):
        return False
    if not all(map(draft.walks, owners)):
        return False
    draft.parts["place"]["name"] = rooms[noun]
    draft.mark(head, rooms[noun])
    return True


def _is_overhead(draft: SceneDraft) -> bool:
    """Note that the sky is named by itself; whether it is over what is on the ground."""
    draft.is_over = True
    return leave_sky(draft)


def leave_sky(draft: SceneDraft) -> bool:
    """Leave open where things on the ground are of which only the sky is said: "it is clear".

    So does what floats on water, wherever the sky is named: boats sail under it.
    """
    things = range(len(draft.things))
    on_ground = draft.is_over and any(map(draft.keeps_to_ground, things))
    on_ground |= any(draft.noun(n).name in AFLOAT for n in things)
    if on_ground and draft.parts["place"].get("name") == "sky":
        del draft.parts["place"]["name"]
    return on_ground


def _fill_place(draft: SceneDraft, token: Token, names: Sequence[str]) -> None:
    """Add those of whom a place is full: "a busy street"."""
    full = word_table("brings")
    said = (full.get(f"{token.text} {one}") for one in names)
    brought = next(filter(None, said), full.get(token.text, {}))
    for noun, count in brought.items():
        draft.show(token)
        draft.claim(token, "many", noun, [draft.add(noun, count)])
