"""Set phrases, by the plain words that they mean."""

from __future__ import annotations

_PARTS_OF_AIR = ("tendrils", "wisps", "plumes", "curls", "puffs", "a plume", "a wisp", "a curl",
                 "a puff")  # fmt: skip

SET_PHRASES: dict[str, tuple[str, ...]] = {
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
