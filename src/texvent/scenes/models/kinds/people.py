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

PEOPLE_GROUPS: dict[str, int] = {
    "couple": 2, "pair": 2, "family": 4, "crowd": 8, "team": 5, "audience": 8, "band": 4,
    "group of people": 5, "ground crew": 3, "orchestra": 8, "choir": 6, "class": 6,
}  # fmt: skip
"""Word for a group of people → how many are shown."""
