"""Words of a clause that mean something else where they stand, put right before it is read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.language.grammar.syntax import Clause, NounGroup, PrepPhrase
from texvent.scenes.language.meaning.acts.activities import PORTIONS, base_form, find_activity
from texvent.scenes.language.meaning.acts.hand_work import DRINKS, list_goals
from texvent.scenes.language.meaning.acts.looking import LOOKS, LOOKS_TO
from texvent.scenes.language.vocabulary.acts import LIGHT_VERBS
from texvent.scenes.language.vocabulary.named_acts import DONE, NAMED, SAME_AS_VERB
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import mark_used
from texvent.scenes.models.effects import LIQUID_COLOURS
from texvent.scenes.models.people.acts.words import AT_HEAD, EVERYDAY
from texvent.scenes.models.people.pastimes.words import BRINGING
from texvent.scenes.models.people.work.verbs import HANDWORK, ONTO, WITH_PARTICLE

_JUGGLE = "juggle"
_BALLS_JUGGLED = 3
_VERTICAL = frozenset({"fall", "sink", "rise", "fly", "jump", "topple"})
_POURED = frozenset(
    {"sprinkle", "pour", "drizzle", "scatter", "dust", "drip", "shine", "light", "illuminate",
     "shower", "spray", "dangle", "hang", "lower", "attack", "reach", "land", "descend"}
)  # fmt: skip
"""Verbs of things that come from above, besides those of motion."""
_DONE_FROM = frozenset(
    {"push", "pull", "attack", "approach", "hug", "grab", "hit", "catch", "watch", "look", "come",
     "light", "pass", "overtake", "arrive", "appear", "blow", "swoop", "tackle", "strike", "kick",
     "sneak", "creep", "throw", "embrace", "hold", "lift", "ram", "chase", "call", "shout",
     "observe", "bite", "kiss", "tap", "touch", "enter", "guard", "stare", "peck"}
)  # fmt: skip
"""Verbs of which "from behind" says whence it is done."""
_SIDES = frozenset({"from above", "from below", "from behind", "from the side", "from the front",
                    "from the back", "from the rear"})  # fmt: skip
_FROM = {"from above": "down", "from below": "up"}


def is_likeness(clause: Clause) -> bool:
    """As in "a shelf set up as a bar", "dressed as a clown": no second thing is there."""
    first = clause.subjects[0] if clause.subjects else None
    is_as = clause.opener is not None and clause.opener.text == "as"
    is_one = first is not None and first.determiner is not None
    return is_as and is_one and clause.verb is None and not clause.auxiliaries


def rewrite_objects(clause: Clause) -> None:
    """Put right what the verb and its objects mean together."""
    take_juggled(clause)
    take_particle(clause)
    take_made(clause)
    take_named_act(clause)


def rewrite_phrases(clause: Clause) -> None:
    """Put right what the verb and its prepositional phrases mean together."""
    take_vessel(clause)
    take_climbed(clause)
    drop_ground(clause)
    take_partners(clause)


def take_named_act(clause: Clause) -> None:
    """As in "does a wheelie", "makes a U-turn", "takes a turn": the noun says what is done."""
    if clause.verb is None or clause.verb.lemma not in DONE or len(clause.objects) != 1:
        return
    group = clause.objects[0]
    verb = group.head.read_as(Role.VERB) if group.head is not None else None
    if group.head is None or verb is None or group.head.text not in NAMED | SAME_AS_VERB:
        return
    form = clause.verb.meaning.form
    clause.verb.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)
    group.head.meaning = replace(verb, form=form)
    clause.verb, clause.objects = group.head, []
    # As "quick" in "makes a quick U-turn".
    clause.adverbs.extend(word for word in group.modifiers if word.role is Role.PACE)


def turn_active(clause: Clause) -> None:
    """As in "wine poured by a waiter", "a shirt being ironed": hand work that someone does.

    Without "by" or "being", only what is poured or sprinkled is an act: a plate that is put on a
    table lies there.
    """
    verb = clause.verb
    work = HANDWORK.get(verb.lemma) if verb is not None and clause.is_passive else None
    if verb is None or work is None or clause.objects or not clause.subjects:
        return
    agents = [one for one in clause.phrases if one.preposition.text == "by"]
    is_going_on = any(word.text == "being" for word in clause.auxiliaries)
    if not (agents or is_going_on or work.pattern in ONTO):
        return
    verb.meaning = replace(verb.meaning, form=VerbForm.THIRD)
    clause.objects, clause.subjects = clause.subjects, []
    for phrase in agents[:1]:
        phrase.preposition.is_used = True
        clause.phrases.remove(phrase)
        clause.subjects = phrase.groups
    clause.auxiliaries, clause.is_participle = [], False


def take_vessel(clause: Clause) -> None:
    """As in "pours tea from a teapot into a cup": the teapot is what the hand holds."""
    if clause.verb is None or clause.verb.lemma not in _POURING or clause.is_passive:
        return
    for group in list(clause.objects):
        is_liquid = group.text == "water" or group.text in LIQUID_COLOURS
        if group.head is not None and is_liquid and clause.phrases:
            group.head.is_used = True  # the stream
            clause.objects.remove(group)
    for phrase in list(clause.phrases):
        heads = [group.head for group in phrase.groups if group.head is not None]
        is_thing = all(head.read_as(Role.NOUN) is not None for head in heads)
        if phrase.preposition.text in ("from", "out of") and heads and is_thing:
            phrase.preposition.is_used = True
            clause.objects[:0] = phrase.groups
            clause.phrases.remove(phrase)


def take_climbed(clause: Clause) -> None:
    """As in "climbs up a tree": it climbs the tree."""
    if clause.verb is None or clause.verb.lemma != "climb" or clause.objects:
        return
    for phrase in list(clause.phrases):
        if phrase.preposition.text == "up" and phrase.groups:
            phrase.preposition.is_used = True
            clause.objects = phrase.groups
            clause.phrases.remove(phrase)


_POURING = frozenset({"pour", "decant", "refill", "spill"})
_DRESSING = ("put on", "putt on")


def _is_activity(clause: Clause) -> bool:
    found = find_activity(clause, is_hand=False)
    return found is not None and found[2]


_TAKING = frozenset({"take", "pick", "grab", "remove", "lift"})
_SOURCES = {"from": "on", "off": "on", "out of": "in"}


BURSTS = frozenset({"explode", "burst", "bloom", "sparkle", "crackle", "erupt"})
"""What fireworks do."""
POPS = frozenset({"pop", "jump", "bounce", "cook"})
"""What popcorn does in a pan."""
_POURS = {**dict.fromkeys(("pour", "flow", "run", "spill", "stream", "trickle", "gush"), "pour"),
          **dict.fromkeys(("drip", "leak"), "drip")}  # fmt: skip


def turn_effects(clause: Clause) -> None:
    """As in "milk pours into a bowl", "a firework explodes", "popcorn pops": no thing does so."""
    if clause.is_passive or clause.objects:
        return
    for group in clause.subjects:
        head, lemma = group.head, clause.verb.lemma if clause.verb is not None else ""
        name = head.lemma.split()[-1] if head is not None else ""
        popping = [word for word in group.modifiers if word.text == "popping"]
        if popping and name == "popcorn":
            lemma = "pop"
            mark_used(popping)
        kind = _POURS.get(lemma) if name in LIQUID_COLOURS else None
        kind = "fireworks" if name.startswith("firework") and lemma in BURSTS else kind
        kind = "popcorn" if name == "popcorn" and lemma in POPS else kind
        if head is not None and kind is not None:
            head.mean(Meaning(Role.EFFECT, Pos.NOUN, kind))


_MADE = {
    "shake off": frozenset({"water", "rain", "snow", "drop"}),
    "drill": frozenset({"hole"}), "bore": frozenset({"hole"}),
    **dict.fromkeys(("draw", "sketch", "trace", "doodle"), frozenset(
        {"picture", "drawing", "sketch", "portrait", "line", "cartoon", "image"})),
}  # fmt: skip
"""Verb of hand work → what comes of it, which is seen with it: holes in a board."""


def take_made(clause: Clause) -> None:
    """As in "drills a hole", "draws a picture": on the board or the paper that comes with it."""
    made = _MADE.get(base_form(clause.verb.lemma), ()) if clause.verb is not None else ()
    if clause.is_passive:
        return
    for group in list(clause.objects):
        if group.head is not None and group.head.lemma in made and not group.phrases:
            mark_used(word for word in group.words if word is group.head)
            clause.objects.remove(group)


def take_particle(clause: Clause) -> None:
    """As in "picks up a ball", "puts the cup down": the particle is of the verb."""
    if clause.verb is None or clause.is_passive:
        return
    sources = [one for one in clause.phrases if one.preposition.text in _SOURCES]
    if clause.verb.lemma in _TAKING and clause.objects and sources:
        # What is taken from a shelf is on it before.
        clause.verb.lemma = "take out"
        preposition = sources[0].preposition
        place = _SOURCES[preposition.text]
        preposition.meaning = Meaning(Role.RELATION, preposition.pos, place)
        return
    for word in list(clause.adverbs):
        whole = f"{clause.verb.lemma} {word.text}"
        if whole in WITH_PARTICLE and clause.objects:
            word.is_used, clause.verb.lemma = True, whole
            clause.adverbs.remove(word)
            return
    for phrase in list(clause.phrases):
        whole = f"{clause.verb.lemma} {phrase.preposition.text}"
        if whole in _DRESSING and not clause.objects and not _is_activity(clause):
            clause.verb.is_lost = phrase.preposition.is_lost = True
            clause.objects.extend(phrase.groups)
            clause.phrases.remove(phrase)
            return
        if whole in WITH_PARTICLE and not clause.objects:
            phrase.preposition.is_used, clause.verb.lemma = True, whole
            clause.objects.extend(phrase.groups)
            clause.phrases.remove(phrase)
            return


def _take_board(clause: Clause) -> None:
    """As in "writes a word on a whiteboard": at its face, not on a page."""
    for phrase in list(clause.phrases):
        heads = {group.head.lemma for group in phrase.groups if group.head is not None}
        if phrase.preposition.text in ("on", "onto", "across") and heads & _WRITTEN_ON:
            phrase.preposition.is_used, clause.verb_word.lemma = True, "chalk"
            clause.verb_word.has_other_sense = True
            clause.objects = phrase.groups
            clause.phrases.remove(phrase)
            return


_WRITING = frozenset({"write", "draw", "sketch", "scribble", "doodle", "scrawl"})
_WRITTEN_ON = frozenset({"whiteboard", "blackboard", "chalkboard", "white board", "black board",
                         "board", "wall"})  # fmt: skip


def take_partners(clause: Clause) -> None:
    """As in "crashes into a wall", "collide with each other": what they meet is the object."""
    if clause.verb is not None and clause.verb.role is Role.CAMERA_MOVE:
        return  # "pulls out from a child" is said of the camera
    if clause.verb is not None and clause.verb.lemma in _WRITING and not clause.is_passive:
        _take_board(clause)
    _turn_into_hit(clause)
    verb = clause.verb.meaning.value if clause.verb is not None else None
    prepositions: tuple[str, ...] = ()
    if isinstance(verb, Verb) and verb.act == "collide":
        prepositions = ("into", "with", "against", "off")
    elif clause.verb is not None and clause.verb.lemma in LOOKS and not clause.objects:
        prepositions = LOOKS_TO
    elif clause.verb is not None and clause.verb.lemma in HANDWORK:
        prepositions = list_goals(clause)
    elif clause.verb is not None and clause.verb.lemma in DRINKS and not clause.objects:
        prepositions = ("from", "out of")
    elif clause.verb is not None and clause.verb.lemma == "climb" and not clause.objects:
        prepositions = ("over",)
    for phrase in list(clause.phrases):
        if phrase.preposition.text in prepositions:
            # Who climbs over a wall is seen to climb it.
            is_whole = phrase.preposition.text != "over" or clause.verb_word.lemma != "climb"
            phrase.preposition.is_used, phrase.preposition.is_lost = is_whole, not is_whole
            clause.objects.extend(phrase.groups)
            clause.phrases.remove(phrase)


_UP = frozenset(
    {"take off", "lift off", "rise", "launch", "pick", "pick up", "lift", "jump", "leap", "get up",
     "stand up", "grab", "bounce"}
)  # fmt: skip
"""What begins on the ground anyway."""


def drop_ground(clause: Clause) -> None:
    """As in "takes off from the ground", "picks up a box from the floor": where things are."""
    if clause.verb is None or base_form(clause.verb.lemma) not in _UP:
        return
    for phrase in list(clause.phrases):
        heads = [group.head.text for group in phrase.groups if group.head is not None]
        if phrase.preposition.text in ("from", "off") and heads in (["ground"], ["floor"]):
            mark_used([phrase.preposition, *(w for group in phrase.groups for w in group.words)])
            clause.phrases.remove(phrase)


_GOING_INTO = frozenset({"roll", "slide", "drive", "fly", "walk", "run", "bounce", "skate"})
_SOLID = frozenset(
    {"wall", "fence", "pole", "post", "lamppost", "pillar", "column", "rock", "boulder", "iceberg",
     "barrier", "target", "dartboard", "hydrant", "window", "mirror", "tree", "trunk"}
)  # fmt: skip
"""What one does not get into."""
_VEHICLES = frozenset({"car", "bus", "truck", "van", "lorry", "train", "bicycle", "motorcycle"})


def _turn_into_hit(clause: Clause) -> None:
    """As in "rolls into a wall", "bounces off a wall", "drives into a tree": it meets it."""
    verb = clause.verb.meaning.value if clause.verb is not None else None
    if not isinstance(verb, Verb) or verb.kind not in _GOING_INTO or clause.negation is not None:
        return
    for phrase in clause.phrases:
        heads = {group.head_word.lemma.split()[-1] for group in phrase.groups if group.head}
        is_met = phrase.preposition.text == "into" and verb.kind != "bounce"
        if verb.kind == "bounce":
            is_met = phrase.preposition.text in ("off", "against")
        solids = _SOLID | _VEHICLES if verb.kind in ("drive", "slide", "roll") else _SOLID
        if is_met and heads & solids:
            meant = replace(verb, act="collide", relation=None)
            clause.verb_word.meaning = replace(clause.verb_word.meaning, value=meant)
            return


def turn_views(clause: Clause) -> None:
    """As in "a ball drops from above": the ball does, not the camera."""
    if clause.verb is None:
        return
    if any(word.text in _OVERTURNED for word in clause.adverbs) and clause.verb.lemma != "flip":
        # As in "turns a bottle upside down": no turn about its axis.
        clause.verb.meaning = Meaning(Role.UNKNOWN, Pos.VERB, None, clause.verb.meaning.form)
        return
    verb = clause.verb.meaning.value
    is_vertical = isinstance(verb, Verb) and verb.kind in _VERTICAL
    if not is_vertical and clause.verb.lemma not in _POURED:
        _lose_sides(clause, clause.verb.lemma)
        return
    for word in clause.adverbs:
        if word.role is Role.VIEW and word.text in _FROM:
            word.meaning = Meaning(Role.DIRECTION, word.pos, _FROM[word.text])


def _lose_sides(clause: Clause, verb: str) -> None:
    """As in "pushes a child from behind": not where the camera is, and not shown."""
    is_of_camera = any(
        one.head is not None and one.head.role in (Role.CAMERA, Role.FUNCTION)
        for one in clause.subjects
    )
    if verb not in _DONE_FROM or is_of_camera:
        return
    for word in clause.adverbs:
        if word.role is Role.VIEW and word.text in _SIDES:
            word.meaning, word.is_lost = Meaning(Role.UNKNOWN, word.pos), True


_OVERTURNED = ("upside down", "inside out", "right side up")
_COMES_WITH = frozenset(
    {*AT_HEAD, *EVERYDAY, *BRINGING, "phone", "text", "play drums", "play chess",
     "play video games", "serve", "dunk",
     "flip pan", "bowl", "tug of war", "skip rope", "hula hoop", "archery", "mow"}
)  # fmt: skip
"""Activities that bring the thing that their phrase names."""


def list_brought(clause: Clause, *, is_hand: bool = False) -> list[NounGroup]:
    """As in "dunks a basketball": the one that comes with the activity, and no other.

    A hand that "makes a fist" is no second hand.
    """
    if clause.verb is None or clause.is_passive:
        return []
    found = find_activity(clause, is_hand=is_hand)
    is_named = is_hand or clause.verb.lemma in LIGHT_VERBS
    if found is None or not found[2] or not (is_named or found[0] in _COMES_WITH):
        return []
    within = [group for phrase in clause.phrases for group in phrase.groups]
    return [
        group
        for group in (*clause.objects, *within)
        if any(one is group.head for one in found[1])
        and (not group.phrases or group.head_word.lemma in PORTIONS)
    ]


def list_other_phrases(clause: Clause, brought: Sequence[NounGroup]) -> list[PrepPhrase]:
    """Phrases of a clause that name nothing of what is brought."""
    return [
        phrase
        for phrase in clause.phrases
        if not any(group is one for group in phrase.groups for one in brought)
    ]


def take_juggled(clause: Clause) -> None:
    """As in "juggles three oranges": three balls, which the juggler has, and no others."""
    if clause.verb is None or clause.verb.lemma != _JUGGLE:
        return
    for group in clause.objects:
        for word in group.words:
            word.is_used = word is group.head or word.meaning.value == _BALLS_JUGGLED
        if group.head is not None and "ball" not in group.head.text:
            group.head.shown_as = "ball"
    clause.objects = []
