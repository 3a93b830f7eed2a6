"""Words of film: what each does to the camera, or that it does nothing here.

Views, framings and moves change the camera. Words of style either ask for nothing that is seen by
itself ("cinematic", "4k"), or for something that this generator does not draw ("lens flare").
"""

from __future__ import annotations

from collections.abc import Iterable

CAMERA_WORDS = (
    "camera", "cameras", "viewpoint", "viewer", "lens", "steadicam", "action camera", "gopro",
    "go pro", "film camera", "video camera", "camera operator", "cameraman", "security camera",
    "surveillance camera", "cctv camera", "wildlife camera", "trail camera",
)  # fmt: skip
"""Nouns of what films the scene."""

_SHOTS = ("shot", "view", "footage", "video", "clip", "perspective", "angle", "image", "framing")


def _shots(*bases: str, endings: Iterable[str] = _SHOTS) -> tuple[str, ...]:
    """Each base alone, and before each word for a piece of film."""
    return tuple(f"{base} {end}".strip() for base in bases for end in ("", *endings))


def _motions(*ways: str) -> tuple[str, ...]:
    """As in "6-DoF camera motion", "forward ego-motion", "lateral translation"."""
    kinds = ("camera motion", "ego motion", "camera translation", "translation", "camera movement")
    return tuple(f"{way} {kind}" for way in ways for kind in kinds)


CAMERA_PHRASES: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("pan", None): ("slow pan", "quick pan", "fast pan", "smooth pan", "gentle pan", "whip pan",
                    "swish pan", "camera pan", "pan shot", "panning shot", "panning view",
                    "camera yaw", "yaw motion", "yaw rotation", "rotation in yaw"),
    ("tilt", None): ("slow tilt", "camera tilt", "tilt shot", "tilting shot", "camera pitch",
                     "pitch motion", "pitch rotation", "rotation in pitch"),
    ("zoom", None): ("slow zoom", "smooth zoom", "camera zoom", "zoom shot"),
    ("zoom", "in"): ("crash zoom", "snap zoom", "zoom in shot", "slow zoom in"),
    ("zoom", "out"): ("zoom out shot", "slow zoom out"),
    ("dolly", "in"): (
        "dolly shot", "push in shot", "slow push in", "gentle push in", "subtle push in",
        "slow dolly in", "dolly in shot",
        *(f"{one} {to}" for one in _motions("forward") for to in ("towards", "toward", "to")),
    ),
    ("dolly", "out"): ("pull out shot", "pull back shot", "slow pull back", "slow pull out",
                       "slow dolly out", "dolly out shot"),
    ("dolly zoom", "in"): ("dolly zoom", "vertigo shot", "vertigo effect"),
    ("truck", None): ("trucking shot", "slider shot", "lateral tracking shot", "lateral shot",
                      "lateral camera movement", "lateral camera move", "lateral movement",
                      "sideways tracking shot", "sideways camera movement", "side scrolling",
                      *_motions("sideways", "lateral", "horizontal")),
    ("pedestal", None): _motions("vertical"),
    ("crane", "up"): ("crane shot", "jib shot", "boom shot", "crane up shot", "rising shot"),
    ("crane", "down"): ("crane down shot", "descending shot"),
    ("follow", None): ("tracking shot", "follow shot", "following shot", "chase cam", "follow cam",
                       "chase camera", "chase shot", "follow camera"),
    ("orbit", None): ("orbiting shot", "orbit shot", "arc shot", "orbital shot", "circling shot",
                      "orbiting camera", "360 degree shot"),
    ("handheld", None): ("handheld", "hand held", "shaky", "camera shake", "handheld camera",
                         "hand held camera", "shaky camera", "shaky cam", "handheld footage",
                         "handheld shot", "hand held shot", "handheld video", "shaking effect",
                         "intense shaking effect", "with an intense shaking effect",
                         "with a shaking effect", "camera jitter", "camera vibration"),
    ("handheld", "all axes"): _motions("6 dof", "six dof", "6 degree of freedom", "random",
                                       "erratic", "free", "jerky"),
    ("dutch", None): ("dutch angle", "dutch tilt", "canted angle", "tilted angle",
                      "tilted horizon", "dutch angle shot", "slanted angle", "oblique angle"),
    ("travel", "forward"): (
        "dashcam", "dash cam", "dashboard camera", "dashboard cam", "driving footage", "fpv",
        "egocentric", "dashcam footage", "dashcam view", "dashcam video", "dash cam footage",
        "dash cam view", "dash cam video", "dashcam shot", "fpv shot", "fpv footage", "fpv view",
        "fpv drone shot", "fly through", "flythrough", "walk through shot", "walking shot",
        "driving shot", "ego motion", "egomotion", *_motions("forward"),
    ),
    ("travel", "backward"): _motions("backward"),
    ("roll", None): ("camera roll", "roll motion", "roll rotation", "rotation in roll"),
    ("static", None): ("static camera", "fixed camera", "still camera", "stationary camera",
                       "static shot", "locked off shot", "locked shot", "locked off", "tripod shot",
                       "locked down shot", "locked camera", "locked off camera", "fixed shot",
                       "still shot", "stationary shot", "static frame", "static view",
                       "fixed frame", "fixed view", "unmoving camera",
                       "steady and smooth perspective",
                       "featuring a steady and smooth perspective", "steady perspective",
                       "smooth and steady perspective",
                       *(f"in front of {one} {still} camera" for one in ("a", "the")
                         for still in ("fixed", "static", "still", "stationary"))),
}  # fmt: skip
"""Camera move and direction → noun phrases for it."""
UPRIGHT_AXES = tuple(
    f"{about} {the} {axis} axis"
    for about in ("about", "around")
    for the in ("the", "its")
    for axis in ("vertical", "y", "z", "yaw")
)
"""What turns about one of these turns to the left or to the right."""
CAMERA_VERBS: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("pan", None): ("pan", "yaw", "rotate in place", "rotate on the spot", "spin in place",
                    "turn in place", *(f"rotate {axis}" for axis in UPRIGHT_AXES)),
    ("tilt", None): ("tilt",),
    ("roll", None): ("roll", "rotate"),
    ("zoom", None): ("zoom",),
    ("zoom", "in"): ("zoom in",),
    ("zoom", "out"): ("zoom out",),
    ("dolly", None): ("dolly",),
    ("dolly", "in"): ("dolly in", "push in", "move in", "move closer", "close in", "dolly forward"),
    ("dolly", "out"): ("dolly out", "pull back", "pullback", "pull out", "pull away", "move back",
                       "dolly back", "back away"),
    ("truck", None): ("truck", "slide", "translate"),
    ("crane", "up"): ("crane up",),
    ("crane", "down"): ("crane down",),
    ("follow", None): ("follow", "track", "chase", "trail"),
    ("orbit", None): ("orbit", "circle"),
    ("handheld", None): ("shake", "wobble", "sway"),
    ("static", None): ("remain", "stay", "stand", "stop", "rest", "hover"),
}  # fmt: skip
"""Camera move and direction → verbs for it, of the camera and of other things."""
OF_CAMERA: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("pan", None): ("sweep", "swing", "swivel", "whip", "whip pan", "scan"),
    ("tilt", None): ("pitch", "nod"),
    ("dolly", "in"): ("push", "creep", "inch", "ease", "approach"),
    ("dolly", "out"): ("pull", "retreat", "recede", "withdraw"),
    ("pedestal", "up"): ("lift", "ascend", "rise", "climb"),
    ("pedestal", "down"): ("descend", "lower", "sink"),
    ("crane", "up"): ("crane", "boom"),
    ("follow", None): ("tail", "shadow", "accompany", "pursue", "keep pace", "keep up"),
    ("orbit", None): ("arc", "revolve", "wrap", "whirl"),
    ("static", None): ("hold", "linger", "lock", "fix", "mount", "place", "position", "sit",
                       "perch", "set", "attach", "strap", "wait", "rest", "station", "keep"),
}  # fmt: skip
"""Camera move and direction → verbs that mean it where the camera does it."""
CAMERA_ADJECTIVES: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("static", None): ("static", "fixed", "stationary", "motionless", "immobile", "steady",
                       "locked", "unmoving"),
    ("follow", None): ("tracking", "following"),
    ("handheld", None): ("shaky",),
    ("pan", None): ("panning",),
    ("orbit", None): ("orbiting",),
}  # fmt: skip
TRAVEL_MEANS: dict[str, str] = {
    "drive": "drive", "ride": "drive", "cycle": "cycle", "walk": "walk", "hike": "walk",
    "stroll": "walk", "run": "run", "jog": "run", "fly": "fly", "glide": "fly", "soar": "fly",
    "sail": "sail", "swim": "swim", "dive": "fly", "speed": "drive", "cruise": "drive",
    "bike": "cycle", "ski": "run",
}  # fmt: skip
"""Verb → how a camera travels that does it."""

_LOW = ("wheel", "knee", "ankle", "ground", "floor", "tyre", "tire", "foot", "toe", "grass",
        "street", "kerb", "curb", "pavement", "dog", "cat", "bumper", "hoof")  # fmt: skip
_LEVEL = ("eye", "head", "chest", "shoulder", "face", "waist", "human")


def _at(bases: Iterable[str]) -> tuple[str, ...]:
    """As in "at eye level", "from waist height", "an eye-level shot"."""
    forms = [f"{base} {unit}" for base in bases for unit in ("level", "height")]
    return (
        *(f"{word} {form}" for form in forms for word in ("at", "from")),
        *(f"{form} {shot}".strip() for form in forms for shot in ("", "shot", "view", "angle")),
    )


VIEWS: dict[str, tuple[str, ...]] = {
    "aerial": (
        *_shots("aerial", "drone", "bird eye", "helicopter", "high angle",
                endings=(*_SHOTS, "drone shot", "drone footage", "photography"))[1:],
        "aerial", "bird eye", "from above", "seen from above", "high angle", "from a drone",
        "from drone", "from drones", "from the air", "from helicopter",
        "by a drone", "from a high angle", "from high above",
         "from a height", "from high up", "from a helicopter", "elevated view",
        "elevated shot", "elevated angle",
    ),
    "top": (
        *_shots("overhead", "top down", endings=(*_SHOTS, "camera"))[1:], "top view", "top shot",
        "top down", "from directly above", "birds eye", "birds eye view", "directly overhead",
        "from directly overhead", "from straight above", "straight down shot", "plan view",
        "flat lay",
    ),
    "low": (
        *_shots("low angle", "worm eye", "frog eye"), "from below", "from a low angle",
        "from underneath", "low camera", "low to the ground", "close to the ground",
        "near the ground", *_at(_LOW),
    ),
    "level": _at(_LEVEL),
    "first person": (
        *_shots("first person", "pov", "first person pov", "subjective"), "point of view",
        "point of view shot", "driver view", "driver perspective", "rider view",
    ),
    "side": ("side view", "from the side", "side on view", "side on", "side shot", "side angle",
             "profile view", "in profile", "profile shot", "side profile", "from one side",
             "lateral view"),
    "front": ("front view", "from the front", "head on", "head on view", "head on shot",
              "frontal view", "frontal shot", "front on", "front shot", "front angle"),
    "back": ("rear view", "back view", "from behind", "from the back", "from the rear",
             "rear shot", "rear angle", "back shot", "seen from behind"),
    "shoulder": ("over the shoulder", "over shoulder", "over the shoulder shot",
                 "over the shoulder view", "over shoulder shot", "over his shoulder",
                 "over her shoulder", "over their shoulder"),
}  # fmt: skip
"""View → phrases for it."""

_CLOSE = ("close up", "closeup", "extreme close up", "tight close up", "medium close up",
          "tight shot", "close shot", "close view", "macro", "macro shot", "macro view",
          "macro close up", "macro footage", "detail shot", "close up shot", "close up view",
          "close up footage", "extreme close up shot", "extreme macro shot", "extreme macro",
          "close up video", "insert shot")  # fmt: skip
FRAMINGS: dict[str, tuple[str, ...]] = {
    "close": (*_CLOSE, *(f"{one} of" for one in _CLOSE), "close up on", "in close up",
              "headshot", "head and shoulders shot"),
    "medium": ("medium shot", "mid shot", "medium view", "waist up", "from the waist up",
               "cowboy shot", "american shot", "waist shot", "medium shot of", "waist up shot",
               "medium long shot", "medium wide shot"),
    "full": ("full shot", "full body shot", "full length shot", "full body", "full body view"),
    "wide": ("wide shot", "wide angle", "wide view", "long shot", "panorama", "establishing shot",
             "extreme wide shot", "very wide shot", "extreme long shot", "wide establishing shot",
             "wide angle shot", "wide angle view", "wide angle lens", "panoramic view",
             "panoramic shot", "master shot", "wide static shot", "wide aerial shot"),
}  # fmt: skip
"""Framing → phrases for it."""
FRAMING_ADJECTIVES = {"wide": "wide", "medium": "medium", "close": "close", "tight": "close",
                      "full": "full", "long": "wide", "panoramic": "wide",
                      "mid": "medium"}  # fmt: skip
"""Adjective of a shot → framing."""

_RATES = tuple(f"{number} fps" for number in (24, 25, 30, 48, 50, 60))
_SIZES = tuple(f"{number} {unit}" for number, unit in
               ((2, "k"), (4, "k"), (5, "k"), (6, "k"), (8, "k"), (12, "k"), (720, "p"),
                (1080, "p"),
                (2160, "p")))  # fmt: skip
_MILLIMETRES = tuple(f"{number} mm" for number in
                     (8, 12, 14, 16, 18, 20, 24, 28, 35, 50, 65, 70, 85, 100, 135,
                      200))  # fmt: skip
GREYSCALE = "in shades of grey"
"""What a film in black and white is."""
_GREY = tuple(
    f"black and white {one}"
    for one in (
        "footage",
        "film",
        "video",
        "shot",
        "image",
        "photograph",
        "movie",
        "cinematography",
    )
)

STYLE_NOUNS: dict[str, tuple[str, ...]] = {
    "": (
        *_RATES, *_SIZES, *_MILLIMETRES, *(f"{one} film" for one in _MILLIMETRES),
        *(f"{one} lens" for one in _MILLIMETRES), *(f"{one} {end}" for one in _SIZES[:5] for end in
                                                    ("resolution", "video", "footage", "quality")),
        "hdr", "uhd", "full hd", "ultra hd", "high definition", "high detail", "fine detail",
        "stock footage", "film look", "film stock", "celluloid", "imax", "super 8",
        "cinematography",
        "documentary style", "arri alexa", "red camera", "octane render", "unreal engine",
        "ray tracing", "masterpiece", "aspect ratio", "16 9", "single take", "one take",
        "long take",
        "single shot", "continuous shot", "continuous take", "one shot", "uncut shot",
        "telephoto lens", "zoom lens", "prime lens", "long lens", "wide lens", "macro lens",
        "telephoto", "b roll", "cinematic style", "prores", "film quality", "sharp focus",
        "deep focus",
    ),
    "the lens blurs nothing": (
        "depth of field", "shallow depth of field", "narrow depth of field", "low depth of field",
        "shallow focus", "soft focus", "selective focus", "rack focus", "focus pull", "bokeh",
        "bokeh lights", "background blur", "blurred background", "blurry background",
        "out of focus", "defocused background", "soft background", "tilt shift", "focus rack",
        "racking focus", "creamy bokeh", "soft bokeh",
    ),
    "the lens flares nowhere": (
        "lens flare", "sun flare", "anamorphic flare", "light leak", "lens reflection",
    ),
    GREYSCALE: (*_GREY, "greyscale", "grayscale"),
    "colours are as they are": (
        "sepia tone", "colour grading", "color grading",
        "colour grade",
        "color grade", "teal and orange", "warm tones", "cool tones", "warm colours", "warm colors",
        "cool colours", "cool colors", "muted colours", "muted colors", "vibrant colours",
        "vibrant colors", "vivid colours", "vivid colors", "pastel colours", "pastel colors",
        "blue grey tones", "warm palette", "cool palette", "muted palette", "film noir",
        "night vision", "thermal imaging", "thermal camera", "infrared camera",
        "infrared night camera", "night vision camera", "thermal camera footage",
        "night vision footage", "infrared footage", "thermal footage", "warm grade", "cool grade",
        "colour palette", "color palette", "desaturated colours", "desaturated colors",
        "saturated colours", "saturated colors",
    ),
    "pictures have no grain": ("film grain", "heavy grain", "analog noise", "vhs", "vhs footage",
                               "vhs look", "super 8 footage", "scan line", "glitch effect"),
    "the lens draws straight lines": ("fisheye", "fish eye", "fisheye lens", "fish eye lens",
                                      "fisheye view", "barrel distortion", "fisheye shot"),
    "things are plain shapes": ("anime", "anime style", "cartoon style", "claymation",
                                "stop motion", "stop motion animation", "oil painting style",
                                "watercolor style", "watercolour style", "pixel art",
                                "studio ghibli", "pixar style", "comic book style"),
    "light leaves no trace": ("motion blur", "long exposure", "light trail"),
    "there is one picture": ("split screen", "picture in picture", "jump cut", "montage",
                             "crossfade", "cross fade", "fade in", "fade out", "fade to black",
                             "vignette", "letterbox", "subtitle", "quick cut", "smash cut",
                             "match cut"),
}  # fmt: skip
"""Why a word of style asks for nothing that this generator draws → nouns; "": it asks for nothing
that could be seen by itself."""
STYLE_ADJECTIVES: dict[str, tuple[str, ...]] = {
    "": ("cinematic", "hyper realistic", "hyperrealistic", "ultra realistic", "highly detailed",
         "ultra detailed", "hyper detailed", "intricate", "award winning", "filmic", "lifelike",
         "crisp", "high fidelity", "ultra high definition", "true to life", "uncut", "unedited"),
    "the lens blurs nothing": ("defocused", "soft focused"),
    GREYSCALE: ("monochrome", "monochromatic"),
    "colours are as they are": ("sepia", "desaturated", "infrared",
                                "sepia toned", "colour graded", "color graded",
                                "high contrast", "low contrast", "high key", "low key"),
    "pictures have no grain": ("grainy", "vhs style"),
    "the lens draws straight lines": ("anamorphic",),
    "light leaves no trace": ("motion blurred",),
}  # fmt: skip
"""The same of adjectives."""
