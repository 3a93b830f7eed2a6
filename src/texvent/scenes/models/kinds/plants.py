"""Kinds of plants, fruit and food."""

from __future__ import annotations

FOOD_AND_PLANT_KINDS: dict[str, str] = {
    "tree": """
        oak, oak tree, birch, birch tree, willow, willow tree, beech, elm, ash tree,
        poplar, aspen, linden, lime tree, chestnut tree, walnut tree, apple tree, pear
        tree, plum tree, orange tree, lemon tree, fruit tree, olive tree, fig tree,
        sycamore, alder, eucalyptus, acacia, baobab, mangrove, plane tree, magnolia,
        horse chestnut, buckeye, deciduous tree, banyan, teak, bonsai""",
    "pine": """
        fir, fir tree, spruce, conifer, cedar, larch, hemlock tree, juniper, cypress,
        sequoia, redwood, evergreen, yew""",
    "palm": "coconut tree, coconut palm, date palm",
    "bush": "boxwood, thicket, rhododendron, hydrangea, undergrowth, azalea bush, hedge",
    "flower": """
        petunia, pansy, marigold, geranium, orchid, carnation, chrysanthemum, dahlia,
        violet flower, poppy, iris flower, lavender, blossom, anemone flower, primrose,
        begonia, peony, hibiscus, gerbera, buttercup, cornflower, wildflower, bloom,
        zinnia, snowdrop, aster, azalea, jasmine""",
    "daisy": "chamomile, marguerite, oxeye daisy",
    "tulip": "crocus, daffodil, narcissus",
    "rose": "camellia, rosebud",
    "grass tuft": "wheat, weed, barley, rice plant",
    "cactus": "prickly pear, saguaro, succulent, aloe",
    "potted plant": """
        monstera, ficus, rubber plant, aloe vera, herb, basil plant, bonsai tree, plant,
        basil, mint, rosemary, thyme, parsley, venus flytrap, snake plant, spider plant,
        cilantro""",
    "mushroom": "agaric, fly agaric, bolete, fungus, champignon, chanterelle, shiitake",
    "apple": "granny smith, crabapple, crab apple, quince, plum, pomegranate, guava",
    "orange": "tangerine, clementine, mandarin, grapefruit, citrus, kumquat",
    "lemon": "lime fruit, citron, lime",
    "watermelon": "melon, honeydew, papaya, cantaloupe",
    "strawberry": "raspberry",
    "cherry": "cranberry",
    "banana": "plantain",
    "broccoli": "cauliflower",
    "tomato": "cherry tomato, persimmon",
    "cucumber": """
        zucchini, courgette, gherkin, pickle, eggplant, aubergine, okra, green bean, pea
        pod""",
    "pepper": "chili, chilli, chili pepper, jalapeno, paprika, capsicum",
    "carrot": "parsnip",
    "potato": """
        sweet potato, yam, ginger, kiwi, kiwi fruit, truffle, ginger root, peanut,
        almond, pistachio, cashew""",
    "pumpkin": "squash, gourd, halloween pumpkin",
    "bread": """
        baguette, french loaf, toast, roll of bread, sourdough, bread roll, bun,
        breadstick, slice of bread, ciabatta, garlic bread, tortilla, pita, naan,
        brioche""",
    "donut": "bagel, pretzel",
    "cookie": """
        biscuit, cracker, brownie, snack, gingerbread man, gingerbread, shortbread,
        wafer, rice cracker""",
    "cupcake": "muffin",
    "cake": """
        pie, tart, cheesecake, chocolate cake, wedding cake, gateau, dessert, sponge
        cake, apple pie, pumpkin pie, cherry pie, tiramisu, cream cake, panettone,
        fruitcake""",
    "sandwich": """
        burger sandwich, toastie, panini, burrito, taco, kebab, sub sandwich,
        quesadilla, gyro, shawarma, ham sandwich, grilled cheese, calzone""",
    "hamburger": "veggie burger, macaron, slider",
    "sausage": """
        frankfurter, bratwurst, salami, spring roll, egg roll, meatball, corn dog,
        chicken nugget, croquette, falafel, sausage roll""",
    "soup": """
        consomme, stew, broth, chowder, noodle soup, curry, sauce, gravy, dip, hummus,
        guacamole, goulash, borscht, tomato sauce, pasta sauce""",
    "salad": "head cabbage, coleslaw, spinach, fruit salad, caesar salad, poke bowl",
    "ice cream": "gelato, sorbet, sundae, frozen yogurt, waffle cone, soft serve",
    "lollipop": "candy, lolly, popsicle, ice lolly, caramel apple, toffee apple, ice pop",
    "cheese": "cheddar, butter, tofu, feta, mozzarella, brie, fudge, margarine",
    "corn": "maize, ear of corn",
    "egg": "easter egg, boiled egg",
    "wine glass": """
        champagne glass, champagne flute, goblet, chalice, red wine, wine, white wine,
        sherry, prosecco""",
    "beer glass": "beer, ale, lager, eggnog, cider",
    "glass": """
        juice, orange juice, milk, lemonade, shot glass, smoothie, milkshake, cola, iced
        tea, iced coffee, soft drink, bubble tea, drink, sparkling water, protein shake,
        fruit juice, apple juice""",
    "mug": """
        latte, cappuccino, hot chocolate, cocoa, coffee, flat white, macchiato, hot
        cocoa, americano, matcha""",
    "cup": "espresso, tea",
    "grape": "blueberry, blackberry, olive, currant, berry, raisin",
    "peach": "mango, lychee, passion fruit",
    "onion": """
        garlic, fig, radish, beetroot, beet, turnip, garlic clove, shallot, red onion,
        fennel""",
    "cabbage": """
        lettuce,
        kale, celery, leek, asparagus, bok choy, chard, artichoke, brussels sprout, head
        of lettuce""",
    "fried egg": "omelette, omelet, scrambled egg, breakfast, poached egg",
    "steak": """
        ham, pork chop, roast, ribs, barbecue ribs, lamb chop, roast beef, schnitzel,
        fillet, grilled chicken, grilled fish, raw meat""",
    "meal": "dinner, lunch, supper, chinese food, mexican food, fast food, dish of food",
    "rice": "fried rice, risotto, couscous",
    "pizza": "flatbread, quiche, focaccia",
    "noodles": "lasagna, lasagne, macaroni, udon, pad thai, ravioli, fettuccine",
    "jar": """
        honey, jam, mayonnaise, peanut butter, honey jar, pickle jar, spice jar,
        marmalade, jelly, glass jar, cookie jar""",
    "sushi": "nigiri, maki, dim sum, sashimi, dumpling, gyoza, wonton, pierogi",
    "pancake": "flapjack, blini",
    "coral branch": "sea fan",
    "lily pad": "lotus, lily, lotus flower, water lily",
    "leaf pile": "dry leaves, fallen leaves, pile of leaves",
    "autumn tree": "maple tree, maple",
    "grass blade": "dewy grass",
    "croissant": "pastry",
    "powder heap": "flour, salt, sugar, powder, sawdust",
    "dough": "lump of clay, modeling clay, clay lump, ball of clay",
    "roast chicken": """
        roast turkey, fried chicken, roast duck, chicken wing, chicken leg,
        thanksgiving turkey, grilled chicken leg""",
}
"""Noun of the models → kinds of it, separated by commas."""
