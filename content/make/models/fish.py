"""A fish from measurements: a body of elliptical rings, fins as sheets, eyes, a spine that swims.

Measurements are fractions of the whole length: s runs from the snout (0) to the tip of the tail (1), heights
are above (+) or below (-) the snout's axis. Model frame: facing +Z, +Y up, origin at half length, metres.
"""

from dataclasses import dataclass, field
from typing import Callable

import numpy as np

import paint
from glb import Glb
from mesh import (Curve, Part, grid_triangles, join, quaternion, quaternion_product, strongest_four,
                  tangent_frame, unit, without_slivers)

SNOUT_ROUNDNESS = 0.25  # how much of the texture's width the head gets: s ~ U^2 below this, ~ U above


def smoothed(values, passes):
    v = values.copy()
    for _ in range(passes):
        v[1:-1] = 0.25 * v[:-2] + 0.5 * v[1:-1] + 0.25 * v[2:]
    return v


class Body:
    """The surface P(U, V): U from the snout (0) to the root of the tail fin (1), V from back (0) to belly (1)."""

    def __init__(self, length, end, upper, lower, width, widest, keel=1.0, displace=None):
        self.length, self.end, self.keel = length, end, keel
        self.displace = displace or (lambda s, h, v: 0.0)
        self.roots = np.linspace(0, 1, 600)

        def table(points):
            return smoothed(Curve([(np.sqrt(s / end), y) for s, y in points])(self.roots), 60)
        self.tables = [table(p) for p in (upper, lower, width, widest)]

    def s_of(self, u):
        m = SNOUT_ROUNDNESS
        return self.end * u * u * (1 + m) / (u + m)

    def u_of(self, s):
        m, t = SNOUT_ROUNDNESS, np.clip(np.asarray(s, float) / self.end, 0, 1)
        return (t + np.sqrt(t * t + 4 * (1 + m) * t * m)) / (2 * (1 + m))

    def profile(self, which, s):
        index = {'upper': 0, 'lower': 1, 'width': 2, 'widest': 3}[which]
        return np.interp(np.sqrt(np.clip(np.asarray(s, float) / self.end, 0, 1)), self.roots,
                         self.tables[index])

    def point(self, u, v, side=1.0, displaced=True):
        s, angle = self.s_of(u), np.pi * v
        top, bottom = self.profile('upper', s), self.profile('lower', s)
        middle = bottom + (top - bottom) * self.profile('widest', s)
        c, n = np.cos(angle), np.clip(np.sin(angle), 0, 1)
        x = self.profile('width', s) * n ** self.keel
        y = np.where(c > 0, top - middle, middle - bottom) * c
        if displaced:
            d = self.displace(s, middle + y, v)
            r = np.maximum(np.hypot(x, y), 1e-5)
            x, y = x * (1 + d / r), y * (1 + d / r)
        scale = self.length
        return np.stack(np.broadcast_arrays(side * x * scale, (middle + y) * scale, (0.5 - s) * scale), -1)

    def derivatives(self, u, v, displaced=True, e=2e-3):
        u, v = np.maximum(u, 2 * e), np.clip(v, 0, 1)
        v0, v1 = np.maximum(v - e, 0), np.minimum(v + e, 1)
        u0, u1 = u - e, np.minimum(u + e, 1)
        du = (self.point(u1, v, displaced=displaced) - self.point(u0, v, displaced=displaced)) / (u1 - u0)[..., None]
        dv = (self.point(u, v1, displaced=displaced) - self.point(u, v0, displaced=displaced)) / (v1 - v0)[..., None]
        return du, dv

    def on_side(self, s, h):
        """Point of the left (+X) surface at s and height h, with its outward normal."""
        v = np.linspace(0.02, 0.98, 400)
        u = np.full_like(v, self.u_of(s))
        k = np.argmin(np.abs(self.point(u, v)[:, 1] / self.length - h))
        du, dv = self.derivatives(u[k:k + 1], v[k:k + 1])
        return self.point(u[k], v[k]), unit(-np.cross(du, dv))[0]

    def part(self, rings, around):
        u, v = np.meshgrid(np.linspace(0, 1, rings), np.linspace(0, 1, around), indexing='ij')
        du, dv = self.derivatives(u, v)
        n = -np.cross(du, dv)
        n[:, [0, -1], 0] = 0
        n = unit(n)
        n[0] = unit(np.mean(n[1], 0) * [0, 1, 1])
        left = facing(without_slivers(Part(
            self.point(u, v).reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, du, -dv).reshape(-1, 4),
            np.stack([u, v], -1).reshape(-1, 2), grid_triangles(rings, around))))
        return join([left, mirrored(left)])

    def canvas(self, width, height):
        """Maps of the texture: where on the body each texel lies."""
        u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
        p = self.point(u, v, displaced=False)
        du, dv = self.derivatives(u, v, displaced=False)
        texel_u = np.linalg.norm(du, axis=-1) / width
        texel_v = np.maximum(np.linalg.norm(dv, axis=-1) / height, 2e-6)
        return Canvas(self, u, v, self.s_of(u), p[..., 1] / self.length, p[..., 0] / self.length,
                      np.maximum(texel_u, 2e-6), texel_v)


@dataclass
class Canvas:
    body: Body
    u: np.ndarray
    v: np.ndarray
    s: np.ndarray        # fraction of the length
    h: np.ndarray        # height, fraction of the length
    x: np.ndarray        # half width, fraction of the length
    texel_u: np.ndarray  # metres
    texel_v: np.ndarray

    def near(self, s, h):
        """Distance from a point of the side view, in fractions of the length."""
        return np.hypot(self.s - s, self.h - h)

    def scales(self, rows, seed=1):
        """Overlapping scales in rows along the body. Returns relief 0..1, edge 0..1, a random number of each scale.

        Rows keep their number from head to tail, as in life, so scales shrink where the body does. A scale lies
        over the one behind it and rises towards its free hind edge.
        """
        s = np.linspace(0, self.body.end, 500)
        girth = np.maximum(self.body.profile('upper', s) - self.body.profile('lower', s), 0.04) * 1.25
        travel = np.concatenate([[0], np.cumsum(np.diff(s) * rows / (0.5 * (girth[1:] + girth[:-1])))])
        a = np.interp(self.s, s, travel)
        b = self.v * rows
        relief, edge, which = np.zeros_like(a), np.zeros_like(a), np.zeros_like(a)
        done = np.zeros(a.shape, bool)
        column = np.floor(a).astype(int)
        for back in (-2, -1, 0, 1, 2):  # hindmost first would be under; the foremost that covers wins
            c = column + back
            shift = (c % 2) * 0.5
            row = np.round(b - shift).astype(int)
            jitter = (paint.scatter(seed + 3, c, row) - 0.5) * 0.16
            da, db = a - (c + jitter), (b - shift - row) / 0.62
            inside = (da / 1.25) ** 2 + db ** 2
            hit = (inside < 1) & (da > -0.2) & ~done
            local = np.sqrt(np.clip(inside, 0, 1))
            relief = np.where(hit, step01(da / 1.25) * 0.75 + 0.25 * (1 - db ** 2), relief)
            edge = np.where(hit, paint.step(0.74, 0.98, local), edge)
            which = np.where(hit, paint.scatter(seed, c, row), which)
            done |= hit
        return relief, edge, which


def step01(x):
    return np.clip(x, 0, 1)


@dataclass
class Fin:
    """A sheet: rays leave the root line at `direction`, each `length` long; a runs along the root, b outwards."""
    name: str
    root: np.ndarray       # k x 3, metres, model frame
    direction: np.ndarray  # k x 3, unit
    length: np.ndarray     # k, metres
    tile: tuple            # atlas rectangle: u, v, width, height in 0..1
    bend: tuple = (0, 0, 0)  # where tips drift, metres at b = 1, grows with b^2
    ripple: float = 0.0    # waves in the membrane, metres at b = 1
    waves: float = 3.0
    thickness: float = 0.0  # half, at the root's middle; 0: one sheet
    joint: str = ''        # pectoral joint, if it has one
    columns: int = 14
    rows: int = 7
    mirror: bool = False
    paint: Callable = None
    under: tuple = None     # another tile for a thick fin's lower skin, painted by paint_under
    paint_under: Callable = None

    def parts(self):
        k = len(self.root)
        a = np.linspace(0, 1, self.columns)
        b = np.linspace(0, 1, self.rows)
        at = np.linspace(0, 1, k)

        def along(values):
            return np.stack([np.interp(a, at, np.asarray(values)[:, i]) for i in range(3)], -1)
        root, direction = along(self.root), unit(along(self.direction))
        length = np.interp(a, at, self.length)
        reach = b[:, None]
        p = root[None] + direction[None] * (length * reach)[..., None]
        p = p + np.asarray(self.bend) * (reach * reach)[..., None] * (length / max(length.max(), 1e-9))[None, :, None]
        p = p.reshape(self.rows, self.columns, 3)
        dv, du = np.gradient(p, axis=0), np.gradient(p, axis=1)
        n = unit(np.cross(du, dv))
        # rays of length zero leave no area: take the neighbour's normal
        bad = np.linalg.norm(np.cross(du, dv), axis=-1) < 1e-12
        n = np.where(bad[..., None], unit(n[~bad].mean(0)), n)
        if self.ripple:
            p = p + n * (self.ripple * reach * np.sin(a * self.waves * 2 * np.pi + 0.7))[..., None]
            dv, du = np.gradient(p, axis=0), np.gradient(p, axis=1)
            n = np.where(bad[..., None], n, unit(np.cross(du, dv)))
        x, y, w, h = self.tile
        uv = np.stack(np.broadcast_arrays(x + w * a[None, :], y + h * reach), -1)
        if not self.thickness:
            return [self._part(p, n, du, -dv, uv, False)]
        foil = (4 * a * (1 - a)) ** 0.5 * (1.35 - 0.7 * a)  # blunt in front, sharp behind
        t = self.thickness * foil[None, :] * (1 - reach ** 1.5)
        out = []
        for sign in (1.0, -1.0):
            q = p + n * (sign * t)[..., None]
            qv, qu = np.gradient(q, axis=0), np.gradient(q, axis=1)
            qn = np.cross(qu, qv) * sign
            m = np.where(bad[..., None] | (np.linalg.norm(qn, axis=-1, keepdims=True) < 1e-12), n * sign, unit(qn))
            # round the leading edge: both skins meet there in the direction of the edge
            m[:, 0] = unit(m[:, 0] - 1.2 * unit(qu[:, 0]))
            skin = uv
            if self.under and (n[..., 1].mean() * sign < 0):
                skin = (uv - self.tile[:2]) / self.tile[2:] * self.under[2:] + self.under[:2]
            out.append(self._part(q, m, qu, -qv, skin, sign < 0))
        return out

    def _part(self, p, n, along, up, uv, flip):
        t = tangent_frame(n, along, up)
        part = Part(p.reshape(-1, 3), n.reshape(-1, 3), t.reshape(-1, 4), uv.reshape(-1, 2),
                    grid_triangles(self.rows, self.columns, flip=not flip))
        part = facing(part)
        if self.mirror:
            part = mirrored(part)
        part.reach = np.broadcast_to(np.linspace(0, 1, self.rows)[:, None], p.shape[:2]).reshape(-1)
        return without_slivers(part)


def facing(part):
    """Turns triangles so that they face as the normals do."""
    p = part.positions[part.triangles]
    face = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    wrong = np.sum(face * part.normals[part.triangles].sum(1)) < 0
    if wrong:
        part.triangles = part.triangles[:, ::-1]
    return part


def mirrored(part):
    f = np.array([-1.0, 1, 1])
    t = np.concatenate([part.tangents[:, :3] * f, -part.tangents[:, 3:]], -1)
    return Part(part.positions * f, part.normals * f, t, part.uvs, part.triangles[:, ::-1])


def eye_part(centre, outward, radius, bulge=0.55, rings=6, around=16):
    """Half an ellipsoid that looks along `outward`; its texture is seen from the front."""
    n = unit(outward)
    right = unit(np.cross([0, 1, 0], n))
    up = np.cross(n, right)
    f, g = np.meshgrid(np.linspace(0, np.pi / 2, rings), np.linspace(0, 2 * np.pi, around + 1), indexing='ij')
    x, y, z = np.sin(f) * np.cos(g), np.sin(f) * np.sin(g), np.cos(f)
    p = centre + radius * (x[..., None] * right + y[..., None] * up + bulge * z[..., None] * n)
    m = unit(x[..., None] * right + y[..., None] * up + z[..., None] / bulge * n)
    uv = np.stack([0.5 + 0.5 * x, 0.5 - 0.5 * y], -1)
    t = tangent_frame(m, np.broadcast_to(right, m.shape), np.broadcast_to(up, m.shape))
    return facing(without_slivers(Part(p.reshape(-1, 3), m.reshape(-1, 3), t.reshape(-1, 4), uv.reshape(-1, 2),
                                       grid_triangles(rings, around + 1))))


def eye_picture(iris, ring, pupil=0.5, size=128, seed=5, rim='#101014'):
    """A fish's eye from the front: black pupil, bright ring, iris with fine spokes, dark rim."""
    y, x = np.mgrid[0:size, 0:size]
    x, y = (x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1
    r, g = np.hypot(x, y * 1.04), np.arctan2(y, x)
    spokes = paint.fbm(seed, g * 9, r * 2, octaves=3)
    c = paint.mix(paint.rgb(ring), paint.rgb(iris), paint.step(pupil + 0.02, pupil + 0.20, r))
    c = c * (1 + 0.22 * spokes[..., None])
    c = paint.mix(c, c * 0.55, 0.6 * paint.step(0.3, -0.9, -y) * paint.step(0.4, 0.8, r))
    c = paint.mix(c, paint.rgb(rim), paint.step(0.80, 0.93, r))
    return paint.mix(paint.rgb('#050608'), c, paint.step(pupil - 0.03, pupil + 0.025, r))


# ---------------------------------------------------------------- fins

def median_fin(body, name, which, s0, s1, lengths, leans, tile, sink=0.012, **more):
    """A fin along the back ('upper') or belly ('lower'); lean: radians towards the tail."""
    a = np.linspace(0, 1, 65)
    s = s0 + (s1 - s0) * a
    sign = 1.0 if which == 'upper' else -1.0
    y = body.profile(which, s) - sign * sink
    root = np.stack([0 * a, y, 0.5 - s], -1) * body.length
    lean = Curve(leans)(a)
    direction = np.stack([0 * a, sign * np.cos(lean), -np.sin(lean)], -1)
    return Fin(name, root, direction, (Curve(lengths)(a) + sink) * body.length, tile, **more)


def tail_fin(body, lengths, spread, tile, s=None, overlap=0.02, turn=0.0, **more):
    """The tail: rays fan from +spread (a = 0, upper) to -spread; lengths over a."""
    a = np.linspace(0, 1, 65)
    s = (s or body.end) - overlap
    top, bottom = body.profile('upper', s), body.profile('lower', s)
    root = np.stack([0 * a, top + (bottom - top) * a, 0.5 - s + 0 * a], -1) * body.length
    angle = (spread * (1 - 2 * a) * (0.75 + 0.25 * np.abs(1 - 2 * a))) + turn
    direction = np.stack([0 * a, np.sin(angle), -np.cos(angle)], -1)
    long = Curve(lengths)(a) + overlap
    long = long * (1 - s) / np.max(long * np.cos(angle))  # the longest ray ends at s = 1
    return Fin('tail', root, direction, long * body.length, tile, **more)


def paired_fin(body, name, s, heights, lengths, first, last, tile, sink=0.006, slant=0.0, **more):
    """A pectoral or pelvic fin of the left side: root from heights[0] to heights[1] at s, slanting back by `slant`;
    ray directions turn from `first` to `last`."""
    k = 33
    a = np.linspace(0, 1, k)
    root = np.stack([body.on_side(s + slant * t, heights[0] + (heights[1] - heights[0]) * t)[0] for t in a])
    outward = body.on_side(s, np.mean(heights))[1]
    root = root - outward * sink * body.length
    direction = unit(unit(first)[None] * (1 - a)[:, None] + unit(last)[None] * a[:, None])
    return Fin(name, root, direction, (Curve(lengths)(a) + sink) * body.length, tile, **more)


def ray_picture(a, b, rays, width=0.16, spiny=0.0, seed=3):
    """Where fin rays run: 0..1. Soft rays split in two beyond b = 0.45; spines (a < spiny) do not."""
    r = a * rays
    wobble = 0.05 * paint.noise(seed, r * 0.7, b * 3)
    f = (r + wobble) % 1.0 - 0.5
    soft = a > spiny
    fork = np.where(soft, np.clip((b - 0.4) * 0.42, 0, 0.24), 0)
    d = np.minimum(np.abs(f - fork), np.abs(f + fork))
    w = width * np.where(soft, 1 - 0.45 * b, 1.25 - 0.8 * b)
    lines = 1 - paint.step(w * 0.5, w * 1.3, d)
    joints = 0.93 + 0.07 * np.sign(np.sin(b * 90 + np.floor(r) * 2.4))
    return lines * np.where(soft & (b > 0.2), joints, 1.0)


def edge_alpha(a, b, rays, spiny=0.0, scallop=0.10, ragged=0.010, seed=9):
    """1 inside the fin, 0 beyond its edge, which dips between spines and frays between rays."""
    f = np.abs((a * rays) % 1.0 - 0.5) * 2  # 0 on a ray
    spine = paint.step(spiny + 0.02, spiny - 0.02, a)
    edge = 0.965 - spine * scallop * f ** 1.5 - (1 - spine) * ragged * (f + 0.8 * paint.noise(seed, a * rays * 1.7))
    return 1 - paint.step(edge - 0.025, edge + 0.005, b)


def atlas(fins, size):
    """Paints every fin into one RGBA picture and one normal map."""
    colour = np.zeros((size, size, 4))
    normal = np.ones((size, size, 3)) * [0.5, 0.5, 1.0]
    painted = set()
    tiles = [(fin, fin.tile, fin.paint) for fin in fins]
    tiles += [(fin, fin.under, fin.paint_under) for fin in fins if fin.under]
    for fin, tile, painter in tiles:
        if tile in painted:
            continue
        painted.add(tile)
        x, y, w, h = tile
        pad = 3
        x0, y0 = int(round(x * size)) - pad, int(round(y * size)) - pad
        x1, y1 = int(round((x + w) * size)) + pad, int(round((y + h) * size)) + pad
        px, py = np.meshgrid(np.arange(max(x0, 0), min(x1, size)), np.arange(max(y0, 0), min(y1, size)))
        a = ((px + 0.5) / size - x) / w
        b = ((py + 0.5) / size - y) / h
        c, alpha, height = painter(np.clip(a, 0, 1), np.clip(b, 0, 1))
        colour[py, px] = np.concatenate([c, alpha[..., None]], -1)
        span = np.linalg.norm(np.diff(fin.root, axis=0), axis=1).sum() + 0.5 * fin.length.mean()
        normal[py, px] = paint.normal_map(height, span / (w * size), fin.length.mean() / (h * size))
    return colour, normal


# ---------------------------------------------------------------- spine and clips

SPINE_S = (0.0, 0.20, 0.32, 0.43, 0.53, 0.62, 0.71, 0.80, 0.89)


@dataclass
class Rig:
    """Spine joints from the snout to the tail fin; each turns what lies behind it about Y."""
    length: float
    s: tuple = SPINE_S
    extra: list = field(default_factory=list)  # (name, parent spine joint, position in metres)

    @property
    def names(self):
        return [f'spine_{i}' for i in range(len(self.s))] + [e[0] for e in self.extra]

    @property
    def positions(self):
        spine = [np.array([0, 0, (0.5 - s) * self.length]) for s in self.s]
        return spine + [np.asarray(e[2], float) for e in self.extra]

    def weights(self, points):
        """Each point follows the two nearest segments; half and half at the joint between them."""
        s = 0.5 - points[:, 2] / self.length
        ends = np.append(self.s, 1.0)
        middles = 0.5 * (ends[:-1] + ends[1:])
        w = np.zeros((len(points), len(self.names)))
        k = np.clip(np.searchsorted(middles, s) - 1, 0, len(middles) - 2)
        t = paint.step(0, 1, (s - middles[k]) / (middles[k + 1] - middles[k]))
        rows = np.arange(len(points))
        w[rows, k] = 1 - t
        w[rows, k + 1] += t
        return w

    def bind(self, part):
        """part.jaw, if there: how much each vertex follows the jaw instead, 0..1."""
        w = self.weights(part.positions)
        jaw = getattr(part, 'jaw', None)
        if jaw is not None:
            w *= 1 - jaw[:, None]
            w[:, self.names.index('jaw')] = jaw
        part.joints, part.weights = strongest_four(w)
        return part

    def bind_fin(self, part, joint):
        w = self.weights(part.positions)
        if joint:
            t = paint.step(0.02, 0.3, part.reach)
            root = w[np.argmin(part.reach)]
            w = root * (1 - t)[:, None]
            w[:, self.names.index(joint)] = t
        part.joints, part.weights = strongest_four(w)
        return part

    def add_nodes(self, glb):
        """Returns node indices of the joints; parents a spine joint to the one before it."""
        root = glb.node('root')
        nodes, at = [], self.positions
        for i in range(len(self.s)):
            nodes.append(glb.node(self.names[i], nodes[-1] if nodes else root, at[i] - (at[i - 1] if i else 0)))
        for name, parent, p in self.extra:
            nodes.append(glb.node(name, nodes[parent], np.asarray(p) - at[parent]))
        binds = []
        for p in at:
            m = np.eye(4)
            m[:3, 3] = -np.asarray(p, '<f4').astype(float)
            binds.append(m)
        return nodes, glb.skin(nodes, binds, root)

    def bend(self, lateral, duration, keys):
        """Rotations that lay the midline on x = lateral(s, phase in 0..1), and the snout's sideways travel, metres.

        Segments keep their length: sin(angle) = -dx / length, as a turn by +angle about Y takes -Z towards -X.
        """
        phase = np.linspace(0, 1, keys + 1)
        ends = np.append(self.s, 1.0)
        x = np.stack([lateral(s, phase) for s in ends], -1) * self.length
        slope = np.diff(x, axis=1) / (np.diff(ends) * self.length)
        angle = -np.arcsin(np.clip(slope, -0.95, 0.95))
        turn = np.diff(np.concatenate([np.zeros((keys + 1, 1)), angle], 1), axis=1)
        return phase * duration, x[:, 0], turn


def wave(amplitude, wave_length=0.95, cycles=1, bias=None):
    """A travelling wave in fractions of the length. The envelope 0.02 - 0.0825 s + 0.1625 s^2 is what Videler and
    Hess (1984) measured on saithe and mackerel; amplitude scales it."""
    def lateral(s, phase):
        envelope = 0.02 - 0.0825 * s + 0.1625 * s * s
        x = amplitude * envelope * np.sin(2 * np.pi * (s / wave_length - cycles * phase))
        return x if bias is None else x + bias(s, phase)
    return lateral


def thrash(strength=1.0):
    """A held fish: its whole body whips into a C, to one side and the other, unevenly."""
    def lateral(s, phase):
        c = 0.75 * np.sin(2 * np.pi * 2 * phase) + 0.4 * np.sin(2 * np.pi * 3 * phase + 0.9)
        tail = np.sin(2 * np.pi * (s * 0.9 - 3 * phase))
        return strength * (0.70 * c * ((s - 0.42) ** 2 - 0.06) + 0.06 * s * s * tail)
    return lateral


def add_clip(glb, rig, nodes, name, duration, keys, lateral, fins=None, roll=None, lift=None):
    """fins(phase) -> {joint name: quaternions}; roll(phase): radians about Z; lift(phase): metres."""
    times, sway, turn = rig.bend(lateral, duration, keys)
    phase = times / duration
    start = rig.positions[0]
    up = lift(phase) if lift else 0 * phase
    channels = [(nodes[0], 'translation', np.stack([sway, start[1] + up, 0 * sway + start[2]], -1))]
    for i in range(len(rig.s)):
        q = quaternion([0, 1, 0], turn[:, i])
        if i == 0 and roll:
            q = quaternion_product(quaternion([0, 0, 1], roll(phase)), q)
        channels.append((nodes[i], 'rotation', q))
    for joint, q in (fins(phase) if fins else {}).items():
        channels.append((nodes[rig.names.index(joint)], 'rotation', q))
    glb.animation(name, times, channels)


def flap(axis, beats, swing, rest=0.0, lag=0.0):
    """Both pectoral fins beat together, mirror images; axis: the left fin's root line."""
    axis = unit(axis)

    def clip(phase):
        angle = rest + swing * np.sin(2 * np.pi * (beats * phase + lag))
        twist = 0.35 * swing * np.cos(2 * np.pi * (beats * phase + lag))
        left = quaternion_product(quaternion(axis, angle), quaternion([1, 0, 0], twist))
        right = left * [1, -1, -1, 1]  # mirrored in x
        return {'pectoral_left': left, 'pectoral_right': right}
    return clip


# ---------------------------------------------------------------- the whole animal

@dataclass
class Animal:
    name: str
    body: Body
    fins: list
    eye: tuple               # s, h, radius (fractions), iris, ring
    colour: np.ndarray       # body pictures
    normal: np.ndarray
    metal_rough: np.ndarray
    clips: list              # dicts for add_clip
    rings: int = 46
    around: int = 21
    fin_size: int = 512
    fin_rough: float = 0.45
    extra_joints: list = field(default_factory=list)
    extra_parts: list = field(default_factory=list)  # (part, dict of Glb.material's arguments)
    thick_fins: bool = False  # opaque foils, as sharks have, instead of translucent sheets
    eye_picture: np.ndarray = None

    def write(self, path):
        glb = Glb()
        body = self.body
        pectoral = [f for f in self.fins if f.joint]
        joints = list(self.extra_joints)
        for fin in pectoral:
            middle = fin.root[len(fin.root) // 2].copy()
            if fin.mirror:
                middle[0] = -middle[0]
            parent = int(np.searchsorted(SPINE_S, 0.5 - middle[2] / body.length)) - 1
            joints.append((fin.joint, parent, middle))
        rig = Rig(body.length, extra=joints)

        skin_material = glb.material('skin', glb.texture(paint.jpeg(self.colour, 93)),
                                     glb.texture(paint.jpeg(self.normal, 93)),
                                     glb.texture(paint.jpeg(paint.shrink(self.metal_rough, 2), 90)))
        picture, relief = atlas(self.fins, self.fin_size)
        encoded = paint.jpeg(picture[..., :3], 92) if self.thick_fins else paint.png(picture)
        fin_material = glb.material('fins', glb.texture(encoded), glb.texture(paint.jpeg(relief, 90)),
                                    rough=self.fin_rough, metal=0.0, blend=not self.thick_fins,
                                    double=not self.thick_fins)
        s, h, r, iris, ring = self.eye
        look = eye_picture(iris, ring) if self.eye_picture is None else self.eye_picture
        eye_material = glb.material('eyes', glb.texture(paint.jpeg(look, 95)), rough=0.25, metal=0.0)

        skin = rig.bind(body.part(self.rings, self.around))
        centre, outward = body.on_side(s, h)
        outward = unit(outward + [0.25, 0.0, 0.12])  # eyes look a little more sideways and ahead than the skin
        left = eye_part(centre - outward * 0.18 * r * body.length, outward, r * body.length)
        eyes = rig.bind(join([left, mirrored(left)]))
        eyes.joints[:], eyes.weights[:] = 0, [1, 0, 0, 0]
        sheets = join([rig.bind_fin(p, f.joint) for f in self.fins for p in f.parts()])

        nodes, skin_index = rig.add_nodes(glb)
        primitives = [glb.primitive(skin, skin_material), glb.primitive(eyes, eye_material, False)]
        extras = [rig.bind(part) for part, _ in self.extra_parts]
        primitives += [glb.primitive(part, glb.material(**look), False)
                       for part, (_, look) in zip(extras, self.extra_parts)]
        primitives.append(glb.primitive(sheets, fin_material))
        mesh = glb.mesh(self.name, primitives)
        glb.node(self.name, mesh=mesh, skin=skin_index)
        for clip in self.clips:
            add_clip(glb, rig, nodes, **clip)
        size = glb.save(path)
        return size, sum(len(p.triangles) for p in (skin, eyes, sheets, *extras))


def with_mirror(fin):
    """The fin and its twin on the right side; their joints are pectoral_left and pectoral_right."""
    twin = Fin(**{**fin.__dict__, 'mirror': True,
                  'joint': fin.joint.replace('left', 'right') if fin.joint else ''})
    return [fin, twin]
