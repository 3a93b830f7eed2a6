"""Kinds of buildings, street furniture, nature, and vehicles with their parts."""

from __future__ import annotations

OUTDOOR_KINDS: dict[str, str] = {
    "building": """
        apartment building, apartment tower, motel, police station, fire station, post
        office, town hall, courthouse,
        parking garage, government building, mansion block, facade, tower building,
        office tower, high rise building, department store, shopping mall, shopping
        centre, shopping center, airport terminal, embassy, inn, casino, headquarters,
        apartment complex, condo""",
    "shop": """
        convenience store, corner shop, bookstore, cafe building, laundromat, pharmacy,
        drugstore, bakery, store, restaurant, cafe, coffee shop, pizzeria, butcher shop,
        barber shop""",
    "factory building": "nuclear power plant, nuclear plant, refinery",
    "house": """
        townhouse, farm house, guest house, ranch house, beach house, summer house,
        gazebo, gingerbread house, dollhouse, doll house, holiday home""",
    "hut": """
        newsstand, ticket booth, toll booth, tollbooth, guard booth, bungalow hut,
        treehouse, tree house, gatehouse, boat house, sentry box, beach hut, garden
        shed, tool shed, sauna""",
    "church": "synagogue, steeple",
    "mosque": "dome, domed building, taj mahal, palace dome",
    "temple": "greek ruin, parthenon, mausoleum",
    "tower": """
        spire, observation tower, belfry, cooling tower, leaning tower, obelisk tower,
        fortress tower, cooling stack""",
    "power pylon": """
        eiffel tower, antenna, aerial, antenna mast, electric pole, transmission line,
        radio mast, light pole, oil derrick, telegraph pole line""",
    "satellite": "space telescope, parabolic dish, radar",
    "tent": "circus tent, canopy, big top, gazebo tent, pavilion, sun sail",
    "market stall": """
        food cart, hot dog stand, food stand, fruit stand, ice cream cart, ice cream
        stand, lemonade stand, vegetable stand, flower stall, flower stand, newspaper
        stand, coffee cart, snack bar, popcorn stand, popcorn machine, souvenir stand,
        book stall""",
    "wall": """
        sea wall, brick facade, dam, garden wall, retaining wall, great wall, parapet,
        barricade wall, quay wall, stone barrier""",
    "fence": "wire mesh fence, fence post, security fence, iron fence, metal railing, guard fence",
    "gate": """
        entrance gate, torii gate, torii, metal detector, archway gate, toll gate, park
        gate, lock gate""",
    "vending machine": """
        ticket machine, jukebox, gambling machine, drinks machine, water cooler, parking
        ticket machine, self checkout, gumball machine""",
    "gas pump": "charging station, charging point, ev charger, charger",
    "bollard": "hitching post, wooden post",
    "column": "stone pillar, obelisk, concrete pillar",
    "bridge": """
        rope bridge, footbridge bridge, railroad bridge, golden gate bridge, cable
        stayed bridge""",
    "pier": """
        boat dock, landing stage, wooden dock, wooden pier, quay, mooring dock, raised
        walkway, wooden deck""",
    "stone bridge": "stepping stones, stone arch, dam bridge",
    "ferris wheel": "observation wheel ride, amusement ride, fairground ride",
    "merry-go-round": "fairground carousel, roundabout toy, chairoplane",
    "slide": "water slide, waterslide, water chute, jungle gym, climbing frame, monkey bars",
    "flag": """
        pennant, checkered flag, pirate flag, prayer flag, weather vane, weathervane,
        semaphore flag""",
    "statue": """
        garden statue, bronze statue, angel statue, buddha statue, stone figure, snow
        sculpture, ice sculpture, wax figure, dummy, crash test dummy""",
    "gravestone": "coffin, casket, tomb, crypt stone, stone cross, milestone, stone tablet",
    "water well": "well",
    "puddle": """
        pothole, mud, mud puddle, oil slick, pool of water, water puddle, tide pool, wet
        patch""",
    "tree": """
        weeping willow, topiary, walnut, mulberry tree, cork tree, rubber tree, ebony
        tree, locust tree, hazel tree, hazel, plum blossom tree, holly, sapling tree,
        mango tree, cacao tree, ginkgo, elm tree, beech tree, linden tree""",
    "bush": """
        holly bush, rose bush, berry bush, moss, clump of bushes, shrubbery, briar,
        tumbleweed, kudzu, bramble, lavender bush""",
    "grass tuft": """
        clover, four leaf clover, moss tuft, rye, oat, rice paddy, rice plants, straw,
        tea plant, clump of grass, weeds, wild grass, thistle""",
    "leaf": """
        leaf blade, clover leaf, fig leaf, banana leaf, oak leaf, palm leaf, tea leaf,
        ivy leaf""",
    "branch": """
        root, stem, driftwood, thorn, vine branch, pussy willow, mistletoe, olive
        branch, kindling""",
    "log": """
        timber,
        firewood log, wooden log, piece of oak, wooden beam, timber beam, balance beam,
        balancing beam, log pile, driftwood log, piece of driftwood""",
    "rock": """
        mineral stone, piece of rock, stepping stone, concrete block""",
    "stone": """
        fossil, gold nugget, nugget, lump of coal, coal, geode, paving stone, cobble,
        charcoal""",
    "brick": """
        cinder block, gold bar, ingot, gold brick, paver, adobe, tile, floor tile, roof
        tile, stone block, bar of gold, butter stick""",
    "pine cone": "fir cone, hazelnut, nut, chestnut, walnut nut, hop cone",
    "spider web": "honeycomb web, dream catcher, dreamcatcher",
    "beehive": "honeycomb, wasp nest",
    "bone": "dinosaur bone, tusk, wishbone, thigh bone, dog chew, claw, fang",
    "feather": "bird feather, ostrich feather, peacock feather",
    "seashell": "oyster, mussel, oyster shell, nautilus, snail shell, ammonite",
    "earth": "blue planet, blue marble",
    "planet": "gas giant, moon of jupiter, dwarf planet, pluto, alien planet, ringless planet",
    "truck": """
        horse trailer, cargo truck bed, car carrier, flatbed, horse box, shipping
        container truck, trailer truck cab, lowloader, dumper truck cab""",
    "train": """
        train car, railway carriage, railway car, boxcar, railroad car, tram train, high
        speed rail, diesel train, carriage of a train, railroad train""",
    "bicycle": """
        cargo bike, tandem bike, tandem bicycle, bmx bike, fat bike, fixie, rental bike,
        road bicycle, penny farthing""",
    "motorcycle": """
        trike, enduro, sport bike, trail bike, motor bike, harley, cruiser motorcycle,
        motocross bike""",
    "van": "rv, panel van, mail van, cargo van, prison van, tv van, passenger van",
    "car": """
        getaway car, old car, vintage car, classic car, rental car, wrecked car, rally
        car, sedan car, toyota, tesla, coupe car, porsche, ferrari, bmw, mercedes,
        volkswagen, oldtimer""",
    "tractor": "plough, plow, hay wagon tractor, farm machine, seed drill, harrow",
    "trolley": """
        hay wagon, hay cart, luggage trolley, baggage cart, sack truck, dolly, pallet
        jack, food trolley, tool cart, cargo trolley, serving cart, housekeeping cart""",
    "scooter": "hoverboard, push bike scooter",
    "airplane": """
        boeing, airbus, passenger jet, commercial airplane, transport plane, water
        bomber, bush plane""",
    "rocket": """
        space capsule, capsule, ballistic missile, space ship, lunar lander, moon
        lander, firecracker, starship, spaceship rocket""",
    "boat": """
        rescue boat, steamboat, paddle steamer, trawler, dive boat, life raft, fishing
        trawler, police boat, inflatable boat, lobster boat, barge, pontoon""",
    "surfboard": "wakeboard, windsurf board, windsurfer, kiteboard, boogie board",
    "paddle": "canoe paddle, kayak paddle, rowing oar, rudder, wooden paddle",
    "frisbee": "hubcap, flying ring, sewer lid",
    "wind turbine": "wind power plant",
    "wheel": """
        bicycle wheel, wagon wheel, water wheel, waterwheel, mill wheel, spoked wheel,
        flat tire, spare tire, spare wheel, hamster wheel, ship wheel, car tire, car
        tyre""",
    "propeller": """
        rotor,
        ship propeller, drone propeller, propeller blade, jet engine, windmill blade,
        turbine wheel, rotor blade""",
    "sign": """
        construction sign, license plate, licence plate, number plate, wooden sign, exit
        sign, for sale sign, protest sign, direction sign, yield sign, name plate, no
        parking sign, do not enter sign, no entry sign, warning sign, neon letters, shop
        sign, railway signal, traffic board, crossing sign, protest banner""",
    "railway track": "tram track, tram tracks, rail track, monorail track, roller coaster track",
    "gravel path lines": "footpath, hiking trail, garden path, stone path",
    "cable car": "gondola lift, funicular, ski gondola, zip line, zipline",
    "ski lift": "t bar lift, drag lift, chair lift seat",
    "ski": "ski pole, ski poles, cross country ski",
    "barrier": """
        roadworks barrier, construction barrier, crowd barrier, police barrier, speed
        bump, construction fence, security barrier, crash barrier sign, finish line,
        finishing line""",
    "parachute": "parasail canopy, skydiving parachute, paraglider wing",
    "fountain": "hot spring, water jet fountain, drinking fountain, splash pad",
    "campfire": "fire pit, camp fire, log fire, bonfire pile",
    "volcano": "crater, volcanic crater, mount fuji",
    "scarecrow": "straw man",
    "hay bale": "hay, pile of hay, straw bundle",
    "park lamp": "victorian lamp, garden lantern, old street lamp, lantern post",
    "street lamp": "street lighting pole, lamp pole, light post",
    "traffic light": "traffic signal, red light, pedestrian light, signal light, railroad signal",
    "webcam": """
        surveillance cam, speed camera, traffic camera, cctv camera, lidar, sensor,
        lidar sensor, camera sensor""",
    "grill": "barbeque, charcoal grill, fire bowl, bbq grill, brazier",
    "chimney": "smoke stack, drainpipe, downspout, stovepipe",
    "pipe": """
        gutter, drain pipe, exhaust pipe, water pipe, tube, metal tube, copper pipe,
        muffler, bamboo tube, didgeridoo, rebar, hollow tube""",
    "windsock": "wind chime, wind chimes",
    "birdhouse": "bird box, insect hotel",
    "cage": """
        lobster trap, crab trap, mousetrap, mouse trap, rat trap, pet carrier, animal
        cage, rabbit hutch, hutch, chicken coop, dog crate, kennel cage""",
    "manhole cover": "drain cover, drain, storm drain, sewer grate",
    "skull": "human skull, dinosaur skull, animal skull",
    "firework": "sparkler, roman candle, bottle rocket, firework rocket",
    "snowball": "ball of snow, lump of snow, popsicle ball",
    "canoe": "birch bark canoe, outrigger",
    "ladder": """
        rope ladder, library ladder, pool ladder, aluminium ladder, extension ladder,
        parallel bars""",
    "wheelbarrow": "garden cart, barrow cart",
    "dragonfly": "firefly, mayfly, cicada, lacewing",
    "cloud": "thundercloud, puffy cloud, mushroom cloud",
    "water tower": "water tank",
    "moon": "crescent moon",
    "stalagmite": "stalactite",
    "canyon wall": "mesa, butte",
    "tornado": "hurricane, cyclone",
    "skate ramp": "quarter pipe, halfpipe, half pipe",
    "lifebuoy": "pool float",
    "fishing rod": "fishing tackle",
    "spear": "lance, harpoon",
}
"""Noun of the models → kinds of it, separated by commas."""
