"""Compounds whose last word misleads: a hair slide is no slide.

None of them can be shown, and none is to be shown as its last word.
"""

from __future__ import annotations

_TEXT = """
    waves breaking, waves crashing, waves lapping, waves rolling, waves washing, sea horse, sea
    cucumber, sea urchin, sea slug, sea cow, sea pen, ant lion, antlion, star fish, jelly bean,
    cuttle fish, silver fish, butter cup, water bear, gummy bear, horse shoe, horseshoe, sea
    dragon, dragon, bearded dragon, tasmanian devil, walking stick, stick insect, praying mantis,
    cray fish, lion fish, dog fish, catwalk, cat tail, fox glove, foxglove, pig tail, pigtail,
    pony tail, ponytail, horse tail, dove tail, swallow tail, goose bump, goose neck, chicken
    nugget, fried chicken, roast chicken, roast duck, chicken wing, chicken leg, fish finger, fish
    stick, fried fish, scrambled egg, egg cup, egg shell, egg roll, spring roll, meat loaf, meat
    ball, rice ball, rice cake, crab cake, fish cake, pan cake, hot pot, potpie, ice lolly, hot
    plate, license plate, licence plate, number plate, home plate, face plate, name plate,
    satellite dish, solar dish, dish rag, dish cloth, dishrag, dishcloth, gravy boat, banana
    split, adam apple, oak apple, horse radish, horseradish, ground nut, chest nut, chestnut, coco
    nut, pea nut, star anise, star fruit, custard apple, butternut squash, acorn squash, spaghetti
    squash, coral fungus, mushroom cloud, tag cloud, word cloud, point cloud, flower bed, river
    bed, sea bed, truck bed, seed bed, garden bed, bed bug, flower girl, power plant, nuclear
    plant, chemical plant, processing plant, treatment plant, car plant, tree house, treehouse,
    white house, green house effect, ware house, power house, doll house, dollhouse, gingerbread
    house, bounce house, bouncy castle, sand box, sandbox, gear box, gearbox, fuse box, voice box,
    juke box, jukebox, penalty box, set top box, ballot box, check box, pencil box, sound box,
    book jacket, book mark, bookmark, book end, book worm, bookworm, match book, pass book, face
    book, key ring, onion ring, ear ring, earring, nose ring, ring finger, ring road, tree ring,
    wrestling ring, circus ring, rubber ring, swim ring, life ring, teething ring, hair bow,
    violin bow, rain bow, cross bow, crossbow, ear drum, brake drum, drum stick, drumstick, pogo
    stick, memory stick, usb stick, glow stick, match stick, matchstick, candle wick, cinnamon
    stick, selfie stick, stick figure, lip stick, lipstick, score card, sound card, graphics card,
    memory card, sim card, credit card, report card, dash board, dashboard, card board, ouija
    board, mood board, spring board, diving tower, eiffel tower, cooling tower, computer tower,
    light tower, leaning tower of pisa, big ben, golden gate, statue of liberty, light switch,
    light saber, light year, traffic jam, fire screen, window screen, sun screen, sunscreen, smoke
    screen, screen door, screen saver, wind screen, windscreen, windshield, car mirror, rear view
    mirror, side mirror, ball gown, cannon ball, cannonball, eye ball, eyeball, paint ball, pin
    ball, wrecking ball, cotton ball, fur ball, dust ball, hair ball, masked ball, mosquito net,
    hair net, fishing net, butterfly net, cargo net, safety net, lens cap, bottle cap, bottlecap,
    ice cap, gas cap, hub cap, hubcap, knee cap, polar cap, brake shoe, snow shoe, snowshoe, shoe
    horn, shoe shop, shoe lace, shoelace, shoe shiner, sock puppet, bell cote, door bell,
    doorbell, alarm bell, bell boy, bell bottom, dumb waiter, cow bell, cowbell, barbell squat,
    door knob, doorknob, trap door, cat flap, train station, parking lot car, side car, dining
    car, street car, car seat, child seat, seat belt, safety belt, conveyor system, fan belt,
    chain mail, chain reaction, food chain, daisy chain, bicycle chain lock, feather boa, boa
    scarf, hair slide, water slide, mud slide, landslide, slide rule, slide show, microscope
    slide, hair pin, hairpin, safety pin, rolling pin, rolling mill, pepper mill, saw mill,
    sawmill, coffee mill, steel mill, tread mill, paper mill, wind chime, rock star, movie star,
    film star, pop star, star ship, star sign, death star, sheriff star, road fork, bicycle fork,
    jack knife, butterfly knife trick, tooth pick, toothpick, ice pick, guitar pick, finger nail,
    fingernail, toe nail, toenail, nail polish, nail file, nail gun, band saw, jig saw, jigsaw,
    jigsaw puzzle, drill sergeant, seed drill, oil filter, coffee filter, water filter, water
    meter, gas meter, speed meter, parking brake, disk brake, hand brake, floppy disk, disk
    jockey, piano key, arrow key, computer key, key lime, space bar, chocolate bar, crow bar,
    crowbar, wrist watch band, neck watch, cell wall, cell division, fire wall, firewall, sea
    wall, sidewall, climbing wall, wall paper, wallpaper, wall nut, fly paper, sand paper,
    sandpaper, paper weight, paperweight, paper clip, paper trail, wrapping paper, periodic table,
    water table, time table, timetable, multiplication table, table cloth, tablecloth, table
    tennis, pool party, swimming pool ladder, fish ladder, rope ladder, step brother, spring
    water, hot spring, spring flower season, spring onion, box spring, watch spring, hair spray,
    pepper spray, bug spray, tear gas, gas mask, gasmask, face mask, ski mask, oxygen mask, death
    mask, mouse trap, mousetrap, mouse pad, mousepad, mouse hole, rat trap, cob web, web site,
    website, web page, spider plant, spider man, batman, ant hill, ant eater, anteater, bee line,
    elephant ear, elephant trunk, frog man, bullfight, bull ring, bull whip, horse power, horse
    hair, oxcart, dog ear, dog tag, dog collar, dog leash, dog food, dog biscuit, cat food, cat
    scan, cat eye, lions gate, lion king, tiger lily, tiger balm, zebra crossing, turtle neck,
    turtleneck, snail mail, snake skin, snakeskin, snake plant, crocodile clip, alligator clip,
    alligator pear, crocodile tear, kite surfer, kite board, plate rack, coat rack, bike rack,
    bike lane, towel rack, coat hook, coat hanger, clothes hanger, clothes rack, fish hook,
    crochet hook, fishing rod, lightning rod, bolt cutter, wire cutter, bolt lock, cookie cutter,
    cookie jar lid, paper cutter, steering wheel, water wheel, mill wheel, cog railway, ship
    wheel, wheel of fortune, wheel house, hamster wheel, wheel clamp, toilet brush, paint roller,
    hair roller, hair brush holder, hair band, haircut, rubber band, rock band, brass band, arm
    band, marching band, wedding band, head band, headband, band aid, tape worm, tapeworm, duct
    tape, red tape, tape dispenser, adhesive tape, scotch tape, ticker tape, screw driver drink,
    screw cap, cork board, wine cork, wine cellar, wine rack, cup holder, cup board, world cup,
    suction cup, ice cup, tea bag, teabag, sleeping bag, air bag, airbag, bean bag, beanbag, body
    bag, saddle bag, vacuum bag, plastic surgery, can opener, bottle opener, tin opener, tin foil,
    tinfoil, trash compactor, tin whistle, glass eye, opera glass, hour hand, second hand, minute
    hand, clock hand, hand cuff, handcuff, hand rail, hand bag strap, hand grenade, hand gun,
    handgun, hand brush, handkerchief, hand towel rail, hand cream, hand print, handprint, foot
    ball field, foot print, footprint, foot step, footstep, foot bridge toll, ear phone jack, ear
    plug, earplug, spark plug, bath plug, fire plug, hair plug, power strip, comic strip, landing
    strip, bathing suit, swim suit, swimsuit, tree surgeon, family tree, shoe tree, coat tree,
    decision tree, axle tree, tree line, palm reader, palm oil, palm pilot, palm print, pine nut,
    pine apple juice, christmas tree farm, rose wood, rose bowl, rose garden, wind rose, compass
    rose, sun flower seed, sunflower seed, sunflower oil, flower shop, ice flower, corn field,
    corn flake, corn maze, corn dog, peppercorn, pop corn, acorn, unicorn, mountain range,
    mountain pass, mountain goat cheese, rock pool, rock music, rock climbing, bed of roses,
    stepping stone, mile stone, milestone, grave stone, tomb stone, gem stone, gemstone, hail
    stone, hailstone, cobble stone street, wind turbine blade, razor blade, shoulder blade, roller
    coaster, rollercoaster, bus driver, truck driver, bus ticket, train set, boat shoe, boat
    house, ship yard, shipyard, ship wreck, shipwreck, rocket salad, rocket launcher, plane
    ticket, jet lag, jet engine, jet stream, balloon animal, hot air, speech bubble, bubble gum,
    bubble tea, bubble bath, soap opera, soap dish, soap dispenser, chandelier earring, street
    art, torch singer, fan club, sports fan, football fan, fan art, ceiling rose, desk job, chair
    man, chairman, ski resort, ski pole, sedan chair, electric chair, night stand lamp, music
    stand, music box, hat pin, tie clip, zip tie, railway tie, pillow case, clock work, scale
    model, richter scale, fish scale, scale bar, musical scale, saddle horn, car horn, fog horn,
    air horn, french kiss, orange juicer, apple pie filling, apple juice, apple sauce, banana
    peel, banana boat, big apple, lemon grass, grape vine, grape juice, cherry picker, tomato
    sauce, tomato juice, ketchup bottle cap, potato chip, potato masher, mashed potato, couch
    potato, french fry, hot sauce, carrot cake top, salt shaker, pepper shaker, saltshaker, cheese
    grater, bread crumb, bread box, sandwich board, cup cake liner, pizza cutter, pizza oven peel,
    wine press, printing press, garlic press, letter press, milk tooth, milkshake, milky way,
    coffee bean, coffee grinder, pencil sharpener, pencil skirt, pen drive, pen pal, pig pen, play
    pen, playpen, light pen, globe artichoke, artichoke, snow globe shaker, domino effect, card
    trick, house of cards, chess piece, chess clock, dice game, toy shop window, doll face, paper
    doll, puppet, voodoo doll, gate way, gateway, flood gate, gate keeper, water gate, fire gate,
    toll gate, golf course, golf bag, football pitch, net curtain, bow and arrow game, arrow head,
    arrowhead, dart frog, poison dart frog, bus bar, toad stool, nut shell, nutshell, shell
    script, bomb shell, shell suit, eggshell paint, bone china, bone marrow, wish bone, wishbone,
    back bone, backbone, jaw bone, collar bone, fish bone, trombone slide, skull cap, skullcap,
    crossbones, bird flu, bird seed, bird bath, big bird, angry bird, lady bird book, hen of the
    woods, cliff dwelling, mobile home, madagascar cat, tobacco shop, radio telescope, tank top,
    gas tank, think tank, safe house
"""

OPAQUE_COMPOUNDS: tuple[str, ...] = tuple(
    dict.fromkeys(word for word in (" ".join(one.split()) for one in _TEXT.split(",")) if word)
)
"""Singular compounds, in lower case."""
