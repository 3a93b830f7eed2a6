"""The number of each noun in label images, boxes and events: the same in every clip and version.

New nouns are added at the end; no number is ever given to another noun.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

BACKGROUND = 0
"""Class of what is no object: ground, sky, walls, scenery without an id."""
UNNAMED = 1000
"""Class of an object whose name is not known."""
FIRST_OTHER = 1001
"""Numbers of names that are no nouns of the embedded generator begin here."""
_NOUNS: tuple[str, ...] = (
    "airplane", "ball", "balloon", "barn", "barrier", "basketball", "bear", "bed", "bee",
    "bench", "bicycle", "bird", "boat", "bookshelf", "bottle", "box", "bridge", "building",
    "bus", "bush", "butterfly", "cactus", "candle", "car", "cat", "chair", "cheetah", "chicken",
    "child", "clock", "cloud", "cone", "cow", "crane", "cube", "cup", "cylinder", "deer", "dog",
    "dolphin", "dragonfly", "drone", "duck", "eagle", "elephant", "excavator", "fan", "fence",
    "fire engine", "fish", "flag", "flamingo", "flower", "football", "fox", "giraffe", "goat",
    "gull", "helicopter", "horse", "hot air balloon", "house", "jellyfish", "kite", "lamp",
    "lion", "man", "motorcycle", "mountain", "ostrich", "palm", "pendulum", "penguin", "person",
    "pickup", "pig", "pine", "polar bear", "police car", "pyramid", "rabbit", "rock", "rocket",
    "runner", "sailboat", "shark", "sheep", "ship", "sign", "snail", "snake", "sofa", "sphere",
    "street lamp", "suv", "table", "taxi", "tennis ball", "tiger", "tractor", "traffic cone",
    "traffic light", "train", "tree", "truck", "turtle", "ufo", "umbrella", "van", "whale",
    "wheel", "wind turbine", "windmill", "wolf", "woman", "worker", "zebra",
    "hand",
    "apple", "orange", "lemon", "pear", "banana", "pineapple", "watermelon", "strawberry",
    "grape", "cherry", "tomato", "carrot", "broccoli", "mushroom", "pumpkin", "egg", "bread",
    "sandwich", "hamburger", "hot dog", "pizza", "donut", "cake", "cupcake", "ice cream",
    "cheese", "sausage", "lollipop", "corn", "pepper", "cucumber", "potato", "cookie", "soup",
    "salad", "refrigerator", "oven", "microwave", "toaster", "coffee machine", "blender",
    "sink", "faucet", "toilet", "bathtub", "shower", "washing machine", "iron",
    "vacuum cleaner", "heater", "grill", "tv", "monitor", "screen", "laptop", "tablet",
    "cell phone", "poster", "picture frame", "checkerboard", "book", "closed book", "page",
    "newspaper", "map", "blackboard", "whiteboard", "card", "billboard", "computer mouse",
    "keyboard", "remote", "photo camera", "video camera", "tripod", "webcam", "printer",
    "radio", "game controller", "joystick", "calculator", "projector", "router",
    "circuit board", "hard disk", "cd", "cassette", "battery", "plug", "telephone",
    "typewriter", "desk", "shelf", "armchair", "office chair", "stool", "rocking chair",
    "wardrobe", "chest of drawers", "chest", "crib", "pillow", "rug", "curtain", "mirror",
    "door", "window", "blind", "potted plant", "bouquet", "fireplace", "stairs", "bunk bed",
    "aquarium", "cage", "light bulb", "led", "flashlight", "desk lamp", "lantern",
    "paper lantern", "chandelier", "neon tube", "spotlight lamp", "torch", "campfire",
    "lighter", "lava lamp", "backpack", "handbag", "suitcase", "briefcase", "shopping bag",
    "tie", "hat", "cap", "helmet", "shoe", "glove", "shirt", "sock", "glasses", "watch",
    "ring", "wallet", "hair drier", "toothbrush", "toothpaste", "comb", "brush", "razor",
    "soap", "towel", "toilet paper", "scissors", "pen", "pencil", "paintbrush", "stapler",
    "key", "padlock", "coin", "bowling ball", "golf ball", "baseball", "volleyball",
    "billiard ball", "ping-pong ball", "marble", "hamster ball", "american football",
    "shuttlecock", "puck", "frisbee", "boomerang", "spinning top", "gyroscope",
    "fidget spinner", "spinning disc", "yo-yo", "guitar", "electric guitar", "ukulele",
    "violin", "cello", "piano", "grand piano", "music keyboard", "drum", "drum kit", "cymbal",
    "gong", "trumpet", "saxophone", "flute", "harp", "accordion", "xylophone", "microphone",
    "metronome", "speaker", "headphones", "record player", "hammer", "mallet", "sledgehammer",
    "axe", "screwdriver", "wrench", "pliers", "saw", "chainsaw", "drill", "nail", "screw",
    "tape measure", "ruler", "shovel", "rake", "pitchfork", "broom", "mop", "plunger",
    "ladder", "gear", "propeller", "pinwheel", "spring", "rope", "hose", "pipe", "chain",
    "magnet", "syringe", "magnifying glass", "telescope", "microscope", "compass", "scale",
    "hourglass", "bell", "anchor", "anvil", "sword", "shield", "watering can", "lawn mower",
    "robot arm", "robot", "mobile robot", "robot vacuum", "conveyor belt", "crate", "pallet",
    "barrel", "shopping cart", "trolley", "wheelchair", "stroller", "sewing machine", "engine",
    "newton cradle", "forklift", "wheelbarrow", "cement mixer", "brick", "fire hydrant",
    "stop sign", "parking meter", "mailbox", "dustbin", "dumpster", "bus stop", "phone booth",
    "bollard", "gas pump", "vending machine", "fountain", "statue", "chimney", "power pylon",
    "park lamp", "railway crossing", "manhole cover", "tent", "tower", "lighthouse",
    "water tower", "church", "mosque", "castle", "hut", "log cabin", "igloo", "greenhouse",
    "doghouse", "birdhouse", "stone bridge", "gate", "wall", "tunnel", "column", "temple",
    "arch", "pier", "water well", "scaffold", "oil rig", "ruin", "rose", "tulip", "sunflower",
    "daisy", "dandelion", "grass tuft", "leaf", "log", "stump", "branch", "hay bale",
    "pine cone", "bird nest", "beehive", "bone", "skull", "seashell", "volcano", "iceberg",
    "snowflake", "snowball", "satellite", "planet", "saturn", "earth", "asteroid", "meteor",
    "star", "firework", "teddy bear", "toy robot", "doll", "toy block", "dice", "domino",
    "chessboard", "roulette wheel", "toy car", "toy train", "rubik cube", "rocking horse",
    "snow globe", "globe", "swing", "slide", "seesaw", "merry-go-round", "ferris wheel",
    "sandcastle", "snowman", "scarecrow", "paper plane", "water balloon", "soap bubble",
    "feather", "tennis racket", "badminton racket", "baseball bat", "baseball glove",
    "cricket bat", "golf club", "hockey stick", "pool cue", "ping-pong paddle", "skateboard",
    "scooter", "roller skate", "ice skate", "basketball hoop", "goal", "net", "trampoline",
    "archery target", "dartboard", "dart", "arrow", "bow", "dumbbell", "barbell",
    "boxing glove", "punching bag", "hula hoop", "whistle", "trophy", "medal", "bowling pin",
    "parachute", "ski", "snowboard", "sled", "surfboard", "buoy", "rubber duck", "paper boat",
    "raft", "canoe", "fork", "knife", "spoon", "wooden spoon", "chopstick", "bowl", "plate",
    "wine glass", "glass", "beer glass", "mug", "kettle", "teapot", "pot", "frying pan",
    "tray", "jar", "soda can", "jug", "vase", "urn", "bucket", "basket", "chopping board", "whisk",
    "corkscrew", "napkin", "candlestick",
    "camel", "donkey", "squirrel", "hedgehog", "mouse", "rat", "hamster", "panda",
    "koala", "raccoon", "rhino", "hippo", "crocodile", "lizard", "sauropod", "monkey", "gorilla",
    "kangaroo", "frog", "seal", "octopus", "dinosaur", "owl", "fruit bat", "spider", "crab",
    "ant", "beetle", "ladybug", "worm", "caterpillar", "rooster", "turkey", "parrot", "swan",
    "moth", "housefly", "mosquito", "vest", "scarf", "mask", "crown", "jacket", "coat", "dress",
    "binoculars", "safe", "necklace", "piggy bank", "harmonica", "abacus", "disco ball",
    "treadmill", "crutch", "paddle", "stethoscope", "hammock", "sundial", "spider web",
    "starfish", "windsock", "tank", "cannon", "snowmobile", "golf cart", "cable car",
    "submarine",
    "girl", "parked bicycle", "parked motorcycle",
    "surfer", "skier", "snowboarder", "skateboarder", "ice skater", "hockey player",
    "goalkeeper", "baseball batter", "baseball player", "catcher", "cricketer", "golfer",
    "tennis player", "football player", "basketball player", "american football player",
    "boxer", "fencer", "archer", "scuba diver", "swimmer", "referee", "jockey",
    "sumo wrestler", "climber", "hiker", "racing driver", "chef", "baker", "butcher", "waiter",
    "waitress", "potter", "farmer", "gardener", "fisherman", "shepherd", "cowboy",
    "firefighter", "police officer", "soldier", "sailor", "pilot", "astronaut", "doctor",
    "scientist", "technician", "surgeon", "nurse", "mechanic", "plumber", "carpenter", "welder",
    "blacksmith", "glassblower", "miner", "lumberjack", "painter", "janitor", "postman",
    "courier", "businessman", "priest", "monk", "nun", "photographer", "tourist",
    "lifeguard", "guitarist", "violinist", "conductor", "singer", "flamenco dancer",
    "ballerina", "bride", "groom", "king", "queen", "princess", "knight", "samurai", "pirate",
    "wizard", "witch", "ninja", "clown", "magician", "santa claus", "superhero", "angel",
    "elderly man", "elderly woman", "baby", "toddler", "teenager", "schoolboy", "schoolgirl",
    "student",
    "cowboy hat", "straw hat", "top hat", "chef hat", "witch hat", "santa hat", "turban",
    "woolly hat", "apron", "skirt", "robe", "cape", "tutu", "overalls", "wetsuit", "suit",
    "pyjamas", "spacesuit", "sweater", "hoodie", "trousers", "shorts",
    "elderly person",
    "golden retriever", "labrador", "dalmatian", "husky", "german shepherd", "border collie",
    "dachshund", "corgi", "poodle", "chihuahua", "beagle", "bulldog", "puppy", "tabby",
    "ginger cat", "siamese", "kitten", "calf", "bull", "foal", "pony", "piglet", "lamb",
    "kid goat", "fawn", "lioness", "lion cub", "tiger cub", "bear cub", "leopard", "panther",
    "bison", "reindeer",
    "lab bench", "flask", "beaker", "test tube", "petri dish", "centrifuge", "school desk",
    "wall blackboard", "large painting", "display case", "church pew", "altar", "stained glass",
    "stage curtain", "operating table", "operating lamp", "medical monitor", "subway train",
    "platform edge", "train seat", "train window", "grocery shelf", "restaurant table",
    "bar counter", "factory machine", "tyre stack", "car lift", "rink boards", "car wash brush",
    "stalagmite", "cell bars", "disco lights", "hall mirror", "hall column", "market stall",
    "grandstand", "floodlight mast", "guard rail", "motorway sign", "runway light",
    "runway markings", "control tower", "hangar", "tennis court net", "high net",
    "tennis court lines", "basketball court lines", "pitch lines", "running lanes", "hurdle",
    "boxing ring ropes", "gravel path lines", "railway track", "parking lines", "sun lounger",
    "diving board", "lane rope", "mooring post", "crop row", "corn row", "vine row",
    "gravestone", "slalom gate", "ski lift", "dune mound", "green hill", "cliff", "canyon wall",
    "waterfall", "lava flow", "wooden house", "garden fence", "corral fence", "bowling lane",
    "barrier tape",
    "ambulance", "double-decker bus", "tram", "dump truck", "garbage truck", "tanker truck",
    "school bus", "racing car", "steamroller", "bulldozer", "combine harvester", "carriage",
    "covered wagon", "rickshaw", "steam locomotive", "rowing boat", "kayak", "catamaran",
    "gondola", "cargo ship", "cruise ship", "propeller plane", "biplane", "fighter jet",
    "glider", "hang glider", "paraglider", "airship", "kingfisher", "robin", "crow", "pigeon",
    "dove", "cardinal", "canary", "hummingbird", "bluebird", "chick", "heron", "stork",
    "peacock", "coral branch", "seaweed", "anemone", "lily pad", "reed", "leaf pile",
    "autumn tree", "cherry tree", "bare tree", "bamboo", "fern", "grass blade", "anthill",
    "puddle", "seedling", "rainbow", "moon", "dripping icicle", "ice block", "siemens star",
    "dotted disc", "spiral disc", "led matrix", "double pendulum", "zoetrope", "tuning fork",
    "marble run", "bunsen burner", "prism", "watch movement", "filament printer", "lathe machine",
    "potter wheel", "angle grinder", "drill press", "table saw", "bench vise", "loom",
    "spinning wheel", "pancake", "popcorn", "fried egg", "noodles", "steak", "sushi",
    "croissant", "onion", "peach", "coconut", "cabbage", "cocktail", "yarn ball",
    "ironing board", "christmas tree", "goldfish bowl", "clothesline", "pinata", "bird feeder",
    "gift", "handbell", "table tennis table", "pool table", "table football",
    "lifeguard tower",
    "square", "disc", "triangle", "vertical bar", "grating", "expanding ring", "looming disc",
    "eye",
    "escalator", "sprinkler",
    "rock waterfall",
    "blanket", "grandfather clock", "coat rack", "easel", "rolling pin", "sack",
    "fire extinguisher", "music stand", "steering wheel", "windshield", "pistol", "rifle",
    "round bomb", "boot", "high heel", "sandal", "belt", "molecule", "plastic heart", "maraca",
    "robot dog", "powder heap", "dough", "french fries", "chocolate bar", "roast chicken",
    "shrimp", "bacon", "climbing wall", "podium", "chess piece", "kettlebell", "exercise bike",
    "fishing rod", "spear", "skate ramp", "saddle", "lifebuoy", "barbed fence", "gas station",
    "trailer", "shipping container", "roundabout", "crosswalk", "roller coaster", "solar panel",
    "satellite dish", "steel beam", "plank", "breaking wave", "tornado", "diamond", "neon arch",
    "horse trough", "striped awning", "unicorn", "skeleton", "ghost", "alien", "dragon",
    "car wash arch", "check-in desk", "flight board", "locker row", "corridor door", "ticket gate",
    "terrace table", "drive slab", "garage front",
    "corridor walls", "locker walls", "alley walls", "roof parapet", "roof unit", "balcony rail",
    "ward walls", "stone",
    "ward walls",
    "gripper", "domino row", "block tower", "card house", "box stack",
    "book stack",
    "vertical edge", "random dots", "barcode", "qr code", "april tag",
    "ceiling fan", "pendant lamp", "laser dot", "tilting platform", "ramp",
    "tunnel walls", "flying owl",
    "kitchen cabinet", "kitchen counter", "kitchen sink", "shower curtain", "wash stand",
    "computer desk", "bread shelf", "medicine shelf", "food counter", "canteen table",
    "cinema seats", "film screen", "mixing desk", "mansion", "palace", "golf green",
    "sand bunker", "flower bed", "skyscraper", "factory building", "hospital building", "shop",
    "scrap heap", "baseball diamond", "glacier front", "race kerb", "start arch", "pool basin",
    "food", "meal", "rice", "vegetables", "fruit", "peas", "cutlery", "pizza slice", "waffle",
    "pizza pan", "meat", "clock tower",
)  # fmt: skip
CLASS_IDS: Mapping[str, int] = MappingProxyType(
    {name: number for number, name in enumerate(_NOUNS, start=1)}
)
"""Noun → class id, 1, 2, ...."""


def class_ids_of(names: Iterable[str]) -> dict[str, int]:
    """The class ids of names; those of no noun are numbered in alphabetical order.

    Args:
        names: class names, such as "car".

    Returns:
        Name → class id.

    Example:
        >>> class_ids_of(["zeppelin", "dirigible"])
        {'dirigible': 1001, 'zeppelin': 1002}
    """
    asked = set(names)
    others = enumerate(sorted(asked - CLASS_IDS.keys()), start=FIRST_OTHER)
    known = {name: CLASS_IDS[name] for name in sorted(asked & CLASS_IDS.keys())}
    return known | {name: number for number, name in others}
