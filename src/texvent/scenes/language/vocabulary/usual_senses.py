"""Nouns with several everyday senses, of which one is drawn unless other words tell another.

Where nothing tells that the drawn sense is meant, the report names it: "wheel → wheel of a car".
The senses that are told by words are in `senses`.
"""

from __future__ import annotations

from typing import NamedTuple


class UsualSense(NamedTuple):
    """The sense of a noun that is drawn."""

    said_as: str
    """What tells it from the others."""
    cues: frozenset[str]
    """Base forms of words beside which it is meant for sure."""


_PLAY = "playground park child kid girl boy toddler play climb push"
_DRINK = """drink water wine juice milk beer whisky table cup bottle waiter toast lemonade tea straw
    drop break fall shatter pour fill empty clink smash hold wash tip spill"""

USUAL_SENSES: dict[str, UsualSense] = {
    noun: UsualSense(said_as, frozenset(cues.split()))
    for noun, said_as, cues in (
        ("arrow", "archer's arrow", "bow archer archery shoot target quiver hunter bowstring"),
        ("bar", "bar counter", "bartender barman pub beer cocktail wine stool drink whisky"),
        ("basin", "wash basin", "wash tap faucet bathroom water hand face"),
        ("bow", "archer's bow", "arrow archer archery hunter shoot quiver"),
        ("bolt", "screw", "wrench tighten loosen screw unscrew spanner nut metal plate engine"),
        ("brush", "hairbrush", "hair comb"),
        ("bubble", "soap bubble", "soap blow float air child kid pop park"),
        ("bulb", "light bulb", "light lamp glow led socket flicker switch electric bright dim"),
        ("cap", "baseball cap", "wear head hat baseball"),
        ("catcher", "baseball catcher", "baseball pitcher batter glove mitt"),
        ("chest", "treasure chest", "treasure gold pirate lid coin wooden"),
        ("circle", "flat disc", "white black grey red blue green yellow square triangle screen"
                                " background stimulus line pattern contrast"),
        ("column", "pillar", "temple stone marble roof building hall greek roman"),
        ("comb", "hair comb", "hair"),
        ("crane", "tower crane", "construction building tower load site lift harbour steel beam"
                                 " container skyscraper"),
        ("diver", "scuba diver", "scuba underwater reef fish coral sea shark wreck turtle oxygen"),
        ("dot", "flat disc", "white black grey red blue green yellow square screen background"
                             " stimulus line pattern contrast"),
        ("drill", "power drill", "hole wall wood screw worker carpenter bolt metal"),
        ("fan", "electric fan", "electric blade spin rotate turn table desk ceiling cool wind"),
        ("fork", "table fork", "knife spoon plate eat food table salad"),
        ("gear", "cog wheel", "cog wheel machine clock motor mesh turn rotate spin tooth"),
        ("glass", "drinking glass", _DRINK),
        ("gun", "pistol", "shoot fire bullet robber police pistol"),
        ("heart", "heart of plastic", "red plastic toy shape model beat pulse throb pulsate"),
        ("iron", "clothes iron", "clothes shirt board steam press"),
        ("jet", "jet plane", "fly plane sky airport land pilot runway wing fighter air"),
        ("key", "door key", "door lock keyhole house car open padlock chain"),
        ("net", "net of a court", "tennis volleyball badminton court"),
        ("pipe", "water pipe", "water leak metal plumber factory tube"),
        ("racket", "tennis racket", "tennis ball hit swing court serve player"),
        ("rail", "railway track", "train tram railway locomotive station"),
        ("ring", "ring of a finger", "finger wedding diamond gold jewel jeweller propose hand"),
        ("rocker", "rocking chair", "chair porch grandmother grandfather rock"),
        ("scale", "kitchen scale", "weigh weight kitchen pan"),
        ("seal", "seal in the sea", "sea ice fish swim beach zoo water ocean animal circus"),
        ("shell", "seashell", "beach sea sand ocean shore"),
        ("shower", "shower of a bathroom", "bathroom water wash bath head tap"),
        ("slide", "playground slide", _PLAY),
        ("spring", "metal spring", "metal coil bounce compress steel stretch weight oscillate"),
        ("square", "flat square", "white black grey red blue green yellow circle triangle screen"
                                  " background stimulus line pattern contrast rotate"),
        ("star", "star with five points", "toy paper gold yellow christmas tree shape point"),
        ("swing", "playground swing", _PLAY),
        ("tank", "army tank", "army soldier military war battle battlefield gun desert turret"),
        ("tap", "water tap", "water sink drip wash kitchen bathroom"),
        ("target", "archery target", "arrow archer archery dart shoot bow hit aim"),
        ("torch", "burning torch", "fire burn flame cave night dark knight"),
        ("tower", "stone tower", "stone castle wall medieval flag clock bell town city old"),
        ("turbine", "wind turbine", "wind field hill offshore blade turn"),
        ("wheel", "wheel of a car", "car truck tyre tire bicycle bike vehicle roll axle"),
    )
}  # fmt: skip
