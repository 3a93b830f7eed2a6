"""Words of grammar: they join, point or introduce, and need no effect of their own."""

from __future__ import annotations

from texvent.scenes.language.phrases.moods import MANNERS, MOODS
from texvent.scenes.language.words.english import Pos

DETERMINERS = (
    "a", "an", "the", "this", "that", "these", "those", "its", "their", "his", "her", "our", "my",
    "your", "another", "each", "every", "all", "any", "other", "the other", "both", "one another",
    "such",
)  # fmt: skip
DEFINITE = ("the", "this", "that", "these", "those", "its", "their", "his", "her")
"""Determiners of a thing that may have been named before."""

PRONOUNS = (
    "it", "they", "he", "she", "them", "him", "her", "itself", "themselves", "himself", "herself",
    "they all", "they both", "all of them", "both of them", "them all", "them both",
    "i", "we", "us", "me", "you", "one another", "each other", "there", "here", "someone",
    "somebody", "everyone", "nothing", "something", "everything",
)  # fmt: skip
VIEWERS = ("i", "we", "us", "me", "you")
"""Pronouns of the one who looks: the camera."""
SOMEONE = ("someone", "somebody", "everyone")
"""Pronouns of a person who is not named."""
UNNAMED = ("nothing", "something", "everything")
"""Pronouns of things that are not named."""
NOBODY = ("nobody", "no one")

NEGATIONS = (
    "no", "without", "without any", "with no", "with no other", "no other", "without other",
    "without any other", "not any", "not a", "no more", "not", "never", "free of", "neither",
    "there are no", "there is no", "n't", "nobody", "no one", "empty of",
)  # fmt: skip
CONTRASTS = ("but", "only", "just")
"""Words after which a negation no longer holds: "no cars, only bicycles"."""

FUNCTION_WORDS: dict[Pos, tuple[str, ...]] = {
    Pos.DETERMINER: DETERMINERS,
    Pos.PRONOUN: PRONOUNS,
    Pos.NEGATION: NEGATIONS,
    Pos.CONJUNCTION: ("and", "or", "plus", "but", "as well as", "nor", "only", "just"),
    Pos.SUBORDINATOR: (
        "while", "as", "when", "whenever", "until", "till", "because", "if", "though", "although",
        "so that", "before", "after", "once", "since", "where", "whereas", "just as", "even as",
        "so", "than", "then", "and then", "afterwards", "finally", "at first", "first", "next",
        "later", "and finally", "followed by", "followed closely by", "closely followed by",
    ),
    Pos.RELATIVE: ("which", "who", "whose", "that", "whom"),
    Pos.AUXILIARY: (
        "is", "are", "was", "were", "be", "been", "being", "am", "has", "have", "had", "having",
        "can", "could", "will", "would", "may", "might", "must", "should", "do", "does", "did",
        "gets", "get", "getting", "got", "begins to", "begin to", "starts to", "start to", "begins",
        "starts", "keeps", "keep", "trying to", "tries to", "try to", "attempting to",
        "attempts to", "beginning to", "starting to", "continues to", "continuing to",
        "continue to",
    ),
    Pos.TO: ("to",),
    Pos.NOUN: (
        "scene", "shot", "view", "video", "clip", "footage", "image", "photo", "photograph",
        "picture", "frame", "sight", "kind", "sort", "type", "sequence", "recording", "example",
        "viewpoint", "perspective", "angle", "motion", "film", "gesture", "hand gesture", "tableau",
        "snapshot", "portrayal", "depiction",
    ),
    Pos.ADJECTIVE: (
        "beautiful", "nice", "photorealistic", "pretty", "realistic", "visible",
        "detailed", "high quality", "high resolution", "plain", "quiet", "silent", "noisy", "loud",
        "favourite", "favorite", "famous", "expensive", "cheap", "delicious", "tasty", "own",
        *sorted(MOODS),
    ),
    Pos.ADVERB: (
        "also", "here", "how", "please", "quite", "really", "so", "too", "very", "why",
        "somewhat", "almost", "again", "silently", "quietly", "loudly", "noisily",
        "from a standstill", "from standstill", "from rest", "extremely", *sorted(MANNERS),
    ),
    Pos.VERB: (
        "show", "shows", "showing", "shown", "depicts", "depicting", "depict", "features",
        "featuring", "feature", "create", "generate", "render", "see", "seen", "appears", "appear",
        "filmed", "film", "captured", "capture", "captures", "taken", "recorded", "imagine",
        "watch", "contains", "containing", "set", "located", "placed", "positioned", "there is",
        "there are", "there s",
    ),
}  # fmt: skip
"""Part of speech → words of it."""

TIME_ORDER: dict[str, str] = {
    **dict.fromkeys(
        ("then", "and then", "afterwards", "finally", "next", "later", "until", "till", "before",
         "and finally", "followed by"),
        "after",
    ),
    **dict.fromkeys(("after", "once"), "before"),
}  # fmt: skip
"""Subordinator → whether the clause it opens comes "after" or "before" the one it belongs to;
the others happen at the same time."""
SENTENCE_OPENERS = ("first", "at first", "then", "and then", "next", "later", "finally")
_HAPPENINGS = """
    finale startup calibration trick walkthrough rotation insertion splash action activity
    experiment test demo demonstration trial practice practise training session workout exercise
    routine performance show display race match game competition contest tournament final derby
    parade ceremony celebration festival event scenario simulation measurement inspection
    maintenance repair assembly operation process procedure production movement dynamics
    behaviour behavior interaction navigation tracking detection recognition segmentation
    localization odometry slam dataset sample evaluation setup benchmark vibration oscillation
    flicker acceleration deceleration expansion contraction deformation collision impact launch
    takeoff landing liftoff arrival departure approach escape hunt feeding migration breakdown
    failure malfunction ignition combustion explosion release deployment delivery transport
    sorting packing exit entrance entry closeup macro reveal flyover flyby flythrough tour trip
    commute ride spin stunt attempt attack defence defense
"""
HAPPENINGS = frozenset(_HAPPENINGS.split())
"""Nouns of what happens to the thing before them, or why it is filmed: "fireworks finale"."""
