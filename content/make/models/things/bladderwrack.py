"""A tuft of bladderwrack, Fucus vesiculosus: flat olive fronds that fork, with a midrib and gas bladders in pairs. It hangs on
a joint named "weed", with three chains of joints that sway."""

import numpy as np

import paint
from mesh import Part, facing, join, quaternion, quaternion_product, strongest_four, tangent_frame, unit
from paint import bump, mix, rgb, step
from things.thing import GONE, skin

HEIGHT = 0.105         # metres
CHAINS, LINKS = 3, 3   # joints: weed, then weed_0_0 .. weed_2_2
FORK = 0.42            # share of a frond's length below its fork
BLADE, BLADDER = (384, 0, 128, 216), (384, 216, 128, 40)  # tiles
STILL = [0.0, 1.0]     # phases of a clip that holds still


def joints(at, first):
    """first: number of the joint "weed", which hangs on joint 0; at: where it is fastened, a little inside of the body."""
    out = [('weed', 0, at, None)]
    for k in range(CHAINS):
        for j in range(LINKS):
            out.append((f'weed_{k}_{j}', first if j == 0 else first + LINKS * k + j, at + [0, HEIGHT * j / LINKS, 0], None))
    return out


def frame(t, at, angle, lean, long, branch, seed):
    """Middle line of a blade at t, 0 to 1 along it, and the directions across it and out of it. lean: metres that its tip is
    off along x and z; branch: 1 or -1, for the two ways after the fork."""
    side = unit([np.cos(angle), 0.1, 0.55 * np.sin(angle)])
    out = unit(np.cross(side, [0, 1, 0]))
    twist = 0.9 * np.sin(2.3 * seed) * t + 0.25 * np.sin(11 * t + seed)
    across = np.cos(twist)[..., None] * side + np.sin(twist)[..., None] * out
    face = np.cos(twist)[..., None] * out - np.sin(twist)[..., None] * side
    middle = at + np.stack([lean[0] * t ** 1.3, long * (t - 0.12 * t * t), lean[1] * t ** 1.3], -1)
    apart = (0.031 if branch > 0 else -0.020) * np.clip(t - FORK, 0, 1) ** 1.15 + 0.004 * np.sin(6.5 * t + 2.1 * seed) * t
    return middle + apart[..., None] * side + (0.0055 * np.sin(8 * t + seed) * t)[..., None] * out, across, face


def blade(start, *line):
    """One way of a frond, from start on, without thickness; it is seen from both sides."""
    def place(u, v):
        middle, across, _ = frame(v, *line)
        half = 0.0026 + 0.0019 * step(0.02, 0.35, v) + 0.0008 * step(0.80, 0.92, v)
        half = half * np.sqrt(np.clip(1 - ((v - 0.88) / 0.121) ** 2 * (v > 0.88), 0.25, 1))
        return middle + (half * (2 * u - 1))[..., None] * across
    rows = np.append(np.linspace(start, 0.88, 4 if start == 0 else 3), 1)
    return skin(place, [0, 1], rows, frame(np.array([0.5]), *line)[2][0])


def bladder(t, side, *line):
    """A flat lozenge whose normals are those of a round one: bladders are six pixels wide in a hand's reach."""
    middle, across, face = (w[0] for w in frame(np.array([t]), *line))
    ahead = unit(np.cross(across, face)) * (1 if np.cross(across, face)[1] > 0 else -1)
    middle = middle + side * 0.0038 * across
    across = unit(across + 0.7 * face)  # out of the blade's plane
    out = np.array([across, ahead, -across, -ahead])
    normals = unit(out + 0.8 * face)
    return facing(Part(middle + np.array([0.0042, 0.0062] * 2)[:, None] * out, normals,
                       tangent_frame(normals, np.tile(across, (4, 1)), np.tile(ahead, (4, 1))),
                       np.array([(1, 0.5), (0.5, 0), (0, 0.5), (0.5, 1)]), np.array([(0, 1, 2), (0, 2, 3)])))


def tuft(at, first, reach, sheet):
    """Fronds that lean up to about reach metres along Z from where they are fastened. first: number of the joint "weed"."""
    sheet.paint(BLADE, lambda u, v: np.stack([0.01 * u, HEIGHT * v, 0 * u], -1), paint_blade)
    sheet.paint(BLADDER, lambda u, v: np.stack([0.02 * u, 0.01 * v, 0 * u], -1), paint_bladder)
    fronds = ((0, 0.3, (0.026, 0.2), 0.112), (1, 1.9, (-0.024, -0.4), 0.116), (2, 2.8, (-0.003, 0.5), 0.098))
    parts = []
    for k, (chain, angle, lean, long) in enumerate(fronds):
        line = at, angle, (lean[0], lean[1] * reach), long
        for start, branch in ((0, -1), (FORK - 0.02, 1)):
            made = [sheet.placed(blade(start, *line, branch, 3 * k), BLADE)]
            for t, sides in (((0.34, (-1, 1)),) if branch < 0 else ((0.62, (-1,)),)):
                made += [sheet.placed(bladder(t + 0.03 * np.sin(5 * k), side, *line, branch, 3 * k), BLADDER) for side in sides]
            parts.append(follow(join(made), at, first, chain))
    return parts


def follow(part, at, first, chain):
    """Each vertex follows the two nearest joints of its chain."""
    along = np.clip((part.positions[:, 1] - at[1]) / HEIGHT * LINKS - 0.35, 0, LINKS - 1)
    low = np.minimum(along.astype(int), LINKS - 2)
    weights = np.zeros((len(part.positions), first + 1 + CHAINS * LINKS))
    every = np.arange(len(weights))
    weights[every, first + 1 + chain * LINKS + low] = 1 - (along - low)
    weights[every, first + 2 + chain * LINKS + low] = along - low
    part.joints, part.weights = strongest_four(weights)
    return part


def paint_blade(u, v, p):
    s = np.abs(2 * u - 1)
    tone = paint.fbm(611, p[..., 0] * 260, p[..., 1] * 90, octaves=4)
    colour = mix(rgb('#4c3f16'), rgb('#85702a'), step(-0.5, 0.6, tone + 0.35 * (v - 0.4)))
    rib = bump(s, 0.13) * step(0.95, 0.6, v)
    ripe = step(0.82, 0.91, v)  # receptacles, full of warts
    colour = mix(colour, rgb('#33280f'), 0.65 * rib)
    colour = mix(colour, rgb('#b39a45'), 0.55 * ripe)
    colour = mix(colour, rgb('#30260e'), 0.6 * step(0.15, 0.0, v))
    dots = step(0.34, 0.15, paint.cells(612, u * 9, v * 110)[0]) * ripe
    colour = colour * (1 - 0.25 * dots + 0.15 * bump(s - 0.97, 0.06))[..., None]
    return colour, 0.0005 * rib + 0.0003 * dots + 0.00012 * tone, 0.42 + 0.08 * tone


def paint_bladder(u, v, p):
    tone = paint.fbm(613, np.cos(2 * np.pi * u) * 2, np.sin(2 * np.pi * u) * 2, v * 4, octaves=3)
    colour = mix(rgb('#65541d'), rgb('#947e36'), step(-0.5, 0.5, tone))
    colour = mix(colour, rgb('#4c3f16'), 0.7 * step(0.22, 0.0, np.minimum(v, 1 - v)))
    return colour, 0.0001 * tone, 0.30 + 0.06 * tone


def drift():
    """Channels of a gentle sway, whole turns of sines."""
    phases = np.linspace(0, 1, 13)
    channels = {('weed', 'scale'): np.ones((len(phases), 3))}
    for k in range(CHAINS):
        for j in range(LINKS):
            turn = 2 * np.pi * (phases - 0.14 * j) + 1.3 * k
            lean = quaternion([0, 0, 1], (0.05 + 0.045 * j) * np.sin(turn))
            nod = quaternion([1, 0, 0], (0.04 + 0.03 * j) * np.sin(turn + 1.9))
            channels[f'weed_{k}_{j}', 'rotation'] = quaternion_product(lean, nod)
    for values in channels.values():
        values[-1] = values[0]
    return phases, channels


def gone():
    return {('weed', 'scale'): np.full((2, 3), GONE)}
