"""Kinds of things in rooms: of the house, the kitchen, clothes, what people carry."""

from __future__ import annotations

INDOOR_KINDS: dict[str, str] = {
    "window": "windowsill, window sill, casement, skylight, bay window, porthole",
    "door": "sliding glass door, elevator door, lift door, screen door, cellar door, hatch",
    "fence": "banister, balustrade, guardrail fence",
    "stairs": "staircase steps, doorstep, stairwell, steps",
    "desk lamp": "night light, bedside light, clip lamp",
    "lamp": "night lamp",
    "heater": "air conditioner, air conditioning unit, humidifier, dehumidifier",
    "plug": "socket, power outlet, outlet, wall socket, extension cord, light switch",
    "scale": "thermostat",
    "rope": """
        wire, string,  ribbon, shoelace, extension cable, leash,
        dog leash""",
    "stool": "ottoman, pouffe, pouf, footrest, bean bag, beanbag",
    "towel": "bath mat, beach towel, hand towel, dishcloth, dish cloth, tea towel, washcloth",
    "napkin": "handkerchief, placemat, paper napkin, duster, dust cloth, cloth, rag",
    "soap": "sponge, dish sponge, shampoo bar",
    "bottle": """
        shampoo, shampoo bottle, detergent, dish soap, soap dispenser, perfume, ketchup
        bottle, ketchup, mustard, olive oil, cooking oil, oil bottle, sauce bottle, soy
        sauce, vinegar, nail polish, whiskey, whisky, champagne, champagne bottle, soda,
        baby bottle, ink bottle, spray bottle, sanitizer, potion, rum, vodka""",
    "box": """
        tissue box, first aid kit, tissue, tupperware, egg carton, jewelry box,
        matchbox, toy box, board game, canister, bread box, sugar box, cooler, ice box,
        milk carton, juice box, moving box, pencil case""",
    "basket": """
        laundry basket, bread basket, picnic basket, easter basket, waste basket, fruit
        basket""",
    "shovel": "dustpan, hoe, snow pusher, coal shovel",
    "dustbin": """
        recycling bin, garbage bin, wheelie bin, trash bag, garbage bag, bin bag, litter
        box""",
    "bowl": """
        sieve, strainer, mixing dish, sugar bowl, dog bowl, fruit bowl, cereal, oatmeal,
        porridge, yogurt, yoghurt, pudding, mortar,
        granola, ashtray, soap dish, birdbath, bird bath""",
    "tray": """
        baking tray, baking sheet, oven tray, cookie sheet, dish rack, ice cube tray,
        cake tin, litter tray, muffin tin""",
    "pot": "casserole dish, pressure cooker, rice cooker, slow cooker, soup pot, fondue",
    "frying pan": "saute pan, paella pan",
    "oven": "stovetop, burner, hob, cooktop, gas stove, kiln, wood stove",
    "blender": """
        juicer, coffee grinder, smoothie maker, hand mixer, mixer, stand mixer, electric
        mixer""",
    "toaster": "sandwich maker, waffle maker",
    "knife": """
        peeler, box cutter, utility knife, pizza cutter, scalpel, dagger blade,
        switchblade, pocketknife, can opener""",
    "spoon": "measuring spoon, scoop, ice cream scoop",
    "corkscrew": "bottle opener",
    "plate": "coaster, cake plate, serving plate, discus",
    "shelf": """
        spice rack, wine rack, shoe rack, towel rack, plate rack, server rack, storage
        rack, pantry""",
    "wardrobe": "medicine cabinet, filing cabinet, file cabinet, storage cabinet",
    "desk": """
        reception desk, checkout
        counter, bar  check in desk, work table, drafting table""",
    "bar counter": "bar",
    "table": "poker table, tabletop, folding table, patio table, trestle table, bistro table",
    "clock": "kitchen timer, timer, barometer",
    "picture frame": """
        painting of a landscape, portrait painting, canvas painting, framed photo,
         oil painting, wall art, tapestry""",
    "poster": "wall poster, mural, graffiti, x ray, advert, movie poster",
    "speaker": "stereo, hi fi, sound system, smart speaker, boom box, loud speaker",
    "game controller": """
        controller, game console, video game console, gaming console, playstation, xbox""",
    "chessboard": "puzzle, jigsaw puzzle, jigsaw, go board, draughts board, checkers",
    "doll": "puppet, ventriloquist dummy, voodoo doll, rag doll, garden gnome, gnome, hand puppet",
    "toy block": "lego, lego bricks, building bricks, lego block",
    "toy train": "train set, model railway",
    "key": "keychain, car key, bunch of keys, set of keys, key ring",
    "pen": """
        lipstick, makeup brush, mascara, eyeliner, laser pointer, highlighter, crayon
        pen, magic wand, wand, chalk, conductor baton, cigarette, cigar, thermometer,
        glue stick, stylus, drill bit""",
    "pencil": "knitting needle, drawing pencil, matchstick, incense stick",
    "chopstick": "drumstick pair, drum stick, drumstick, drumsticks",
    "cassette": "tape cartridge, video tape, vhs tape",
    "ring": "earring, hoop earring, engagement ring, signet ring",
    "necklace": "pearl, pearls, jewelry, jewellery, jewel, bead chain, pendant, rosary",
    "dress": """
        wedding dress, evening dress, evening gown, ball gown, nightgown, sundress, costume,
        summer dress""",
    "trousers": "leggings, tights, sweatpants, slacks, khakis, ski pants, chinos",
    "shirt": """
        uniform shirt, plaid shirt, polo shirt, flannel shirt, undershirt,
          hawaiian shirt""",
    "jacket": """
        denim jacket, leather jacket, winter jacket, ski jacket, parka,
        armor, armour, windbreaker, bomber jacket, anorak, rain jacket""",
    "cap": "graduation cap, swim cap, swimming cap, headband, visor, nurse cap, flat cap",
    "glove": "boxing mitts, rubber glove, gardening glove, work glove, ski glove",
    "glasses": """
        diving mask, snorkel, snorkel mask, swimming goggles, safety glasses, safety
        goggles, reading glasses, monocle, ski goggles, vr headset, virtual reality
        headset, vr goggles, sunglass""",
    "mask": """
        face mask, welding mask, gas mask, carnival mask, oxygen mask, ski mask, dust
        mask, halloween mask, fencing mask""",
    "sweater": "turtleneck, turtleneck sweater, knitted sweater, knit sweater, turtle neck",
    "helmet": "bike helmet, ski helmet, riding helmet, construction helmet",
    "scarf": "veil, headscarf, neckerchief",
    "shoe": """
        ballet shoe, ski boot, ski boots, oxford shoe, dress shoe, pump shoe, football
        boot, snow boot, flipper, snowshoe""",
    "handbag": "pouch, makeup bag, money bag, toiletry bag, leather bag, bag of money",
    "backpack": "hiking backpack, school backpack, camera bag",
    "suitcase": "carry on, trunk case, duffel bag, gym bag, sports bag, toolkit bag",
    "card": """
        credit card, ticket, id card, name tag, price tag, tarot card, luggage tag,
        label, bank card, greeting card, stamp, postage stamp, tag""",
    "closed book": """
        passport, folder, binder, photo album, album, bible book, ledger, hymn book,
        spell book, cookbook""",
    "page": """
        money, cash, dollar, euro bill, sheet music, scroll, blueprint, sticky note,
        post it note, contract, certificate, prescription, worksheet, clipboard, paper
        sheet, wrapping paper, invoice, parchment, envelope of paper, tissue paper""",
    "flower": "bud, flower bud",
    "vase": "planter, flower vase, porcelain vase, pottery, clay pot, ceramic pot",
    "bouquet": """
        flower bouquet, bunch of flowers, bunch of roses, floral arrangement, wreath,
        ikebana""",
    "pillow": "throw pillow, beanbag cushion, sandbag neck pillow",
    "candle": "birthday candle, tea light, tealight, candle stub",
    "star": "ornament star, paper star",
    "ball": "bauble, christmas ornament, ornament, balloon ball, toy ball",
    "teddy bear": "soft toy, plushie, stuffed toy, stuffed bear toy, cuddly toy",
    "rug": """
        doormat mat, carpet runner, bath rug, red carpet, tarp, tarpaulin, sleeping bag,
        gym mat, exercise mat, floor mat, puzzle mat""",
    "laptop": "chromebook, ultrabook",
    "monitor": """
        display,
        information screen, lcd screen, radar screen, gaming monitor, ultrasound
        machine, control panel, fish finder, touchscreen, touch screen""",
    "stapler": "staple gun, hole punch",
    "blanket": "tablecloth",
}
"""Noun of the models → kinds of it, separated by commas."""
