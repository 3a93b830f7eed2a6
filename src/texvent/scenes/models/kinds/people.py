"""Kinds of people, by the person that is shown, and words for groups of people."""

from __future__ import annotations

PEOPLE_KINDS: dict[str, str] = {
    "person": """
        drummer, judge, wrestler, fighter, barista, hunter, driver, officer, guard, patient,
        engineer, electrician, sculptor, musician, pianist, dancer, actor, juggler,
        acrobat, gymnast, athlete, player, teacher, professor, customer, seller, vendor,
        shopkeeper, cashier, traveller, traveler, passenger, commuter, visitor, guest,
        spectator, neighbour, neighbor, skater, parent, operator, thief, barber, tailor,
        librarian, secretary, employee, manager, boss, detective, spy, robber, zombie,
        human being, figure, passer by, bystander, stranger, adult, individual, someone,
        volleyball player, lamplighter, apprentice, hurdler, rower, paddler, rider,
        friend, couple member, toreador, bullfighter, programmer, architect, florist,
        hairdresser, bus driver, taxi driver, truck driver, train driver, flight
        attendant, reporter, journalist, writer, author, dj, karate fighter, martial
        artist, trainer, personal trainer, instructor, coach person, horseback rider,
        skydiver, parachutist, bodybuilder, weightlifter, yoga instructor, yogi, beggar,
        homeless man, homeless person, busker, stuntman, scout, kayaker, breakdancer,
        break dancer, mime, beekeeper, tightrope walker, makeup artist, hotel guest,
        receptionist, clerk, host, presenter, speaker at a lectern, scholar, poet,
        politician, president, mayor, announcer, volunteer, competitor, contestant,
        opponent, teammate, winner, champion, rival, owner, assistant, intern,
        inspector, surveyor, craftsman, artisan, cobbler, shoemaker, watchmaker,
        jeweller, jeweler, locksmith, goldsmith, roofing worker, window cleaner, window
        washer, chimney sweep, truck loader, dockworker, docker, porter, bellhop,
        doorman, bouncer, crossing guard, train conductor, ticket inspector, attendant,
        colleague, coworker, roommate, tenant, resident, villager, citizen, immigrant,
        refugee, prisoner, inmate, criminal, burglar, hostage, witness, victim, suspect,
        assassin, sniper, gunman, gangster, warrior, hero, heroine, villain, vampire,
        elf, dwarf, hobbit, goblin, ghost hunter, influencer, blogger, gamer, video
        gamer, rapper, rock singer, backup dancer, hip hop dancer, ballroom dancer,
        tango dancer, tap dancer, belly dancer, trapeze artist, fire breather, fire
        eater, contortionist, puppeteer, hypnotist, fortune teller, caricaturist, tattoo
        artist, illustrator, designer, fashion model, seamstress, weaver, knitter,
        calligrapher, monk in robes, pilgrim, nomad, hermit, explorer, adventurer,
        camper person, birdwatcher, forager, beachgoer, sunbather, bather, partygoer,
        concertgoer, clubber, moviegoer, shopper, diner guest, patron, drinker, eater,
        smoker, sleeper, caregiver, carer, babysitter, nanny, midwife, therapist,
        physiotherapist, psychologist, optician, pharmacist assistant, radiologist,
        anesthetist, orderly, caretaker, groundskeeper, zookeeper, zoo keeper, animal
        trainer, dog walker, dog trainer, horse trainer, stable boy, ranch hand,
        milkmaid, beekeeper in a veil, winemaker, brewer, cheesemaker, fishmonger,
        greengrocer, grocer, confectioner, chocolatier, pastry cook, line cook,
        dishwasher person, caterer, performer,
        ranger, park ranger, bowler, cellist, flautist, flutist, harpist, trumpeter,
        saxophonist, bassist, percussionist, trombonist, clarinetist, oboist, organist,
        accordionist, banjoist, chorister, coxswain, musher, winger, classmate,
        embroiderer, quilter, basketmaker, glazier, silversmith, engraver, bookbinder,
        cartoonist, animator, woodcarver, cabinetmaker, luthier, wheelwright, farrier,
        distiller, landscaper, goatherd, cowherd, drover, helmsman, deckhand, copilot,
        housekeeper, concierge, hawker, peddler, auctioneer, accountant, juror, bodyguard,
        orthodontist, masseuse, masseur, botanist, zoologist, archaeologist, geologist,
        physicist, astronomer, lecturer, historian, videographer, filmmaker, choreographer,
        illusionist, ventriloquist, kickboxer, judoka, karateka, powerlifter, vaulter,
        speedskater, biathlete, canoeist, oarsman, snorkeler, equestrian, polo player,
        caddie, linesman, rollerblader, hitchhiker, imam, rabbi, preacher, worshipper,
        onlooker, passerby, trainee, activist, protester, marcher, demonstrator,
        pickpocket, sibling, tattooist, stylist, beautician, manicurist, ringmaster,
        falconer, reenactor, cosplayer, newscaster, stargazer, birder, prospector,
        ceramist, grandchild""",
    "woman": """
        actress, housewife, businesswoman, bridesmaid, cheerleader, stewardess, ballroom
        lady, nurse midwife, saleswoman, female runner, pregnant woman, hostess,
        business woman, policewoman in plain clothes, goddess, landlady, grandaunt,
        niece, girlfriend, schoolmistress, mermaid,
        stepmother, fiancee, cowgirl, horsewoman, stuntwoman""",
    "man": """
        prince, boyfriend, businessperson, nephew, landlord, grandson, bearded man, bald
        man, middle aged man, mister, lad, chap, cousin,
        groomsman, stepfather, deliveryman, chauffeur, trucker, cabbie, signalman,
        horseman, bellboy, busboy, weatherman""",
    "child": "twin, youth, kindergartner, kid in a costume, preschooler, orphan, boy scout",
    "girl": """
        teenage girl, girl scout, girl in a dress, mermaid girl,
        granddaughter""",
    "worker": """
        lineman, road worker, roofer, bricklayer, ground crew member, warehouse worker,
        factory worker, labourer, laborer, demolition worker, dock worker, sewage
        worker, rail worker, railway worker, steelworker, construction laborer, mason,
        painter and decorator, plasterer, tiler, scaffolder, crane operator, forklift
        driver, forklift operator, machine operator, excavator operator, machinist,
        assembler, foreman, site manager, farmhand, farm worker, cleaning worker, oil
        worker, power line worker, garbage collector, garbage man,
        ironworker, logger, forester, arborist, foundryman, quarryman""",
    "knight": "viking, gladiator, crusader, roman soldier, spartan, warrior in armor, swordsman",
    "teenager": "teenage boy, highschooler, high schooler, youngster in a hoodie",
    "angel": "fairy, cupid, tooth fairy",
    "soldier": """
        paratrooper, marine, guardsman, sentry, sniper in camouflage, commando, swat
        officer, hunter in camouflage""",
    "witch": "sorceress, enchantress",
    "waiter": "bartender, butler, sommelier",
    "waitress": "maid",
    "cowboy": "rancher, sheriff, rodeo rider",
    "police officer": "security guard, traffic officer",
    "pilot": "captain",
    "doctor": "dentist, veterinarian, vet",
    "technician": "pharmacist",
    "nurse": "paramedic",
    "painter": "artist",
    "janitor": "street sweeper",
    "businessman": "lawyer, banker, salesman",
    "tennis player": "badminton player, table tennis player, ping pong player, squash player",
    "american football player": "rugby player",
    "cowboy hat": "sombrero",
    "robe": "kimono, cloak",
    "suit": "tracksuit",
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
        "traffic jam",
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
    "crew": 4, "film crew": 4, "squad": 5, "troupe": 5, "ensemble": 5, "quartet": 4, "duo": 2,
    "chorus": 6, "elderly couple": 2, "old couple": 2,
}  # fmt: skip
"""Word for a group of people → how many are shown."""
