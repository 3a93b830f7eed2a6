"""People of a sport, told by what they wear."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.models.materials import BLUE, GREEN, ORANGE, RED, WHITE, YELLOW
from texvent.scenes.models.people.outfit import ADULT
from texvent.scenes.models.people.roles.rows import (
    BARE,
    BROWN,
    DARK,
    GREY,
    PLAYER,
    TAN,
    role,
    suit,
    wears,
)

SPORTS = (
    role("surfer", suit(DARK, dress="trousers", hair=(0.42, 0.26, 0.08)), "wave rider"),
    role(
        "skier",
        suit(RED, trousers=DARK, gloves=DARK, hat="ski helmet", hat_colour=BLUE),
        "ski racer",
        motion="ski",
    ),
    role(
        "snowboarder",
        suit(GREEN, trousers=GREY, gloves=DARK, hat="ski helmet", hat_colour=ORANGE),
        motion="snowboard",
    ),
    role("skateboarder", replace(ADULT, hat="cap", hat_colour=RED, dress="shorts"), motion="skate"),
    role("ice skater", replace(suit(BLUE), shoes=WHITE, hat="bun"), "figure skater"),
    role(
        "hockey player",
        suit(
            RED,
            trousers=DARK,
            gloves=DARK,
            hat="hockey helmet",
            hat_colour=RED,
            garments=wears("shoulder pads"),
            bulk=1.12,
        ),
        "ice hockey player",
    ),
    role(
        "goalkeeper",
        suit(YELLOW, dress="trousers", trousers=DARK, gloves=(0.7, 0.55, 0.05)),
        "goalie",
        "keeper",
    ),
    role(
        "baseball batter",
        replace(
            ADULT,
            shirts=(WHITE,),
            trousers=(0.62, 0.62, 0.60),
            hat="batting helmet",
            hat_colour=BLUE,
            garments=wears("belt"),
        ),
        "batter",
        "hitter",
        "batsman",
    ),
    role(
        "baseball player",
        replace(
            ADULT,
            shirts=(WHITE,),
            trousers=(0.62, 0.62, 0.60),
            hat="cap",
            hat_colour=BLUE,
            garments=wears("belt"),
        ),
        "softball player",
        "baseball pitcher",
        "outfielder",
    ),
    role(
        "catcher",
        replace(
            ADULT,
            shirts=(RED,),
            trousers=(0.62, 0.62, 0.60),
            hat="hockey helmet",
            hat_colour=RED,
            garments=wears("pads"),
        ),
        "baseball catcher",
    ),
    role(
        "cricketer",
        suit(WHITE, hat="batting helmet", hat_colour=BLUE, garments=wears("pads")),
        "cricket player",
    ),
    role("golfer", replace(ADULT, trousers=TAN, hat="cap", hat_colour=WHITE), "golf player"),
    role(
        "tennis player",
        replace(PLAYER, shirts=(WHITE,), trousers=WHITE, hat="headband"),
    ),
    role(
        "football player",
        replace(PLAYER, shirts=(RED, BLUE), trousers=WHITE),
        "soccer player",
        "footballer",
        "striker",
        "defender",
        "midfielder",
    ),
    role(
        "basketball player",
        replace(
            PLAYER,
            shirts=(ORANGE, BLUE),
            trousers=ORANGE,
            height=1.12,
            shoes=WHITE,
            hat="headband",
        ),
    ),
    role(
        "american football player",
        suit(
            (0.05, 0.10, 0.32),
            trousers=(0.65, 0.63, 0.58),
            hat="football helmet",
            hat_colour=(0.05, 0.10, 0.32),
            garments=wears("shoulder pads"),
            bulk=1.15,
        ),
        "quarterback",
        "linebacker",
    ),
    role("boxer", replace(PLAYER, shirts=(BARE,), trousers=RED, hat="headband")),
    role("fencer", suit(WHITE, gloves=WHITE, hat="race helmet", hat_colour=GREY)),
    role("archer", replace(ADULT, shirts=(GREEN,), trousers=BROWN, hat="cap", hat_colour=GREEN)),
    role(
        "scuba diver",
        suit(DARK, gloves=DARK, hat="diver", garments=wears("air tank")),
        "diver",
        "skin diver",
        "frogman",
        motion="swim",
    ),
    role(
        "swimmer",
        replace(PLAYER, shirts=(BARE,), trousers=BLUE, hat="turban", hat_colour=RED),
        motion="swim",
    ),
    role(
        "referee",
        replace(ADULT, shirts=(DARK,), trousers=DARK, garments=wears("rings")),
        "umpire",
    ),
    role(
        "jockey",
        suit(
            (0.55, 0.08, 0.30), trousers=WHITE, hat="batting helmet", hat_colour=YELLOW, height=0.9
        ),
    ),
    role(
        "sumo wrestler",
        replace(
            PLAYER, shirts=(BARE,), trousers=DARK, bulk=1.7, hat="bun", garments=wears("belly")
        ),
    ),
    role(
        "climber",
        replace(
            ADULT, hat="bicycle helmet", hat_colour=RED, garments=wears("rucksack", colour=ORANGE)
        ),
        "rock climber",
        "mountaineer",
        "alpinist",
    ),
    role(
        "hiker",
        replace(
            ADULT,
            dress="shorts",
            hat="straw",
            hat_colour=TAN,
            garments=wears("rucksack", colour=BLUE),
        ),
        "backpacker",
        "trekker",
    ),
    role(
        "racing driver",
        suit(RED, hat="race helmet", hat_colour=WHITE),
        "race driver",
        "race car driver",
    ),
)
