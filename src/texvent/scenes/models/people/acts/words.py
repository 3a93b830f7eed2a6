"""Words of what people do at their own head, in the gym, in play, and with each other."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.people.acts.activity import (
    Activity,
    at_head,
    done_to,
    seen_from_side,
    sideways_at_head,
)
from texvent.scenes.models.people.pastimes.words import COMPOUNDS, PASTIMES

_HAIRY = "beard|mustache|moustache|face|chin|cheek|cheeks|head|stubble"
_MAKEUP = "makeup|make up|make-up|blush|powder"
_ON_FACE = "mascara|eyeliner|eyeshadow|eye shadow|foundation|face cream|sunscreen|face paint"

AT_HEAD: dict[str, Activity] = {
    "shave": at_head("shave", *done_to("shave|trim", _HAIRY)),
    "brush teeth": at_head(*done_to("brush|clean|floss", "teeth|tooth")),
    "comb hair": at_head(*done_to("comb|brush|detangle", "hair|long hair|beard"),
                         near=done_to("style|straighten|curl|fix", "hair|long hair|beard")),
    "dry hair": at_head(*done_to("dry|blow dry|blow-dry", "hair"), "blow dry"),
    "put on makeup": at_head(*done_to("put on|apply|wear|do|touch up", _MAKEUP),
                             near=done_to("put on|apply|wear|do|touch up", _ON_FACE)),
    "put on lipstick": at_head(*done_to("put on|apply", "lipstick"),
                               near=done_to("put on|apply", "lip balm|lip gloss")),
    "wash face": at_head(*done_to("wash|rinse|splash|scrub|cleanse|rub", "face|eyes|eye")),
    "wash hair": at_head(*done_to("wash|shampoo|lather|rinse", "hair"),
                         near=("massage scalp",)),
    "wipe face": at_head(*done_to("wipe|dab|mop|dry", "forehead|brow|sweat|face|mouth|eyes|tears"
                                  "|nose"), near=done_to("blow|pick|scratch|touch", "nose")),
    "scratch head": at_head(*done_to("scratch|touch", "head|ear|face|chin|hair")),
    "facepalm": at_head("facepalm"),
    "sneeze": at_head("sneeze"),
    "yawn": at_head("yawn",),
    "cry": at_head("cry", "weep", "sob"),
    "laugh": at_head("laugh", "giggle", "chuckle", "burst out laughing"),
    "shout": at_head("shout", "yell", "scream", "call out"),
    "smoke": at_head("smoke", "smoke cigarette", near=("vape", "smoke cigar", "smoke pipe")),
    "blow bubbles": seen_from_side(*done_to("blow|make", "bubble|bubbles|soap bubble"
                                            "|soap bubbles")),
    "blow whistle": at_head(*done_to("blow|blow into|whistle with", "whistle")),
    "turn head": at_head(*done_to("turn|move|rotate", "head"), "look around", "look left and right",
                         "look from side to side", "look to the left and to the right",
                         "look over shoulder"),
    "nod": at_head("nod", "nod the head", *done_to("bob|bang", "head")),
    "shake head": at_head("shake the head", "shake head"),
    "shrug": at_head("shrug", *done_to("shrug", "shoulder|shoulders")),
}  # fmt: skip
"""Done by hands at the own head, or by the head."""

EXERCISES: dict[str, Activity] = {
    "plank": Activity((*done_to("hold|do|perform", "plank|planks"),), is_sideways=True,
                      is_still=True),
    "pull-up": Activity(("pull-up", "chin-up", *done_to("do|perform",
                         "pull-up|pull-ups|pullup|pullups|chin-up|chin-ups"))),
    "cartwheel": Activity(("cartwheel", *done_to("do|perform|turn", "cartwheel|cartwheels"))),
    "handstand": seen_from_side("handstand", *done_to("do|perform|hold", "handstand|handstands|"
                                "headstand"), "stand on hands", "walk on hands"),
    "somersault": seen_from_side("somersault", *done_to("do|perform|turn", "somersault|somersaults"
                                 "|forward roll"), "roll forward"),
    "flip": seen_from_side("backflip", "do a flip", *done_to("do|perform", "backflip|backflips"
                           "|back flip|flips|front flip")),
    "skip rope": Activity(("skip rope", "jump rope", "jump a rope", "skip with a rope", "skip")),
    "hula hoop": Activity(("hula hoop", "hula-hoop", "spin a hula hoop", "twirl a hula hoop",
                           "use a hula hoop", "play with a hula hoop", "swing a hula hoop")),
    "run in place": seen_from_side("run in place", "jog in place", "run on the spot",
                                   "jog on the spot", "do high knees"),
    "deadlift": seen_from_side("deadlift", *done_to("do|perform", "deadlift|deadlifts")),
    "yoga": Activity((*done_to("do|practice|practise|perform", "yoga|tree pose"),)),
    "ballet": Activity((*done_to("do|dance|practice|practise|perform", "ballet"), "pirouette",
                        "do a pirouette", "do pirouettes")),
    "karate": seen_from_side(*done_to("do|practice|practise|perform", "karate|taekwondo"
                             "|kung fu|martial arts"), near=("kickbox", *done_to(
                             "do|practice|practise|perform", "kickboxing|judo"))),
    "fence": seen_from_side("sword fight", *done_to("swing|wave|wield", "sword|lightsaber"
                            ), *done_to("fight|duel", "with swords|with a sword"), "duel"),
    "archery": seen_from_side(*done_to("shoot|release|draw", "arrow|arrows|bow|bow and arrow"
                              "|with a bow"), "do archery", "practice archery"),
    "bowl": seen_from_side("bowl", "go bowling", "play bowling", "throw a bowling ball",
                           "roll a bowling ball"),
    "serve": seen_from_side("serve", "serve a tennis ball", "serve a ball", "hit a serve",
                            "do a tennis serve",
                            "tennis serve", "play a serve"),
    "dunk": seen_from_side("dunk", "slam dunk", *done_to("dunk|slam", "ball|basketball"),
                           "do a dunk", "do a slam dunk"),
    "mow": Activity(("mow", *done_to("mow|cut", "lawn|grass"), "push a lawn mower",
                          "push a lawnmower", "push a mower"),
                    travels=True, is_sideways=True),
    "flip pan": seen_from_side(*done_to("flip|toss", "pancake|pancakes|omelette|crepe|egg|burger")),
    "jackhammer": seen_from_side("jackhammer", *done_to("use|operate|work with", "jackhammer"
                                 "|pneumatic drill")),
}  # fmt: skip
"""Done with the whole body; what it needs comes with it."""

MUSIC: dict[str, Activity] = {
    "play cello": seen_from_side("play cello",
                                 near=done_to("play", "double bass|contrabass")),
    "play harp": seen_from_side(*done_to("play", "harp")),
    "play accordion": Activity((*done_to("play", "accordion|concertina"),)),
    "play chess": seen_from_side(*done_to("play", "chess|board game|game of chess"),
                                 near=done_to("play", "checkers|cards|card game|poker"
                                              "|playing cards")),
    "play video games": seen_from_side(*done_to("play", "video game|video games|computer game"
                                  "|computer games|console|playstation|xbox|controller"
                                  "|game controller|gamepad|joystick"),
                                *done_to("play game with|play video game with", "controller"
                                         "|game controller|remote controller")),
}  # fmt: skip

PAIRED: dict[str, Activity] = {
    "hug": Activity(("hug", "embrace")),
    "kiss": Activity(("kiss", "kiss each other")),
    "shake hands": Activity(("shake hand", "shake hands", "handshake")),
    "high five": Activity(("high five", "high-five", "give a high five", "give high five",
                           "give high fives", "exchange a high five", "exchange high fives",
                           "give each other high five", "give each other a high five",
                           "slap hands")),
    "wrestle": Activity(("wrestle", "grapple")),
    "arm wrestle": Activity(("arm wrestle", "arm-wrestle")),
    "argue": Activity(("argue", "quarrel", "bicker", "have an argument",
                       "have argument", )),
    "tango": Activity(("dance together", "slow dance", "tango", "tango dance",
                       *done_to("dance|do|perform", "tango")),
                      ("waltz", *done_to("dance|do|perform",
                                         "salsa|waltz|ballroom|rumba|bachata"))),
    "give": Activity(()),
    "receive": Activity(()),
    "show fists": Activity((), done_to("play|do", "rock paper scissors"
                                                "|rock scissors paper")),
    "tug of war": Activity((*done_to("play|have", "tug of war|tug-of-war"), "tug at a rope",
                            "tug on a rope", "pull on a rope")),
}  # fmt: skip
"""Done by two who stand before each other."""

EVERYDAY: dict[str, Activity] = {
    "conduct": Activity(
        (
            "conduct",
            *done_to("wave|swing|move|raise", "baton|conductor baton"),
            *done_to("conduct|lead", "orchestra|choir|band"),
        )
    ),
    "look through binoculars": at_head(
        *done_to(
            "look through|peer through|gaze through|watch through|use|hold up",
            "binoculars|pair of binoculars|field glasses",
        )
    ),
    "open umbrella": Activity(
        (*done_to("open|put up|unfold|unfurl", "umbrella|parasol"), "open up umbrella")
    ),
    "blow out": sideways_at_head(
        *done_to("blow out|extinguish|puff out|snuff out", "candle|match|flame|birthday candle"),
        *done_to("blow", "candle out|match out"),
        "blow at candle",
        "blow on candle",
    ),
    "turn steering wheel": seen_from_side(
        *done_to(
            "turn|rotate|spin|hold|grip|steer|move|hold on to|grab",
            "steering wheel|car steering wheel",
        )
    ),
    "type on keyboard": seen_from_side(
        *done_to("type on|type at|use|work on|press keys on|hit", "keyboard|computer keyboard"),
        *done_to("use|work on|work at|type on|play on", "computer|desktop computer|pc"),
    ),
    "shoot basket": seen_from_side(
        *done_to("shoot|throw", "basketball|hoop|hoops|basket|baskets|free throw|three pointer"),
        "shoot ball into basket",
        "throw ball into basket",
        "shoot basketball into hoop",
        "throw basketball into hoop",
        "shoot ball into hoop",
        "throw ball into hoop",
    ),
}
"""Done with one thing that comes along."""

MORE_ACTIVITIES: Mapping[str, Activity] = MappingProxyType(
    {**PASTIMES, **AT_HEAD, **EXERCISES, **MUSIC, **PAIRED, **EVERYDAY}
)
"""All of these."""

COMPOUND_VERBS = COMPOUNDS | frozenset(
    {"high five", "hula hoop", "arm wrestle", "sword fight", "slam dunk", "blow dry", "slow dance"}
)
"""Verbs of two words whose last one is inflected: "hula hooping"."""

ACTIVITY_NOUNS = (
    "push up", "pull up", "sit up", "chin up", "press up", "star jump", "jumping jack",
    "tug of war", "forward roll", "back flip", "front flip", "video game", "computer game",
    "board game", "card game", "martial art", "kung fu", "tai chi", "tree pose", "lip balm",
    "lip gloss", "face cream", "face paint", "eye shadow", "slam dunk", "high five",
    "high knee", "handstand", "headstand", "backflip", "deadlift", "cartwheel", "pushup", "pullup",
    "somersault", "pirouette", "pneumatic drill", "double bass", "bow and arrow", "sun screen",
    "rock paper scissors", "ok sign", "okay sign", "peace sign", "victory sign", "rock sign",
    "shaka sign", "kickflip", "ollie", "pom pom", "backbend", "jab",
    "uppercut", "punch", "left hook", "right hook",
)  # fmt: skip
"""Nouns of several words that name what is done, or with what."""
