"""Kinds of people, by the person that is shown, and words for groups of people."""

from __future__ import annotations

PEOPLE_KINDS: dict[str, str] = {
    "person": """
        chef, cook, baker, waiter, barista, bartender, butcher, farmer, gardener, fisherman,
        hunter, shepherd, driver, pilot, sailor, captain, astronaut, soldier, officer,
        policeman, police officer, guard, lifeguard, firefighter, fireman, doctor, nurse,
        surgeon, dentist, patient, scientist, researcher, engineer, technician, mechanic,
        electrician, plumber, carpenter, welder, blacksmith, potter, painter, artist,
        sculptor, musician, drummer, guitarist, violinist, pianist, singer, conductor,
        dancer, actor, clown, magician, juggler, acrobat, gymnast, athlete, player, teacher,
        student, professor, customer, seller, vendor, shopkeeper, cashier, tourist,
        traveller, traveler, passenger, commuter, visitor, guest, spectator, neighbour,
        neighbor, hiker, climber, rock climber, mountaineer, diver, scuba diver, swimmer,
        surfer, skier, snowboarder, skater, skateboarder, figure skater, ice skater, boxer,
        wrestler, fencer, archer, golfer, goalkeeper, goalie, batter, catcher, referee,
        cowboy, knight, monk, priest, bride, groom, dad, father, grandfather, parent,
        uncle, husband, photographer, cameraman, operator, postman, mailman, courier,
        delivery man, thief, lumberjack, miner, janitor, cleaner, barber, tailor, librarian,
        secretary, employee, manager, boss, lawyer, judge, detective, spy, ninja, samurai,
        pirate, wizard, robber, zombie, human being, figure, passer by, bystander, stranger,
        adult, individual, someone, football player, soccer player, basketball player,
        tennis player, hockey player, baseball player, golf player, volleyball player,
        badminton player, table tennis player, lamplighter, apprentice, hurdler, rower,
        paddler, rider, jockey, friend, couple member, striker, defender, midfielder,
        quarterback, toreador, bullfighter""",
    "woman": """
        waitress, actress, ballerina, mother, mom, mum, grandmother, grandma, aunt, wife,
        queen, princess, nun, housewife, businesswoman, policewoman, bridesmaid, witch,
        cheerleader, stewardess, young woman, old woman""",
    "man": """
        king, prince, grandpa, young man, old man, santa claus, dude, bloke, businessman""",
    "child": """
        toddler, baby, infant, teenager, teen, schoolboy, pupil, son, brother, little boy,
        young boy, twin, newborn, youngster, youth""",
    "girl": "schoolgirl, daughter, sister, little girl, young girl, teenage girl",
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
}  # fmt: skip
"""Word for a group of people → how many are shown."""
