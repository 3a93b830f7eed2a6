"""Words of feats, of care of the body, of crafts and of meals.

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
)

_SHAPED = "pottery|clay pottery|clay pot|clay vase|clay|pot on wheel|vase on wheel|ceramics"
_METAL = "metal|bar|metal bar|iron bar|steel bar|iron|steel|metal rod|iron rod|wire"
_MONEY = "money|cash|bill|banknote|note|dollar|coin"
_PLATES = "dish|plate|pot|pan|cup|cutlery|bowl"


def _gliding(*words: str, near: tuple[str, ...] = ()) -> Activity:
    return Activity(words, near, travels=True, is_sideways=True)


FEATS: dict[str, Activity] = {
    "skateboard trick": _gliding(*done_to("do|perform", "skateboard trick|kickflip|ollie"),
                                 "ollie", "kickflip"),
    "snowboard trick": _gliding(*done_to("do|perform", "snowboard trick")),
    "ski trick": _gliding(*done_to("do|perform", "ski trick"), near=("ski jump",)),
    "stand on skis": Activity(done_to("wear|have|stand on", "ski|skis|pair of ski"),
                              is_still=True),
    "ice skate": _gliding("ice skate", "figure skate", "speed skate",
                          *done_to("skate", "ice|on ice|on rink|on ice rink")),
    "roller skate": _gliding("roller skate", "rollerblade", "roller blade", "inline skate"),
    "rock climb": seen_from_side("rock climb", "boulder",
                                 *done_to("do|go", "rock climbing|bouldering"),
                                 near=("ice climb", "abseil")),
    "climb rope": seen_from_side(*done_to("climb|climb up|shin up", "rope")),
    "bungee jump": seen_from_side("bungee jump", *done_to("do", "bungee jump|bungee jumping")),
    "skydive": seen_from_side("skydive", "sky dive", "parachute", *done_to("do|go", "skydiving")),
    "cheerlead": Activity(("cheerlead", *done_to("wave|shake|hold|hold up", "pom pom|pompom"))),
    "tai chi": Activity(done_to("do|practice|practise|perform", "tai chi"), named=("tai chi",)),
    "stretch leg": seen_from_side(*done_to("stretch", "leg|hamstring|calf|thigh"),
                                  *done_to("touch", "toe|foot")),
    "bend back": seen_from_side("bend back", "bend backwards", "bend over backwards",
                                *done_to("do|perform", "backbend")),
    "shoot goal": seen_from_side(*done_to("shoot|score|kick", "goal|goal soccer|penalty"),
                                 "shoot at goal", "shoot ball into goal", "take penalty",
                                 "take penalty kick"),
    "robot dance": Activity(("dance robot", "dance like robot", "do robot dance")),
    "lean": Activity((), is_still=True),
}  # fmt: skip
"""Done with the whole body; what it needs comes with it."""

CARE: dict[str, Activity] = {
    "fill brows": at_head(*done_to("fill|fill in|draw|pencil|paint|colour|color|shape|define|do",
                                   "eyebrow|brow"),
                          near=done_to("pluck|wax|tweeze|trim|thread", "eyebrow|brow")),
    "cut nails": at_head(*done_to("cut|trim|clip", "nail|fingernail"),
                         near=(*done_to("file|polish|do", "nail|fingernail|toenail"),
                               *done_to("cut|trim|clip", "toenail"))),
    "massage legs": seen_from_side(*done_to("massage|rub|knead", "leg|calf|shin|thigh|knee"),
                                   near=(*done_to("massage|rub|wash|wax", "foot"),
                                         *done_to("shave|wax|wash", "leg"))),
    "wash hands": seen_from_side(*done_to("wash|rinse|scrub|soap|lather", "hand")),
    "take shower": Activity((*done_to("take|have", "shower"), "shower")),
    "bandage arm": Activity(done_to("bandage|wrap|dress", "arm|hand|wrist|wound|forearm")),
    "tie tie": at_head(*done_to("tie|adjust|straighten|fix|knot|put on|loosen", "tie|necktie"),
                       near=done_to("tie|adjust|straighten|fix|put on", "bow tie|bowtie")),
    "tongue out": at_head(*done_to("stick out|put out|show|poke out", "tongue"),
                          "stick tongue out", "put tongue out", "poke tongue out"),
    "get haircut": Activity((*done_to("get|have|receive", "haircut|hair cut"), "get hair cut",
                             "have hair cut")),
}  # fmt: skip
"""Done to the own body, or by who comes with it."""

CRAFTS: dict[str, Activity] = {
    "make pottery": seen_from_side(*done_to("make|throw|shape|mould|mold|form", _SHAPED),
                                   "work on potter wheel", "work at potter wheel"),
    "sharpen knife": Activity(done_to("sharpen|hone|whet", "knife|blade"),
                              done_to("sharpen|hone|whet", "axe|sword|tool|scissors")),
    "count money": at_head(*done_to("count|count out", _MONEY)),
    "shuffle cards": at_head(*done_to("shuffle|deal", "card|playing card|deck|pack|deck of card")),
    "bend metal": Activity(done_to("bend", _METAL)),
    "do laundry": Activity((*done_to("do|wash|load", "laundry|washing"), "load washing machine",
                            "put clothes in washing machine", "put clothes into washing machine"),
                           done_to("wash", "clothes")),
    "type on lap": Activity(("type on lap",)),
    "make bed": seen_from_side(*done_to("make|tidy", "bed")),
    "plant tree": seen_from_side(*done_to("plant", "tree|sapling|seedling|young tree|bush")),
    "arrange flowers": seen_from_side(*done_to("arrange|put", "flower|rose|tulip|bouquet"
                                               "|flower in vase|rose in vase")),
    "play wii": seen_from_side(*done_to("play", "wii|nintendo wii|wii game|wii sports|game wii"
                                        "|motion controlled game|motion controlled video game"),
                               "play with wii", "play on wii", "play game with wii",
                               "play video game with wii", "use wii",
                               *done_to("play game with|play video game with", "wii remote"
                                        "|remote|remote control|motion controller")),
    "lift trophy": Activity((*done_to("lift|raise|hold up|receive|accept|win|hold", "trophy|award"
                                      "|prize"),), done_to("give|present", "award|prize")),
}  # fmt: skip
"""Done with things that come along."""

_AT_PLATE = (
    "food|meal|dinner|lunch|breakfast|steak|rice|vegetable|meat|chicken|fish|fry|french fry|egg"
)
MEALS: dict[str, Activity] = {
    "wash dishes": seen_from_side(*done_to("wash|clean|rinse|scrub|do", _PLATES),
                                  "do washing up", "wash up"),
    "cook eggs": seen_from_side(*done_to("cook|fry|make|scramble", "egg|fried egg|omelette")),
    "cook sausages": seen_from_side(*done_to("cook|fry", "sausage|bacon")),
    "cook meat": seen_from_side(*done_to("cook|fry", "chicken|steak|meat|beef|fish|pork")),
    "cook vegetables": seen_from_side(*done_to("cook|fry|stir fry", "vegetable|onion|carrot"
                                               "|mushroom|potato|pepper|tomato")),
    "barbecue": seen_from_side("barbecue", "barbeque", "have barbecue",
                               *done_to("grill|barbecue", "sausage|meat|burger|steak"),
                               "cook on grill", "cook on barbecue", "stand at grill",
                               near=("cook on campfire", "cook over campfire", "cook over fire")),
    "eat noodles": at_head(*done_to("eat", "noodle|noodles|spaghetti|pasta|ramen")),
    "eat cake": at_head(*done_to("eat", "cake|pie|piece of cake|slice of cake|birthday cake"
                                 "|cheesecake")),
    "eat meal": at_head(*done_to("eat", _AT_PLATE)),
    "eat salad": at_head(*done_to("eat", "salad|lettuce|broccoli|spinach")),
    "eat watermelon": at_head(*done_to("eat", "watermelon|melon|slice of watermelon"
                                       "|piece of watermelon")),
    "blow out cake": seen_from_side("blow out candle on cake", "blow out candle on birthday cake",
                                    "blow candle out on cake", "blow out birthday cake",
                                    "blow out cake",
                                    "blow candle on cake out", "blow candle on birthday cake out"),
}  # fmt: skip
"""At the table and about it."""

PASTIMES: Mapping[str, Activity] = MappingProxyType({**FEATS, **CARE, **CRAFTS, **MEALS})
"""All of these."""
BRINGING = frozenset({*CARE, *CRAFTS, *MEALS, "climb rope", "robot dance",
                      "cook", "shoot goal", "ice skate",
                      "skateboard trick", "snowboard trick", "ski trick",
                      "stand on skis"})  # fmt: skip
"""Those that bring the thing that their phrase names."""
COMPOUNDS = frozenset(
    {"cross country ski", "scuba dive",
     "ice skate", "figure skate", "speed skate", "roller skate", "roller blade", "inline skate",
     "rock climb", "ice climb", "bungee jump", "sky dive", "air drum", "ski jump",
     "belly dance", "tap dance", "line dance", "salsa dance", "swing dance",
     "country line dance", "jumpstyle dance", "tango dance", "ice fish"}
)  # fmt: skip
"""Verbs of two words whose last one is inflected."""
