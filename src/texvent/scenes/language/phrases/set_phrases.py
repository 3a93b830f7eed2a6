"""Set phrases, by the plain words that they mean."""

from __future__ import annotations

_PARTS_OF_AIR = ("tendrils", "wisps", "plumes", "curls", "puffs", "a plume", "a wisp", "a curl",
                 "a puff")  # fmt: skip

_OWN_AXES = tuple(
    f"{about} {whose} {axis}"
    for about in ("about", "around")
    for whose in ("its", "its own", "their", "their own", "the")
    for axis in ("axis", "centre", "center", "middle")
)
"""What turns does so about these anyway."""
_OPTICAL = ("the optical axis", "its optical axis", "the viewing axis", "the principal axis")
_ROLLS = tuple(
    f"{rotation} {about} {axis}"
    for rotation in ("camera rotation", "rotation of the camera", "pure rotation of the camera",
                     "pure camera rotation", "rotation", "pure rotation")
    for about in ("about", "around")
    for axis in _OPTICAL
)  # fmt: skip

SET_PHRASES: dict[str, tuple[str, ...]] = {
    "camera roll": _ROLLS,
    **{
        f"{way} the {one}": tuple(f"{way} {the} {camera}" for camera in cameras
                                  for the in ("the", "an", "a"))
        for way, one, cameras in (
            ("in front of", "camera", ("event camera", "sensor", "dvs")),
            ("towards", "camera", ("event camera", "sensor", "dvs")),
            ("across", "picture", ("sensor", "image", "image plane", "field of view")),
        )
    },
    "collide": tuple(f"{one} off each other" for one in ("collide and bounce", "bounce")),
    "colliding": tuple(f"{one} off each other" for one in ("colliding and bouncing", "bouncing")),
    **{
        f"on {the} conveyor belt": tuple(f"{way} {the} conveyor belt" for way in ("along", "down"))
        for the in ("a", "the")
    },
    "dotted disc": tuple(
        f"{dot} on a {disc}" for dot in ("dot", "black dot") for disc in ("disc", "disk")
    ),
    "white dotted disc": tuple(
        f"black dot on {a} white {disc}" for a in ("a", "the") for disc in ("disc", "disk")
    ),
    **{
        belt: tuple(f"conveyor belt {doing}" for doing in doings)
        for belt, doings in (
            ("conveyor belt with", ("carrying", "transporting", "conveying", "moving")),
            ("conveyor belt has", ("carries", "transports", "conveys")),
        )
    },
    "spiral disc": tuple(
        f"{disc} with a {one}" for disc in ("disc", "disk") for one in ("spiral", "spiral pattern")
    ),
    **{
        f"{plain} up and down": tuple(
            f"{verb} {way}" for verb in verbs for way in ("vertically", "up and down")
        )
        for plain, verbs in (
            ("floats", ("oscillates", "moves")),
            ("floating", ("oscillating", "moving")),
        )
    },
    "moves back and forth": ("oscillates horizontally", "oscillates back and forth"),
    "moving back and forth": ("oscillating horizontally", "oscillating back and forth"),
    "driving at night": ("night drive", "night driving"),
    "person walking": ("human gait", "gait of a person", "human walking"),
    **{
        f"person rotating the {side} arm": tuple(
            f"{side} {limb} {going}"
            for limb in ("arm", "hand")
            for going in ("rotating", "circling", "moving in circles")
        )
        for side in ("left", "right")
    },
    "on top of": (
        "on the top of", "at the top of", "in the top of", "up on top of", "at top of",
        "on the very top of", "atop of",
    ),
    "under": (
        "on the bottom of", "on the underside of", "beneath the shade of", "under the shade of",
        "in the shade of",
    ),
    "atop": ("on the back of", "on the roof of", "on the rooftop of"),
    "inside": ("inside of", "in side of", "on the inside of", "in the inside of"),
    "outside": ("outside of", "outdoors", "out of doors"),
    "near a": ("nearby a",),
    "near the": ("nearby the",),
    "in": (
        "in the heart of", "at the heart of", "in the middle of", "in the midst of",
        "in the center of", "in the centre of", "against the backdrop of", "against a backdrop of",
        "set against the backdrop of", "set against a backdrop of",
    ),
    "a row of": ("a line up of", "a lineup of", "a line of"),
    "steam": tuple(f"{part} of steam" for part in _PARTS_OF_AIR),
    "smoke": tuple(f"{part} of smoke" for part in _PARTS_OF_AIR),
    "suit": ("suit and tie", "suit and a tie"),
    "in traffic": (
        "in traffic during rush hour", "in rush hour traffic", "in heavy traffic",
        "in busy traffic",
    ),
    "in front of": ("in the front of", "at the front of", "out in front of"),
    "behind": ("at the back of", "in the rear of"),
    "near": ("nearby to", "close by to", "in the vicinity of"),
    "along": ("along side of", "along the side of"),
    "alongside": ("along side",),
    "next to": ("right next to", "next too", "by the side of"),
    "in the background": ("in the back ground", "in background", "in the backround"),
    "in the foreground": ("in foreground",),
    "slow motion": (
        "super slow motion", "extreme slow motion", "ultra slow motion", "very slow motion",
        "slo mo", "super slo mo",
    ),
    "fly through of": ("flyover of", "drone flyover of", "aerial flyover of"),
    "four people": ("two couples",),
    "six people": ("three couples",),
    "waiting in traffic": (
        "stuck in traffic", "caught in traffic", "stuck in traffic during rush hour",
        "stuck in rush hour traffic", "stuck in heavy traffic",
    ),
    "about to": (
        "getting ready to", "gets ready to", "get ready to", "preparing to", "prepares to",
        "prepare to", "gearing up to", "just about to",
    ),
    "turning": ("turning a corner", "turning the corner", "rounding a corner",
                "rounding the corner"),
    "turns": ("turns a corner", "turns the corner", "rounds a corner", "rounds the corner"),
    "accelerating": ("accelerating to gain speed", "speeding up to gain speed"),
    "accelerates": ("accelerates to gain speed",),
    "drinking from": (
        "bending down to drink water from", "bending down to drink from", "drinking water from",
        "leaning down to drink from",
    ),
    "drinks from": ("bends down to drink water from", "bends down to drink from",
                    "drinks water from"),
    "of leftover": ("of left over",),
    "snowboarding": ("snow boarding",), "snowboarder": ("snow boarder",),
    "snowboarders": ("snow boarders",), "skateboarding": ("skate boarding",),
    "skateboarder": ("skate boarder",), "skateboarders": ("skate boarders",),
    "surfing": ("surf boarding",), "bodysurfing": ("body surfing",),
    "parasailing": ("para sailing",), "windsurfing": ("wind surfing",),
    "kitesurfing": ("kite surfing",), "skiing": ("snow skiing",),
    "wetsuit": ("wet suit",), "wetsuits": ("wet suits",), "shirt": ("tee shirt",),
    "shirts": ("tee shirts",), "cardboard": ("card board",),
    "a crowd of": ("a crow of", "a crows of", "a crowed of"), "crowded": ("crowed",),
    "a lake": ("a body of water", "a large body of water"),
    "grass": ("grassy area", "grassy areas"), "snow": ("snowy area", "snow covered area"),
    "trees": ("wooded area",),
    "towards": ("to join", "to catch up with"),
    "a woman": ("a women",),
    "a man": ("a men",),
    "riding a horse": ("riding on horseback", "riding horseback"),
    "on a horse": ("on horseback",),
    "": (
        *(f"and {one}" for one in ("reappears", "reappears again", "comes out the other side",
                                   "comes out on the other side", "emerges on the other side",
                                   "reappears on the other side")),
        *_OWN_AXES, *(f"{about} {axis}" for about in ("about", "around") for axis in _OPTICAL),
        "and more", "and others", "ready to be eaten", "ready to eat", "waiting to be eaten",
        "are ready to be eaten", "is ready to be eaten", "of some sort", "of some kind",
        "of all kinds", "of various kinds", "of different kinds", "of all sizes", "etc",
        "on display",
    ),
    "side by side": (
        "next to each other", "next to one another", "beside each other", "alongside each other",
        "side by side with each other",
    ),
    **{f"old {who}": (f"older {who}", f"elderly {who}") for who in ("man", "woman", "couple")},
    **{
        f"beside {the} {way}": tuple(
            f"{on} {side} of {the} {way}"
            for on in ("on the", "by the", "at the", "off to the")
            for side in ("side", "edge")
        )
        for the in ("the", "a")
        for way in ("road", "street", "highway", "path", "river", "lake")
    },
    "mountain peaks": ("mountains peaks",),
    "snow covered": ("snow blanketed", "blanketed in snow", "blanketed with snow", "snow clad",
                     "snow laden", "snow dusted"),
    "grassy": ("grass covered", "covered in grass"),
    "beside": (
        "on the side of the road beside", "off to the side of", "to the side of",
    ),
    "full of": ("filled up with", "brimming with", "overflowing with", "jam packed with"),
    "with": (
        "topped with", "topped off with", "adorned with", "equipped with", "laden with",
        "stocked with", "garnished with", "furnished with", "accompanied by", "complete with",
        "that has", "which has", "that have", "which have", "that includes", "that include",
        "that contains", "that contain", "that features", "along with", "together with",
    ),
}  # fmt: skip
"""Plain words → phrases for them; "" = they say nothing of what is seen."""
