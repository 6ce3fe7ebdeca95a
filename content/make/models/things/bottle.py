"""An old bottle of green glass, a little dirty, with barnacles and pink crusts on the side that lay uppermost; its neck is
towards +Z. It is opaque, as dark glass full of dirt nearly is: then it is one draw, and nothing in it must be sorted."""

import numpy as np

import paint
from mesh import Curve, unit
from paint import bump, mix, rgb, step
from things.thing import Sheet, Thing, bound, skin

LENGTH = 0.24
GLASS, SHELL = (0, 0, 448, 256), (448, 0, 64, 64)
# Height above the foot and radius, metres: the punt below, the foot, the wall, the shoulder, the neck, the lip, the mouth.
PROFILE = np.array([(0.020, 0.0), (0.017, 0.010), (0.009, 0.019), (0.001, 0.0265), (0.000, 0.0300), (0.0022, 0.0330), (0.006, 0.0340),
                    (0.050, 0.0340), (0.098, 0.0340), (0.142, 0.0338), (0.155, 0.0318), (0.166, 0.0270), (0.176, 0.0210), (0.187, 0.0165),
                    (0.202, 0.0145), (0.220, 0.0138), (0.2245, 0.0140), (0.2255, 0.0162), (0.2330, 0.0164), (0.2385, 0.0150),
                    (0.2400, 0.0125), (0.2385, 0.0102), (0.230, 0.0095), (0.215, 0.0092), (0.213, 0.0)])
LONG = np.linalg.norm(np.diff(PROFILE, axis=0), axis=1)
ALONG = np.append(0, np.cumsum(LONG)) / LONG.sum()
HEIGHT, WIDE = Curve(np.stack([ALONG, PROFILE[:, 0]], -1)), Curve(np.stack([ALONG, PROFILE[:, 1]], -1))


def place(u, v, out=0.0):
    turn, r = 2 * np.pi * u, WIDE(v) + out
    return np.stack([r * np.cos(turn), r * np.sin(turn), HEIGHT(v) - LENGTH / 2], -1)


def grown(p):
    """How much grows there, 0 to 1: most above, where light came from, and near the foot."""
    patches = paint.fbm(641, *(p[..., k] / 0.030 + 3 for k in range(3)), octaves=4)
    return step(0.05, 0.45, patches + 7 * p[..., 1] - 1.5 * p[..., 2] - 0.18)


def painter(u, v, p):
    def spread(size):
        return [p[..., k] / size + 5 for k in range(3)]
    tone = paint.fbm(642, *spread(0.02), octaves=4)
    colour = mix(rgb('#10351a'), rgb('#265426'), step(-0.5, 0.5, tone))
    colour = mix(colour, rgb('#0a2413'), 0.7 * step(0.030, 0.0, HEIGHT(v)) + 0.5 * bump(HEIGHT(v) - 0.23, 0.008))
    dirt = step(-0.05, 0.5, paint.fbm(643, *spread(0.009), octaves=5)) * (0.35 + 0.4 * step(-0.02, 0.03, p[..., 1]))
    colour = mix(colour, rgb('#7c7a52'), 0.50 * dirt)
    crust = grown(p)
    fine = paint.fbm(644, *spread(0.004), octaves=3)
    colour = mix(colour, mix(rgb('#94647c'), rgb('#c9a2a8'), step(-0.4, 0.5, fine)), 0.85 * crust)
    film = step(0.1, 0.5, paint.fbm(645, *spread(0.017)) + 4 * p[..., 1])
    colour = mix(colour, rgb('#4f5a24'), 0.45 * film * (1 - crust))
    wavy = paint.fbm(646, u * 3, p[..., 2] / 0.05)
    relief = 0.0006 * crust + 0.00025 * fine * crust + 0.00008 * dirt + 0.0003 * wavy
    colour = mix(colour, rgb('#040a06'), 0.95 * step(0.955, 0.975, v))  # inside of the neck
    return colour, relief, 0.12 + 0.35 * dirt + 0.55 * crust + 0.2 * film


def barnacle(at, radius, seed):
    """A cone of plates, open above."""
    out = unit(at * [1, 1, 0])
    side = np.array([0, 0, 1.0])
    other = np.cross(out, side)

    def cone(u, v):
        turn = 2 * np.pi * u + seed
        r = radius * np.interp(v, [0, 0.55, 0.75, 1], [1.0, 0.50, 0.34, 0.02]) * (1 + 0.10 * np.cos(3 * turn))
        h = radius * np.interp(v, [0, 0.55, 0.75, 1], [-0.15, 0.75, 0.70, 0.30])
        return at + r[..., None] * (np.cos(turn)[..., None] * side + np.sin(turn)[..., None] * other) + h[..., None] * out
    rows, columns = [0, 0.55, 0.75, 1], np.linspace(0, 1, 8)
    return skin(cone, columns, rows, out, closed=True)


def paint_barnacle(u, v, p):
    plates = bump(np.abs(np.sin(3 * np.pi * u)), 0.25)
    colour = mix(rgb('#c9c2ae'), rgb('#8f8a78'), np.clip(0.7 * plates + 0.4 * step(0.3, 0.0, v), 0, 1))
    return mix(colour, rgb('#4a453a'), step(0.78, 0.90, v)), -0.0002 * plates, 0.7 + 0 * u


def barnacles():
    parts = []
    for k in range(60):
        u, v = paint.scatter(651, k), 0.18 + 0.50 * paint.scatter(652, k)
        at = place(np.array(u), np.array(v), -0.0004)
        if grown(at) > 0.15 and len(parts) < 11:
            parts.append(barnacle(at, 0.0028 + 0.0030 * paint.scatter(653, k) ** 2, k))
    return parts


def make():
    sheet = Sheet(512, 256)
    sheet.paint(GLASS, place, painter)
    sheet.paint(SHELL, lambda u, v: np.stack([0.02 * u, 0.008 * v, 0 * u], -1), paint_barnacle)
    away = place(*np.meshgrid(np.linspace(0, 1, 25), ALONG)) * [1, 1, 0]
    glass = skin(place, np.linspace(0, 1, 25), ALONG, away, closed=True)
    parts = [sheet.placed(glass, GLASS), *(sheet.placed(part, SHELL) for part in barnacles())]
    return Thing('bottle', [('bottle', None, np.zeros(3), None)], [bound(part, 0) for part in parts], sheet, [], [])
