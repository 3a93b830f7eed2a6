"""Verbs that are shown by a motion near to theirs, and reported so: "slicing → cook"."""

from __future__ import annotations

SIMILAR_ACTIVITIES: dict[str, tuple[str, ...]] = {
    "cook": (
        "slice", "cut", "chop", "knead", "mix", "peel", "pipette", "season", "whisk",
        "bake", "fry", "grill", "roast", "prepare", "grate", "mince", "boil", "serve food",
        "spread", "decorate", "ice", "frost",
    ),
    "wash": (
        "wipe", "scrub", "brush", "polish", "pet", "stroke", "groom", "fold", "iron", "rub",
        "clean", "rinse", "comb", "massage", "shave", "dry", "shampoo",
    ),
    "write": (
        "draw", "sketch", "sign", "note", "solder", "sew", "knit", "tie", "assemble",
        "carve", "engrave", "embroider", "tighten", "adjust", "inspect", "examine",
        "repair", "fix", "change", "shape", "mold", "mould", "sculpt", "thread", "unscrew",
        "screw", "weave",
    ),
    "hammer": ("forge", "nail", "chisel", "pound", "knock", "smash"),
    "dig": ("shovel", "rake", "plant", "hoe", "scoop", "garden"),
    "lift": ("pick", "pick up", "raise", "hoist", "weigh", "load", "unload", "stack"),
    "stretch": ("do yoga", "practice yoga", "exercise", "warm up", "meditate", "train"),
    "swing racket": ("rally", "volley", "smash", "serve"),
    "throw": ("rope", "lasso", "shoot", "fling", "sling", "cast", "pitch", "bowl"),
    "crouch": ("duck", "hide", "stoop"),
    "punch": ("jab", "hook", "fight", "spar"),
    "point": ("signal", "direct", "conduct", "indicate"),
    "eat": ("bite", "chew", "taste", "lick", "swallow", "nibble"),
    "talk": ("shout", "yell", "laugh", "whisper", "recite", "interview", "present"),
    "kneel": ("pray",),
    "clap": ("high five",),
    "climb": ("clamber", "cling", "scale"),
    "jump": ("somersault", "cartwheel", "flip", "vault", "frolic"),
}  # fmt: skip
"""Activity of people → verbs it stands for."""

SIMILAR_MOTIONS: dict[str, tuple[str, ...]] = {
    "walk": (
        "scurry", "scuttle", "pad", "limp", "tiptoe", "sneak", "stalk", "pace", "plod",
        "trudge", "toddle", "sniff", "forage",
    ),
    "run": ("hustle", "scamper", "bolt", "dart", "play"),
    "jump": ("pounce", "bob", "spring", "frolic"),
    "sit": ("crouch", "squat", "curl up", "watch", "stare", "lean", "relax", "lounge"),
    "sway": ("wiggle", "quiver", "jiggle", "shudder", "rattle", "bob", "tug"),
    "spin": ("gyrate", "whirr", "twist", "swirl"),
    "fly": ("swarm", "buzz", "wheel"),
    "move": ("slither", "cut", "emerge", "flow", "stream", "navigate", "patrol"),
    "rise": ("lift", "float up", "climb up", "soar up"),
    "fall": ("tumble", "cascade", "plunge", "dump"),
    "bounce": ("ricochet", "rebound"),
}  # fmt: skip
"""Motion → verbs it stands for, for what is not a person."""
