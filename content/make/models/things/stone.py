"""A cobble, rounded by the sea and a little flat, with speckles; drifting bladderwrack has carried it off."""

import numpy as np

import paint
from paint import bump, mix, rgb, step
from things import bladderwrack
from things.thing import Sheet, Thing, bound, skin

LENGTH, WIDE, HIGH = 0.085, 0.064, 0.046  # metres along z, x, y
TILE = (0, 0, 384, 256)
FASTENED = np.array([0.003, 0.012, -0.004])


def shape(u, v):
    turn, down = 2 * np.pi * u, np.pi * np.clip(v, 0, 1)
    d = np.stack([np.sin(down) * np.cos(turn), np.sin(down) * np.sin(turn), np.cos(down)], -1)
    bumps = 0.13 * paint.noise(621, *(d[..., k] * 1.1 + 3 for k in range(3))) + 0.025 * paint.noise(622, *(d[..., k] * 2.3 for k in range(3)))
    hollow = -0.07 * np.exp(-np.sum((d - [0.75, 0.2, 0.55]) ** 2, -1) / 0.22)
    return d * (1 + bumps + hollow)[..., None]


GRID_U, GRID_V = np.linspace(0, 1, 15), np.linspace(0, 1, 9)
CORNERS = shape(*np.meshgrid(GRID_U, GRID_V)).reshape(-1, 3)
MIDDLE, SPAN = (CORNERS.max(0) + CORNERS.min(0)) / 2, np.ptp(CORNERS, axis=0)


def place(u, v):
    return (shape(u, v) - MIDDLE) / SPAN * [WIDE, HIGH, LENGTH]


def painter(u, v, p):
    turned = p @ np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0], [0.48, 0.64, 0.6]])  # hides the noise's axes

    def spread(size):
        return [turned[..., k] / size + 7 for k in range(3)]
    def grains(seed, size):  # two lattices, so that none shows
        return 0.75 * (paint.noise(seed, *spread(size)) + paint.noise(seed + 20, *[p[..., k] / size for k in range(3)]))
    tone = paint.fbm(623, *spread(0.016), octaves=5)
    colour = mix(rgb('#6f6e6b'), rgb('#a39f97'), step(-0.5, 0.5, tone))
    dark, pale = grains(624, 0.0023), grains(625, 0.0026)
    colour = mix(colour, rgb('#2b2c30'), 0.75 * step(0.25, 0.70, dark))
    colour = mix(colour, rgb('#e2dccf'), 0.75 * step(0.28, 0.75, pale))
    colour = mix(colour, rgb('#b58670'), 0.60 * step(0.35, 0.75, grains(626, 0.0028)))
    vein = bump(p @ np.array([0.35, 0.55, 0.76]) - 0.012 + 0.004 * paint.noise(627, *spread(0.02)), 0.0016)
    colour = mix(colour, rgb('#ddd6c8'), 0.75 * vein)
    crust = step(0.02, 0.16, paint.fbm(628, *spread(0.022), octaves=4) + 8 * p[..., 0] - 0.25)
    colour = mix(colour, rgb('#a8718a'), 0.70 * crust)
    foot = bump(np.linalg.norm(p - FASTENED - [0, 0.008, 0], axis=-1), 0.014)
    film = np.clip(0.35 * step(0.0, 0.5, paint.fbm(629, *spread(0.011))) * step(-0.01, 0.015, p[..., 1]) + 0.9 * foot, 0, 1)
    colour = mix(colour, rgb('#4a4420'), 0.75 * film)
    relief = 0.0005 * tone + 0.00016 * dark - 0.00012 * pale + 0.0003 * crust + 0.0002 * vein
    return colour, relief, 0.62 + 0.10 * tone - 0.12 * vein + 0.08 * crust


def make():
    sheet = Sheet(512, 256)
    sheet.paint(TILE, place, painter)
    body = skin(place, GRID_U, GRID_V, place(*np.meshgrid(GRID_U, GRID_V)), closed=True)
    parts, weed = [bound(sheet.placed(body, TILE), 0)], bladderwrack.tuft(FASTENED, 1, 0.030, sheet)
    joints = [('stone', None, np.zeros(3), None), *bladderwrack.joints(FASTENED, 1)]
    return Thing('stone', joints, parts, sheet, weed,
                 [('drift', 3.2, *bladderwrack.drift()), ('loose', 1.0, bladderwrack.STILL, bladderwrack.gone())])
