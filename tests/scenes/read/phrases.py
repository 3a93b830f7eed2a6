"""Phrases that make a few hundred thousand sentences, known words and others."""

SUBJECTS = ("a dog", "two red balls", "only one man", "some wugs", "a high-speed train",
            "a man in a red jacket", "four red and two green cubes", "a very small bird",
            "a waiter with a tray", "two of three cars")  # fmt: skip
VERBS = ("walks", "is", "comes", "rolls slowly", "crosses", "frobs", "stands", "drives quickly",
         "barely moves", "sits down", "jumps twice", "runs")  # fmt: skip
RELATIONS = ("past", "towards", "across", "down", "onto", "into", "next to", "near", "in front of",
             "above", "through", "along", "around", "off", "out of", "from", "with", "under",
             "behind", "on the other side of", "up", "between", "at")  # fmt: skip
OBJECTS = ("a table", "the street", "it", "two trees", "a zorp", "the camera", "a wug and a house",
           "a narrow park", "a mountain", "another car", "a river", "the room")  # fmt: skip
ENDS = ("", "at high speed", "and then sits on it", "before it stops", "without cars", "outside",
        "at 20 km/h", "in the rain", "while a boat passes")  # fmt: skip
