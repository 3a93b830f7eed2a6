"""Verbs that are shown by a motion near to theirs, and reported so: "whisks → cook"."""

from __future__ import annotations

from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.machine_acts import GRASP, PICK

SIMILAR_ACTIVITIES: dict[str, tuple[str, ...]] = {
    "stretch": ("exercise", "warm up", "meditate", "train", "do tai chi",
                "practice tai chi", "practise tai chi", "perform tai chi"),
    "swing racket": ("rally", "volley", "smash"),
    "throw": ("lasso", "sling", "cast"),
    "crouch": ("duck", "hide", "stoop"),
    "punch": ("jab", "hook"),
    "wave": ("greet",),
    "wave both": ("flail",),
    "raise arms": ("celebrate",),
    "phone": ("call",),
    "cook": ("prepare",),
    "box": ("fight", "spar"),
    "sneeze": ("cough",),
    "swing club": ("putt",),
    "stroke": ("cuddle", "comfort", "tickle", "fondle"),
    "point": ("signal", "direct", "indicate"),
    "eat": ("bite", "chew", "taste", "lick", "swallow", "nibble"),
    "fall over": ("faceplant",),
    "nod": ("headbang",),
    "talk": ("whisper", "recite", "interview", "present", "explain"),
    "kneel": ("pray", "propose"),
    "dance": ("breakdance", "moonwalk", "twerk"),
    "climb": ("clamber", "cling", "scale", "shin up"),
    "jump": ("vault", "play", "romp"),
}  # fmt: skip
"""Activity of people → verbs it stands for."""

NAMED_ACTS: dict[str, tuple[str, ...]] = {
    "swing racket": (
        "tennis", "tennis rally", "tennis volley", "tennis match", "tennis forehand",
        "tennis backhand", "tennis serve", "badminton", "badminton smash", "badminton rally",
        "badminton match", "table tennis", "table tennis rally", "table tennis match", "ping pong",
        "ping pong rally", "squash rally", "pickleball",
    ),
    "swing club": ("golf", "golf swing", "golf shot", "golf drive", "golf putt"),
    "swing bat": ("baseball swing", "baseball hit", "cricket shot"),
    "throw": ("baseball pitch", "shot put", "basketball shot", "basketball free throw",
              "javelin throw", "hammer throw", "discus throw"),
    "dunk": ("basketball dunk", "slam dunk"),
    "kick": ("penalty kick", "soccer penalty kick", "free kick", "soccer kick", "football kick"),
    "karate": ("karate", "karate kick", "taekwondo", "taekwondo kick", "martial arts", "kung fu",
               "high kick", "side kick", "capoeira"),
    "jumping jack": ("aerobics", "zumba class"),
    "show fists": ("rock paper scissors", "rock scissors paper"),
    "ballet": ("ballet", "ballet pirouette", "pirouette"),
    "dance": ("salsa", "salsa dance", "hip hop dance", "street dance", "zumba", "flamenco"),
    "fence": ("fencing bout", "fencing match", "fencing duel", "sabre duel", "kendo",
              "fencing"),
    "wrestle": ("wrestling", "wrestling match", "sumo wrestling", "sumo", "judo", "judo throw",
                "jiu jitsu"),
    "box": ("boxing match", "boxing bout", "kickboxing"),
    "skate": ("figure skating", "ice skating", "speed skating", "roller skating"),
    "jump": ("high jump", "long jump", "triple jump", "vertical jump", "pole vault", "hopscotch",
             "parkour"),
    "lift": ("clean and jerk", "weightlifting", "weight lifting"),
    "sit-up": ("situp", "situps", "sit ups", "crunches"),
    "yoga": ("yoga", "yoga pose"),
    "write": ("handwriting",),
    "archery": ("archery",),
    "tug of war": ("tug of war",),
    "arm wrestle": ("arm wrestling",),
    "play chess": ("chess", "chess game", "chess match"),
    "juggle": ("juggling",),
    "skip rope": ("rope skipping", "jump rope", "rope jumping"),
}  # fmt: skip
"""Activity of a person → nouns that name one like it; only those who do it are shown."""
EXACT_ACTS = frozenset({"archery", "situp", "situps", "sit ups", "yoga",
                         "tug of war", "arm wrestling", "fencing", "wrestling",
                        "juggling", "rope skipping", "jump rope", "rope jumping"})  # fmt: skip
"""Those of these nouns that name just what is shown."""

ALL_LIGHT = frozenset({"do", "perform", "execute", "practice", "practise", "demonstrate"})
"""Verbs that say only that the activity which their object names is done."""
LIGHT_VERBS = ALL_LIGHT | {"give", "take", "have", "make", "let"}
"""The same of `TAKEN_ACTS`."""
TAKEN_ACTS = frozenset(
    {
        "walk",
        "run",
        "swim",
        "bow",
        "nod",
        "wave",
        "shrug",
        "clap",
        "kick",
        "jump",
        "leap",
        "yawn",
        "salute",
        "somersault",
        "cartwheel",
        "pirouette",
        "backflip",
        "handstand",
        "laugh",
        "sneeze",
        "hop",
        "squat",
        "lunge",
    }
)
"""What is given, taken, had or made: "gives a nod", "takes a bow"; not "makes a drink"."""
GESTURE_VERBS = LIGHT_VERBS | {
    "show",
    "form",
    "sign",
    "signal",
    "play",
    "display",
    "hold",
    "hold up",
    "flash",
}
"""The same of gestures of a hand: "shows thumbs up"."""

SIMILAR_GAITS: dict[str, tuple[str, ...]] = {
    "walk": (
        "scurry", "scuttle", "pad", "limp", "tiptoe", "sneak", "stalk", "pace", "plod", "amble",
        "trudge", "toddle", "stagger", "stumble", "lumber", "saunter", "parade", "wade", "hobble",
        "shuffle", "prowl", "roam", "slink",
    ),
    "run": ("hustle", "scamper", "bolt", "dart", "stampede", "charge", "flee", "bound"),
    "jump": ("pounce", "spring", "frolic"),
    "topple": ("faint", "trip"),
}  # fmt: skip
"""Motion → verbs it stands for, for people and for others."""

SIMILAR_MOTIONS: dict[str, tuple[str, ...]] = {
    **ANIMAL_ACTS,
    "run": ("play",),
    "drive": ("plow", "plough"),
    "change lane": ("cut in",),
    "stand": ("freeze", "lean"),
    "jump": ("bob", "breach"),
    "sit": ("crouch", "squat", "curl up", "watch", "stare", "lean", "relax", "lounge",
            "hide"),
    "sway": (
        "wiggle", "quiver", "jiggle", "shudder", "rattle", "bob", "tug", "wriggle", "squirm",
        "billow", "ripple", "twitch",
    ),
    "spin": ("gyrate", "whirr", "twist", "swirl"),
    "turn": ("bank",),
    "topple": ("capsize",),
    "fly": ("swarm", "buzz", "wheel"),
    "move": ("slither", "cut", "emerge", "flow", "stream", "navigate", "patrol"),
    "rise": ("lift", "float up", "soar up"),
    "fall": ("tumble", "cascade", "plunge"),
    "bounce": ("ricochet", "rebound"),
}  # fmt: skip
"""Motion → verbs it stands for, for what is not a person."""

JOBS: dict[str, tuple[frozenset[str], str]] = {
    "robot vacuum": (frozenset({"clean", "vacuum", "sweep"}), "slide"),
    "waterfall": (
        frozenset({"fall", "plunge", "cascade", "pour", "flow", "drop", "crash", "rush", "tumble"}),
        "stand",
    ),
    "excavator": (frozenset({"dig", "work", "excavate", "scoop"}), "work"),
    "robot arm": (
        frozenset(
            {"pick", "pick up", "place", "put", "put down", "grasp", "grab", "grip", "lift", "sort",
             "stack", "handle", "pack", "take", "take out", "transfer", "load", "unload",
             "pick and place"}
        ),
        PICK,
    ),
    "gripper": (
        frozenset({"grasp", "grab", "grip", "hold", "pick", "pick up", "lift", "squeeze", "take"}),
        GRASP,
    ),
}  # fmt: skip
"""Machine → verbs of what it is there for, and the motion that shows it."""
HANDLED: dict[str, str] = {"robot arm": "block", "gripper": "ball"}
"""Machine → what its model handles, whatever the prompt names."""
BOARDS = frozenset(
    {"skateboard", "surfboard", "snowboard", "scooter", "ski", "wave", "sled", "carousel horse"}
)
"""What is ridden besides vehicles and animals."""
WEARABLE = frozenset(
    {"hat", "cap", "helmet", "backpack", "glasses", "scarf", "tie", "vest", "jacket", "dress",
     "shirt", "skirt", "mask", "crown", "sunglasses", "coat", "glove", "boot", "shoe",
     "cowboy hat", "straw hat", "top hat", "chef hat", "witch hat", "santa hat", "turban",
     "woolly hat", "apron", "robe", "cape", "tutu", "overalls", "wetsuit", "suit",
     "pyjamas", "spacesuit", "sweater", "hoodie", "trousers", "shorts", "sandal",
     "high heel", "belt", "headphones"}
)  # fmt: skip
"""What is worn."""
OF_ONESELF = frozenset(
    {"jump", "crouch", "kneel", "stretch", "walk", "run", "topple", "slide", "sway", "hover",
     "sink"}
)  # fmt: skip
"""Motions that are done to nothing: who "flips a pancake" does not jump."""
EFFECT_BY_VERB: dict[str, str] = {
    verb: kind for kind, words in EFFECTS.items() for verb in words.verbs if " " not in verb
}
"""Verb of one word → the effect it means."""
