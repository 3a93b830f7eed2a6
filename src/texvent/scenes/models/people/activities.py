"""Names of what people and hands can do, with the English phrases that mean them.

Loads nothing but the standard library, so that the sentence reader can import it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.models.people.acts.activity import (
    Activity,
    at_head,
    done_to,
    seen_from_side,
    sideways_at_head,
    sign,
)
from texvent.scenes.models.people.acts.words import MORE_ACTIVITIES
from texvent.scenes.models.people.creatures.names import OF_UPRIGHT
from texvent.scenes.models.people.pastimes.words import PASTIMES
from texvent.scenes.models.people.work.verbs import HANDWORK


def _travels(*words: str) -> Activity:
    return Activity(words, travels=True, is_sideways=True)


def _still(*words: str, is_sideways: bool = False) -> Activity:
    return Activity(words, is_sideways=is_sideways, is_still=True)


_GESTURES: dict[str, Activity] = {
    "wave": Activity(("wave", "wave a hand", "wave his hand", "wave her hand")),
    "wave left": Activity(("wave the left hand", "wave with the left hand", "left hand wave")),
    "wave right": Activity(("wave the right hand", "wave with the right hand", "right hand wave")),
    "wave both": Activity(
        ("wave both hands", "wave both arms", "wave the arms", "wave the hands")
    ),
    "clap": at_head(*("clap", "clap hands", "clap the hands", "applaud", "hand clap")),
    "point": Activity(("point", "point a finger")),
    "bow": seen_from_side("bow",),
    "salute": Activity(("salute",)),
    "raise arms": Activity(("raise the arms", "raise arms", "raise both arms", "cheer",
                            "lift the arms"), done_to("pump", "fist|fists")),
    "stretch": Activity(("stretch",)),
    "talk": Activity(("talk", "speak", "chat", "gesticulate", "discuss"),
                     done_to("give|hold|make", "speech|lecture|presentation|talk")),
    "right arm clockwise": Activity(("right arm clockwise", "rotate the right arm clockwise",
                                     "right hand clockwise")),
    "right arm counter-clockwise": Activity(
        ("right arm counter-clockwise", "rotate the right arm counter-clockwise",
         "right hand counter-clockwise", "right arm anticlockwise")),
    "left arm clockwise": Activity(("left arm clockwise", "rotate the left arm clockwise",
                                    "left hand clockwise")),
    "left arm counter-clockwise": Activity(
        ("left arm counter-clockwise", "rotate the left arm counter-clockwise",
         "left hand counter-clockwise", "left arm anticlockwise")),
    "arm roll": Activity(("arm roll", "roll the arms", "forearm roll", "roll the forearms")),
    "air drums": Activity(("air drums", "play air drums", "air drum")),
    "air guitar": Activity(("air guitar", "play air guitar")),
    "other gesture": Activity(("other gesture", "gesture", "make a gesture")),
}  # fmt: skip

_SPORTS: dict[str, Activity] = {
    "jump": Activity(("jump", "hop", "leap", "jump up"), ("play hopscotch",)),
    "dance": Activity(("dance",), ("belly dance", "tap dance", "line dance", "salsa dance",
                                  "swing dance", "jumpstyle dance", *done_to(
                                      "dance|do", "charleston|macarena|gangnam style|samba"
                                      "|twist|jig|hula"))),
    "jumping jack": Activity(("jumping jack", "do a jumping jack", "do jumping jacks",
                              "perform jumping jacks", "star jump"),
                             done_to("do", "aerobics|zumba|calisthenics")),
    "squat": seen_from_side("squat", "do squats"),
    "lunge": seen_from_side("lunge", "do lunges"),
    "push-up": seen_from_side("push-up", "do push-ups", "do pushups", "do press-ups"),
    "sit-up": seen_from_side("sit-up", "do sit-ups", "do situps", "do crunches"),
    "lift": Activity(("lift weights", "lift a weight", "lift a barbell", "do weightlifting")),
    "punch": seen_from_side("punch", *done_to("throw|land|deliver", "punch|jab|hook|uppercut"
                                              "|combination|straight right|left hook")),
    "box": seen_from_side("box", "shadow box"),
    "kick": seen_from_side("kick", near=("play football", "play soccer")),
    "throw": seen_from_side("throw", "toss", "pitch", "hurl",
                            near=("play frisbee", "play catch", "play volleyball", "play ball",
                                  "play fetch")),
    "catch": seen_from_side("catch",),
    "swing bat": seen_from_side("swing a bat", "swing a baseball bat", "swing at ball",
                                "swing at a ball", "swing at a baseball",
                                "swing at a pitch", "bat", near=("play baseball",
                                 "play cricket", "play softball")),
    "swing racket": seen_from_side("swing a racket", "swing a tennis racket",
                                    "swing a racquet", "swing a tennis racquet",
                                    "hit a tennis ball", "return a serve", "play tennis",
                                   near=("play badminton",
                                    "play squash", "play table tennis", "play ping pong")),
    "swing club": Activity(("swing a club", "swing a golf club", "golf", "play golf")),
    "dribble": seen_from_side("dribble", "dribble a ball", "dribble a basketball",
                               "play basketball"),
    "juggle": Activity(("juggle", "juggle balls")),
    "climb": Activity(("climb", "scale"), is_sideways=True),
    "climb down": seen_from_side("climb down",),
    "crawl": _travels("crawl",),
    "swim": Activity(("swim",), ("snorkel", "scuba dive", *done_to(
        "swim", "backstroke|breaststroke|breast stroke|butterfly|butterfly stroke|crawl")),
         travels=True, is_sideways=True),
    "surf": _travels("surf", "ride a wave", "ride the waves", "ride waves", "catch a wave"),
    "skate": _travels("skateboard", "skate", "longboard"),
    "ski": _travels("ski", "go skiing", "cross country ski", "downhill ski"),
    "snowboard": _travels("snowboard",),
    "row oars": seen_from_side("row with oars",),
    "row": seen_from_side("row", "paddle"),
}  # fmt: skip

_DAILY: dict[str, Activity] = {
    "play guitar": Activity(("play guitar", "play the guitar", "strum", "strum a guitar",
                             "play ukulele"), done_to("play|strum", "banjo|mandolin|lute|sitar"
                                                      "|bass")),
    "play drums": Activity(("play drums", "play the drums", "drum")),
    "play piano": seen_from_side("play piano", "play the piano", "play keyboard",
                                  "play the keyboard",
                                  near=done_to("play", "organ|synthesizer|harpsichord")),
    "play violin": at_head("play violin", "play the violin", "fiddle"),
    "play flute": at_head("play flute", "play the flute", "play piccolo",
                          near=done_to("play", "recorder|oboe|pan flute")),
    "play trumpet": sideways_at_head(*done_to("play|blow|blow into", "trumpet|saxophone|clarinet"
                                              "|trombone|oboe|horn")),
    "type": seen_from_side("type", "use a laptop", "work on a laptop", "type on a laptop",
                            "work at a laptop", "use a notebook computer"),
    "write": at_head("write",),
    "read": at_head("read", "read a book", "read a newspaper"),
    "eat": at_head(*("eat", "have lunch", "have dinner", "have breakfast", "dine")),
    "drink": at_head("drink", "sip"),
    "phone": at_head("phone", *done_to("talk on|speak on|chat on|talk into|answer",
                                       "phone|cell phone|telephone|cellphone|mobile phone|mobile"
                                       "|phone call|telephone call"),
                     "make a call", "make a phone call", "listen on phone", "listen to phone",
                     "take a call"),
    "text": at_head("text", *done_to("look at|look on|look down at|stare at|use|check|read|type on"
                                     "|text on|play on|scroll on|play with",
                                     "phone|cell phone|cellphone|smartphone|mobile phone|mobile"
                                     "|iphone|smart phone"),
                    *done_to("look|stare", "phone|mobile")),
    "photograph": at_head("photograph", "film", *done_to("take|snap|shoot|make", "photo|picture|"
                          "photograph|selfie|photos|pictures|photographs|snapshot"),
                          "take a shot", "take shots"),
    "sing": at_head("sing",),
    "dig": seen_from_side("dig", "shovel"),
    "sweep": seen_from_side("sweep",),
    "vacuum": seen_from_side("vacuum", "hoover"),
    "mop": seen_from_side("mop",),
    "rake": seen_from_side("rake",),
    "chop wood": seen_from_side("chop wood", "cut wood", "split wood", "split logs"),
    "cook": seen_from_side("cook", *done_to("cook|prepare|make|fry", "food|meal|dinner|breakfast"
                                            "|lunch|supper|dish")),
    "pull": seen_from_side("pull",),
    "push": seen_from_side("push", "shove"),
    "fish": seen_from_side("fish", "go fishing", near=("ice fish",)),
    "tie shoes": seen_from_side("tie shoes", "tie shoelaces", "tie laces", "tie boots",
                                 "tie sneakers", "lace shoes", "lace boots"),
}  # fmt: skip

_RESTING: dict[str, Activity] = {
    "stand": _still("stand",),
    "sit": _still("sit",),
    "lie": _still("lie", "sleep", is_sideways=True),
    "kneel": _still("kneel", is_sideways=True),
    "crouch": _still("crouch", is_sideways=True),
}  # fmt: skip

_GETTING: dict[str, Activity] = {
    "sit down": seen_from_side("sit down", "take a seat", "have a seat"),
    "stand up": seen_from_side("stand up", "get up", "get to feet", "rise to feet",
                               "jump to feet"),
    "lie down": seen_from_side("lie down",),
    "kneel down": seen_from_side("kneel down", "get down on one knee", "go down on one knee",
                                 "drop to knees", "fall to knees", "get on knees"),
    "crouch down": seen_from_side("crouch down", "squat down", "duck", "duck down"),
    "fall over": seen_from_side("fall over", "fall down", "topple", "topple over", "collapse",
                                "trip", "trip and fall", "faint", "keel over"),
}  # fmt: skip

_ON_FOOT: dict[str, Activity] = {
    "walk": Activity(("walk",), travels=True),
    "run": Activity(("run",), travels=True),
}

ACTIVITIES: Mapping[str, Activity] = MappingProxyType(
    {**{verb: Activity((verb,), is_sideways=work.place != "hands")
        for verb, work in HANDWORK.items()},
     **PASTIMES, **_ON_FOOT, **_RESTING, **_GETTING, **_GESTURES, **_SPORTS, **_DAILY,
     **MORE_ACTIVITIES}
)  # fmt: skip
"""What a person can do: name → activity."""

TRAVELLING = frozenset(name for name, activity in ACTIVITIES.items() if activity.travels)
"""Names of the activities that go from place to place."""

HAND_GESTURES: Mapping[str, Activity] = MappingProxyType(
    {
        "wave": Activity(("wave",)),
        "open and close": Activity(("open and close", "open", "close", "clench", "squeeze")),
        "grasp": Activity(("grasp", "grab", "grip")),
        "fist": sign("fist", words=("clench a fist", "close to a fist", "close into a fist")),
        "point": Activity(("point", "point a finger")),
        "count": Activity(("count", "count to five", "count with its fingers")),
        "thumbs up": sign("thumbs up", "thumb up", "thumbs up sign", words=("thumb up",)),
        "thumbs down": sign("thumbs down", "thumb down", "thumbs down sign"),
        "victory": sign("victory sign", "peace sign", "v sign", "victory", "two fingers",
                        "victory gesture", "peace gesture", "scissors"),
        "ok": sign("ok sign", "ok", "okay sign", "okay", "ok gesture", "okay gesture"),
        "one": sign("one finger", "index finger"),
        "three": sign("three fingers"),
        "four": sign("four fingers"),
        "five": sign("five fingers", "all fingers", "stop sign", "stop gesture", "open palm",
                     "flat palm", "palm"),
        "horns": sign("horns", "horns sign", "rock sign", "sign of the horns", "devil horns",
                      "rock and roll sign", "metal sign"),
        "shaka": sign("shaka", "shaka sign", "call me sign", "hang loose sign"),
        "rotate": Activity(("rotate", "turn", "spin", "twist")),
        "swipe left": Activity(("swipe left", "swipe to the left")),
        "swipe right": Activity(("swipe right", "swipe", "swipe to the right")),
        "swipe up": Activity(("swipe up",)),
        "swipe down": Activity(("swipe down",)),
        "pinch": Activity(("pinch", "zoom")),
        "snap": Activity(("snap", "snap its fingers", "snap fingers")),
        "tap": Activity(("tap", "press", "click", "knock")),
        "type": Activity(("type", "play the piano", "drum its fingers")),
        "rock paper scissors": sign("rock paper scissors", words=("play rock paper scissors",)),
        "stand": Activity(("rest", "keep still"), is_still=True),
    }
)  # fmt: skip
"""What a hand can do: name → gesture."""

DVS_GESTURES: Mapping[str, str] = MappingProxyType(
    {
        "hand clap": "clap",
        "right hand wave": "wave right",
        "left hand wave": "wave left",
        "right arm clockwise": "right arm clockwise",
        "right arm counter clockwise": "right arm counter-clockwise",
        "left arm clockwise": "left arm clockwise",
        "left arm counter clockwise": "left arm counter-clockwise",
        "arm roll": "arm roll",
        "air drums": "air drums",
        "air guitar": "air guitar",
        "other gestures": "other gesture",
    }
)
"""Class of DVS-Gesture (Amir et al., CVPR 2017) → activity."""

SEATS = frozenset({"chair", "armchair", "office chair", "rocking chair", "sofa", "bench", "stool",
                   "bed", "swing", "seesaw", "wheelchair", "throne"})  # fmt: skip
"""Nouns on which a person sits, unless the prompt says otherwise."""
DONE_SEATED = frozenset(
    {"wave", "wave left", "wave right", "wave both", "clap", "point", "nod", "shake head", "talk",
     "play guitar", "play violin", "play flute", "write", "read", "eat", "drink", "phone", "text",
     "photograph", "sing", "fish", "type on lap", "eat noodles", "eat cake", "eat meal",
     "eat salad", "eat watermelon", "count money", "cut nails", "shuffle cards", "knit"}
)  # fmt: skip
"""What a person does just as well sitting: torso, head and arms move, the hips do not."""
TO_AND_FROM_SEATS = frozenset({"sit down", "stand up"})
"""Activities that begin or end on a seat, or on the ground where there is none."""
ON_GROUND: Mapping[str, str] = MappingProxyType(
    {"sit": "sit on ground", "sit down": "sit down on ground", "stand up": "stand up from ground"}
)
"""What they are called, and sitting, where there is no seat."""
SEATED = "sit and "
"""Begins the name of what is done sitting, as "sit and read"."""

_ROLES = """
    surfer, skier, snowboarder, skateboarder, ice skater, hockey player, goalkeeper, baseball
    batter, baseball player, catcher, cricketer, golfer, tennis player, football player,
    basketball player, american football player, boxer, fencer, archer, scuba diver, swimmer,
    referee, jockey, sumo wrestler, climber, hiker, racing driver, chef, baker,
    butcher, waiter, waitress, potter, farmer, gardener, fisherman, shepherd, cowboy,
    firefighter, police officer, soldier, sailor, pilot, astronaut, doctor, scientist,
    technician, surgeon, nurse, mechanic, plumber, carpenter, welder, blacksmith, glassblower,
    miner, lumberjack, painter, janitor, postman, courier, businessman, priest, monk,
    nun, photographer, tourist, lifeguard, guitarist, violinist, conductor, singer,
    flamenco dancer, ballerina, bride, groom, king, queen, princess, knight, samurai, pirate,
    wizard, witch, ninja, clown, magician, santa claus, superhero, angel, elderly man,
    elderly person, elderly
    woman, baby, toddler, teenager, schoolboy, schoolgirl, student, robot
"""
PERSON_NOUNS = (
    frozenset({"person", "man", "woman", "child", "girl", "runner", "worker"})
    .union(" ".join(name.split()) for name in _ROLES.split(","))
    .union(OF_UPRIGHT)
)
"""Nouns whose models take every posture of `ACTIVITIES`."""
HAND_NOUNS = frozenset({"hand"})
"""Nouns whose models take every posture of `HAND_GESTURES`."""
