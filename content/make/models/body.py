"""A fish's body from measurements: rings of rounded cross-sections around the spine, and where paint goes on it.

Measurements are fractions of the whole length: s runs from the snout (0) to the tip of the tail (1), heights
are above (+) or below (-) the snout's axis. Model frame: facing +Z, +Y up, origin at half length, metres.
"""

from dataclasses import dataclass

import numpy as np

import paint
from mesh import Curve, Part, facing, grid_triangles, join, mirrored, tangent_frame, unit, without_slivers

SNOUT_ROUNDNESS = 0.25  # how much of the texture's width the head gets: s ~ U^2 below this, ~ U above


def smoothed(values, passes):
    v = values.copy()
    for _ in range(passes):
        v[1:-1] = 0.25 * v[:-2] + 0.5 * v[1:-1] + 0.25 * v[2:]
    return v


class Body:
    """The surface P(U, V): U from the snout (0) to the root of the tail fin (1), V from back (0) to belly (1)."""

    def __init__(self, length, end, upper, lower, width, widest, keel=1.0, boxy=((0, 2), (1, 2)), displace=None):
        self.length, self.end, self.keel = length, end, keel
        self.displace = displace or (lambda s, h, v: 0.0)
        self.roots = np.linspace(0, 1, 600)

        def table(points):
            return smoothed(Curve([(np.sqrt(s / end), y) for s, y in points])(self.roots), 60)
        self.tables = [table(p) for p in (upper, lower, width, widest)]
        self.boxy = Curve(boxy)  # exponent of the cross-section: 2 an ellipse, more a box with rounded edges

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
        p = self.boxy(s)
        reach = (np.abs(c) ** p + n ** p) ** (-1 / p)
        c, n = c * reach, n * reach
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

    @property
    def arc(self):
        """Way around the body from the middle of its side, + towards the belly, in fractions of the length."""
        way = np.cumsum(self.texel_v, axis=0) / self.body.length
        return way - way[len(way) // 2]

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
        for back in (-2, -1, 0, 1, 2):  # from front to back: the foremost scale that covers a texel is on top
            c = column + back
            shift = (c % 2) * 0.5
            row = np.round(b - shift).astype(int)
            jitter = (paint.scatter(seed + 3, c, row) - 0.5) * 0.16
            da, db = a - (c + jitter), (b - shift - row) / 0.62
            inside = (da / 1.25) ** 2 + db ** 2
            hit = (inside < 1) & (da > -0.2) & ~done
            local = np.sqrt(np.clip(inside, 0, 1))
            relief = np.where(hit, np.clip(da / 1.25, 0, 1) * 0.75 + 0.25 * (1 - db ** 2), relief)
            edge = np.where(hit, paint.step(0.74, 0.98, local), edge)
            which = np.where(hit, paint.scatter(seed, c, row), which)
            done |= hit
        return relief, edge, which
