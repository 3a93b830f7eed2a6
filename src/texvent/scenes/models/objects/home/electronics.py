"""Electronic devices: mouse, keyboard, remote control, camera, printer, radio, circuit board."""

from __future__ import annotations

from texvent.scenes.models.materials import Material, glowing, striped
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
    lying,
    placed,
    ring,
    spinning,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BRASS,
    CHINA,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    PAPER,
    RED_PAINT,
    SCREEN,
    SILVER,
    SILVERY,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, plank, post, rod

_KEYS = striped((0.022, 0.022, 0.025), (0.22, 0.22, 0.23), 7.5)
_LENS = Material((0.04, 0.05, 0.10))
_GREEN_LED = glowing((0.05, 0.85, 0.15), 2.0)


def _button_grid(
    skin: Material, columns: int, rows: int, step: tuple[float, float], low: float, size: float
) -> list[ModelPart]:
    """Buttons on the front of a flat thing, middle columns over y = 0."""
    return [
        box(skin, (0.011, step[0] * (k - 0.5 * (columns - 1)), low + step[1] * i),
            (0.006, size, size)) for k in range(columns) for i in range(rows)
    ]  # fmt: skip


def _tripod(height: float) -> list[ModelPart]:
    return [
        rod(INK, (0.0, 0.0, height - 0.05), (0.35 * c, 0.35 * s, 0.0), 0.018)
        for c, s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))
    ]


def _camera(skin: Material, z: float) -> list[ModelPart]:
    """A camera with its lens towards +x, its lower edge at a height."""
    return [
        box(skin, (0.0, 0.0, z + 0.045), (0.06, 0.14, 0.09)),
        box(skin, (0.0, 0.0, z + 0.10), (0.05, 0.055, 0.03)),
        rod(toned(skin, 1.6), (0.02, 0.0, z + 0.042), (0.10, 0.0, z + 0.042), 0.037),
        disc(GREY_PLASTIC, (0.0, z + 0.042), 0.033, 0.01, 0.098),
        disc(_LENS, (0.0, z + 0.042), 0.028, 0.012, 0.099),
        ball(PALE, (0.104, -0.010, z + 0.052), (0.004, 0.010, 0.010)),
        post(SILVER, (0.0, -0.052, z + 0.095), (0.02, 0.02, 0.012)),
        post(RED_PAINT, (0.0, 0.052, z + 0.093), (0.014, 0.014, 0.008)),
        box(SILVER, (0.031, -0.05, z + 0.07), (0.004, 0.022, 0.012)),
    ]  # fmt: skip


NOUNS = placed("indoor", (
    thing("computer mouse", (BLACKISH, CHINA), lambda p: [
        ball(p, (0.0, 0.0, 0.012), (0.062, 0.11, 0.05)),
        box(INK, (0.0, 0.0, 0.004), (0.05, 0.09, 0.008)),
        rod(GREY_PLASTIC, (-0.004, -0.032, 0.032), (0.004, -0.032, 0.032), 0.008),
        box(GREY_PLASTIC, (0.0, -0.042, 0.0295), (0.002, 0.028, 0.003)),
        *chain(INK, [(0.0, -0.055, 0.008), (0.005, -0.09, 0.004), (-0.02, -0.13, 0.003)], 0.0025)],
        ("optical mouse",)),
    thing("keyboard", (BLACKISH, CHINA), lambda p: [
        plank(p, (0.0, -0.22, 0.011), (0.0, 0.22, 0.011), chord=(0.15, 0.0, -0.012),
            thickness=(0.0, 0.0, 0.014)),
            *(plank(_KEYS, (x, -0.208, 0.020 - 0.08 * x), (x, 0.208, 0.020 - 0.08 * x),
                chord=(0.020, 0.0, -0.0016), thickness=(0.0, 0.0, 0.006))
                for x in (-0.056, -0.028, 0.0, 0.028)),
        box(GREY_PLASTIC, (0.056, 0.0, 0.016), (0.018, 0.15, 0.007)),
        *(box(GREY_PLASTIC, (0.056, y, 0.016), (0.018, 0.03, 0.007))
            for y in (-0.19, -0.14, 0.14, 0.19))], ("computer keyboard", "typewriter keyboard")),
    thing("remote", (BLACKISH,), lambda p: lying([
        box(p, (0.0, 0.0, 0.09), (0.02, 0.048, 0.18)),
        *_button_grid(GREY_PLASTIC, 3, 4, (0.014, 0.016), 0.075, 0.009),
        *(disc(SILVER, (0.0, 0.045), r, 0.02 + 0.002 * i, 0.002) for i, r in enumerate((0.016,))),
        disc(INK, (0.0, 0.045), 0.007, 0.026, 0.001),
        disc(RED_PAINT, (-0.013, 0.165), 0.005, 0.026),
        *_button_grid(PALE, 3, 1, (0.014, 0.0), 0.148, 0.008)]),
        ("remote control", "tv remote", "controller remote")),
    thing("photo camera", (BLACKISH,), lambda p: _camera(p, 0.0),
        ("reflex camera", "digital camera", "dslr", "still camera")),
    thing("video camera", (BLACKISH,),
        lambda p: [*_tripod(1.25), box(p, (-0.05, 0.0, 1.34), (0.34, 0.13, 0.17)),
            rod(toned(p, 1.8), (0.10, 0.0, 1.35), (0.24, 0.0, 1.35), 0.06),
            disc(_LENS, (0.0, 1.35), 0.05, 0.01, 0.24),
            *chain(INK, [(-0.15, 0.0, 1.43), (-0.12, 0.0, 1.50), (0.06, 0.0, 1.50),
                (0.08, 0.0, 1.43)], 0.014), box(SCREEN, (-0.10, -0.10, 1.36), (0.10, 0.02, 0.08)),
                ball(glowing((0.9, 0.02, 0.02), 2.0), (0.125, 0.05, 1.41), (0.012, 0.016, 0.016))],
                ("camcorder", "film camera", "movie camera", "tv camera")),
    thing("tripod", (BLACKISH,),
        lambda p: [*(rod(p, (0.0, 0.0, 1.15), (0.42 * c, 0.42 * s, 0.0), 0.02) for c,
            s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))),
            rod(SILVER, (0.0, 0.0, 0.7), (0.0, 0.0, 1.32), 0.018), *_camera(p, 1.33)[:5],
            *(rod(SILVER, (0.0, 0.0, 0.75), (0.2 * c, 0.2 * s, 0.6), 0.009) for c,
                s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87)))]),
    thing("webcam", (BLACKISH,),
        lambda p: [post(p, (0.0, 0.0, 0.006), (0.08, 0.08, 0.012)),
            rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.06), 0.008),
            ball(p, (0.0, 0.0, 0.085), (0.06, 0.06, 0.06)),
            disc(SILVER, (0.0, 0.085), 0.02, 0.02, 0.024),
            disc(_LENS, (0.0, 0.085), 0.015, 0.022, 0.025)]),
    thing("printer", (CHINA, BLACKISH),
        lambda p: [box(p, (0.0, 0.0, 0.11), (0.36, 0.44, 0.20)),
            box(INK, (0.17, 0.0, 0.08), (0.04, 0.34, 0.05)),
            plank(PAPER, (-0.12, 0.0, 0.20), (-0.22, 0.0, 0.38), chord=(0.0, 0.22, 0.0),
                thickness=(0.004, 0.0, 0.0)), box(PAPER, (0.26, 0.0, 0.065), (0.20, 0.22, 0.004)),
                box(toned(p, 0.7), (0.25, 0.0, 0.055), (0.22, 0.30, 0.012)),
                ball(_GREEN_LED, (0.182, 0.16, 0.16), (0.006, 0.014, 0.014)),
                box(SCREEN, (0.181, 0.10, 0.16), (0.004, 0.05, 0.03))],
                ("photocopier",)),
    thing("radio", (RED_PAINT.colour, WOOD_BROWN),
        lambda p: [box(p, (0.0, 0.0, 0.09), (0.09, 0.28, 0.18)),
            disc(INK, (-0.065, 0.09), 0.058, 0.02, 0.042),
            *ring(SILVER, (0.05, -0.065, 0.09), (0.058, 0.058), 0.004, pieces=14),
            box(PALE, (0.045, 0.06, 0.13), (0.01, 0.11, 0.04)),
            box(RED_PAINT, (0.05, 0.04, 0.13), (0.006, 0.004, 0.04)),
            *(disc(SILVER, (y, 0.06), 0.018, 0.02, 0.05) for y in (0.03, 0.09)),
            rod(SILVER, (-0.02, 0.10, 0.17), (-0.02, 0.20, 0.40), 0.003)],
            ("transistor radio",)),
    thing("game controller", (BLACKISH, CHINA),
        lambda p: lying([ball(p, (0.0, 0.0, 0.06), (0.04, 0.13, 0.07)),
            *(limb(p, (0.0, 0.05 * s, 0.06), (0.0, 0.07 * s, 0.005), 0.024) for s in (1.0, -1.0)),
            *(disc(INK, (0.022 * s, 0.045), 0.010, 0.05) for s in (1.0, -1.0)),
            *(disc(Material(hue), (0.045 + dy, 0.068 + dz), 0.005, 0.042) for hue, dy,
                dz in (((0.6, 0.03, 0.02), 0.011, 0.0), ((0.03, 0.2, 0.6), -0.011, 0.0),
                    ((0.75, 0.5, 0.03), 0.0, 0.011), ((0.05, 0.4, 0.08), 0.0, -0.011))),
                    bar(GREY_PLASTIC, (-0.058, 0.068), (-0.034, 0.068), 0.008, 0.042),
                    bar(GREY_PLASTIC, (-0.046, 0.056), (-0.046, 0.080), 0.008, 0.042)]),
                    ("gamepad", "game pad", "video game controller")),
    thing("joystick", (BLACKISH,),
        lambda p: [box(p, (0.0, 0.0, 0.025), (0.16, 0.16, 0.05)),
            box(RED_PAINT, (0.05, 0.05, 0.052), (0.03, 0.03, 0.012)),
            ball(INK, (0.0, 0.0, 0.05), (0.07, 0.07, 0.05))],
            moving=(Moving(lambda p: [rod(SILVER, (0.0, 0.0, 0.05), (0.0, 0.0, 0.14), 0.009),
                ball(RED_PAINT, (0.0, 0.0, 0.165), (0.06, 0.06, 0.06))],
                swinging("x", 0.35, 0.8, (0.0, 0.0, 0.04))),)),
    thing("calculator", (BLACKISH, GREY_PLASTIC.colour),
        lambda p: lying([box(p, (0.0, 0.0, 0.075), (0.018, 0.08, 0.15)),
            box(Material((0.35, 0.42, 0.30)), (0.008, 0.0, 0.125), (0.006, 0.064, 0.026)),
            *_button_grid(PALE, 4, 5, (0.017, 0.018), 0.018, 0.012),
            bar(INK, (0.005, 0.125), (0.026, 0.125), 0.012, 0.008, 0.0085)]),
            ("pocket calculator",)),
    thing("projector", (CHINA, BLACKISH),
        lambda p: [box(p, (0.0, 0.0, 0.07), (0.26, 0.32, 0.11)),
            rod(INK, (0.10, 0.08, 0.075), (0.16, 0.08, 0.075), 0.042),
            disc(glowing((0.75, 0.85, 1.0), 2.0), (0.08, 0.075), 0.03, 0.01, 0.158),
            *(bar(INK, (-0.12 + 0.03 * i, 0.05), (-0.12 + 0.03 * i, 0.10), 0.008, 0.006, 0.13)
                for i in range(4)), box(GREY_PLASTIC, (0.0, -0.06, 0.128), (0.06, 0.05, 0.006)),
                *(post(INK, (x, y, 0.008), (0.03, 0.03, 0.016)) for x in (0.09, -0.09)
                    for y in (0.12, -0.12))], ("video projector", "beamer")),
    thing("router", (BLACKISH, CHINA),
        lambda p: [box(p, (0.0, 0.0, 0.02), (0.14, 0.22, 0.03)),
            *(rod(p, (-0.06, y, 0.02), (-0.07, 1.2 * y, 0.18), 0.006) for y in (0.09, 0.0, -0.09)),
            *(ball(_GREEN_LED, (0.071, -0.08 + 0.03 * i, 0.022), (0.004, 0.008, 0.008))
                for i in range(6))], ("wi-fi router", "wifi router")),
    thing("circuit board", ((0.02, 0.22, 0.08),),
        lambda p: [box(p, (0.0, 0.0, 0.003), (0.16, 0.22, 0.004)),
            box(INK, (0.01, 0.01, 0.009), (0.05, 0.05, 0.008)),
            *(box(BRASS, (x, y, 0.0055), (w, h, 0.002)) for x, y, w,
                h in ((-0.06, 0.0, 0.004, 0.18), (0.06, 0.03, 0.004, 0.12),
                    (0.0, -0.05, 0.10, 0.003), (0.03, 0.075, 0.05, 0.003))),
                    *(post(SILVER, (x, y, 0.018), (0.016, 0.016, 0.03)) for x,
                        y in ((-0.045, 0.075), (-0.045, 0.05), (0.05, -0.08))),
                        *(box(INK, (-0.03 + 0.02 * i, -0.075, 0.008), (0.012, 0.026, 0.006))
                            for i in range(3)), ball(glowing((0.9, 0.05, 0.03), 3.0),
                            (0.06, 0.095, 0.010), (0.010, 0.010, 0.012)),
                            ball(_GREEN_LED, (0.04, 0.095, 0.010), (0.010, 0.010, 0.012)),
                            box(SILVER, (-0.065, -0.09, 0.014), (0.03, 0.03, 0.02))],
                            ("pcb", "electronic board")),
    thing("hard disk", (SILVERY,),
        lambda p: [box(p, (0.0, 0.0, 0.013), (0.10, 0.147, 0.026)),
            post(INK, (0.0, -0.02, 0.0262), (0.085, 0.085, 0.001)),
            plank(IRON, (0.03, 0.055, 0.029), (0.005, -0.01, 0.029), chord=(0.010, 0.004, 0.0),
                thickness=(0.0, 0.0, 0.003))], ("hard drive", "hard disc", "disk drive"),
                moving=(Moving(lambda p: [post(Material((0.70, 0.71, 0.73)), (0.0, -0.02, 0.027),
                    (0.082, 0.082, 0.0015)),
                    box(INK, (0.02, -0.02, 0.0279), (0.02, 0.006, 0.0004)),
                    post(IRON, (0.0, -0.02, 0.028), (0.025, 0.025, 0.003))],
                    spinning("z", 2.0, (0.0, -0.02, 0.0))),)),
    thing("cd", (SILVERY,),
        lambda p: lying([disc(p, (0.0, 0.06), 0.06, 0.0015),
            *(disc(Material(hue), (0.0, 0.06), r, 0.0015 + 0.0002 * i) for i,
                (hue, r) in enumerate((((0.35, 0.55, 0.50), 0.05), ((0.62, 0.62, 0.66), 0.042),
                    ((0.60, 0.42, 0.58), 0.033), ((0.62, 0.62, 0.66), 0.025),
                    ((0.30, 0.32, 0.33), 0.014), ((0.03, 0.03, 0.03), 0.0075))))]),
                    ("dvd", "compact disc", "cd disc")),
    thing("cassette", (BLACKISH,),
        lambda p: lying([box(p, (0.0, 0.0, 0.032), (0.010, 0.10, 0.064)),
            box(PAPER, (0.003, 0.0, 0.036), (0.008, 0.088, 0.044)),
            box(INK, (0.005, 0.0, 0.034), (0.006, 0.06, 0.018)),
            *(disc(PALE, (0.021 * s, 0.034), 0.007, 0.006, 0.006) for s in (1.0, -1.0)),
            bar(RED_PAINT, (-0.04, 0.050), (0.04, 0.050), 0.006, 0.006, 0.005)]),
            ("cassette tape",)),
    thing("battery", (BRASS.colour,),
        lambda p: [post(INK, (0.0, 0.0, 0.02), (0.014, 0.014, 0.036)),
            post(p, (0.0, 0.0, 0.042), (0.0142, 0.0142, 0.012)),
            post(SILVER, (0.0, 0.0, 0.0495), (0.006, 0.006, 0.003)),
            post(SILVER, (0.0, 0.0, 0.001), (0.013, 0.013, 0.002))]),
    thing("plug", (CHINA,),
        lambda p: lying([ball(p, (0.0, 0.0, 0.03), (0.03, 0.035, 0.05)),
            *(rod(SILVER, (0.0, 0.008 * s, 0.05), (0.0, 0.008 * s, 0.075), 0.0024)
                for s in (1.0, -1.0)),
                *chain(p, [(0.0, 0.0, 0.01), (0.0, 0.01, -0.05), (0.0, -0.02, -0.10),
                    (0.0, 0.02, -0.14)], 0.004)]), ("power plug", "electric plug")),
    thing("telephone", (RED_PAINT.colour, BLACKISH), lambda p: [
        plank(p, (0.0, 0.0, 0.0), (-0.02, 0.0, 0.09), chord=(0.17, 0.0, 0.0),
            thickness=(0.0, 0.18, 0.0)), rod(PALE, (0.05, 0.0, 0.06), (0.068, 0.0, 0.066), 0.055),
            rod(p, (0.06, 0.0, 0.064), (0.075, 0.0, 0.069), 0.025),
            limb(p, (-0.03, -0.11, 0.125), (-0.03, 0.11, 0.125), 0.020),
            *(ball(p, (-0.025, 0.105 * s, 0.105), (0.06, 0.055, 0.055)) for s in (1.0, -1.0)),
            *(box(p, (-0.03, 0.05 * s, 0.10), (0.03, 0.02, 0.03)) for s in (1.0, -1.0))],
            ("dial phone", "landline phone", "rotary phone")),
    thing("typewriter", ((0.03, 0.12, 0.12), BLACKISH),
        lambda p: [plank(p, (0.0, 0.0, 0.0), (-0.05, 0.0, 0.13), chord=(0.28, 0.0, 0.0),
            thickness=(0.0, 0.30, 0.0)),
            rod(INK, (-0.10, -0.20, 0.155), (-0.10, 0.20, 0.155), 0.025),
            plank(PAPER, (-0.12, 0.0, 0.15), (-0.17, 0.0, 0.36), chord=(0.0, 0.21, 0.0),
                thickness=(0.003, 0.0, 0.0)),
                *(disc(PALE, (-0.12 + 0.03 * i + 0.008 * k, 0.04 + 0.02 * k), 0.010, 0.012,
                    0.155 - 0.02 * k) for k in range(3) for i in range(9)),
                    rod(SILVER, (-0.10, 0.20, 0.155), (-0.08, 0.24, 0.19), 0.005)]),
))  # fmt: skip
"""Nouns of electronic devices."""
