"""Kinds of people, by the person that is shown, and words for groups of people."""

from __future__ import annotations

PEOPLE_KINDS: dict[str, str] = {
    "person": """
        drummer, judge, wrestler, barista, hunter, driver, officer, guard, patient,
        engineer, electrician, sculptor, musician, pianist, dancer, actor, juggler,
        acrobat, gymnast, athlete, player, teacher, professor, customer, seller, vendor,
        shopkeeper, cashier, traveller, traveler, passenger, commuter, visitor, guest,
        spectator, neighbour, neighbor, skater, parent, operator, thief, barber, tailor,
        librarian, secretary, employee, manager, boss, detective, spy, robber, zombie,
        human being, figure, passer by, bystander, stranger, adult, individual, someone,
        volleyball player, lamplighter, apprentice, hurdler, rower, paddler, rider,
        friend, couple member, toreador, bullfighter""",
    "woman": "actress, housewife, businesswoman, bridesmaid, cheerleader, stewardess",
    "man": "prince",
    "child": "twin, youth",
    "girl": "teenage girl",
    "worker": """
        lineman, road worker, roofer, bricklayer, ground crew member, warehouse worker,
        factory worker, labourer, laborer""",
}
"""Noun of the models → kinds of it, separated by commas."""

TRAFFIC: dict[str, tuple[tuple[str, int, str], ...]] = {
    "traffic": (
        ("car", 2, "right"), ("truck", 1, "right"), ("car", 2, "left"), ("van", 1, "left"),
    ),
    "city traffic": (
        ("taxi", 1, "right"), ("car", 2, "right"), ("car", 1, "left"), ("bus", 1, "left"),
    ),
    "rush hour traffic": (
        ("car", 3, "right"), ("bus", 1, "right"), ("car", 3, "left"), ("van", 1, "left"),
    ),
}  # fmt: skip
"""Word for traffic → vehicles, how many, and which way they drive."""
TRAFFIC_WORDS: dict[str, tuple[str, ...]] = {
    "traffic": (
        "traffic",
        "highway traffic",
        "motorway traffic",
        "freeway traffic",
        "road traffic",
        "traffic flow",
        "flow of traffic",
        "stream of traffic",
        "oncoming traffic",
    ),
    "city traffic": ("city traffic", "street traffic", "urban traffic"),
    "rush hour traffic": (
        "rush hour traffic",
        "heavy traffic",
        "dense traffic",
        "busy traffic",
        "heavy city traffic",
    ),
}
"""Key of `TRAFFIC` → words for it."""

PEOPLE_GROUPS: dict[str, int] = {
    "couple": 2, "pair": 2, "family": 4, "crowd": 8, "team": 5, "audience": 8, "band": 4,
    "group of people": 5, "ground crew": 3, "orchestra": 8, "choir": 6, "class": 6,
    "elderly couple": 2, "old couple": 2,
}  # fmt: skip
"""Word for a group of people → how many are shown."""
