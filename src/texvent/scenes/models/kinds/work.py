"""Kinds of tools, machines, laboratory and office things, instruments, sports gear, arms."""

from __future__ import annotations

WORK_KINDS: dict[str, str] = {
    "drill": """
        nail gun, hammer drill, glue gun, screw gun, soldering iron, blowtorch, blow
        torch, electric screwdriver, heat gun, welding torch, hot glue gun, barcode
        scanner, handheld scanner, spray gun, laser gun""",
    "axe": """
        pickaxe, pick axe, ice axe, ice pick, battle axe, mattock, splitting axe,
        cleaver axe, adze""",
    "screwdriver": """
        chisel, file, awl, allen key, hex key, metal file, wood chisel, wood carving
        knife, engraving tool, soldering pen, crank handle""",
    "wrench": """
        crowbar, pry bar, socket wrench, pipe wrench, caliper, calipers, vernier
        caliper, adjustable wrench, lever, crank, torque wrench, car jack""",
    "pliers": """
        clamp, wire cutter, wire cutters, bolt cutter, forceps, kitchen tongs, crimping tool""",
    "scissors": """
        shears, pruning shears, hedge shears, garden shears, secateurs, hair scissors,
        tailor scissors, snips""",
    "saw": "jigsaw tool, coping saw, band saw, bow saw, fret saw, crosscut saw",
    "chainsaw": "hedge trimmer, leaf blower, brush cutter, strimmer, weed whacker, string trimmer",
    "bucket": """
        paint can, paint bucket, ice bucket, can of paint, paint pot, sand bucket, toy
        bucket, champagne bucket, washtub, wash tub""",
    "paintbrush": "paint roller, artist brush, house painting brush",
    "screw": "nut and bolt, hex bolt, wing nut, threaded rod",
    "nail": """
        needle, sewing needle, thumbtack, tack, pin, push pin, paper clip, paperclip,
        hairpin, safety pin, toothpick, rivet, spike nail, fish hook, fishhook, hook""",
    "ruler": """
        spirit level, carpenter level, measuring stick, protractor, set square, t
        square, yard stick""",
    "engine": """
        generator, compressor, air compressor, pump, water pump, electric motor, car
        engine, piston, diesel engine, motor block, gearbox, diesel generator, valve,
        turbocharger""",
    "gear": "pulley, sprocket, flywheel, bearing, ball bearing, bicycle chain, chainring",
    "chain": "chain link, anchor chain, gold chain, snow chain, bike chain",
    "spring": """
        slinky, coil, metal coil, helix, dna model, dna, dna strand, double helix,
        corkscrew coil""",
    "rope": """
        cable reel, fishing line, electric cable, power cable, power cord, wires,
        cables, fishing net, net rope, lifeline, garland, tinsel, string lights""",
    "hose": "fire hose, water hose, iv drip, drip tube, garden pipe",
    "soda can": """
        can of beans, can of soda, pepsi can, can of beer, can of soup, tuna can,
        aerosol can, energy drink, food can, tomato can""",
    "barrel": """
        oil barrel, wine barrel, water barrel, beer barrel, beer keg, wooden cask, metal
        drum, gas cylinder, gas bottle, propane tank, gas canister, oxygen tank, milk
        churn""",
    "crate": """
        shipping crate, milk crate, plastic crate, cargo crate, cargo box, packing
        crate, chicken crate, fruit crate, beer crate, apple crate, storage crate, hay
        box""",
    "conveyor belt": """
        assembly belt, baggage carousel, luggage carousel, baggage belt, luggage belt,
        airport conveyor, sorting belt, moving walkway, travelator, checkout belt,
        roller conveyor""",
    "robot arm": """
        industrial arm, robot manipulator, robotic
        hand, robot hand, welding robot, prosthetic arm, pick and place robot, cobot,
        two armed robot, delta robot""",
    "robot": """
        bipedal robot, service robot, robot waiter, humanoid machine, droid, cyborg man,
        robot butler""",
    "mobile robot": """
        moon rover, lunar rover, wheeled rover, planetary rover, warehouse robot,
        inspection robot, exploration rover, robot car, tracked robot, robot platform""",
    "microscope": "electron microscope, stereo microscope",
    "magnifying glass": """
        glass lens, camera lens, optical lens, monocular, loupe glass, hand mirror""",
    "test tube": """
        pipette rack, vial, glass vial, pipette, micropipette, test tube holder, row of vials,
        glass tube, syringe rack""",
    "circuit board": """
        breadboard, cpu, processor, resistor, transistor, integrated circuit, arduino,
        raspberry pi, graphics card, memory card, sim card, usb stick, usb drive, flash
        drive, electronics, electronic component, semiconductor""",
    "checkerboard": """
        chess pattern, crossword, grid, chequered flag board, checkered pattern""",
    "centrifuge": """
        incubator, autoclave, laboratory instrument, spectrometer, pcr machine, lab
        instrument, fume hood, sterilizer, shredder""",
    "medical monitor": """
        ecg monitor, patient monitor, vital signs monitor, defibrillator, ultrasound
        scanner, dialysis machine, ventilator machine""",
    "operating table": """
        stretcher, gurney, massage table, dentist chair, dental chair, examination
        table, hospital stretcher, x ray table, hospital bed trolley""",
    "radio": """
        multimeter, tape recorder, amplifier radio, two way radio, geiger counter,
        voltmeter, cassette recorder, guitar amp, effects pedal, intercom, car radio,
        baby monitor, mixing console, dj deck, dj booth, dj controller""",
    "cd": "lp, vinyl, vinyl disc, film reel, disc record, laserdisc",
    "music keyboard": "keyboard piano, piano keys, piano keyboard, midi keyboard, keytar",
    "microphone": """
        microphone stand, mic stand, boom microphone, studio microphone, podium
        microphone""",
    "violin": "bow of a violin, rebec, violin bow",
    "harp": "lyre, zither, autoharp",
    "trumpet": "bagpipes, bagpipe, horn instrument, vuvuzela, hunting horn, sousaphone, brass horn",
    "drum": "bass drum, taiko drum, conga, hand drum, kettledrum, tabla, war drum, cajon",
    "cymbal": "hi hat, crash cymbal, ride cymbal, finger cymbals",
    "handbell": """
        rattle, baby rattle, doorbell, door bell, cowbell, school bell, sleigh bell,
        jingle bell, bicycle bell, desk bell, service bell, bell ringer bell""",
    "triangle": "musical triangle, set triangle",
    "whistle": "referee whistle, duck call, kazoo",
    "hockey stick": """
        lacrosse stick, field hockey stick, polo mallet, croquet mallet, curling broom,
        shinty stick, cane, walking stick, baton, wooden stick, shepherd staff, crook""",
    "pool cue": """
        cue, cue stick, snooker cue, wooden pole, rod, flag pole stick, trekking pole,
        hiking pole, vaulting pole, bamboo stick, broomstick, stake, wooden stake,
        curtain rod, metal rod""",
    "dumbbell": "shot put, weight plate",
    "barbell": "weight bench, bench press, barbell weights, weight bar, olympic bar",
    "treadmill": """
        elliptical, elliptical trainer, rowing machine, cross trainer, stepper, gym
        machine, exercise machine""",
    "punching bag": "heavy bag, boxing bag, speed bag, heavy punching bag, sandbag hanging",
    "basketball hoop": "backboard, basketball goal, basket hoop, basketball rim",
    "goal": """
        handball goal, goal net, football net, goal post, penalty goal, lacrosse goal,
        water polo goal""",
    "net": "fishing net rack, badminton court net, pickleball net, safety net, cargo net",
    "archery target": "shooting range target, round target",
    "dart": "blowgun dart, tranquilizer dart",
    "arrow": "crossbow bolt, arrow shaft, bolt of a crossbow",
    "bow": "crossbow, longbow bow, recurve bow, compound bow, slingshot, hunting bow, catapult toy",
    "cannon": """
        catapult, trebuchet, ballista, howitzer, mortar gun, artillery, bombard,
        artillery gun, field cannon""",
    "stool": """
        pommel horse, vaulting horse, vaulting box, starting block, piano stool, kitchen
        stool, milking stool, step stool""",
    "trophy": "gold cup, champions cup, winner cup, oscar statue, prize cup",
    "medal": """
        gold medal, silver medal, bronze medal, badge, sheriff badge, buckle, belt
        buckle, compass medal, brooch, insignia, pocket watch medal""",
    "chessboard": "game board, checkers board",
    "dice": "game dice, pair of dice",
    "coin": """
        gold coin, poker chip, casino chip, gold coins, cent, euro coin, silver coin,
        copper coin, token coin, doubloon""",
    "sword": """
        spear blade, machete, dagger sword, foil, scimitar, broadsword, toy sword,
        wooden sword, fencing foil, epee""",
    "shield": "knight shield, riot shield, round shield",
    "lighter": "matchbox lighter, gas lighter, zippo",
    "torch": "olympic torch, flaming torch",
    "flashlight": "pocket lamp, searchlight hand lamp, bike light, bicycle light, spot light torch",
    "mirror": """
        rearview mirror, side mirror, wing mirror, dressing mirror, bathroom mirror,
        vanity mirror, full length mirror""",
    "whiteboard": "flipchart, drawing board, projector board",
    "tripod": "camera stand, camera tripod, telescope tripod, theodolite, surveying instrument",
    "projector": """
        film projector, old film projector, movie projector, slide projector,
        film reel projector, cinema projector,
        overhead projector""",
    "photo camera": """
        cameras, disposable camera, mirrorless camera, camera on a strap, action camera,
        gopro""",
    "cell phone": """
        cellular phone, walkie talkie phone, android phone, phone screen, game boy,
        handheld console""",
    "clock": "cuckoo clock case, station clock, tower clock, mantel clock, digital timer",
    "spinning top": "toy top, humming top",
    "sphere": """
        musket ball, cannonball, cannon ball, pellet, torus, ellipsoid, globe ball,
        dewdrop, bubble gum ball, pearl ball""",
    "cube": """
        cuboid, rectangular block, tetrahedron, polyhedron, sugar cube, metal cube, foam
        block, toy cube, metal block, workpiece, block of wood, wood block, voxel""",
    "disc": "circle shape, cutting disc, round shape",
    "square": "rectangle, hexagon, rhombus, rectangle shape, square shape, polygon",
    "grating": "zebra pattern, line pattern",
    "sled": "snow tube, snow sled, dog sled, luge",
    "soap bubble": "foam bubble",
    "frying pan": "steel pan, cast iron pan, iron skillet",
    "crib": "playpen, manger, cot bed",
    "school desk": "cubicle, exam desk, study desk",
    "display case": """
        glass case, trophy case, exhibit case, jewelry case, counter display, showcase
        window""",
    "wheelchair": "electric wheelchair, hospital wheelchair",
    "led": "diode",
    "zoetrope": "praxinoscope",
    "marble run": "rube goldberg machine, chain reaction machine",
    "bunsen burner": "alcohol burner",
    "table saw": "circular saw",
    "molecule": "atom",
}
"""Noun of the models → kinds of it, separated by commas."""
