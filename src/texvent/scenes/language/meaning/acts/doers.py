"""What a word for a person says that the person does: a swimmer swims."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from texvent.scenes.description import RIDES, ObjectMotion, Relation
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.vocabulary.verbs import VERBS
from texvent.scenes.language.words.english import Pos, list_readings
from texvent.scenes.language.words.word import mark_used
from texvent.scenes.models.people.activities import ACTIVITIES, SEATS

_ENDINGS = ("er", "or")
_RIDERS = ("rider", "jockey")


_UPRIGHT = frozenset({"walk", "run", "move", "stand"})


def settle_doings(draft: Draft) -> None:
    """What people do of themselves: they ride, hold what is theirs, do what their name says."""
    mount_riders(draft)
    give_to_owners(draft)
    type_on_laps(draft)
    choose_balls(draft)
    add_doings(draft)
    for number, one in enumerate(draft.relations):
        motions = draft.objects[one.subject].motions
        if one.kind in ("with", "hold") and motions and motions[-1].kind == "paw":
            # As in "a cat plays with a ball of yarn": it is before its paws.
            draft.relations[number] = replace(one, kind="work on")
        if one.kind == "with" and draft.noun(one.subject).motion == "sail" and one.targets:
            # As in "a sailboat with a dog": it is aboard.
            draft.relations[number] = _aboard(draft, one)
        is_upright = not motions or motions[-1].kind in _UPRIGHT
        holds = one.kind == "under" and bool(motions) and is_upright
        holds |= one.kind == "with" and is_upright and is_person(draft.noun(one.subject))
        if holds and _is_umbrella(draft, one.targets):
            # As in "walks under an umbrella", "get caught in the rain with umbrellas".
            draft.relations[number] = replace(one, kind="hold")
            held = draft.objects[one.targets[0]]
            if not held.is_counted:
                held.count = draft.objects[one.subject].count


def _aboard(draft: Draft, one: Relation) -> Relation:
    passengers = [i for i in one.targets if is_living(draft.noun(i))]
    if len(passengers) != 1 or draft.noun(passengers[0]).habitat != "ground":
        return one
    return Relation("on", passengers[0], (one.subject,))


def _is_umbrella(draft: Draft, things: Sequence[int]) -> bool:
    return {draft.noun(index).name for index in things} == {"umbrella"}


def type_on_laps(draft: Draft) -> None:
    """As in "types on a laptop on a couch": no desk stands on a couch."""
    for one in draft.relations:
        motions = draft.objects[one.subject].motions
        is_on_seat = one.kind == "on" and draft.noun(one.targets[0]).name in SEATS
        if is_on_seat and motions and motions[-1].kind == "type":
            motions[-1] = replace(motions[-1], kind="type on lap")


_RESTING = ("sit", "stand")


def talk_on_phone(draft: Draft, subjects: Sequence[int], things: Sequence[int]) -> bool:
    """Let who is "on a cell phone", and does nothing else, talk on it.

    Returns:
        Whether the prompt means that.
    """
    items = [draft.objects[index] for index in subjects if is_person(draft.noun(index))]
    is_phone = bool(things) and draft.noun(things[0]).name == "cell phone"
    if not is_phone or not items or len(items) < len(subjects):
        return False
    if any(motion.kind not in _RESTING for item in items for motion in item.motions):
        return False
    for item in items:
        item.motions[:] = [ObjectMotion("phone")]
    return True


_BALL_OF = {"swing bat": "baseball", "swing racket": "tennis ball", "swing club": "golf ball",
            "dribble": "basketball", "dunk": "basketball"}  # fmt: skip


def choose_balls(draft: Draft) -> None:
    """As in "swings a bat at a ball": the ball is one of that game."""
    kinds = [one.kind for item in draft.objects for one in item.motions if one.kind in _BALL_OF]
    for item in draft.objects:
        if item.noun == "ball" and kinds:
            item.noun = _BALL_OF[kinds[0]]


def mount_riders(draft: Draft) -> None:
    """As in "camels, each rider": a rider rides what is there to ride."""
    taken = {i for one in draft.relations if one.kind in RIDES
             for i in (one.subject, *one.targets)}  # fmt: skip
    for index, item in enumerate(draft.objects):
        if item.said not in _RIDERS or index in taken or item.motions:
            continue
        mounts = (i for i in range(len(draft.objects)) if i not in taken and _is_mount(draft, i))
        for mount in itertools.islice(mounts, 1):
            draft.relate("ride", [index], [mount])
            item.motions.append(ObjectMotion("sit"))
            taken.add(mount)


def _is_mount(draft: Draft, index: int) -> bool:
    noun = draft.noun(index)
    return is_living(noun) and not is_person(noun) and noun.habitat == "ground"


def give_to_owners(draft: Draft) -> None:
    """As in "her basket", "tips his hat": it is at its owner, unless it is said where it is."""
    for index, item in enumerate(draft.objects):
        noun = draft.noun(index)
        is_placed = any(
            one.subject == index or (index in one.targets and one.kind not in _LOOSE)
            for one in draft.relations
        )
        if item.owner is None or is_placed or noun.motion != "stand" or item.motions:
            continue
        owner = _find_owner(draft, item.owner, index)
        if owner is None or draft.length_m(index) > _CARRIED_M:
            continue
        draft.relations[:] = [one for one in draft.relations if index not in one.targets]
        draft.relate("wear" if noun.name in WEARABLE else "hold", [owner], [index])


_LOOSE = ("with", "beside")
_CARRIED_M = 1.0
_OF_WOMEN, _OF_MEN = ("woman", "girl"), ("man",)


def _find_owner(draft: Draft, pronoun: str, item: int) -> int | None:
    """The only person whom the pronoun fits."""
    others = {"her": _OF_MEN, "his": _OF_WOMEN}.get(pronoun, ())
    people = [
        index
        for index in range(len(draft.objects))
        if index != item and is_person(draft.noun(index)) and draft.noun(index).name not in others
    ]
    return people[0] if len(people) == 1 and pronoun in ("her", "his", "their") else None


def add_doings(draft: Draft) -> None:
    """A swimmer swims, unless the prompt says what else it does or rides."""
    riders = {one.subject for one in draft.relations if one.kind in RIDES}
    for index, item in enumerate(draft.objects):
        doing = find_doing(item.said or "")
        is_idle = not item.motions and not item.is_verb_lost and index not in riders
        if doing is not None and is_idle and is_person(draft.noun(index)):
            item.motions.append(ObjectMotion(doing))
            draft.note(f"the {item.said} does what the word says: {doing}")


def tell_by_doings(draft: Draft, subjects: Sequence[Referent]) -> None:
    """As in "a drummer plays the drums": who does what the word says is told by it."""
    for one in subjects:
        head = one.group.head
        for index in one.things if head is not None else ():
            item = draft.objects[index]
            doing = find_doing(item.said or "")
            if head is not None and doing is not None and item.motions[-1:]:
                does = item.motions[-1].kind == doing and is_person(draft.noun(index))
                head.shown_as = None if does else head.shown_as


_MUSIC = frozenset(
    {"solo", "melody", "tune", "song", "piece", "music", "fill", "roll", "riff", "chord", "scale",
     "beat", "rhythm", "note", "concerto", "sonata", "serenade", "groove"}
)  # fmt: skip
"""What is played on any instrument."""


def play_own(draft: Draft, clause: Clause, subjects: Sequence[Referent]) -> bool:
    """As in "a drummer plays a solo": whether musicians play, each the own instrument."""
    verb = clause.verb
    heads = [group.head for group in clause.objects]
    is_music = all(head is not None and head.lemma in _MUSIC for head in heads)
    if verb is None or verb.lemma not in ("play", "perform") or not is_music:
        return False
    played = []
    for one in subjects:
        for index in one.things if one.is_things else ():
            item = draft.objects[index]
            doing = find_doing(item.said or draft.noun(index).name)
            if doing is not None and doing.startswith("play "):
                item.motions.append(ObjectMotion(doing))
                played.append(index)
                if one.group.head is not None and item.said:
                    one.group.head.shown_as = None
    if played:
        words = [verb, *(head for head in heads if head is not None)]
        mark_used(words)
        draft.link_motion(words, played)
    return bool(played)


_DOINGS = {
    "gymnast": "cartwheel", "acrobat": "flip", "weightlifter": "deadlift",
    "powerlifter": "deadlift", "pianist": "play piano",
    "cellist": "play cello", "harpist": "play harp", "trumpeter": "play trumpet",
    "guitarist": "play guitar", "violinist": "play violin", "fiddler": "play violin",
    "flutist": "play flute", "flautist": "play flute", "accordionist": "play accordion",
    "yogi": "yoga", "chess player": "play chess", "typist": "type", "pedestrian": "walk",
}  # fmt: skip
"""Word for a person of which no verb is made → what the person does."""


@lru_cache(maxsize=512)
def find_doing(said: str) -> str | None:
    """The motion or activity of a person of that name; None if the name says none.

    Example:
        >>> find_doing("swimmer"), find_doing("surfer"), find_doing("waiter"), find_doing("worker")
        ('swim', 'surf', None, None)
    """
    if said in _DOINGS:
        return _DOINGS[said]
    if not said.endswith(_ENDINGS):
        return None
    stem = said[:-2]
    for base in (stem, f"{stem}e", stem[:-1] if stem[-1:] == stem[-2:-1] else stem):
        if all(one.pos is not Pos.VERB or one.lemma != base for one in list_readings(base)):
            continue
        if base in ACTIVITIES:
            return base
        for name, activity in ACTIVITIES.items():
            if base in activity.words:
                return name
        for verb in VERBS:
            if verb.base == base and verb.kind in ("walk", "run", "dance", "jump"):
                return verb.kind
    return None
