"""Words with several senses, and the words beside which each of them is meant."""

from __future__ import annotations

from typing import NamedTuple


class Sense(NamedTuple):
    """What a word means where one of the cues is said."""

    cues: frozenset[str]
    """Base forms of words."""
    phrase: str | None
    """Phrase of the lexicon for it; None = nothing that is shown."""


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


def _sense(cues: str, phrase: str | None = None) -> Sense:
    return Sense(_words(cues), phrase)


_STRINGS = "violin violinist cello cellist fiddle fiddler viola bass string orchestra sonata"
_SPORT = """team player match game school child kid practice training whistle soccer shout yell
    instruct clap gym athlete runner swimmer tennis badminton basketball football court hockey
    gymnast boxer skater lesson pupil cheer sideline huddle shuttlecock shuttle"""
_VEHICLES = "car van truck lorry suv taxi pickup limousine"
_CARWASH = "wash carwash windshield windscreen"

SENSES: dict[str, tuple[Sense, ...]] = {
    "lane": (
        _sense("bowling pin bowler skittle", "bowling alley"),
        _sense("swim swimmer pool swimming"),
    ),
    "court": (
        _sense("tennis badminton clay baseline", "tennis court"),
        _sense("basketball hoop dunk", "basketball court"),
        _sense("judge lawyer trial king queen"),
    ),
    "tower": (_sense("block card cup brick dice domino stack stacking crate lego pile jenga can"),),
    "board": (
        _sense("surfer wave surf surfing", "surfboard"),
        _sense("chess checkers", "chessboard"),
    ),
    "club": (
        _sense("golf golfer caddie", "golf club"),
        _sense("dance dancer dj nightclub strobe dancing", "nightclub"),
        _sense("student member book"),
    ),
    "track": (
        _sense("toy marble slot wooden plastic"),
        _sense("train locomotive rail railway tram", "railway"),
        _sense("racing race car motorcycle kart", "race track"),
        _sense("song music album animal paw snow footprint"),
    ),
    "bat": (
        _sense("baseball batter pitcher inning homer swing grip umpire catcher glove mitt",
               "baseball bat"),
        _sense("fly flap wing cave vampire colony roost nocturnal insect halloween", "bat"),
        _sense("ball hit hold hand player plate uniform helmet boy girl man woman child kid",
               "baseball bat"),
        _sense("cricket cricketer wicket", "cricket bat"),
    ),
    "crane": (_sense("bird wing marsh nest feather wetland heron flock beak shallow wade fish reed"
                     " chick hop flap leg dance courtship migrate"),),
    "mouse": (_sense("computer click laptop monitor cursor keyboard", "computer mouse"),),
    "ring": (
        _sense("sumo wrestler wrestling"),
        _sense("boxer boxing fighter referee punch", "boxing ring"),
        _sense("circus phone bell smoke gymnast tree saturn"),
    ),
    "stage": (_sense("rocket booster race launch linear motor translation rotation microscope"
                     " motorised motorized"),),
    "bar": (
        _sense("iron metal steel gold blacksmith anvil gymnast gymnastics chocolate candy barbell"
               " weight soap pull-up pull pullup chin chin-up hang swing park playground forge"
               " glowing uneven parallel high horizontal"),
    ),
    "bank": (_sense("money robber teller customer cash vault"),),
    "flat": (_sense("flat light lighting cloudy ground stone tyre tire"),),
    "pitch": (_sense("throw pitcher voice black dark"),),
    "runway": (_sense("vault vaulter pole sprint jump athlete fashion model catwalk dress"),),
    "arrow": (_sense("neon sign screen cursor traffic blink painted paint direction button"),),
    "wall": (_sense("vase pot clay bowl potter cell"),),
    "web": (_sense("paper printing press newspaper page browser"),),
    "coat": (_sense("fur shed glossy retriever puppy paint layer"),),
    "plant": (_sense("power nuclear factory chemical assembly"),),
    "tripod": (_sense("camera shot filmed film view recording"),),
    "coach": (_sense(_SPORT),),
    "carton": (_sense("milk juice cream egg"),),
    "bow": (_sense(f"{_STRINGS} ribbon hair gift curtsy audience applause bowtie collar"),),
    "palm": (_sense("fortune fingertip wrist knuckle handful cupped slap"),),
    "batter": (_sense("bowl whisk pancake cake dough flour spoon mix waffle oven muffin pan ladle"
                      " griddle crepe"),),
    "bulb": (_sense("tulip onion soil daffodil garlic sprout"),),
    "ball": (
        _sense("waltz gown masked debutante"),
        _sense("ping pong", "ping pong ball"),
        _sense("tennis", "tennis ball"),
        _sense("basketball dunk dribble hoop", "basketball"),
        _sense("golf golfer putt", "golf ball"),
        _sense("baseball batter inning", "baseball"),
        _sense("volleyball", "volleyball"),
        _sense("bowling", "bowling ball"),
    ),
    "tank": (
        _sense("fish goldfish aquarium octopus reef turtle jellyfish bubble", "aquarium"),
        _sense("water oil gas fuel propane septic shark diver oxygen scuba fill"),
    ),
    "train": (_sense("bride gown wedding veil"),),
    "pupil": (_sense("iris dilate eyelash eyelid"),),
    "pen": (_sense("pig sheep cow goat hen chicken lamb calf piglet farmer livestock elephant"
                   " giraffe zebra cattle bull zoo fence enclosure bison rhino ostrich llama"
                   " alpaca"),),
    "ski": (_sense("gear equipment outfit clothing apparel attire"),),
    "pool": (_sense("billiard billiards cue shoot"),),
    "present": (_sense("food dish meal"),),
    "plate": (_sense("tectonic licence license number weight barbell batter umpire catcher"),),
    "key": (_sense("piano pianist typewriter laptop organ accordion press type keyboard organist"
                   " synthesizer xylophone"),),
    "bass": (_sense("band guitar jazz musician stage concert amplifier drummer"),),
    "organ": (_sense("heart donor transplant surgeon body"),),
    "pipe": (_sense("blowpipe smoke puff tobacco grandfather sailor"),),
    "block": (_sense("ice city starting sprinter runner butcher"),),
    "bun": (_sense("hair ballerina ballet dancer"),),
    "cap": (_sense("bottle pen lens jar tube"),),
    "column": (_sense("smoke soldier newspaper ant march steam"),),
    "comb": (_sense("rooster hen chicken cockerel honey bee beekeeper hive"),),
    "crown": (_sense("tooth dentist tree canopy"),),
    "drum": (_sense("oil brake washing machine washer concrete barrel fuel mixer"),),
    "float": (_sense("parade carnival festival"),),
    "fork": (_sense("road path river motorcycle bicycle trail tree branch bike"),),
    "gear": (_sense("camping climbing winter protective landing riot diving fishing rain hiking"
                    " shift driver lever"),),
    "hook": (_sense("boxer punch jab uppercut boxing"),),
    "hand": (_sense("clock watch dial sundial"),),
    "horse": (_sense("gymnast pommel vault seahorse"),),
    "iron": (_sense("golf golfer anvil blacksmith molten"),),
    "jet": (_sense("water nozzle flame steam fountain hose gas burner air"),),
    "lock": (_sense("canal hair barge boat curl"),),
    "monitor": (_sense("lizard"),),
    "page": (_sense("boy king castle"),),
    "plane": (_sense("carpenter wood plank shaving workbench woodworker"),),
    "rail": (_sense("skate skateboard skateboarder skater snowboarder grind hand stairs staircase"
                    " balcony ship deck boat ballet barre curtain towel ranch horse"),),
    "rock": (_sense("concert band guitarist"),),
    "rocket": (_sense("salad arugula"),),
    "rook": (_sense("chess"),),
    "ruler": (_sense("king queen throne emperor"),),
    "scale": (_sense("fish lizard dragon snake music piano pianist"),),
    "school": (_sense("fish sardine herring"),),
    "shell": (_sense("turtle tortoise snail egg walnut artillery crab nut peanut coconut"),),
    "shower": (_sense("meteor spark confetti"),),
    "slide": (_sense("microscope trombone hair rock mud snow projector"),),
    "spade": (_sense("card poker ace"),),
    "squash": (_sense("racket court player"),),
    "stall": (_sense("horse toilet bathroom restroom shower stable ballet theatre theater opera"
                     " stage concert"),),
    "star": (
        _sense("movie film celebrity pop carpet sheriff"),
        _sense("satellite telescope planet galaxy milky constellation comet spaceship spacecraft"
               " astronaut night sky twinkle", "starry night"),
    ),
    "stump": (_sense("wicket cricket bowler batsman"),),
    "tablet": (_sense("medicine pill swallow headache"),),
    "tie": (_sense("railway railroad"),),
    "torch": (_sense("weld welder blowtorch propane"),),
    "trunk": (_sense("swim swimmer beach elephant mammoth car suitcase luggage"),),
    "wave": (
        _sense("hair crowd stadium sound radio"),
        _sense("surfer surf surfboard sea ocean beach boat ship shore seagull", "sea waves"),
    ),
    "brush": (_sense(_CARWASH),),
    "calf": (_sense("muscle stretch tattoo cramp runner leg"),),
    "ice": (_sense("crushed fishmonger stall market glass cube drink cocktail bartender barman"
                   " waiter bucket cooler lemonade whisky whiskey soda cola juice tongs freezer"
                   " blender shaker"),),
    "cell": (_sense("prison prisoner jail"),),
    "charger": (_sense("knight phone laptop plug socket cable"),),
    "chest": (_sense("muscle breathe hairy bare gorilla beat doctor stethoscope"),),
    "nail": (_sense("manicure polish manicurist salon finger fingernail toe file varnish"),),
    "temple": (_sense("finger forehead gun headache massage"),),
    "seal": (_sense("envelope wax jar letter stamp airlock hatch"),),
    "bolt": (_sense("door gate lightning cloth crossbow"),),
    "platform": (
        _sense("tilt wobble rock tip sway", "tilting platform"),
        _sense("trapeze acrobat circus diver diving dive gymnast jump bungee pool cliff swim"
               " swimmer tower robot sensor turntable ball"),
    ),
    "laser pointer": (_sense("move wall floor dot ceiling slide", "laser dot"),),
    "vessel": (_sense("blood vein artery"),),
    "bridge": (_sense("nose violin guitar gymnast dental"),),
    "bark": (_sense("dog seal"),),
    "patch": (_sense("eye pirate knee elbow jacket"),),
    "deck": (_sense("card"),),
    "well": (_sense("pipette scientist plate lab laboratory sample"),),
    "saw": (_sense("seesaw"),),
    "screen": (_sense("wipe"),),
    "shot": (_sense("block goalie fire gun drink espresso tequila whiskey score rifle save"),),
    "wheel": (
        _sense("hamster mouse gerbil rat rodent cheese"),
        _sense("potter pottery clay", "potter wheel"),
        _sense("ship captain helm", "steering wheel"),
    ),
    "spinning wheel": (
        _sense("potter pottery clay vase pot bowl", "potter wheel"),
        _sense("bicycle bike cyclist car tyre tire hamster roulette casino cart scooter mechanic"
               " wagon toy fortune skateboard unicycle"),
    ),
    "piste": (_sense("fencer fencing sabre foil epee duel"),),
    "flyover": (_sense("car traffic highway road truck bus concrete lorry train metro", "bridge"),),
    "robot": (_sense("drive wheel wheeled differential odometry", "mobile robot"),),
    "bag": (_sense("boxer punch boxing kickboxer heavy", "punching bag"),),
    "rotor": (_sense("centrifuge brake engine motor turbine"),),
    "bubble": (_sense("gum chewing glass molten blowpipe boil champagne soda beer speech aquarium"
                      " diver scuba"),),
    "circle": (_sense("gymnast gymnastics bar dancer child friend people crowd drum sit"),),
    "door": (_sense(f"{_VEHICLES} airplane aircraft"),),
    "lens": (_sense("camera wide long telephoto zoom film shot flare macro seen fisheye filmed"
                    " focus angle anamorphic contact eye"),),
    "step": (_sense("take quick few back forward dance behind baby careful slow two three first"
                    " hesitant"),),
    "swing": (_sense("golf golfer club bat batter baseball pillow racket punch boxer axe sword"
                     " hammer trapeze"),),
    "carriage": (_sense("train locomotive engine railway steam platform subway"),),
    "apron": (_sense("airport airliner plane aircraft jet marshaller taxi", "airfield"),),
    "gate": (
        _sense("ski skier slalom piste snowboarder", "slalom gate"),
        _sense("airport airliner plane flight aircraft boarding passenger"),
    ),
    "perch": (_sense("parrot bird budgie canary cage owl falcon hawk"),),
    "horn": (_sense("car truck honk driver rhino rhinoceros bull goat ram unicorn buffalo antelope"
                    " viking"),),
    "fan": (_sense("team stadium cheer supporter football concert crowd scarf autograph goal"),),
    "pitcher": (_sense("mound baseball batter catcher fastball inning throw", "baseball player"),),
    "nut": (_sense("bolt wrench screw spanner wheel"),),
    "tear": (_sense("cry eye cheek sob weep"),),
    "toast": (_sense("champagne wedding raise speech wine"),),
    "wing": (_sense("hospital building museum hotel stage"),),
    "diamond": (_sense("baseball infield card"),),
    "jam": (_sense("traffic session paper"),),
    "boot": (_sense("suitcase luggage car taxi computer"),),
    "bonnet": (_sense(f"{_VEHICLES} engine mechanic"),),
    "hood": (_sense(f"{_VEHICLES} engine mechanic"),),
    "barrel": (_sense("gun rifle cannon surfer surf wave pistol"),),
    "tube": (_sense("surfer surf wave london toothpaste"),),
    "jack": (_sense("glass blower artisan card queen"),),
    "driver": (_sense("golf golfer tee screw"),),
    "hole": (_sense("golf golfer putt"),),
    "ray": (_sense("sun light sunlight laser moon morning window dust"),),
    "range": (_sense("shooting golf rifle driving"),),
    "needle": (_sense("pine compass gauge speedometer record"),),
    "note": (_sense("music musical piano guitar bank sing"),),
    "button": (_sense("press push click elevator remote"),),
    "shade": (_sense("tree sun umbrella parasol"),),
    "stand": (_sense("taxi crowd spectator"),),
    "suit": (_sense("card poker"),),
    "roll": (_sense("drum kitchen toilet film"),),
    "mine": (_sense("land explode coal gold miner"),),
    "press": (_sense("bench barbell weightlifter conference journalist"),),
    "leaf": (_sense("rosetta latte espresso gold table"),),
    "tunnel": (
        _sense("train locomotive railway rail tram leave exit emerge enter into mouth out",
               "tunnel"),
        _sense("in inside within through along down drive driving ride dashcam lamp light traffic",
               "road tunnel"),
    ),
    "mouth": (_sense("river cave tunnel"),),
    "face": (_sense("wave surfer cliff rock clock watch dial"),),
    "foot": (_sense("mountain stairs hill bed"),),
    "boxer": (_sense("puppy leash bark tail", "dog"),),
    "turkey": (_sense("roast oven thanksgiving carve plate", "roast chicken"),),
    "chicken": (_sense("roast grill fry oven plate cook barbecue knife fork", "roast chicken"),),
    "kiwi": (_sense("slice fruit peel bowl spoon salad"),),
    "swallow": (_sense("pill water throat drink"),),
    "cabin": (_sense("plane airplane aircraft airliner cruise ship passenger pilot"),),
    "jumper": (_sense("ski high long horse cable"),),
    "racket": (_sense("noise loud"),),
    "ramp": (_sense("skate skateboard skateboarder skater bmx scooter stunt", "skate ramp"),),
    "hoop": (_sense("dog lion tiger seal poodle puppy cat horse dolphin circus", "hula hoop"),),
}  # fmt: skip
"""Noun → its senses other than the usual one; the first whose cue is said counts."""
ONLY_WITH: dict[str, frozenset[str]] = {
    "display": _words("computer screen digital lcd led pixel desk monitor laptop show video text"),
    "weight": _words("lift lifter gym barbell dumbbell kettlebell scale exercise curl press squat"
                     " pulley spring pendulum string rope hang oscillate swing crossfit"),
    "top": _words("spin toy whirl wobble twirl wooden"),
    "chip": _words("circuit computer silicon tweezers board solder robot microscope wafer cpu"
                   " electronic electronics"),
    "spring": _words("metal coil bounce compress steel mattress stretch wire jump hang weight"
                     " slinky oscillate spiral mechanical"),
    "hoop": _words("basketball basket dunk court player shoot shot dribble backboard nba"),
    "gear": _words("cog wheel machine mechanism clock motor turn rotate spin tooth mesh metal"
                   " engine interlock axle clockwork brass"),
    "coach": _words("drive passenger station bus road highway street horse tour tourist stop"
                    " travel luggage pass overtake park motorway red blue white tunnel bridge"
                    " arrive"),
}  # fmt: skip
"""Noun → words of which one must be said for its usual sense."""
OWNED = _words(
    "palm nail chest calf temple pupil sole lid lash crown bark iris organ vessel joint bridge"
)
"""Nouns that "her" and "his" make parts of a body: "his chest"."""
VERB_SENSES: dict[str, tuple[Sense, ...]] = {
    "carve": (
        _sense("ski skier piste powder", "ski"),
        _sense("snowboard snowboarder", "snowboard"),
        _sense("surf surfer wave", "surf"),
        _sense("river valley glacier canyon road motorcycle bend curve"),
    ),
    "skate": (_sense("ice hockey rink puck goalie figure", "ice skate"),),
    "drill": (_sense("soldier troop army parade platoon cadet"),),
    "draw": (_sense("bow archer violinist cellist curtain sword gun breath bath blind knife"
                    " blood weapon fiddler iron forge blacksmith bar cart plough crowd syringe"),),
    "cut": (_sense("bow keel prow wave boat ship swimmer shark fin surfboard"),),
    "plane": (_sense("board plank wood carpenter"),),
    "play": (_sense("trick dead"),),
    "run": (_sense("tap faucet tears mascara stocking ink"),),
    "shoot": (_sense("pool billiard glance star geyser"),),
    "ride": (_sense("wind thermal current elevator escalator"),),
    "file": (_sense("nail manicure manicurist"),),
}  # fmt: skip
"""Verb → its senses other than the usual one."""
PARTICLES: dict[str, frozenset[str]] = {
    "call": frozenset({"out", "for", "off"}),
    "show": frozenset({"off"}),
    "track": frozenset({"down"}),
    "duck": frozenset({"under", "down", "behind", "out"}),
    "break": frozenset({"into"}),
    "fish": frozenset({"out"}),
    "bear": frozenset({"down"}),
    "put": frozenset({"away", "out", "up"}),
    "putt": frozenset({"away", "out", "up"}),
    "push": frozenset({"out"}),
    "take": frozenset({"out", "apart", "in", "over", "on"}),
    "turn": frozenset({"up", "out", "pale", "red"}),
    "cut": frozenset({"out"}),
    "hold": frozenset({"on"}),
    "hang": frozenset({"up", "out"}),
    "check": frozenset({"in", "out"}),
    "work": frozenset({"out"}),
    "throw": frozenset({"up"}),
    "blow": frozenset({"up"}),
    "keep": frozenset({"up"}),
}  # fmt: skip
"""Verb → particles with which it is none of what the word shows alone."""
NO_OBJECT: dict[str, frozenset[str]] = {
    "throw": _words("tantrum party shade light shadow kiss glance look fit"
                    " cross spark sparks"),
    "run": _words("thumb hand finger fingertip palm eye brush tongue cloth comb errand business"),
    "turn": _words("switch tap faucet knob dial stove radio key corner"),
    "catch": _words("breath light eye glimpse sight cold fire attention sun sunlight train bus"),
    "hold": _words("breath pose position still"),
    "kick": _words("dust snow sand spray"),
    "strike": _words("pose match arc"),
    "beat": _words("egg chest heat"),
    "drop": _words("jaw hint gaze"),
    "roll": _words("eye dough sleeve die dice"),
    "cast": _words("shadow light spell vote glow"),
    "blow": _words("kiss nose horn"),
    "pull": _words("trigger face"),
    "push": _words("button"),
    "lift": _words("spirit"),
    "raise": _words("eyebrow voice"),
    "spin": _words("yarn web tale"),
    "drive": _words("nail ball screw stake"),
}  # fmt: skip
"""Verb → objects with which it is none of what it shows alone: "throws a party"."""
IN_VESSELS = _words("""bottle cup glass mug jug pitcher kettle tap faucet sink hose bucket bowl pot
    pan vase jar basin bathtub tub teapot drink sip gulp pour fill refill boil kitchen tumbler
    thermos flask straw aquarium tank balloon towel shower sponge wash rinse splash splatter face
    plant flower can spray mop cloth barista cook runner athlete desk table carafe beaker tube""")
"""Words beside which "water" is in something, or on someone."""
OPEN_WATER = _words("""sea ocean lake river stream pond beach shore coast harbour harbor pier dock
    boat ship sailboat yacht kayak canoe raft ferry swim swimmer surf surfer dive diver dolphin
    whale duck swan goose fish shark seal wave canal bay island waterfall paddle row sail pool
    bridge lighthouse waterfowl heron pelican otter beaver crocodile hippo jet skim wade""")
"""Words beside which it is a place all the same."""
DEVICES = _words("lamp light tv television radio computer faucet tap stove oven fan engine machine"
                 " switch torch flashlight heater music lantern laptop console")  # fmt: skip
"""What is turned on and off, and does not turn."""
WOODEN = _words("wood plank log board branch tree pipe timber beam trunk lumber table leg metal")
"""What is sawn; "a man saw a bird" saw it."""
