"""Kinds of animals: breeds and species, by the animal that is shown."""

from __future__ import annotations

ANIMAL_KINDS: dict[str, str] = {
    "dog": """
        spaniel, cocker spaniel, springer spaniel, japanese spaniel, blenheim spaniel,
        clumber, brittany spaniel, welsh springer spaniel, english springer, sussex
        spaniel, cavalier, irish water spaniel, flat coated retriever, curly coated
        retriever, chesapeake bay retriever, maltese dog, maltese, pekinese, pekingese,
        shih tzu, papillon, terrier, toy terrier, bull terrier, bullterrier,
        staffordshire bullterrier, staffordshire terrier, pit bull, american
        staffordshire terrier, bedlington terrier, border terrier, kerry blue terrier,
        irish terrier, norfolk terrier, norwich terrier, yorkshire terrier, yorkie, fox
        terrier, wire haired fox terrier, lakeland terrier, sealyham terrier, airedale,
        cairn, australian terrier, dandie dinmont, scotch terrier, scottish terrier,
        tibetan terrier, silky terrier, soft coated wheaten terrier, jack russell, jack
        russell terrier, west highland white terrier, lhasa, boston bull, boston
        terrier, rhodesian ridgeback, ridgeback, afghan hound, basset, bloodhound,
        bluetick, coonhound, black and tan coonhound, walker hound, english foxhound,
        redbone, borzoi, wolfhound, irish wolfhound, greyhound, italian greyhound,
        whippet, ibizan hound, norwegian elkhound, elkhound, otterhound, saluki,
        deerhound, scottish deerhound, weimaraner, doggy, mutt, mongrel, schnauzer,
        miniature schnauzer, giant schnauzer, standard schnauzer, pointer dog, german
        short haired pointer, vizsla, setter, english setter, irish setter, gordon
        setter, kuvasz, schipperke, groenendael, malinois, briard, kelpie, komondor, old
        english sheepdog, shetland sheepdog, bouvier des flandres, rottweiler, doberman,
        pinscher, miniature pinscher, greater swiss mountain dog, mountain dog, bernese
        mountain dog, appenzeller, entlebucher, boxer dog, mastiff, bull mastiff,
        tibetan mastiff, english bulldog, great dane, saint bernard, st bernard, eskimo
        dog, affenpinscher, basenji, leonberg, newfoundland dog, great pyrenees,
        samoyed, pomeranian, chow, chow chow, keeshond, brabancon griffon, pembroke,
        miniature poodle, mexican hairless, shiba inu, akita, service dog, guide dog,
        stray dog, lapdog, dingo, dhole, african hunting dog, pug dog, police hound,
        hunting dog, sled hound, street dog, greyhound racer, collie mix, spitz,
        cockapoo, labradoodle, hound dog, puggle, doodle, boxer puppy""",
    "cat": """
        persian cat, egyptian cat, maine coon, british shorthair, house cat, tomcat,
        stray cat, calico cat, sphynx, bengal cat, pussycat""",
    "fox": "kit fox, arctic fox, fennec, vixen",
    "wolf": """
        timber wolf, red wolf, coyote, jackal,
        werewolf, hyena""",
    "lion": "african lion, cougar, puma, mountain lion",
    "tiger": "tigress, siberian tiger, bengal tiger",
    "cheetah": "snow leopard, lynx, bobcat, serval",
    "bear": """
        sloth bear, grizzly bear, grizzly, spectacled
        bear, kodiak, anteater, wombat""",
    "polar bear": "ice bear",
    "horse": """
        racehorse, mustang, sorrel, thoroughbred, arabian horse, draft horse, workhorse,
        wild horse, racing horse, carthorse, warhorse, palomino, appaloosa,
        clydesdale""",
    "donkey": "mule, burro, ass",
    "cow": "heifer, water buffalo, dairy cow, yak, holstein, longhorn",
    "sheep": "ram, bighorn, mouflon, bighorn sheep",
    "goat": "billy goat, ibex, mountain goat, chamois, nanny goat",
    "pig": "hog, boar, wild boar, warthog, sow, swine, hogget, tapir",
    "deer": """
        doe, buck, antelope, gazelle, impala, hartebeest, white tailed deer,
        roe deer, gnu, wildebeest, stag deer, sika deer, okapi, oryx, red deer,
        springbok, eland, muskox, kudu""",
    "camel": "arabian camel, bactrian camel, dromedary",
    "elephant": "indian elephant, african elephant, tusker, mammoth",
    "rabbit": "hare, wood rabbit, angora, cottontail, jackrabbit",
    "squirrel": """
        fox squirrel, chipmunk, marmot, prairie dog, ground squirrel, groundhog, ferret,
        weasel, mink, mongoose, stoat""",
    "mouse": "field mouse, rodent, vole, gerbil",
    "hamster": "guinea pig, cavy",
    "hedgehog": "porcupine, echidna, armadillo, pangolin",
    "raccoon": "lesser panda, coati",
    "monkey": """
        macaque, baboon, langur, colobus, proboscis monkey, marmoset, capuchin, titi,
        howler monkey, spider monkey, squirrel monkey, guenon, patas, rhesus monkey,
        vervet, tamarin, mandrill, gibbon, siamang, lemur""",
    "gorilla": "ape, chimpanzee, chimp, orangutan, silverback, bonobo",
    "kangaroo": "wallaby, joey, wallaroo",
    "crocodile": "african crocodile, american alligator, caiman, nile crocodile, alligator",
    "lizard": """
        gecko, banded gecko, iguana, common iguana, chameleon, african chameleon, american
        chameleon, whiptail, agama, alligator lizard, gila monster, komodo
        dragon, salamander, european fire salamander, spotted salamander, newt, common
        newt, eft, skink, monitor lizard""",
    "frog": "tailed frog, treefrog, tadpole frog, toad, tree frog, bullfrog",
    "snake": """
        cobra, indian cobra, python, rock python, boa, boa constrictor, viper, adder,
        horned viper, rattlesnake, diamondback, sidewinder, mamba, green mamba, garter
        snake, king snake, grass snake, thunder snake, ringneck snake, hognose snake,
        water snake, vine snake, night snake, sea snake, anaconda, serpent,
        eel""",
    "turtle": """
        tortoise, loggerhead, leatherback, leatherback turtle, mud turtle, terrapin, box
        turtle, snapping turtle""",
    "bird": """
        sparrow, swallow, finch, house finch, brambling, junco, bulbul, indigo bunting,
        bunting, jay, magpie, chickadee, water ouzel, titmouse, tit, thrush, starling,
        wren, lark, nightingale, cuckoo, coucal, bee eater, jacamar, woodpecker,
        songbird, warbler, oriole, cardinal bird, passerine, swift, partridge, quail,
        house sparrow, wagtail, mockingbird, jackdaw, hoopoe, tern bird, skylark,
        waxwing, nuthatch, bullfinch, weaver bird, plover, sandpiper, roadrunner,
        lapwing, sand martin, oriole bird""",
    "parrot": """
        macaw, cockatoo, sulphur crested cockatoo, lorikeet, african grey, parakeet,
        budgie, budgerigar, toucan, hornbill""",
    "eagle": """
        bald eagle, golden eagle, hawk, falcon, vulture, condor, buzzard, osprey, kestrel,
        bird of prey, peregrine falcon, harrier, sea eagle""",
    "owl": "great grey owl, snowy owl, owlet, barn owl",
    "gull": "albatross, tern, petrel, sea bird, gannet",
    "duck": """
        mallard, drake, merganser, red breasted merganser, goose, american coot,
        coot, moorhen, cormorant, loon""",
    "swan": "black swan, cygnet, mute swan, pelican",
    "chicken": """
        ptarmigan, black grouse, ruffed grouse, grouse, prairie chicken, fowl, pheasant,
        poultry, guinea fowl""",
    "rooster": "cock, cockerel",
    "flamingo": """
        little blue heron, american egret, white stork, black stork, spoonbill, ibis,
        wading bird, bittern""",
    "ostrich": "emu, rhea, cassowary",
    "penguin": "king penguin, emperor penguin, puffin",
    "fish": """
        goldfish, carp, koi, tench, salmon, coho, tuna, trout, cod, herring, sardine,
        bass, perch, clownfish, anemone fish, rock beauty, angelfish, barracouta,
        barracuda, sturgeon, mackerel, minnow, guppy, tropical fish, reef fish, piranha,
        catfish, snapper, mullet, betta, siamese fighting fish, gar, stingray, manta
        ray, pufferfish, blowfish, swordfish, tadpole, piranha fish, sunfish, flounder,
        anglerfish, lionfish, aquarium fish""",
    "shark": """
        great white shark, white shark, tiger shark, hammerhead, hammerhead shark, reef
        shark, bull shark, whale shark, nurse shark, great white""",
    "dolphin": "porpoise, bottlenose dolphin",
    "whale": """
        grey whale, gray whale, humpback, blue whale, sperm whale, killer whale, orca,
        beluga, narwhal""",
    "seal": "walrus, fur seal, elephant seal, sea lion, manatee, dugong",
    "octopus": "squid, cuttlefish, kraken",
    "jellyfish": "medusa, man of war",
    "crab": """
        dungeness crab, rock crab, fiddler crab, king crab, hermit crab, horseshoe crab,
        spider crab, lobster, crayfish, scorpion""",
    "spider": """
        black and gold garden spider, barn spider, jumping spider, garden spider, black widow, wolf
        spider, harvestman, daddy longlegs, tick, mite, arachnid, tarantula""",
    "ant": "fire ant, termite, worker ant",
    "beetle": """
        ground beetle, tiger beetle, long horned beetle, leaf beetle, dung beetle,
        rhinoceros beetle, weevil, stag beetle, scarab, cockroach, bug, june bug,
        grasshopper, locust, cricket, praying mantis, mantis, stick insect, water
        strider""",
    "ladybug": "ladybird, lady beetle, ladybird beetle",
    "housefly": "fly, fruit fly, horsefly, bluebottle",
    "bee": "wasp, hornet, honey bee, yellowjacket, bumblebee",
    "butterfly": """
        monarch, monarch butterfly, admiral, ringlet, cabbage butterfly, lycaenid, sulphur
        butterfly, swallowtail""",
    "dragonfly": "damselfly, darner",
    "worm": "flatworm, nematode, maggot, larva",
    "snail": "garden snail, sea snail, land snail, slug, sea slug",
    "fruit bat": "bat, flying fox, vampire bat, pterodactyl, pteranodon",
    "sauropod": "brontosaurus, diplodocus, brachiosaurus",
    "rhino": "triceratops",
    "rat": "platypus, shrew, mole, opossum, possum",
    "dinosaur": "allosaur, godzilla, spinosaurus, monster",
    "leopard": "jaguar, ocelot",
    "beagle": "basset hound, hound",
    "bulldog": "pug",
    "chick": "duckling, gosling",
    "heron": "crane bird, egret",
    "canary": "goldfinch",
    "crow": "blackbird, rook",
    "bluebird": "blue jay, bluetit, blue tit",
}
"""Noun of the models → kinds of it, separated by commas."""
