"""Members of several things that are named before: "the black one", "the older girl"."""

from __future__ import annotations

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.read.draft.abilities import balls_of
from texvent_scenes.read.draft.copies import part_off
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.groups import Group
from texvent_scenes.read.parsing.lexicon import word_set, word_table
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.words import list_plurals

_GOING = frozenset({"walk", "run", "fly", "swim"})
"""Motions of several who go the same way."""


def find_hued(draft: SceneDraft, group: Group, known: int) -> list[int]:
    """One of several things that its colour names again: "the red one" of two balls."""
    hues = [one for one in group.unknown if one.says("field", "colour")]
    things = draft.things[:known] if hues and (group.article, group.picks) == ("the", "one") else []
    values = {one.value("field")[1] for one in hues}
    found = [n for n, one in enumerate(things) if {one.get("colour")} == values]
    like = [n for n, one in enumerate(things) if found and one["noun"] == things[found[0]]["noun"]]
    if len(found) != 1 or len(like) < 2:
        return []
    draft.left = [one for one in like if one not in found]  # "the other one"
    draft.show(*group.unknown)
    draft.last.nearest = found
    return found


def part_member(draft: SceneDraft, group: Group, head: Token) -> list[int]:
    """One of several whom a noun of theirs, or of a kind of theirs, names: "the older girl".

    It does what all do. The last who is left is named by it too.
    """
    noun = group.noun.noun if group.noun is not None else ""
    is_one = group.article == "the" and group.count == 1 and not group.is_plural
    is_led = any(head.text.endswith(f" {one}") for one in word_set("things", "elsewhere"))
    if not (noun and is_one) or is_led or _names_other(draft, head):
        return []  # "the car ahead"
    hues = {one.value("field")[1] for one in group.modifiers if one.says("field", "colour")}
    kinds = word_table("general").get(head.text, ())
    many = [n for n, one in enumerate(draft.things) if "word" in one
            and (one["count"] > 1 or n in draft.left)
            and (one["noun"] == noun or noun in _list_hyponyms(draft, n) or one["noun"] in kinds)
            and hues <= {one.get("colour", *hues)}]  # fmt: skip
    return [_part_one(draft, many[-1], noun, head)] if many else []


def is_in_play(draft: SceneDraft, group: Group, head: Token) -> bool:
    """Whether a group names the ball that comes with an act that is said: no second one."""
    who = [n for n in range(len(draft.things)) for kind in draft.does([n])
           if head.nouns & balls_of(kind)]  # fmt: skip
    if group.article == "a" or group.is_plural or draft.find(head.nouns) or not who:
        return False
    draft.show(head)
    draft.claim(head, SEEN, "", who[-1:])
    if draft.last.was_camera:
        draft.parts["camera"].setdefault("target", who[-1])
    return True


def _part_one(draft: SceneDraft, own: int, noun: str, head: Token) -> int:
    """Part one thing from several, and name it by a noun of its kind, where that is closer."""
    index = own
    thing = draft.things[own]
    for motion in thing["motions"] if not thing["relations"] else ():  # one goes with the others
        goes = motion["kind"] in _GOING and motion.get("direction", "across") == "across"
        motion |= {"direction": "right"} if goes else {}
    if draft.things[own]["count"] > 1:
        part_off(draft, own, 1)
        draft.left, index = [own], len(draft.things) - 1
    thing = draft.things[index]
    if noun in _list_hyponyms(draft, own):
        thing |= {"noun": noun, "word": head.text}
    return index


def _list_hyponyms(draft: SceneDraft, own: int) -> set[str]:
    """Nouns of kinds of what several are: girls and toddlers of children, no girls of boys."""
    thing = draft.things[own]
    names = {name for name in word_table("general") if thing["word"] in list_plurals(name)}
    names |= {thing["noun"]} & {"person"}
    return {noun for name in names for noun in word_table("general").get(name, ())}


def find_fellow(draft: SceneDraft, group: Group) -> list[int]:
    """The other, or one of the others, from whom one was picked: "passes a defender"."""
    head, left = group.head, [one for one in draft.left if one < len(draft.things)]
    is_fellow = any(one.text in word_set("things", "fellows") for one in group.words)
    is_fellow &= draft.names(left) <= PERSON_NOUNS and not group.is_plural
    if not left or not (is_fellow or (head is None and group.picks in ("other", "others"))):
        return []
    if is_fellow and draft.things[left[0]]["count"] > 1:
        part_off(draft, left[0], 1)
        left = [len(draft.things) - 1]
    for token in group.words:
        is_kind = head is token and draft.things[left[0]]["noun"] not in token.nouns
        draft.mark(token, draft.things[left[0]]["noun"] if is_kind else "shown")
    draft.claim(head or group.words[0], SEEN, "", left)
    draft.last.nearest = left
    return left


def find_whole_of(draft: SceneDraft, group: Group, known: int) -> list[int]:
    """Several of whom a group names one, among the first things: the same noun, or persons."""
    if group.noun is None or "one" not in [one.text for one in group.modifiers]:
        return []
    own, sexed = group.noun.noun, word_set("things", "sexed")
    like = PERSON_NOUNS - sexed if own in PERSON_NOUNS else set()
    return [n for n, one in enumerate(draft.things[:known])
            if one["count"] > 1 and one["noun"] in {own, *like}][-1:]  # fmt: skip


def list_kinds(draft: SceneDraft, head: Token) -> list[int]:
    """Things of a kind: "the bird" means the pigeon, "the robot" a delivery robot."""
    kinds = word_table("general").get(head.text, ())
    return [n for n, one in enumerate(draft.things)
            if one["noun"] in kinds or one.get("word", "").endswith(f" {head.text}")]  # fmt: skip


def is_again(draft: SceneDraft, group: Group, head: Token, known: int) -> bool:
    """Whether a group names a thing again; not "her coach", or "the car behind"."""
    thing = draft.things[known]
    is_owned = group.article in ("its", "his", "her", "their")
    is_role = thing["noun"] == "person" and head.text != "person"
    is_role &= head.text != thing.get("word", head.text) and thing.get("word") != "person"
    return (is_owned or group.article == "the") and not (is_role or _names_other(draft, head))


def _names_other(draft: SceneDraft, head: Token) -> bool:
    """Whether the word after a noun says that it is another one: "the car behind"."""
    after = draft.tokens[head.at + 1 :][:2]
    is_other = bool(after) and after[0].text in word_set("things", "elsewhere")
    return is_other and not (after[1:] and after[1].has("articles", "pronouns", "noun", "field"))
