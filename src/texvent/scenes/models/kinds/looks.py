"""Nouns whose models strangers do not recognise, and what the models look like.

From a study in which every model was drawn alone and named without its word.
The report lists them as substituted: "glassblower → person".
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

LOOKS: Mapping[str, str] = MappingProxyType(
    {
        "breaking wave": "blue bank with foam",
        "carpenter": "person in work clothes",
        "catcher": "baseball player",
        "fruit bat": "dark winged shape",
        "glassblower": "person in work clothes",
        "groom": "person in a dark suit",
        "hang glider": "red and yellow wing",
        "janitor": "person in work clothes",
        "lifeguard tower": "box on stilts",
        "lion cub": "tan young animal",
        "operating lamp": "bent lamp post",
        "overalls": "blue bag with straps",
        "popcorn": "box of popcorn",
        "potter": "person in work clothes",
        "shepherd": "person in a long robe",
        "ski lift": "red seats on a line",
        "snowmobile": "small vehicle",
        "soap bubble": "pale ball",
        "sprinkler": "post with a round head",
        "technician": "person in a white coat",
        "teenager": "person in a cap",
        "tunnel": "short gateway",
        "tutu": "pink disc",
        "vest": "striped bag",
        "welder": "person in work clothes",
    }
)
"""Noun → plain words for what is seen."""
