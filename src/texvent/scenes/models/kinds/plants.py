"""Kinds of plants, fruit and food."""

from __future__ import annotations

FOOD_AND_PLANT_KINDS: dict[str, str] = {
    "tree": """
        oak, oak tree, maple, maple tree, birch, birch tree, willow, willow tree, beech,
        elm, ash tree, poplar, aspen, linden, lime tree, chestnut tree, walnut tree, apple
        tree, cherry tree, pear tree, plum tree, orange tree, lemon tree, fruit tree,
        olive tree, fig tree, sycamore, alder, eucalyptus, acacia, baobab, mangrove, plane
        tree, blossom tree, magnolia, horse chestnut, buckeye, sapling, deciduous tree,
        banyan, teak, bonsai""",
    "pine": """
        fir, fir tree, spruce, conifer, cedar, larch, hemlock tree, juniper, cypress,
        sequoia, redwood, christmas tree, evergreen, yew""",
    "palm": "coconut tree, coconut palm, date palm",
    "bush": "boxwood, thicket, rhododendron, hydrangea, undergrowth, azalea bush, hedge",
    "flower": """
        petunia, pansy, marigold, geranium, lily, orchid, carnation, chrysanthemum,
        dahlia, violet flower, poppy, iris flower, lavender, blossom, anemone flower,
        primrose, begonia, peony, hibiscus, gerbera, buttercup, cornflower, wildflower,
        bloom, zinnia, snowdrop, aster, lotus, water lily, azalea, jasmine""",
    "daisy": "chamomile, marguerite, oxeye daisy",
    "tulip": "crocus, daffodil, narcissus",
    "rose": "camellia, rosebud",
    "grass tuft": "reed, wheat, weed, fern, barley, rice plant, seaweed, kelp, sprout, seedling",
    "cactus": "prickly pear, saguaro, succulent, aloe",
    "potted plant": """
        monstera, ficus, rubber plant, aloe vera, herb, basil plant, bonsai tree, plant""",
    "mushroom": "agaric, fly agaric, bolete, fungus, champignon, chanterelle, shiitake",
    "apple": "granny smith, crabapple, crab apple, quince, nectarine, peach, apricot, plum",
    "orange": "tangerine, clementine, mandarin, grapefruit, citrus, kumquat",
    "lemon": "lime fruit, citron",
    "watermelon": "melon, honeydew",
    "strawberry": "raspberry",
    "cherry": "cranberry",
    "banana": "plantain",
    "broccoli": "cauliflower",
    "tomato": "cherry tomato, persimmon",
    "cucumber": "zucchini, courgette, gherkin, pickle, eggplant, aubergine",
    "pepper": "chili, chilli, chili pepper, jalapeno, paprika, capsicum",
    "carrot": "parsnip",
    "potato": "sweet potato, yam",
    "pumpkin": "squash, gourd, halloween pumpkin",
    "bread": "baguette, french loaf, toast, roll of bread, sourdough, bread roll, bun, croissant",
    "donut": "bagel, pretzel",
    "cookie": "biscuit, cracker, waffle",
    "cupcake": "muffin",
    "cake": "pie, tart, cheesecake, chocolate cake, wedding cake, gateau, pastry, dessert",
    "sandwich": "burger sandwich, toastie, panini, burrito, taco, kebab",
    "hamburger": "veggie burger",
    "sausage": "frankfurter, bratwurst, salami",
    "soup": "consomme, stew, broth, chowder, ramen, noodle soup",
    "salad": "lettuce, cabbage, head cabbage, coleslaw, spinach",
    "ice cream": "gelato, sorbet, sundae, frozen yogurt",
    "lollipop": "candy, lolly",
    "cheese": "cheddar, butter",
    "corn": "maize, ear of corn",
    "egg": "easter egg, boiled egg",
    "wine glass": "champagne glass, champagne flute, cocktail glass, goblet, chalice, red wine",
    "beer glass": "beer, ale, lager, eggnog, cider",
    "glass": "juice, orange juice, milk, lemonade, cocktail, shot glass",
    "mug": "latte, cappuccino, hot chocolate, cocoa",
    "cup": "espresso, tea",
}
"""Noun of the models → kinds of it, separated by commas."""
