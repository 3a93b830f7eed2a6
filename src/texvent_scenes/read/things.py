"""Things of a sentence: noun groups named, again or for the first time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import HAND_NOUNS, PERSON_NOUNS
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.copies import (
    PLURAL_COUNT,
    add_like,
    count_like,
    find_several,
    pick,
    stack,
)
from texvent_scenes.read.draft.scene_draft import SceneDraft, add_motion
from texvent_scenes.read.draft.setting import go_inside, names_place, set_place, set_scene
from texvent_scenes.read.members import (
    find_fellow,
    find_hued,
    find_whole_of,
    is_again,
    is_in_play,
    list_kinds,
    part_member,
)
from texvent_scenes.read.modifiers import say_modifiers, say_word
from texvent_scenes.read.parsing.groups import Group, Phrase, is_trajectory, ordinals
from texvent_scenes.read.parsing.lexicon import (
    NounSense,
    Sense,
    VerbSense,
    deeds,
    word_set,
    word_table,
)
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.read.parts import claim_fine
from texvent_scenes.spec.scene import MAX_BODIES
from texvent_scenes.words import list_plurals


def pick_group(draft: SceneDraft, group: Group, known: int) -> list[int]:
    """Some of several things, or the others: "two dogs, a brown one and a white one".

    What is named again is one of the first `known` things: "four teenagers play, one player".
    """
    if again := find_hued(draft, group, known):
        return again
    whole = find_whole_of(draft, group, known)
    for each in group.of.groups if group.of is not None and group.picks else ():
        whole += name_group(draft, each)  # "two of the dogs"
    if whole and group.head is not None and group.noun is not None:
        noun = draft.things[whole[0]]["noun"]
        draft.mark(group.head, "shown" if group.noun.noun == noun else noun)
    elif not group.picks or (draft.last.is_lost and not whole):
        return []  # "three wugs hang, one falls"
    several = find_several(draft, whole)
    is_another = group.picks == "another"
    like = several or (_find_doer(draft) or find_several(draft, least=1)) * is_another
    is_new = bool(like) and (not several or count_like(draft, like[0]) < group.ordinal)
    picked = add_like(draft, like[0]) if is_new else pick(draft, group.picks, group.count, whole)
    which = word_set("things", "members") | ({*ordinals()} if not is_new else set())
    for token in (*group.modifiers, *group.unknown) if picked else ():
        if token.text in ("left", "right"):  # "the left one"
            for index in picked:
                draft.things[index]["placement"] = token.text
            draft.show(token)
            continue
        say_word(draft, token, picked)
        draft.show(*([token] if token.text == group.picks and token.text not in which else []))
    return picked


def _find_doer(draft: SceneDraft) -> list[int]:
    """Person who acts on something: "hits a ball and another catches it"."""
    acting = (one for one in draft.last.subjects if draft.acts([one]) and draft.walks(one))
    return [*acting][:1]


def name_group(
    draft: SceneDraft, group: Group, relation: str = "", owners: Indices = ()
) -> list[int]:
    """Add what a group names; the indices of its objects, at most one."""
    head = group.head
    draft.modifying |= {one.at for one in group.words} if head is not None else set()
    found: list[int] = []
    if head is not None and relation in word_set("things", "by_effects"):
        head = _see_as_thing(head, relation)
        group = replace(group, head=head)
    if head is not None and (formed := _list_formed(group, head)):
        return [index for one in formed for index in name_group(draft, one, relation, owners)]
    outer = [one for one in group.words if one.text in word_set("things", "outer")]
    is_none = bool(outer and head and head.has("place")) or _is_of_unknown(group, head)
    if go_inside(draft, group, relation, owners) or is_none:
        return []  # "on the roof of a hospital": in no ward
    if head is not None and names_place(head, relation) and not is_trajectory(group):
        set_place(draft, group, head, relation)
    elif head is not None and (whole := _find_whole(draft, group)):
        found = name_group(draft, whole, relation, owners)
        draft.claim(head, SEEN, "", found)
        return found if relation else []  # what a part does, the whole does not
    elif head is not None and head.has("noun", "pose"):
        found = _pose_again(draft, group, head) or _find_all_of(draft, group)
        if not (found or head.at in draft.fates):
            found = _name_thing(draft, group, head)
    elif not (found := _find_unnamed(draft, group, relation) if head is None else []):
        _name_others(draft, group, relation, owners)
    phrase = group.of or Phrase(head or NO_TOKEN, ())
    for content in phrase.groups:
        _fill(draft, found, content, phrase.preposition)
    return found


def _name_others(draft: SceneDraft, group: Group, relation: str, owners: Indices) -> None:
    """Add an effect, light or weather, or nothing that is known."""
    head = group.head
    for token in group.unknown if relation not in ("", "with") else ():
        if names_place(token, relation):  # "in a city centre"
            set_place(draft, Group(token), token, relation)
    _light_own(draft, group)
    for token in (*group.modifiers, *([head] if head else [])):
        effect = token.first("effect")
        is_mark = relation == "with" and any(map(draft.walks, owners))
        marks = word_set("things", "marks") if is_mark else ()
        if not set_scene(draft, token) and effect and effect.value not in marks:
            draft.add_effect(token, effect.value, owners)
            draft.show_inherent((draft.beside(token, -1), *group.words), effect.value)


def _find_whole(draft: SceneDraft, group: Group) -> Group | None:
    """The thing of which a group names a part that is not drawn alone: "the bell of a church".

    A person or an animal has things, and what is in a vessel is no whole.
    """
    whole = group.of.groups[0] if group.of is not None and group.of.groups else None
    part = group.noun.noun if group.noun else ""
    if whole is None or whole.noun is None or not whole.article or group.article != "the":
        return None
    apart = word_set("things", "vessels") | word_set("things", "depictions")
    going = [one for one in (part, whole.noun.noun)
             if one in draft.nouns and draft.nouns[one].speed_m_s]  # fmt: skip
    return None if going or part in apart or whole.noun.noun in PERSON_NOUNS else whole


def _light_own(draft: SceneDraft, group: Group) -> None:
    """Switch the lamps of the last thing that has some: "its headlights are on", "lights off"."""
    lamps = draft.find(LAMPS)[-1:]
    is_owned = lamps and group.article in {*word_set("things", "owners"), ""}
    for token in group.unknown if is_owned else ():
        if token.says("field", "is_lit"):
            say_word(draft, token, lamps)


def _fill(draft: SceneDraft, vessels: Indices, content: Group, token: Token) -> None:
    """Add a place, or what is in a vessel or place: "of apples"; else its part is not known."""
    head, nouns = content.head, [draft.things[one]["noun"] for one in vessels]
    kinds = (("in", "vessels"), ("on", "laden"), ("on", "loaded"))
    bearing = next((kind for kind, one in kinds if word_set("things", one) & {*nouns}), "")
    if head is not None and names_place(head, ""):
        name_group(draft, content, "in")
    elif head and not head.is_liquid and bearing:
        for index in name_group(draft, content):
            draft.relate(index, bearing, vessels)
            draft.show(token)
        draft.last.nearest = list(vessels)
    elif token.has("containing") and not vessels:
        for index in name_group(draft, content):
            draft.things[index]["count"] = 2 * PLURAL_COUNT
            draft.show(token)


def _find_unnamed(draft: SceneDraft, group: Group, relation: str) -> list[int]:
    """Things that a group without a noun means: all of some, or one more of who act."""
    if group.picks == "another" and relation in ("", "to", "towards"):
        draft.last.nearest = pick_group(draft, group, len(draft.things))
        return draft.last.nearest
    return _find_all_of(draft, group)


def _find_all_of(draft: SceneDraft, group: Group) -> list[int]:
    """All things that a group names again: "both balls" of two kinds, "the vehicles", "the two"."""
    if fellows := find_fellow(draft, group):
        return fellows
    counts = [one for one in group.words if one.says("field", "count")]
    named = [one for one in group.words if one not in counts]
    is_again = group.article == "the" or any(one.text == "both" for one in counts)
    if not is_again or len(named) > 1 or group.of is not None:
        return []
    for found, is_wide in _list_alike(draft, named[0] if named else NO_TOKEN):
        number = sum(draft.things[one]["count"] for one in found)
        if counts[0].value("field")[1] == number if counts else is_wide and found[1:]:
            draft.show(*named, *counts)
            for token in counts:
                draft.claim(token, SEEN, token.value("field")[1], found)
            draft.last.nearest = found
            return found
    return []


def _list_alike(draft: SceneDraft, head: Token) -> Iterator[tuple[list[int], bool]]:
    """Things that a plural may mean, and whether it is a word for things of several nouns."""
    if head is NO_TOKEN:
        yield draft.last.subjects, False
        return
    kinds = (one for name, one in word_table("general").items() if head.text in list_plurals(name))
    nouns = head.nouns.union(*kinds)
    yield draft.find(nouns), False
    yield draft.find(PERSON_NOUNS if nouns & PERSON_NOUNS else ()), False
    if head.text in word_set("things", "wide"):
        is_so = _WIDE[head.text]
        yield [n for n in range(len(draft.things)) if is_so(draft.noun(n))], True


_WIDE: Mapping[str, Callable[[Noun], bool]] = {
    "animals": lambda noun: bool(noun.acts) or noun.motion == "swim",
    "people": lambda noun: noun.name in PERSON_NOUNS,
    "vehicles": lambda noun: noun.motion == "drive",
}
"""Words for things of several nouns, and which these are."""


def _name_thing(draft: SceneDraft, group: Group, head: Token) -> list[int]:
    noun, owners = group.noun, word_set("things", "owners")
    known = draft.find([noun.noun] if noun else ())
    known = known or (list_kinds(draft, head) if group.article == "the" else [])
    having = draft.find(word_table("parts").get(head.text, ()))
    apart = {""} if noun is None else set()  # "a cake and three candles"
    if group.article in owners | {"the"} | apart and having:
        draft.show(head)
        claim_fine(draft, head, having[-1:])
        draft.claim(head, SEEN, "", having[-1:])
        return []  # "a cyclist falls off his bike", "a car stops and the door opens"
    is_owned = group.article in owners or bool(draft.find(PERSON_NOUNS))
    is_part = noun and ((is_owned and noun.noun in HAND_NOUNS) or group.article == "its")
    is_part = bool(is_part and not known) or is_in_play(draft, group, head)
    if len(draft.things) == MAX_BODIES or is_part:
        return []  # "his hands", "with its propellers": parts of a body
    members = noun.members if noun is not None else ()
    if members:
        return _name_members(draft, group, head, members)
    draft.show(head)
    unknown = {one.text for one in group.unknown} - word_set("things", "wholes")
    hues = [one.value("field")[1] for one in group.modifiers if one.says("field", "colour")]
    is_plain = len(hues) == len(group.modifiers) and not unknown
    is_either = head.text in list_plurals(head.text)  # "the fish", one or more
    same = [n for n in known if is_either or group.is_plural == (draft.things[n]["count"] > 1)]
    if len(known) > len(same):  # "the player", of a player and two defenders
        same = [n for n in same if draft.things[n].get("word", "").endswith(head.text)] or same
    same = [n for n in same if all(draft.things[n].get("colour") == one for one in hues)]
    if same and is_plain and is_again(draft, group, head, same[-1]):
        draft.last.nearest = same[-1:]  # "the car", where there is one, "the red car"
        draft.show(*group.modifiers)
        return same[-1:]
    picked = [] if same else part_member(draft, group, head)
    for token in (*group.modifiers, *group.unknown) if picked else ():
        say_word(draft, token, picked)
    draft.last.nearest = picked or [_add_thing(draft, group, head)]
    return draft.last.nearest


def _add_thing(draft: SceneDraft, group: Group, head: Token) -> int:
    """Add an object for a noun, or for who is named by an act; its index."""
    noun = group.noun
    if noun is None:
        name, activity = head.all("pose")[0].value
        index = draft.add(name, motions=[{"kind": activity}])
    else:
        name = noun.noun
        index = draft.add(name, word=head.text)
        draft.things[index] |= {"deed": deed} if (deed := deeds().get(head.text)) else {}
        if noun.is_kind:
            draft.mark(head, name)
    if group.is_plural:
        many = trait_value("bodies of a plural", name) or PLURAL_COUNT
        draft.things[index] |= {"count": many, "is_open": not group.is_counted}
    draft.show_inherent(group.unknown, name)
    draft.claim(head, SEEN, "", [index])  # of a word that the others decide: "bar" as a counter
    hued = {one: hue for one in group.unknown
            if (hue := word_table("hued").get(f"{one.text} {head.text}"))}  # fmt: skip
    for token, hue in hued.items():  # "a lab coat" is white, and in no laboratory
        draft.things[index]["colour"] = hue
        draft.mark(token, "shown")
        draft.claim(token, "colour", hue, [index])
    group = replace(group, unknown=tuple(one for one in group.unknown if one not in hued))
    say_modifiers(draft, group, index)
    for token in group.unknown if not draft.can_go(index) else ():
        if names_place(token, "") and not token.has("noun"):  # "a kitchen table"
            set_place(draft, Group(token), token, "")
    draft.name_kind((*group.unknown, *group.modifiers), head, draft.things[index]["noun"])
    if any(one.text in word_set("things", "stacks") for one in group.modifiers):
        stack(draft, index)
    _mount(draft, group, head, index)
    return index


def _mount(draft: SceneDraft, group: Group, head: Token, rider: int) -> None:
    """Give a rider what the word before says: "a horse rider", "two scooter riders"."""
    for token in group.words if head.text in word_set("things", "riders") else ():
        for noun in sorted(token.nouns & trait_values("ridden").keys())[:1]:
            draft.mark(token, "shown")
            draft.mark(head, "shown")
            draft.compounds.pop(head.at, None)
            mount = draft.add(noun, draft.things[rider]["count"])
            draft.relate(rider, "on", [mount])
            draft.things[rider]["rides"] = mount


def _pose_again(draft: SceneDraft, group: Group, head: Token) -> list[int]:
    """Let who is there do what is named: "during a slow pirouette"."""
    if head.has("noun"):
        return []
    who, activity = head.all("pose")[0].value
    able = PERSON_NOUNS if who == "person" else {who}
    is_open = draft.last.is_then or who == "person"
    same = [one for one in draft.find(able) if is_open or not draft.does([one])][-1:]
    if who in HAND_NOUNS and draft.find(PERSON_NOUNS):
        draft.mark(head, "shown" if same else "lost")  # "holds it with two fingers"
        return same
    for index in same:
        draft.show(head)
        if activity not in draft.does([index]):
            add_motion(draft.things[index], VerbSense(who, activity))
        draft.claim(head, "activity", activity, [index])
        say_modifiers(draft, group, index)
    return same if draft.last.is_then else []


def _name_members(
    draft: SceneDraft, group: Group, head: Token, members: Sequence[tuple[str, int]]
) -> list[int]:
    """Add those who are a couple, a family or a crowd; a "family of ducks" is not known."""
    if group.of is not None or len(draft.things) + len(members) > MAX_BODIES:
        return []
    draft.show(head)
    deed = {"deed": done} if (done := word_table("members_do").get(head.text)) else {}
    draft.last.nearest = [draft.add(noun, count, **deed) for noun, count in members]
    draft.claim(head, SEEN, "", draft.last.nearest)
    for index in draft.last.nearest:
        say_modifiers(draft, group, index)
    return draft.last.nearest


def _list_formed(group: Group, head: Token) -> Sequence[Group]:
    """Groups of what has the shape that a head names, which is no thing: "a pyramid of cans"."""
    parts = group.of.groups if group.of is not None else ()
    is_shape = bool(head.nouns & nouns_with("formed of others"))
    said = [one.head for one in parts if one.head and not (one.article or one.head.has("field"))]
    is_shape &= len(said) == len(parts) and all(one.has("noun", "effect") for one in said)
    return parts if is_shape else ()


def _is_of_unknown(group: Group, head: Token | None) -> bool:
    """Whether it is a cloud of what is not known, which is none of the sky: "clouds of sand"."""
    is_cloud = head is not None and bool(head.nouns & word_set("things", "aloft"))
    return is_cloud and group.of is not None and group.of.preposition.text == "of"


def _see_as_thing(head: Token, relation: str) -> Token:
    """A word as what has the effect or the room which it names: "around a fire", "past a cafe"."""
    kinds = ("effect", "place") if relation in word_set("things", "outside") else ("effect",)
    said = {one.value for kind in kinds for one in head.all(kind)} if not head.has("noun") else ()
    table = {one: noun for noun, own in word_table("seen_as").items() for one in own}
    senses = [Sense("noun", NounSense(table[one], is_kind=head.has("place")))
              for one in said if one in table]  # fmt: skip
    return replace(head, senses=tuple(senses)) if senses else head
