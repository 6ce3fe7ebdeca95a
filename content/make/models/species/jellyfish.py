"""Mauve stinger, Pelagia noctiluca: a translucent bell that pulses upright, four frilled arms, trailing tentacles; its rim and
canals glow when it is disturbed. Unlike fish it has no spine: +Y is up, and it drifts along +Z."""

import numpy as np

import paint
from glb import Glb
from mesh import Part, facing, grid_triangles, join, quaternion, strongest_four, tangent_frame, unit
from paint import bump, mix, rgb, step

RADIUS, HEIGHT = 0.10, 0.085   # metres, of the bell
SECTORS = 8                    # joints around the rim; the bell's lobes are twice as many
CHAIN = 4                      # joints along tentacles and arms
TENTACLES, ARMS = 8, 4
TENTACLE_M, ARM_M = 0.34, 0.20
BELL, LOWER, TENTACLE, ARM = (0, 0, 0.70, 0.48), (0, 0.52, 0.70, 0.48), (0.74, 0, 0.06, 1.0), (0.84, 0, 0.16, 1.0)  # uv tiles
SIZE = 512


def joints():
    """Name, parent's number, place: the bell, its rim, and a chain for each two tentacles and for each arm."""
    out = [('bell', None, np.zeros(3))]
    for k in range(SECTORS):
        a = 2 * np.pi * k / SECTORS
        out.append((f'rim_{k}', 0, np.array([0.55 * RADIUS * np.cos(a), 0.25 * HEIGHT, 0.55 * RADIUS * np.sin(a)])))
    for kind, count, long, away in (('tentacle', TENTACLES, TENTACLE_M, 0.93), ('arm', ARMS, ARM_M, 0.22)):
        for k in range(count):
            a = 2 * np.pi * (k + 0.5) / count
            for j in range(CHAIN):
                parent = (1 + k * SECTORS // count if kind == 'tentacle' else 0) if j == 0 else len(out) - 1
                out.append((f'{kind}_{k}_{j}', parent, np.array([away * RADIUS * np.cos(a), -long * j / CHAIN, away * RADIUS * np.sin(a)])))
    return out


def number(name):
    return [joint[0] for joint in joints()].index(name)


def dome(inside):
    """The bell's upper skin or its lower one, lobed at the rim; both meet there."""
    rows, columns = 11, 48
    t, g = np.meshgrid(np.linspace(0.02, 1, rows), np.linspace(0, 2 * np.pi, columns + 1), indexing='ij')
    lobes = np.abs(np.sin(g * SECTORS)) ** 0.6
    r = RADIUS * np.sin(t * np.pi / 2) ** 0.9 * (1 - 0.05 * (1 - lobes) * t ** 6)
    y = HEIGHT * (np.cos(t * np.pi / 2) ** 0.75 - 0.10 * t ** 3) - 0.05 * HEIGHT * lobes * t ** 8
    if inside:
        y = y - 0.020 * np.cos(t * np.pi / 2) ** 0.5 - 0.0005
        r = r * (1 - 0.01 * (1 - t))
    p = np.stack([r * np.cos(g), y, r * np.sin(g)], -1)
    p[:, -1] = p[:, 0]
    dt, dg = np.gradient(p, axis=0), np.gradient(p, axis=1)
    n = unit(np.cross(dt, dg))
    n = n * np.sign(n[4, ..., 1].mean()) * (-1 if inside else 1)
    uv = np.stack([g / (2 * np.pi), t], -1)
    tile = np.array(LOWER if inside else BELL)
    part = facing(Part(p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, dg, -dt).reshape(-1, 4),
                       (tile[:2] + uv * tile[2:]).reshape(-1, 2), grid_triangles(rows, columns + 1)))
    w = np.zeros((len(part.positions), len(joints())))
    rim = (step(0.30, 0.95, t) * 0.98).reshape(-1)
    angle = g.reshape(-1) * SECTORS / (2 * np.pi)
    for k in range(SECTORS):
        near = 1 - np.abs((angle - k + SECTORS / 2) % SECTORS - SECTORS / 2)
        w[:, 1 + k] = rim * np.clip(near, 0, 1)
    w[:, 0] = 1 - rim
    part.joints, part.weights = strongest_four(w)
    return part


def ribbon(kind, k, count, long, away, wide, tile, frill, rows):
    """Two skins of a strip that hangs down, narrowing; frill: how far it waves to and fro, metres."""
    a = 2 * np.pi * (k + 0.5) / count
    t = np.linspace(0, 1, rows)
    out, side = np.array([np.cos(a), 0, np.sin(a)]), np.array([-np.sin(a), 0, np.cos(a)])
    middle = away * RADIUS * out - np.array([0, 1, 0]) * (long * t)[:, None] + (0.010 * np.sin(5 * t + k))[:, None] * out
    half = wide * (1 - 0.75 * t ** 1.5) * (0.75 + 0.25 * np.minimum(1, 8 * t))
    columns = 4
    s = np.linspace(-1, 1, columns)
    p = middle[:, None] + (half[:, None] * s)[..., None] * side
    p = p + (frill * np.sin(t[:, None] * 34 + 1.7 * k + 2.2 * s[None]) * np.abs(s)[None] * (1 - 0.5 * t[:, None]))[..., None] * out
    n = unit(np.cross(np.gradient(p, axis=0), np.gradient(p, axis=1)))
    uv = np.stack(np.broadcast_arrays(0.5 + 0.5 * s[None], t[:, None]), -1)
    tile = np.array(tile)
    skins = []
    for sign in (1.0, -1.0):
        skins.append(facing(Part((p + sign * 0.0006 * n).reshape(-1, 3), (sign * n).reshape(-1, 3),
                                 tangent_frame(sign * n, np.gradient(p, axis=1), -np.gradient(p, axis=0)).reshape(-1, 4),
                                 (tile[:2] + uv * tile[2:]).reshape(-1, 2), grid_triangles(rows, columns))))
    part = join(skins)
    w = np.zeros((len(part.positions), len(joints())))
    at = np.clip(np.tile(np.repeat(t, columns), 2) * CHAIN, 0, CHAIN - 1e-6)
    low = np.minimum(at.astype(int), CHAIN - 1)
    blend = step(0.25, 1.0, at - low) * (low < CHAIN - 1)
    first = number(f'{kind}_{k}_0')
    rows_of = np.arange(len(w))
    w[rows_of, first + low] += 1 - blend
    w[rows_of, first + np.minimum(low + 1, CHAIN - 1)] += blend
    part.joints, part.weights = strongest_four(w)
    return part


def pictures():
    """Colour with opacity, and light emitted."""
    y, x = (np.mgrid[0:SIZE, 0:SIZE] + 0.5) / SIZE
    colour, alpha, glow = np.zeros((SIZE, SIZE, 3)), np.zeros((SIZE, SIZE)), np.zeros((SIZE, SIZE, 3))

    def within(tile):
        inside = (x >= tile[0] - 0.01) & (x < tile[0] + tile[2] + 0.01) & (y >= tile[1] - 0.02) & (y < tile[1] + tile[3] + 0.02)
        return inside, np.clip((x[inside] - tile[0]) / tile[2], 0, 1), np.clip((y[inside] - tile[1]) / tile[3], 0, 1)

    def put(inside, c, a, light):
        colour[inside], alpha[inside], glow[inside] = c, a, light
    inside, u, t = within(BELL)
    g = 2 * np.pi * u
    warts = step(0.30, 0.16, paint.cells(511, u * 46, t * 14)[0]) * step(0.10, 0.25, t)
    rim = step(0.90, 0.99, t)
    canal = bump(np.abs(np.sin(g * SECTORS)) - 0.0, 0.10) * step(0.25, 0.6, t)
    thick = 0.26 + 0.34 * step(0.55, 1.0, t) + 0.14 * paint.fbm(512, np.cos(g) * 3, np.sin(g) * 3, t * 5, octaves=3)
    c = mix(rgb('#d9b6d6'), rgb('#a85f9c'), step(0.3, 1.0, t))
    c = mix(c, rgb('#7b2f63'), 0.75 * warts)
    c = mix(c, rgb('#f3d7ef'), 0.7 * rim)
    light = rgb('#3aa7ff') * (1.00 * rim + 0.50 * canal + 0.28 * warts)[:, None]
    put(inside, c, np.clip(thick + 0.35 * warts + 0.25 * rim, 0, 0.92), light)
    inside, u, t = within(LOWER)
    g = 2 * np.pi * u
    canal = bump(np.sin(g * SECTORS), 0.16) * step(0.12, 0.3, t) * step(1.0, 0.9, t)
    muscle = 0.5 + 0.5 * np.sin(t * 90)
    organ = bump(np.abs(np.sin(g * 2)) - 0.75, 0.30) * bump(t - 0.36, 0.10)
    c = mix(rgb('#c79cc9'), rgb('#8d3f7c'), np.clip(0.6 * canal + organ, 0, 1))
    put(inside, c, np.clip(0.16 + 0.08 * muscle * step(0.5, 0.8, t) + 0.30 * canal + 0.55 * organ, 0, 0.85),
        rgb('#47b4ff') * (0.60 * canal + 0.70 * organ)[:, None])
    inside, u, t = within(TENTACLE)
    beads = 0.5 + 0.5 * np.sin(t * 150)
    c = mix(rgb('#b4568f'), rgb('#e7b7d8'), beads)
    put(inside, c, np.clip((0.9 - 0.35 * t) * step(0.0, 0.25, u) * step(1.0, 0.75, u), 0, 1),
        rgb('#49b0ff') * (0.60 * beads * (1 - t))[:, None])
    inside, u, t = within(ARM)
    fold = np.abs(2 * u - 1)
    lace = paint.fbm(513, u * 9, t * 26, octaves=4)
    c = mix(rgb('#e9c3de'), rgb('#9b4a85'), np.clip(1 - fold + 0.4 * lace, 0, 1))
    ragged = step(1.0, 0.86, fold + 0.10 * lace) * step(1.0, 0.94, t)
    put(inside, c, np.clip((0.78 - 0.30 * fold + 0.2 * lace) * ragged, 0, 0.95), rgb('#3f9fff') * (0.32 * (1 - fold))[:, None])
    return np.concatenate([np.clip(colour, 0, 1), alpha[..., None]], -1), np.clip(glow, 0, 1)


class Jellyfish:
    """Has the method that make_models calls of an Animal."""

    def write(self, path):
        # far skins first: they are blended in this order
        parts = [ribbon('tentacle', k, TENTACLES, TENTACLE_M, 0.93, 0.0042, TENTACLE, 0.002, 17) for k in range(TENTACLES)]
        parts += [ribbon('arm', k, ARMS, ARM_M, 0.22, 0.024, ARM, 0.011, 21) for k in range(ARMS)]
        whole = join([*parts, dome(True), dome(False)])
        glb = Glb()
        colour, glow = pictures()
        material = glb.material('jelly', glb.texture(paint.png(paint.bled(colour))), rough=0.30, metal=0.0, blend=True,
                                glow=glb.texture(paint.jpeg(glow, 88)))
        known, nodes = joints(), []
        binds = np.tile(np.eye(4), (len(known), 1, 1))
        for k, (name, parent, place) in enumerate(known):
            offset = place if parent is None else place - known[parent][2]
            nodes.append(glb.node(name, None if parent is None else nodes[parent], offset))
            binds[k, :3, 3] = -place
        glb.node('jellyfish', mesh=glb.mesh('jellyfish', [glb.primitive(whole, material)]), skin=glb.skin(nodes, binds, nodes[0]))
        self.clip(glb, nodes, 'swim', 1.6, 32, 0.42)
        self.clip(glb, nodes, 'dart', 0.8, 24, 0.60)
        self.clip(glb, nodes, 'struggle', 0.6, 24, 0.30, shiver=0.10)
        return glb.save(path), len(whole.triangles), len(whole.positions)

    def clip(self, glb, nodes, name, duration, keys, squeeze, shiver=0.0):
        """A pulse: the rim closes in a third of the time and opens slowly; what hangs from it follows later."""
        phase = np.linspace(0, 1, keys + 1)

        def pulse(p):
            p = p % 1.0
            return np.where(p < 0.33, 0.5 - 0.5 * np.cos(np.pi * p / 0.33), 0.5 + 0.5 * np.cos(np.pi * (p - 0.33) / 0.67))
        channels = [(nodes[0], 'translation', np.stack([0 * phase, 0.012 * pulse(phase - 0.12), 0 * phase], -1))]
        for k in range(SECTORS):
            a = 2 * np.pi * k / SECTORS
            tangent = np.array([np.sin(a), 0, -np.cos(a)])
            angle = -squeeze * (pulse(phase + 0.02 * np.sin(3 * k)) - 0.15) + shiver * np.sin(2 * np.pi * (3 * phase + 0.37 * k))
            channels.append((nodes[1 + k], 'rotation', quaternion(tangent, angle)))
        for kind, count in (('tentacle', TENTACLES), ('arm', ARMS)):
            for k in range(count):
                a = 2 * np.pi * (k + 0.5) / count
                tangent, out = np.array([np.sin(a), 0, -np.cos(a)]), np.array([np.cos(a), 0, np.sin(a)])
                for j in range(CHAIN):
                    lag = 0.16 * (j + 1)
                    swing = (0.28 if kind == 'tentacle' else 0.10) * squeeze / 0.42
                    bend = swing * (pulse(phase - lag) - 0.5) + (0.5 * squeeze * pulse(phase) if j == 0 and kind == 'tentacle' else 0)
                    sway = 0.10 * np.sin(2 * np.pi * (phase - 0.11 * j) + 1.9 * k)
                    channels.append((nodes[number(f'{kind}_{k}_{j}')], 'rotation',
                                     quaternion(unit(tangent + 1e-9 * out), bend + sway)))
        times = phase * duration
        for _, _, values in channels:
            values[-1] = values[0]
        glb.animation(name, times, channels)


def make():
    return Jellyfish()
