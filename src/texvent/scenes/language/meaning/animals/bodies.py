"""What animals do with all of the body: walk, lie, rear, join a herd, spray themselves."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.animals.mouths import LYING
from texvent.scenes.language.meaning.animals.words import (
    OWN,
    find_animal,
    find_verb,
    is_own,
    list_heads,
    say,
    split_words,
)
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.protocol import Noun

_TAKING = split_words("take enjoy have")


_TAKEN = {"walk": "walk", "stroll": "stroll", "run": "run", "jog": "jog", "swim": "swim",
          "nap": "sleep", "snooze": "sleep", "rest": "lie", "leap": "leap",
          "hop": "hop"}  # fmt: skip
"""What one takes → the verb that says it."""


_UP = split_words("sky skies ceiling stars star moon sun clouds cloud top treetops")


_LOOKING = split_words("look stare gaze peer")


_RAISING = split_words("point raise lift tilt turn stretch crane hold")


_SPRAYING = split_words("spray shower splash douse squirt bathe cool")


_HERDS = split_words("herd flock pack group pride kind")


_MET = 4
"""How many a herd has that one runs to join."""


def take_act(clause: Clause) -> bool:
    """As in "takes a peaceful walk", of people and animals."""
    verb, group = clause.verb, clause.objects[0] if len(clause.objects) == 1 else None
    if verb is None or verb.lemma not in _TAKING or group is None or group.head is None:
        return False
    act = _TAKEN.get(group.head.text)
    if act is None or group.owner is not None:
        return False
    form, head = verb.meaning.form, group.head
    verb.meaning, verb.is_used = Meaning(Role.FUNCTION, Pos.AUXILIARY), True
    head.mean(Meaning(Role.VERB, Pos.VERB, find_verb(act), form))
    head.lemma = act
    clause.verb, clause.objects = head, []
    clause.adverbs.extend(group.modifiers)
    return True


def go_to_herd(clause: Clause, animal: str) -> bool:
    """As in "runs towards a herd of its kind"."""
    kinds = [one for one in clause.objects if one.head is not None and one.head.lemma == "kind"]
    for phrase in clause.phrases if kinds else ():
        group = phrase.groups[0] if phrase.groups else None
        counts = [] if group is None else [one for one in group.words if one.role is Role.COUNT]
        if group is None or group.head not in (None, *counts) or not counts:
            continue
        _mean_herd(kinds[0].head_word, counts[0], animal)
        mark_used(word for word in kinds[0].words if word.role is Role.FUNCTION)
        group.modifiers, group.head = counts[:1], kinds[0].head
        clause.objects.remove(kinds[0])
        return True
    return False


def _mean_herd(word: Word, count: Word, animal: str) -> None:
    """The word means some of those animals."""
    word.mean(Meaning(Role.NOUN, Pos.NOUN, animal))
    word.lemma = f"{animal}s"
    count.meaning = replace(count.meaning, value=_MET)


def lie(clause: Clause) -> bool:
    """As in "rests on a bed", "laying on a couch"."""
    verb = clause.verb_word
    if verb.lemma not in LYING or clause.objects:
        return False
    say(verb, "lie")
    verb.lemma = "lie"
    return True


def spray(clause: Clause, following: Clause | None) -> bool:
    """As in "sprays itself with water using its trunk", "sprays water with its trunk"."""
    is_sprayed = any(is_own(one) or one.text == "water" for one in clause.objects)
    if clause.verb_word.lemma not in _SPRAYING or not is_sprayed or not clause.subjects:
        return False
    animal = clause.subjects[0].head
    if animal is None or animal.meaning.value not in ("elephant", "upright elephant"):
        return False
    say(clause.verb_word, "spray")
    for group in clause.objects:
        mark_used(group.words)
    clause.objects = []
    for phrase in list(clause.phrases):
        if [group.text for group in phrase.groups] == ["water"]:
            mark_used([phrase.preposition, *phrase.groups[0].words])
            # The spray is that water, and no lake.
            phrase.groups[0].head_word.meaning = Meaning(Role.FUNCTION, Pos.NOUN)
            clause.phrases.remove(phrase)
    if following is not None and following.verb is not None and following.verb.lemma == "use":
        parts = [word for group in following.objects for word in group.words]
        if any(word.lemma in OWN for word in parts):
            mark_used([following.verb, *parts])
            following.verb.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
            following.verb, following.objects, following.subjects = None, [], []
            following.hosts = []
    return True


def look_up(clause: Clause) -> bool:
    """As in "looks up", "stares at the ceiling", "points its head towards the sky"."""
    lemma = clause.verb_word.lemma
    goes_up = [word for word in clause.adverbs if word.text in ("up", "upward", "upwards")]
    goals = [one for one in clause.phrases if {head.lemma for head in list_heads(one)} & _UP]
    heads = [group for group in clause.objects if group.head is not None and (
        group.head.text in ("head", "neck", "nose"))]  # fmt: skip
    is_look = lemma in _LOOKING and not clause.objects
    is_raised = lemma in _RAISING and bool(heads) and len(heads) == len(clause.objects)
    if not (is_look or is_raised) or not (goes_up or goals):
        return False
    say(clause.verb_word, "look up")
    mark_used([*goes_up, *(word for group in heads for word in group.words)])
    mark_used(one.preposition for one in goals)
    mark_used(head for one in goals for head in list_heads(one) if head.role is Role.UNKNOWN)
    clause.objects = []
    clause.adverbs = [word for word in clause.adverbs if word not in goes_up]
    return True


def rear_up(clause: Clause) -> bool:
    """As in "stands on its hind legs"."""
    for phrase in list(clause.phrases):
        words = {word.text for group in phrase.groups for word in group.words}
        legs = words & {"legs", "feet", "paws"} and words & {"hind", "back", "rear", "two"}
        if clause.verb_word.lemma in ("stand", "rear") and phrase.preposition.text == "on" and legs:
            say(clause.verb_word, "rear")
            mark_used([phrase.preposition, *(w for group in phrase.groups for w in group.words)])
            clause.phrases.remove(phrase)
            return True
    return False


def drop_role(clause: Clause, following: Clause | None) -> bool:
    """As in "works as a lifeguard": no lifeguard stands beside it, and its work is not shown."""
    if following is None or following.opener is None or following.opener.text != "as":
        return False
    if following.verb is not None or len(following.subjects) != 1:
        return False
    if clause.verb_word.lemma not in ("work", "serve", "act", "pose", "dress", "disguise"):
        return False
    role, group = following.subjects[0].head, following.subjects[0]
    if role is None:
        return False
    role.lose(Pos.NOUN)
    clause.phrases.extend(group.phrases)
    clause.phrases.extend(following.phrases)
    group.phrases, following.phrases = [], []
    return True


def build_nest(clause: Clause) -> bool:
    """As in "builds a nest": it puts its beak to it."""
    heads = [group.head.lemma for group in clause.objects if group.head is not None]
    if clause.verb_word.lemma not in ("build", "make", "weave", "construct") or "nest" not in {
        head.split()[-1] for head in heads
    }:
        return False
    say(clause.verb_word, "peck")
    return True


def give_to_wearers(clauses: Sequence[Clause]) -> None:
    """As in "wearing jeans and a hat riding a bicycle": who wears them rides, not the hat."""
    for before, clause in itertools.pairwise(clauses):
        verb = before.verb
        if verb is None or verb.lemma != "wear" or not clause.is_participle or not before.subjects:
            continue
        worn = [group for group in clause.subjects if _is_worn(group)]
        if worn and len(worn) == len(clause.subjects) and clause.sentence == before.sentence:
            before.objects = [*before.objects, *(one for one in worn if one not in before.objects)]
            clause.subjects, clause.hosts = list(before.subjects), []


def _is_worn(group: NounGroup) -> bool:
    meaning = group.head.meaning if group.head is not None else None
    return meaning is not None and meaning.role is Role.NOUN and meaning.value in WEARABLE


def sit_on_swing(clause: Clause) -> bool:
    """As in "plays on a swing": who does sits there, and the swing goes to and fro."""
    verb = clause.verb
    if verb is None or verb.lemma not in ("play", "swing", "ride") or clause.objects:
        return False
    for phrase in clause.phrases:
        names = {str(head.meaning.value) for head in list_heads(phrase)}
        if phrase.preposition.text == "on" and names & {"swing", "seesaw"}:
            say(verb, "sit")
            return True
    return False


def mean_parents(clauses: Sequence[Clause], nouns: Mapping[str, Noun]) -> None:
    """As in "a baby elephant near its mother": a grown animal of its kind, no woman."""
    young = ""
    for clause in clauses:
        for group in clause.subjects:
            animal = find_animal(group, nouns)
            young = animal if animal in GROWN else young
        phrases = [*clause.phrases, *(one for group in clause.subjects for one in group.phrases)]
        groups = [*clause.objects, *(one for phrase in phrases for one in phrase.groups)]
        for group in groups if young else ():
            owner = group.determiner.text if group.determiner is not None else ""
            if group.head is None or group.head.text not in _PARENTS or owner not in _ITS:
                continue
            grown = GROWN[young]
            group.head.meaning = Meaning(Role.NOUN, Pos.NOUN, grown)
            group.head.others, group.head.lemma = (), f"grown {grown}"
            if group.determiner is not None:
                group.determiner.is_used = True
                group.determiner = None  # it is another one than the young one


_PARENTS = split_words("mother mom mum mama father dad parent")
_ITS = split_words("its their his her")
GROWN = {
    "elephant calf": "elephant", "calf": "cow", "lamb": "sheep", "foal": "horse", "piglet": "pig",
    "kitten": "cat", "puppy": "dog", "fawn": "deer", "bear cub": "bear", "lion cub": "lioness",
    "tiger cub": "tiger", "panda cub": "panda", "wolf pup": "wolf", "fox cub": "fox",
    "kid goat": "goat", "duckling": "duck", "chick": "chicken",
}  # fmt: skip
"""Young animal → the grown one."""
