"""Adjectives, adverbs and participles: what they say of things."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.colours import SURFACES
from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.materials import PATTERNED, has_colour
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.acts import perform
from texvent_scenes.read.draft.abilities import MEANS, Indices
from texvent_scenes.read.draft.copies import part_off, part_ways, switch_in_turn
from texvent_scenes.read.draft.scene_draft import SceneDraft, add_motion, set_field
from texvent_scenes.read.draft.setting import set_scene
from texvent_scenes.read.parsing.groups import Group
from texvent_scenes.read.parsing.lexicon import Sense, VerbSense, word_set, word_table
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.parts import claim_lamps
from texvent_scenes.read.prepositions import comes_down, set_before

_IN_WIND = frozenset({"sway", "fly", "glide", "float", "hover", "sail"})
"""Motions in which the wind shows."""
_REPEATED = {name: one.repeats_hz for name, one in ACTIVITIES.items()}
_QUANTITIES = ("rate_hz", "turns_hz", "blink_hz")
"""Fields of which each object has one."""
_MEANT = {"circle": ("orbit", (*MEANS, "move", "orbit")), "stays": ("spin", ("turn",))}
"""Adverbs → the motion that some motions are by them: "turns on the spot"."""
_REST = Pose(0.0, 0.0, 0.0, "stand")
_ROCKING, _BOTH_WAYS = ("tilt", "sway"), ("to and fro", "up and down")
"""Motions that turn back by themselves, and the directions that say so."""
_CROWD = 5
"""Persons who are a crowd."""
_REACHED = 2.0
"""Pace that who starts from rest reaches, where none is said."""
_ASIDE = ("left", "right", "across", "towards", "away")
"""Directions in which what hovers leaves its place."""


def say_modifiers(draft: SceneDraft, group: Group, index: int) -> None:
    """Apply adjectives; of several colours a body has the others by itself."""
    fields = ((one, one.first("field")) for one in group.modifiers)
    colours = {one: said.value[1] for one, said in fields
               if said is not None and said.value[0] == "colour"}  # fmt: skip
    painted = _find_paint(draft, index, [*colours.values()])
    own = [one for one, colour in colours.items() if painted and colour != painted[0]]
    sizes = _list_numbers(draft, group, index)
    other = None if painted else _find_pattern(draft, group, index, colours)
    for token in (one for one in group.modifiers if one not in sizes):
        if token in own:
            draft.claim(token, "colour", colours[token], [index])
            continue
        if token is other:
            draft.things[index]["second_colour"] = colours[token]
            draft.show(token)
            continue
        if token.text in word_set("things", "rows"):
            draft.claim(token, "row", "along", [index])
        if token.text in word_set("things", "heaps"):
            draft.claim(token, "stack", "", [index])
        draft.claim(token, "look", "tall", [index] if token.text == "tall" else [])
        is_side = token.text in ("left", "right")  # "the left ball"
        draft.show(*([token] if token.has("hollow", "partitive") or is_side else []))
        draft.things[index] |= {"placement": token.text} if is_side else {}
        first = sorted(token.senses, key=lambda one: one.kind != "field")  # "a low fence"
        say_word(draft, replace(token, senses=tuple(first)), [] if is_side else [index])
    if other is not None:
        draft.things[index].setdefault("material", "striped")
    for token in sizes:
        thing = draft.things[index]
        thing["count"] = max(2, round(thing["count"] * token.value("field")[1]))
        draft.show(token)


def _find_paint(draft: SceneDraft, index: int, colours: Sequence[str]) -> list[str | None]:
    """The colour to paint a body in so that it has all of several; none where no one does it.

    "A black and white football" has both as it is, "a white and green tram" painted green.
    """
    noun = draft.nouns[draft.things[index]["noun"]]

    def has_all(paint: str | None) -> bool:
        rgb = None if paint is None else SURFACES[paint]
        bodies = (noun.build(colour=rgb, scale=1.0, seed=seed).parts(_REST) for seed in range(3))
        return all(has_colour(each, SURFACES[one]) for each in bodies for one in colours)

    tried = (None, *colours) if len({*colours}) > 1 else ()
    return next(([one] for one in tried if has_all(one)), [])


def _find_pattern(
    draft: SceneDraft, group: Group, index: int, colours: Mapping[Token, str]
) -> Token | None:
    """The second of two colours, of what has a pattern or may be striped: "a red and blue ball"."""
    said = {one.value("field")[1] for one in group.modifiers if one.says("field", "material")}
    noun, both = draft.things[index]["noun"], [*colours]
    is_patterned = bool(said & {*PATTERNED}) if said else noun in nouns_with(
        "striped in two colours"
    )  # fmt: skip
    return both[1] if len(both) == len({*colours.values()}) == 2 and is_patterned else None


def _list_numbers(draft: SceneDraft, group: Group, index: int) -> list[Token]:
    """Sizes of groups, which say how many they are: "a small crowd", "a large flock of birds"."""
    is_crowd = group.head is not None and group.head.text in word_table("groups")
    is_crowd &= draft.things[index]["count"] >= _CROWD
    return [one for n, one in enumerate(group.modifiers) if one.says("field", "size")
            and (is_crowd or any(after.says("field", "count") and after.text.endswith(" of")
                                 for after in group.modifiers[n + 1 :]))]  # fmt: skip


def say_word(draft: SceneDraft, token: Token, subjects: Indices) -> None:
    """Apply an adjective, an adverb, a participle, or a word of the scene."""
    light = draft.parts["light"]
    said = token.first("field", "picture", "adverb")
    field, value = said.value if said is not None else ("", "")
    subjects = _find_unsaid(draft, field, subjects, draft.last.nearest)
    things = [draft.things[index] for index in subjects]
    if field == "distance_m" or _say_at_once(draft, token, field, value, subjects):
        return
    if field == "rate_hz" and "flicker_hz" in light and not things:
        light["flicker_hz"] = value
    elif field == "picture" and draft.things:
        is_of_last = draft.beside(token, -1).has("noun")  # "beside april tag 9"
        named = [draft.things[index] for index in draft.last.nearest if is_of_last]
        (named or things or draft.things)[-1]["picture"] = vars(value)
    elif _is_open(draft, field, things):
        is_told = field in ("colour", *word_set("things", "claimed"))
        return _claim_adverb(draft, token, field, value, subjects if is_told else [])
    elif value == "opposite":
        if not part_ways(draft, subjects):
            return
    elif said is not None and things:
        for index in subjects:
            _say_field(draft, token, said, index)
        is_aside = token.text in word_set("things", "aside")
        draft.claim(token, "aside", "", subjects if is_aside else [])
        draft.claim(token, "reverse", "", subjects if value == "backward" else [])
        is_close = value == "near" and token.text != "in the foreground"
        draft.claim(token, "near", "", subjects if is_close else [])
        is_lamp = field == "rate_hz" and all("blink_hz" in one for one in things)
        draft.claim(token, "shine" if is_lamp else SEEN, "", subjects)
        claim_lamps(draft, token, subjects if field == "is_lit" else [])
    else:
        if not set_scene(draft, token, things) and things and token.verbs("ing", "ed"):
            perform(draft, token, subjects, [], False)
        return
    draft.show(token)


def _claim_adverb(
    draft: SceneDraft, token: Token, field: str, value: Any, subjects: Indices
) -> None:
    """Leave it to the staged scene whether things do it so, and let them do what it means."""
    if field == "on_ground" and draft.beside(token, -1).has("noun"):
        subjects = draft.last.nearest or subjects  # "hovers over a ball on the ground"
    if field == "times":
        _repeat(draft, value, subjects)
    meant, kinds = _MEANT.get(field, ("", ()))
    for motions in (draft.things[index]["motions"] for index in subjects):
        if motions and motions[-1]["kind"] in kinds:
            hurried = motions[-1]["kind"] == "run" and meant == "orbit"
            pace = 2.0 * motions[-1].get("pace", 1.0)
            motions[-1] |= {"kind": meant} | ({"pace": pace} if hurried else {})
        if field == "on_ground" and [one["kind"] for one in motions] == ["break"]:
            motions.insert(0, {"kind": "fall"})  # "a balloon bursts on the ground"
    if field == "in_air":
        field, value = "ground", False
    draft.claim(token, field, value, subjects)


def _say_at_once(
    draft: SceneDraft, token: Token, field: str, value: Any, subjects: Indices
) -> bool:
    """Apply a state of what opens, or the speed of a view; a dark tunnel is not painted."""
    state = word_table("states").get(token.text)
    if field == "colour" and token.text in word_set("things", "shades"):
        lit = nouns_with("passage") | nouns_with("has a door") | LAMPS.keys()
        return any(draft.things[n]["noun"] in lit and not draft.can_go(n) for n in subjects)
    acts = [draft.noun(index).acts for index in subjects]
    if acts and state and (not field or all(state in one for one in acts)):
        _set_state(draft, token, subjects)
        return True
    if field == "set" and (subjects or draft.last.nearest):
        return set_before(draft, token, value, subjects or draft.last.nearest)
    if field == "in_turn" and not subjects and draft.effects:
        draft.show(*([token] if draft.effects[-1]["kind"] == "drip" else []))
        return True  # drops fall one by one
    is_still = bool(subjects) and not any(draft.things[one]["motions"] for one in subjects)
    if field == "in_turn" and is_still and any(draft.is_lamp(one) for one in subjects):
        is_so = all([switch_in_turn(draft, one) for one in subjects])
        draft.mark(token, "shown" if is_so else "lost")
        return True
    if field == "on_ground" and not subjects:
        draft.mark(token, "shown" if comes_down(draft.beside(token, -1)) else "lost")
        return True  # "snow on the ground"
    if field == "end_pace" and not subjects and draft.moves:
        draft.mark(token, "shown" if draft.quicken(value) else "lost")
        return True
    for one in subjects if field == "in_mouth" else ():
        draft.take_in_mouth(one)
    if field == "wind":
        is_blown = [_blow(draft, index) for index in subjects] or [bool(draft.effects)]
        draft.show(*([token] if all(is_blown) else []))
        return True
    nouns = draft.names(subjects)
    is_still = nouns <= nouns_with("fits who goes through")  # "a tunnel exit, 60 km/h"
    is_way = is_still and draft.set_journey(field, value)
    draft.show(*([token] if is_way else []))
    return is_way


def _blow(draft: SceneDraft, index: int) -> bool:
    """Let things sway in the wind; whether the wind shows in their motion."""
    thing, noun = draft.things[index], draft.noun(index)
    stays = noun.speed_m_s == 0.0
    said, verb = [one["kind"] for one in thing["motions"][-1:]], draft.last.verb
    if noun.is_working and stays and said == ["move"] and verb is not None:
        thing["motions"].pop()  # "a flag moves in the wind"
        draft.mark(verb, "shown")
        draft.claims.pop(verb.at, None)
    if noun.is_working or {one["kind"] for one in thing["motions"]} & _IN_WIND:
        return True
    is_still = {one["kind"] for one in thing["motions"]} <= {"stand", "grow", "move"}
    if (noun.habitat == "fixed" or noun.motion == "stand" or stays) and is_still:
        thing["motions"] = [{"kind": "sway"}]
    return bool(thing["motions"]) and thing["motions"][-1]["kind"] == "sway"


def _set_state(draft: SceneDraft, token: Token, subjects: Indices) -> None:
    """Apply an adjective of what opens and closes: "an open door"."""
    state = word_table("states")[token.text]
    able = [n for n in subjects if state in draft.noun(n).acts]
    for index in able:
        add_motion(draft.things[index], VerbSense(kind=state))
    draft.claim(token, "activity", state, able)
    draft.show(*([token] if able == [*subjects] else []))


def _is_open(draft: SceneDraft, field: str, things: Sequence[Mapping[str, Any]]) -> bool:
    """Whether a field of things cannot be set: a second colour, a height at rest."""
    motions = [one for thing in things for one in thing["motions"]]
    if field == "angle_deg":
        return True  # a camera turns by it
    if field == "is_lit":
        return not all(one["noun"] in LAMPS or draft.nouns[one["noun"]].is_working
                       for one in things)  # fmt: skip
    if field == "rate_hz":
        works = any(draft.nouns[one["noun"]].is_working for one in things)
        is_lamp = any("blink_hz" in one or one["noun"] in LAMPS for one in things)
        return not (motions or works or is_lamp)
    if field == "height_m":  # it is no way either: "seen from 3 m"
        return not any(
            one["kind"] in ("fall", "bounce", "hover", "fly", "glide", "float") for one in motions
        )
    is_set = field in word_set("things", "once") and any(field in one for one in things)
    return is_set or field in word_set("things", "claimed")


def _say_field(draft: SceneDraft, token: Token, said: Sense, index: int) -> None:
    """Set a field of an object; of a speed also the one that it reaches: "brakes to 2 m/s"."""
    if token.text in ("up", "down") and draft.handles(index):
        return  # "an arm puts a box down", and stays on its foot
    motions, before = draft.things[index]["motions"], draft.beside(token, -1).text
    (name, value), end = said.value, motions[-1].get("end_pace") if motions else None
    if name == "speed_m_s" and end is not None:
        is_end = before == "to" or (before != "from" and end > motions[-1].get("pace", 1.0))
        name = "end_m_s" if is_end else name
    if name == "direction" and motions[-1:] and motions[-1]["kind"] == "hover" and value in _ASIDE:
        motions[-1]["kind"] = "move"  # "a bubble floats past"
    if name == "direction" and motions and motions[-1]["kind"] in _ROCKING and value in _BOTH_WAYS:
        return  # "tilts back and forth", on the spot
    if name == "direction" and motions and value in ("across", "diagonal"):
        held = {"across", "diagonal"} & {motions[-1].get("direction")}
        value = "diagonal" if held else value  # "diagonally across the screen"
    if name == "start_pace":  # "accelerates from standstill"
        name, value = "pace", value / (motions[-1].get("pace", 1.0) if motions else 1.0)
        set_field(draft.things[index], said.kind, "end_pace", end or _REACHED)
    set_field(draft.things[index], said.kind, name, value)
    draft.quantities[index, name] = value


def _repeat(draft: SceneDraft, times: Any, indices: Indices) -> None:
    """Let objects rest after so many repetitions of what is counted."""
    acts = [draft.things[index]["motions"] for index in indices]
    rates = [_REPEATED.get(one[0]["kind"], 0.0) if len(one) == 1 else 0.0 for one in acts]
    for motions, rate_hz in zip(acts, rates, strict=True) if all(rates) else ():
        rate_hz *= motions[0].get("pace", 1.0)
        motions.append({"kind": "stand", "start_s": round(times / rate_hz, 6)})


def _find_unsaid(draft: SceneDraft, name: str, indices: Indices, nearest: Indices) -> list[int]:
    """Objects of which a quantity is said now: no other than before of the same.

    Of "two LEDs at 5 Hz and 9 Hz" the second has it, of "a fan at 5 Hz by a fan at 9 Hz" the
    nearest one.
    """
    if name not in _QUANTITIES or not any((one, name) in draft.quantities for one in indices):
        return [*indices]
    free = [one for one in nearest if one not in indices and (one, name) not in draft.quantities]
    if free:
        return free
    own = indices[0]
    if len(indices) > 1 or draft.things[own]["count"] != 2:
        return []
    part_off(draft, own, 1)
    return [len(draft.things) - 1]
