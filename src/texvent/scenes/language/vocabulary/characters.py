"""What only people do, wear, hold, eat and sit on: an animal that does stands upright."""

from __future__ import annotations

from texvent.scenes.models.people.work.verbs import HANDWORK


def _words(text: str) -> frozenset[str]:
    return frozenset(" ".join(word.split()) for word in text.split(","))


SHARED_ACTS = _words(
    """stretch, jump, climb, climb down, crawl, swim, kick, catch, throw, pull, push, stand, sit,
    lie, kneel, crouch, sit down, stand up, lie down, kneel down, crouch down, fall over, walk,
    run, yawn, sneeze, cry, laugh, shout, sing, turn head, nod, shake head, scratch head, hug,
    kiss, wrestle, tug of war, give, receive, dig, eat, drink, run in place, somersault, flip,
    fish, punch, wave, bow, lunge, squat, talk, wash face, wipe face, point, raise arms, swing bat,
    skip rope, mow, other gesture, dribble, serve, plank, rake, box, smoke, argue, dance"""
)
"""Activities of people whose words an animal on four legs does in its own way."""
BY_PEOPLE_ONLY = _words(
    "discuss, argue, chat, applaud, clap, lecture, juggle, cook, bake, type, read, write, surf, ski"
)
"""Verbs of which an animal is never the subject but as a figure."""
_PATTERNS = frozenset(
    {"slice", "peel", "snip", "saw", "uncork", "unlock", "drill", "knit", "stir", "sprinkle",
     "pour", "water", "scribble", "chop"}
)  # fmt: skip
_TOOLS = frozenset(
    {"iron", "sponge", "cloth", "paintbrush", "rolling pin", "hammer", "wrench", "needle", "block",
     "torch", "pipette"}
)  # fmt: skip
WORK_OF_PEOPLE = frozenset(
    verb for verb, work in HANDWORK.items() if work.pattern in _PATTERNS or work.tool in _TOOLS
)
"""Work that takes hands."""
HELD_IN_HANDS = _words(
    """umbrella, sign, cup, mug, balloon, microphone, cell phone, phone, smartphone, camera, sword,
    guitar, wine glass, glass, beer glass, banner, torch, lantern, flag, placard, trophy, tray,
    newspaper, map, shield, wand, gun, trumpet, saxophone, violin, racket, tennis racket,
    baseball bat, golf club, broom, mop, shovel, paintbrush, fork, spoon, knife"""
)
IN_MOUTH = _words("mouth, teeth, jaw, beak, trunk, talon, claw")
DRINKS = _words(
    """coffee, tea, beer, wine, cocktail, juice, soda, milkshake, latte, cappuccino, lemonade,
    espresso, champagne, cola, smoothie, whiskey, martini, boba"""
)
MEALS = _words(
    """hamburger, burger, pizza, noodles, noodle, ramen, sushi, sandwich, popcorn, ice cream, cake,
    donut, doughnut, taco, spaghetti, pasta, hot dog, french fries, chopstick, cupcake, pancake,
    soup, salad, burrito, cookie, dumpling, food, candy, lollipop"""
)
EATERS = _words(
    """panda, squirrel, raccoon, monkey, gorilla, bear, black bear, polar bear, koala, rabbit,
    mouse, hamster, kangaroo, teddy bear, fox, frog, penguin"""
)
"""Animals that, in tales, hold their food in their hands."""
EATING_PLACES = _words("cafe, café, restaurant, bar, pub, coffee shop, diner, bistro, coffeehouse")
SEATS_OF_PEOPLE = _words("swing, swing set, seesaw")
PLAYED_BY_PEOPLE = _words(
    """guitar, drum, drums, drum kit, piano, violin, cello, trumpet, saxophone, flute, banjo,
    ukulele, harp, accordion, keyboard, chess, poker, cards, tennis, golf, basketball, baseball,
    cricket, video game, saxophone, harmonica, instrument, badminton, hockey, xylophone, turntable,
    grand piano, electric guitar"""
)
TOYS = frozenset({"teddy bear"})
"""What cannot move by itself on its usual body."""
HOOFED = _words(
    "horse, zebra, cow, calf, bull, elephant, deer, giraffe, camel, donkey, pony, rhino"
    ", hippo, sheep, lamb, goat, reindeer, duck, owl, chicken, penguin, frog"
)
"""Animals that dance on the legs that they have."""
PEOPLES_CLOTHES = _words(
    "trousers, suit, dress, skirt, robe, pyjamas, spacesuit, overalls, tutu, wetsuit, shorts, apron"
)
"""Garments that only an upright body can wear; a sweater or a hat, one on four legs too."""
