"""Figures of tales and of feasts, and people of an age."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.models.materials import BLACK, BLUE, GREEN, RED, WHITE, YELLOW
from texvent.scenes.models.people.outfit import ADULT, CHILD, GIRL, WOMAN
from texvent.scenes.models.people.roles.rows import (
    DARK,
    GREY,
    PURPLE,
    SILVER_HAIR,
    STEEL,
    role,
    suit,
    wears,
)

TALES = (
    role(
        "ballerina",
        replace(
            WOMAN,
            shirts=((0.80, 0.45, 0.50),),
            dress="shorts",
            long_hair=False,
            trousers=(0.78, 0.60, 0.58),
            hat="bun",
            shoes=(0.80, 0.45, 0.50),
            garments=wears("tutu"),
        ),
        "ballet dancer",
    ),
    role(
        "bride",
        replace(WOMAN, shirts=(WHITE,), hat="veil", has_sleeves=True, garments=wears("gown")),
    ),
    role("groom", suit(DARK, garments=wears("bow tie")), "bridegroom"),
    role(
        "king",
        suit(
            RED, hat="crown", garments=(("robe", RED), ("cape", (0.40, 0.02, 0.03)), ("belt", None))
        ),
    ),
    role(
        "queen",
        replace(
            WOMAN,
            shirts=(PURPLE,),
            hat="crown",
            has_sleeves=True,
            garments=(("gown", None), ("cape", RED)),
        ),
    ),
    role(
        "princess",
        replace(WOMAN, shirts=((0.75, 0.30, 0.45),), hat="crown", garments=wears("gown")),
        plurals=("princesses",),
    ),
    role(
        "knight",
        suit(STEEL, gloves=STEEL, shoes=STEEL, hat="knight", garments=wears("armour")),
    ),
    role(
        "samurai",
        suit(
            (0.30, 0.03, 0.03),
            hat="samurai",
            garments=(("skirt", DARK), ("shoulder pads", (0.3, 0.03, 0.03))),
        ),
    ),
    role(
        "pirate",
        suit(
            DARK,
            shirts=((0.65, 0.62, 0.55),),
            hat="pirate",
            garments=(("knee coat", (0.35, 0.03, 0.03)), ("belt", None)),
        ),
    ),
    role(
        "wizard",
        suit(
            (0.05, 0.05, 0.30),
            hat="pointed",
            hat_colour=(0.05, 0.05, 0.30),
            garments=(("robe", None), ("belt", None)),
        ),
        "sorcerer",
    ),
    role(
        "witch",
        replace(
            WOMAN,
            shirts=(DARK,),
            hat="pointed",
            hat_colour=DARK,
            has_sleeves=True,
            garments=wears("gown"),
        ),
        plurals=("witches",),
    ),
    role("ninja", suit(DARK, gloves=DARK, hat="ninja", garments=wears("belt"))),
    role(
        "clown",
        suit(
            (0.75, 0.55, 0.05),
            trousers=(0.15, 0.30, 0.65),
            hat="clown",
            gloves=WHITE,
            shoes=RED,
            garments=wears("ruff"),
            bulk=1.15,
        ),
    ),
    role(
        "magician",
        suit(
            DARK,
            hat="top hat",
            hat_colour=DARK,
            garments=(("bow tie", None), ("cape", (0.35, 0.02, 0.03))),
        ),
    ),
    role(
        "santa claus",
        suit(
            RED,
            hat="santa",
            hat_colour=RED,
            gloves=WHITE,
            garments=wears("belly", "belt"),
            bulk=1.2,
        ),
        "santa",
        "father christmas",
    ),
    role("superhero", suit(BLUE, shoes=RED, gloves=RED, garments=(("cape", RED), ("belt", None)))),
    role(
        "angel", replace(WOMAN, shirts=(WHITE,), has_sleeves=True, garments=wears("gown", "wings"))
    ),
)

AGES = (
    role(
        "elderly man",
        suit((0.26, 0.22, 0.18), trousers=GREY, hair=SILVER_HAIR, stoop=0.34, height=0.95),
        "old man",
        "grandfather",
        "grandpa",
        "elderly gentleman",
        plurals=("old men", "elderly men"),
    ),
    role(
        "elderly person",
        suit((0.26, 0.22, 0.18), trousers=GREY, hair=SILVER_HAIR, stoop=0.34, height=0.95),
        "senior",
        "pensioner",
        "old person",
        plurals=("elderly people", "old people"),
    ),
    role(
        "elderly woman",
        replace(
            WOMAN,
            shirts=((0.20, 0.12, 0.24),),
            hair=SILVER_HAIR,
            hat="bun",
            stoop=0.34,
            height=0.88,
            long_hair=False,
            has_sleeves=True,
            garments=wears("long skirt"),
        ),
        "old woman",
        "grandmother",
        "grandma",
        "old lady",
        "elderly lady",
        "granny",
        plurals=("old women", "elderly women"),
    ),
    role(
        "baby",
        replace(
            CHILD,
            height=0.40,
            head=1.75,
            shirts=(WHITE, (0.35, 0.55, 0.75)),
            bulk=1.35,
            has_sleeves=True,
            hair=(0.45, 0.28, 0.12),
        ),
        "infant",
        "newborn",
        plurals=("babies",),
        motion="crawl",
    ),
    role("toddler", replace(CHILD, height=0.50, head=1.55, bulk=1.2, shirts=(YELLOW, RED))),
    role(
        "teenager",
        replace(ADULT, height=0.90, head=1.05, hat="cap", hat_colour=BLACK),
        "teen",
        "adolescent",
    ),
    role(
        "schoolboy",
        replace(CHILD, garments=wears("rucksack", colour=RED)),
        "pupil",
        "schoolchild",
        plurals=("schoolchildren",),
    ),
    role("schoolgirl", replace(GIRL, hat="pigtails", garments=wears("rucksack", colour=BLUE))),
    role("student", replace(ADULT, garments=wears("rucksack", colour=GREEN))),
)
