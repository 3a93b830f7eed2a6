"""Things named again: "the dog" after a beagle, "one player" of four, "the car" after a car."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.groups import Group, Phrase
from texvent_scenes.read.parsing.lexicon import general_names, word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.spec.data import PLACING


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
    kinds = general_names().get(head.text, ())
    return [n for n, one in enumerate(draft.things)
            if one["noun"] in kinds or one.get("word", "").endswith(f" {head.text}")]  # fmt: skip


def is_again(draft: SceneDraft, group: Group, head: Token, known: int) -> bool:
    """Whether a group names a thing again; not "her coach", or "the car behind"."""
    thing, after = draft.things[known], draft.tokens[head.at + 1 :][:2]
    is_owned = group.article in ("its", "his", "her", "their")
    is_role = thing["noun"] == "person" and head.text != "person"
    is_role &= head.text != thing.get("word", head.text) and thing.get("word") != "person"
    is_other = bool(after) and after[0].text in word_set("things", "elsewhere")
    is_other &= not (after[1:] and after[1].has("articles", "pronouns", "noun", "field"))
    return (is_owned or group.article == "the") and not (is_role or is_other)


def leave_places(draft: SceneDraft, picked: Sequence[int], after: Sequence[Phrase | Token]) -> None:
    """Take some of several away from where all were: "two on a desk, one on the floor"."""
    words = (one.preposition for one in after if isinstance(one, Phrase))
    kinds = {sense.value for word in words for sense in word.all("relation")}
    for thing in (draft.things[index] for index in picked if kinds & PLACING):
        thing["relations"] = [one for one in thing["relations"] if one["kind"] not in PLACING]
