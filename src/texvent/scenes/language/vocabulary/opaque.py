"""Compounds whose last word misleads: a hair slide is no slide.

None of them can be shown, and none is to be shown as its last word.
"""

from __future__ import annotations

_TEXT = """
    holding pen, sea horse, sea
    cucumber, sea urchin, sea cow, sea pen, ant lion, antlion, star fish, jelly bean, cuttle fish,
    silver fish, butter cup, water bear, gummy bear, horse shoe, horseshoe, sea dragon, bearded
    dragon, tasmanian devil, cray fish, lion fish, dog fish, catwalk, fox glove,
    foxglove, pig tail, pigtail, pony tail, ponytail, dove tail, swallow tail, goose
    bump, goose neck, fish finger, fish stick, fried fish, egg cup, egg shell, meat loaf, meat
    ball, rice ball, rice cake, crab cake, fish cake, pan cake, hot pot, potpie, hot plate, home
    plate, face plate, solar dish, dish rag, dishrag, gravy boat, banana split, adam apple, oak
    apple, horse radish, horseradish, ground nut, chest nut, coco nut, pea nut, star anise, star
    fruit, custard apple, butternut squash, acorn squash, spaghetti squash, coral fungus, tag
    cloud, word cloud, point cloud, river bed, sea bed, truck bed, seed bed, garden bed, bed bug,
    flower girl, chemical plant, processing plant, treatment plant, car plant, white house, green
    house effect, ware house, power house, bounce house, bouncy castle, sand box, sandbox, gear
    box, fuse box, voice box, juke box, penalty box, set top box, ballot box, check box, pencil
    box, sound box, book jacket, book mark, bookmark, book end, book worm, bookworm, match book,
    pass book, face book, onion ring, ear ring, nose ring, ring finger, ring road, tree ring,
    wrestling ring, circus ring, teething ring, hair bow, rain bow, cross bow, ear drum, brake
    drum, pogo stick, memory stick, glow stick, match stick, candle wick, cinnamon stick, selfie
    stick, stick figure, lip stick, score card, sound card, report card, dash board, card board,
    ouija board, mood board, spring board, diving tower, computer tower, light tower, leaning
    tower of pisa, big ben, golden gate, statue of liberty, light saber, light year, evening wear,
    evening attire,
    fire screen, window screen, sun screen, sunscreen, smoke screen, screen saver, wind screen,
    rear view mirror, eye ball, eyeball, paint ball, pin ball, wrecking ball, cotton
    ball, fur ball, dust ball, hair ball, masked ball, mosquito net, mosquito netting, traffic
    pole, hair net, butterfly net, lens
    cap, bottlecap, ice cap, gas cap, hub cap, knee cap, polar cap, brake shoe, snow
    shoe, shoe horn, shoe shop, shoe lace, shoe shiner, sock puppet, bell cote, alarm bell, bell
    boy, bell bottom, dumb waiter, cow bell, barbell squat, door knob, doorknob, trap door, cat
    flap, parking lot car, side car, dining car, street car, car seat, child seat,
    seat belt, safety belt, conveyor system, fan belt, chain mail, chain reaction, food chain,
    daisy chain, bicycle chain lock, feather boa, boa scarf, hair slide, mud slide, landslide,
    slide rule, slide show, microscope slide, hair pin, rolling mill, pepper mill, saw mill,
    sawmill, coffee mill, steel mill, tread mill, paper mill, rock star, movie star, film star,
    paper helicopter, butterfly stroke,
    breast stroke, back stroke,
    side stroke, brush stroke, heat stroke, sun stroke,
    parking space, living space, tight space, narrow space, small space, open space,
    white space, storage space, office space, pop star, star ship, star sign, death star,
    sheriff star, road fork, bicycle fork, jack knife,
    butterfly knife trick, tooth pick, guitar pick, finger nail, fingernail, toe nail, toenail,
    nail file, jig saw, drill sergeant, oil filter, coffee filter, water filter, water meter, gas
    meter, speed meter, parking brake, disk brake, hand brake, floppy disk, disk jockey, arrow
    key, computer key, key lime, space bar, crow bar, wrist watch band, neck watch,
    cell wall, cell division, fire wall, firewall, sidewall, wall paper, wallpaper, wall nut, fly
    paper, sand paper, sandpaper, paper weight, paperweight, paper trail, periodic table, water
    table, time table, timetable, multiplication table, table cloth, pool party,
    swimming pool ladder, fish ladder, step brother, spring water, spring flower season, spring
    onion, box spring, watch spring, hair spray, pepper spray, bug spray, tear gas, gasmask, death
    mask, mouse pad, mousepad, mouse hole, cob web, web site, website, web page,
    ant hill, ant eater, bee line, elephant ear, elephant trunk, frog man, bullfight, bull
    ring, bull whip, horse power, horse hair, oxcart, dog ear, dog tag, dog collar, dog food, dog
    biscuit, cat food, cat scan, cat eye, lions gate, lion king, tiger lily, tiger balm,
    snail mail, snake skin, snakeskin, crocodile clip, alligator clip, alligator
    pear, crocodile tear, kite surfer, kite board, bike rack, bike lane, coat hanger, clothes
    hanger, crochet hook, lightning rod, bolt lock, cookie cutter, cookie jar lid, paper cutter,
    cog railway, wheel of fortune, wheel house, wheel clamp, toilet brush, hair roller, hair brush
    holder, hair band, haircut, rubber band, rock band, brass band, arm band, marching band,
    wedding band, head band, band aid, tape worm, tapeworm, duct tape, red tape, tape dispenser,
    adhesive tape, scotch tape, ticker tape, screw driver drink, screw cap, cork board, wine cork,
    wine cellar, cup holder, cup board, world cup, suction cup, ice cup, tea bag, teabag, air bag,
    airbag, body bag, saddle bag, vacuum bag, plastic surgery, tin opener, tin foil, tinfoil,
    trash compactor, tin whistle, glass eye, opera glass, hour hand, second hand, minute hand,
    hand cuff, handcuff, hand rail, hand bag strap, hand gun, hand brush, hand towel
    rail, hand cream, hand print, handprint, foot ball field, foot print, footprint, foot step,
    footstep, foot bridge toll, ear phone jack, ear plug, earplug, spark plug, bath plug, fire
    plug, hair plug, power strip, comic strip, landing strip, bathing suit, swim suit, swimsuit,
    tree surgeon, family tree, shoe tree, decision tree, axle tree, tree line, palm reader, palm
    oil, palm pilot, palm print, pine nut, pine apple juice, christmas tree farm, rose wood, rose
    bowl, rose garden, wind rose, compass rose, sun flower seed, sunflower seed, sunflower oil,
    flower shop, ice flower, corn field, corn flake, corn maze, peppercorn, pop corn, acorn,
    mountain pass, mountain goat cheese, rock pool, rock music, bed
    of roses, mile stone, grave stone, tomb stone, gem stone, hail stone, cobble stone
    street, razor blade, shoulder blade, bus ticket, boat shoe, ship yard,
    shipyard, ship wreck, shipwreck, rocket salad, rocket launcher, plane ticket, jet lag, jet
    stream, balloon animal, hot air, speech bubble, bubble gum, bubble bath, soap opera,
    chandelier earring, street art, torch singer, fan club, sports fan, football fan, fan art,
    ceiling rose, desk job, chair man, chairman, ski resort, sedan chair, electric chair, night
    stand lamp, music box, hat pin, tie clip, zip tie, railway tie, pillow case, clock work, scale
    model, richter scale, fish scale, scale bar, musical scale, saddle horn, car horn, fog horn,
    air horn, french kiss, orange juicer, apple pie filling, apple sauce, banana peel, banana
    boat, big apple, lemon grass, grape vine, grape juice, cherry picker, tomato juice, ketchup
    bottle cap, potato chip, potato masher, mashed potato, couch potato, hot sauce, carrot cake
    top, salt shaker, pepper shaker, saltshaker, cheese grater, bread crumb, sandwich board, cup
    cake liner, pizza oven peel, wine press, printing press, garlic press, letter press, milk
    tooth, milky way, coffee bean, pencil sharpener, pencil skirt, pen drive, pen pal, pig pen,
    play pen, light pen, globe artichoke, snow globe shaker, domino effect, card trick,
    chess clock, dice game, toy
    shop window, doll face, paper doll, gate way, gateway,
    flood gate, gate keeper, water gate, fire gate, golf bag, football pitch, net
    curtain, bow and arrow game, arrow head, arrowhead, dart frog, poison dart frog, bus bar, toad
    stool, nut shell, nutshell, shell script, bomb shell, shell suit, eggshell paint, bone china,
    bone marrow, wish bone, back bone, backbone, jaw bone, collar bone, fish bone, trombone slide,
    skull cap, skullcap, crossbones, bird flu, bird seed, big bird, angry bird, lady bird book,
    hen of the woods, cliff dwelling, mobile home, madagascar cat, tobacco shop, tank top, gas
    tank, think tank, safe house
"""

OPAQUE_COMPOUNDS: tuple[str, ...] = tuple(
    dict.fromkeys(word for word in (" ".join(one.split()) for one in _TEXT.split(",")) if word)
)
"""Singular compounds, in lower case."""
