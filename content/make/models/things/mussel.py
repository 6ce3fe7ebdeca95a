"""A blue mussel, Mytilus edulis, on drifting bladderwrack: two ridged shells that meet at x = 0 and gape about the ligament,
which runs from the beak at -Z up the back; inside nacre, mantle and flesh.

It rests open, with its weed, because self-occlusion is that of the rest pose and would leave the inside of a closed one black;
its other clips close it.
"""

import numpy as np

import paint
from mesh import Curve, mirrored, quaternion, unit
from paint import bump, mix, rgb, step
from things import bladderwrack
from things.thing import Sheet, Thing, bound, skin

LENGTH, THICK = 0.09, 0.0172   # metres; the second of one shell
GAPE = np.radians(50)
OUTER, INNER, FLESH = (0, 0, 256, 256), (256, 0, 128, 128), (256, 128, 128, 128)
# Distance of the rim from the beak, shares of the length, by angle above +Z, degrees: belly, hind end, back.
VENTRAL, DORSAL = -9.0, 40.0
RIM = Curve([(VENTRAL, 0.66), (-6, 0.78), (-1, 0.90), (5, 0.975), (11, 1.0), (18, 0.975), (26, 0.87), (33, 0.74), (DORSAL, 0.60)])
BEAK = np.array([0, -0.0137, -LENGTH / 2])
LIGAMENT = np.array([0, np.sin(np.radians(DORSAL)), np.cos(np.radians(DORSAL))])
FASTENED = BEAK + 0.62 * 0.60 * LENGTH * LIGAMENT - [0, 0.002, 0]
ROWS = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0, 1, 8))  # closer where the shell turns down to its rim
COLUMNS = 0.5 + 0.25 * (np.linspace(-1, 1, 9) + np.sin(np.pi / 2 * np.linspace(-1, 1, 9)))


def flat(u, v):
    """Returns the place at the share v of the way from beak to rim (u: 0 along the belly, 1 the back), and the shell's depth."""
    u, v = np.clip(u, 0, 1), np.clip(v, 0, 1)
    angle = VENTRAL + (DORSAL - VENTRAL) * u
    long = RIM(angle) * LENGTH * v / 0.982  # the hind end lies 11 degrees above +Z
    turn = np.radians(angle)
    depth = THICK * (1 - np.abs(2 * u - 1) ** 2.4) ** 0.5 * v ** 0.6 * (1 - v ** 3.2) ** 0.5 / 0.60
    return BEAK + np.stack([0 * u, long * np.sin(turn), long * np.cos(turn)], -1), depth


def outer(u, v):
    at, depth = flat(u, v)
    return at + depth[..., None] * [1, 0, 0]


def inner(u, v):
    at, depth = flat(u, v)
    return at + np.maximum(0.88 * depth - 0.0006, 0)[..., None] * [1, 0, 0]


def flesh(rise):
    """A mound in the left shell; rise: how far its middle comes out of it, metres."""
    def place(u, v):
        s, t = 2 * np.clip(u, 0, 1) - 1, 2 * np.clip(v, 0, 1) - 1
        at, depth = flat(0.5 + 0.37 * s, 0.48 + 0.37 * t)
        mound = np.sqrt(np.clip((1 - s ** 4) * (1 - t ** 4), 0, 1))
        frill = 0.0016 * np.sin(19 * s + 3 * t) * np.sin(7 * t + 1) * mound + 0.0028 * bump(np.hypot(s + 0.1, 1.2 * (t + 0.1)), 0.5)
        return at + (0.82 * depth * (1 - mound) - (rise + frill) * mound)[..., None] * [1, 0, 0]
    return place


def growth(v):
    """Lines of growth: darker rests of winters, closer towards the rim."""
    phase = 26 * np.clip(v, 0, 1) ** 1.7 + 1.1 * paint.noise(631, v * 17)
    return np.sin(2 * np.pi * phase)


def paint_outer(u, v, p):
    lines = growth(v + 0.012 * paint.noise(632, u * 6, v * 5))
    tone = paint.fbm(633, p[..., 1] / 0.010, p[..., 2] / 0.010, octaves=4)
    colour = mix(rgb('#141a2b'), rgb('#2f3a5e'), step(-0.5, 0.6, tone + 0.4 * np.sin(9 * v)))
    rays = step(0.1, 0.6, paint.noise(634, u * 22, v * 1.2)) * step(0.15, 0.4, v)
    colour = mix(colour, rgb('#4a3f6b'), 0.30 * rays)
    colour = mix(colour, rgb('#3b2a1c'), 0.55 * step(0.30, 0.02, u) + 0.30 * step(0.55, 0.95, v))  # horny skin
    colour = colour * (1 + 0.16 * lines)[..., None]
    worn = step(0.26, 0.10, v + 0.08 * tone)
    colour = mix(colour, rgb('#8f8aa6'), 0.75 * worn)
    near, _, which = paint.cells(635, p[..., 2] / 0.009, p[..., 1] / 0.009, 0.9)
    near = near + 0.10 * paint.noise(638, p[..., 1] / 0.0012, p[..., 2] / 0.0012)
    wall = step(0.80, 0.88, which) * step(0.26, 0.14, near) * step(0.05, 0.12, np.minimum(v, 1 - v))  # young barnacles
    colour = mix(colour, rgb('#a9a497'), 0.8 * wall)
    rim = np.maximum(step(0.990, 0.998, v), step(0.012, 0.003, np.minimum(u, 1 - u)) * step(0.05, 0.2, v))
    colour = mix(colour, rgb('#a9b7cf'), 0.75 * rim)
    relief = 0.00016 * lines + 0.00010 * tone + 0.0007 * wall * (1 - 0.5 * step(0.10, 0.04, near))
    return colour, relief, 0.30 + 0.10 * tone + 0.25 * wall + 0.15 * worn


def paint_inner(u, v, p):
    shine = paint.fbm(636, p[..., 1] / 0.014, p[..., 2] / 0.014, octaves=3)
    colour = mix(rgb('#c9d0dc'), rgb('#e9e2e6'), step(-0.4, 0.5, shine))
    near_rim = np.maximum(step(0.93, 0.99, v), step(0.05, 0.01, np.minimum(u, 1 - u)))
    colour = mix(colour, rgb('#5a6a9c'), 0.70 * near_rim)
    colour = mix(colour, rgb('#8795bd'), 0.6 * bump(v - 0.91, 0.04))
    return colour, 0.0001 * shine, 0.22 + 0.1 * near_rim


def paint_flesh(u, v, p):
    s, t = 2 * u - 1, 2 * v - 1
    tone = paint.fbm(637, u * 5, v * 7, octaves=4)
    colour = mix(rgb('#ff9c3f'), rgb('#ffe2b4'), step(-0.5, 0.5, tone + 0.3 * t))
    mantle = step(0.62, 0.86, np.maximum(np.abs(s), np.abs(t)) + 0.05 * tone)
    colour = mix(colour, rgb('#d98340'), 0.5 * mantle)
    colour = mix(colour, rgb('#6a4528'), 0.5 * step(0.90, 1.0, np.maximum(np.abs(s), t)))
    gills = np.sin(60 * u + 6 * tone) * bump(np.abs(s) - 0.42, 0.16)
    colour = colour * (1 + 0.08 * gills)[..., None]
    foot = bump(np.hypot(2.6 * (s + 0.05), 1.4 * (t + 0.35)), 0.42)
    colour = mix(colour, rgb('#a86a3e'), 0.45 * foot)
    return colour, 0.0005 * gills + 0.0006 * tone + 0.0008 * foot, 0.28 + 0.06 * tone


def turned(share):
    """Rotations of the left and right shell."""
    return [quaternion(LIGAMENT, sign * share * GAPE / 2) for sign in (1, -1)]


def make():
    sheet = Sheet(512, 256)
    mound, lining = flesh(0.0035), flesh(-0.0075)
    for tile, place, painter in ((OUTER, outer, paint_outer), (INNER, inner, paint_inner), (FLESH, mound, paint_flesh)):
        sheet.paint(tile, place, painter)
    left = np.array([1.0, 0, 0])
    shell = [sheet.placed(skin(outer, COLUMNS, ROWS, left), OUTER), sheet.placed(skin(inner, COLUMNS, ROWS[[0, 2, 4, 6, 7]], -left), INNER)]
    soft = [sheet.placed(skin(place, np.linspace(0, 1, 5), np.linspace(0, 1, 6), -left), FLESH) for place in (mound, lining)]
    parts = [bound(part, 1) for part in (*shell, soft[0])] + [bound(mirrored(part), 2) for part in (*shell, soft[1])]
    weed = bladderwrack.tuft(FASTENED, 3, 0.020, sheet)
    open_turns = turned(1)
    joints = [('mussel', None, np.zeros(3), None), ('left', 0, BEAK, open_turns[0]), ('right', 0, BEAK, open_turns[1]),
              *bladderwrack.joints(FASTENED, 3)]

    def shells(share, keys):
        return {(name, 'rotation'): np.tile(turn, (keys, 1)) for name, turn in zip(('left', 'right'), turned(share))}
    phases, sway = bladderwrack.drift()
    still, gone = bladderwrack.STILL, bladderwrack.gone()
    return Thing('mussel', joints, parts, sheet, weed,
                 [('drift', 2.8, phases, {**sway, **shells(0, len(phases))}), ('loose', 1.0, still, {**gone, **shells(0, 2)}),
                  ('open', 1.0, still, {**gone, **shells(1, 2)})])
