"""Fins: lenses of two skins that meet at the edge, spanned by rays that leave a root line on the body."""

from dataclasses import dataclass
from typing import Callable

import numpy as np

import paint
from mesh import Curve, Part, facing, grid_triangles, join, mirrored, tangent_frame, unit, without_slivers


@dataclass
class Fin:
    """Rays leave the root line at `direction`, each `length` long; a runs along the root, b outwards, both 0..1."""
    name: str
    root: np.ndarray         # k x 3, metres, model frame
    direction: np.ndarray    # k x 3, unit
    length: np.ndarray       # k, metres
    tile: tuple              # rectangle of the picture: u, v, width, height in 0..1
    paint: Callable          # (a, b) -> colour, alpha, height in metres
    thickness: float         # half, metres, at the thickest of the root
    flesh: float = 0.0       # metres from the root over which it lies on the body's skin and fades in
    bend: tuple = (0, 0, 0)  # where tips drift, metres at b = 1, grows with b^2
    ripple: float = 0.0      # waves in the membrane, metres at b = 1
    waves: float = 3.0
    foil: str = 'blade'      # across the root: blade (even), lens (as a round tail root), wing (blunt in front)
    joint: str = ''          # the joint that swings it, if it has one
    columns: int = 12
    rows: int = 5
    mirror: bool = False
    under: tuple = None      # another tile for the lower skin, painted by paint_under
    paint_under: Callable = None

    def surface(self):
        """The middle surface, rows x columns x 3, with a and b, denser in b near the root."""
        a, b = np.linspace(0, 1, self.columns), np.linspace(0, 1, self.rows) ** 1.25
        at = np.linspace(0, 1, len(self.root))

        def along(values):
            return np.stack([np.interp(a, at, np.asarray(values)[:, i]) for i in range(3)], -1)
        length = np.interp(a, at, self.length)
        p = along(self.root)[None] + unit(along(self.direction))[None] * (length * b[:, None])[..., None]
        drift = (b * b)[:, None] * (length / max(length.max(), 1e-9))[None]
        return p + np.asarray(self.bend) * drift[..., None], a, b

    def part(self):
        """Both skins; part.reach holds b of each vertex."""
        p, a, b = self.surface()
        n, sound = grid_normals(p)
        if self.ripple:
            wave = b[:, None] * np.sin(a * self.waves * 2 * np.pi + 0.7)
            p = p + n * (self.ripple * wave)[..., None]
            n, sound = grid_normals(p)
        foil = {'blade': np.minimum(1, 8 * np.minimum(a, 1 - a)), 'lens': np.sqrt(4 * a * (1 - a)),
                'wing': np.sqrt(4 * a * (1 - a)) * (1.35 - 0.7 * a)}[self.foil]
        t = self.thickness * foil[None, :] * ((1 - b) ** 1.4)[:, None]
        uv = np.stack(np.broadcast_arrays(a[None, :], b[:, None]), -1)
        skins = []
        for sign in (1.0, -1.0):
            q = p + n * (sign * t)[..., None]
            m, _ = grid_normals(q)
            m = np.where(sound[..., None], m, n) * sign
            if self.foil == 'wing':  # a rounded leading edge: both skins meet there in its direction
                m[:, 0] = unit(m[:, 0] - 1.2 * unit(np.gradient(q, axis=1)[:, 0]))
            below = self.under and n[..., 1].mean() * sign < 0
            tile = np.array(self.under if below else self.tile)
            skins.append(facing(Part(
                q.reshape(-1, 3), m.reshape(-1, 3),
                tangent_frame(m, np.gradient(q, axis=1), -np.gradient(q, axis=0)).reshape(-1, 4),
                (tile[:2] + tile[2:] * uv).reshape(-1, 2), grid_triangles(self.rows, self.columns, flip=sign > 0))))
        whole = without_slivers(join(skins))
        whole = mirrored(whole) if self.mirror else whole
        whole.reach = np.tile(np.repeat(b, self.columns), 2)
        return whole


def grid_normals(p):
    """Unit normals of a grid of points, and where it has area; elsewhere the mean normal stands in."""
    n = np.cross(np.gradient(p, axis=1), np.gradient(p, axis=0))
    sound = np.linalg.norm(n, axis=-1) > 1e-12
    return np.where(sound[..., None], unit(n), unit(n[sound].mean(0))), sound


def with_mirror(fin):
    """The fin and its twin on the right side; their joints are named ..._left and ..._right."""
    return [fin, Fin(**{**fin.__dict__, 'mirror': True, 'joint': fin.joint.replace('left', 'right')})]


def median_fin(body, name, which, s0, s1, lengths, leans, tile, sink=0.012, thickness=0.006, **more):
    """A fin along the back ('upper') or belly ('lower'); lean: radians towards the tail."""
    a = np.linspace(0, 1, 65)
    s = s0 + (s1 - s0) * a
    sign = 1.0 if which == 'upper' else -1.0
    y = body.profile(which, s) - sign * sink
    root = np.stack([0 * a, y, 0.5 - s], -1) * body.length
    lean = Curve(leans)(a)
    direction = np.stack([0 * a, sign * np.cos(lean), -np.sin(lean)], -1)
    return Fin(name, root, direction, (Curve(lengths)(a) + sink) * body.length, tile,
               thickness=thickness * body.length, **more)


def tail_fin(body, lengths, spread, tile, overlap=0.035, turn=0.0, thickness=None, foil='lens', reach=1.0, **more):
    """The tail: rays fan from +spread (a = 0, upper) to -spread; lengths over a; the longest ends at s = reach before it is bent.
    Its lens starts `overlap` before the body's end, just outside of the body, so that one flows into the other."""
    a = np.linspace(0, 1, 65)
    s = body.end - overlap
    top, bottom = body.profile('upper', s), body.profile('lower', s)
    root = np.stack([0 * a, top + (bottom - top) * a, 0.5 - s + 0 * a], -1) * body.length
    angle = (spread * (1 - 2 * a) * (0.75 + 0.25 * np.abs(1 - 2 * a))) + turn
    direction = np.stack([0 * a, np.sin(angle), -np.cos(angle)], -1)
    long = Curve(lengths)(a) + overlap
    long = long * (reach - s) / np.max(long * np.cos(angle))
    if thickness is None:
        thickness = float(body.profile('width', s)) * 1.10
    return Fin('tail', root, direction, long * body.length, tile, thickness=thickness * body.length, foil=foil,
               flesh=overlap * body.length, **more)


def paired_fin(body, name, s, heights, lengths, first, last, tile, sink=0.006, slant=0.0, thickness=0.005, **more):
    """A pectoral or pelvic fin of the left side: root from heights[0] to heights[1] at s, slanting back by `slant`;
    ray directions turn from `first` to `last`."""
    a = np.linspace(0, 1, 33)
    root = np.stack([body.on_side(s + slant * t, heights[0] + (heights[1] - heights[0]) * t)[0] for t in a])
    outward = body.on_side(s, np.mean(heights))[1]
    root = root - outward * sink * body.length
    direction = unit(unit(first)[None] * (1 - a)[:, None] + unit(last)[None] * a[:, None])
    return Fin(name, root, direction, (Curve(lengths)(a) + sink) * body.length, tile,
               thickness=thickness * body.length, **more)


# ---------------------------------------------------------------- their pictures

def ray_picture(a, b, rays, width=0.16, spiny=0.0, seed=3):
    """1 on a fin ray, 0 between rays. Soft rays split in two beyond b = 0.4; spines (a < spiny) do not."""
    r = a * rays
    wobble = 0.05 * paint.noise(seed, r * 0.7, b * 3)
    f = (r + wobble) % 1.0 - 0.5
    soft = a > spiny
    fork = np.where(soft, np.clip((b - 0.4) * 0.42, 0, 0.24), 0)
    d = np.minimum(np.abs(f - fork), np.abs(f + fork))
    w = width * np.where(soft, 1 - 0.45 * b, 1.25 - 0.8 * b)
    lines = 1 - paint.step(w * 0.5, w * 1.3, d)
    joints = 0.90 + 0.10 * np.sign(np.sin(b * 90 + np.floor(r) * 2.4))
    return lines * np.where(soft & (b > 0.2), joints, 1.0)


def edge_alpha(a, b, rays, spiny=0.0, scallop=0.10, ragged=0.012, seed=9):
    """1 inside the fin, 0 beyond its edge, which dips between spines and frays between rays."""
    f = np.abs((a * rays) % 1.0 - 0.5) * 2  # 0 on a ray
    spine = paint.step(spiny + 0.02, spiny - 0.02, a) if spiny else 0.0
    tatter = f + 0.8 * paint.noise(seed, a * rays * 1.7) + 1.6 * np.maximum(paint.noise(seed + 1, a * rays * 0.31), 0)
    edge = 0.965 - spine * scallop * f ** 1.5 - (1 - spine) * ragged * tatter
    return 1 - paint.step(edge - 0.025, edge + 0.005, b)


def membrane(a, b, rays, spiny=0.0, clear=0.4, dense=0.92, seed=1, scallop=0.10, ragged=0.012):
    """Rays 0..1 and alpha: the skin between rays lets through 1 - clear, more towards its edge."""
    ray = ray_picture(a, b, rays, spiny=spiny, seed=seed)
    between = clear * (1 - 0.35 * paint.step(0.4, 1, b)) * (1 + 0.25 * paint.noise(seed + 2, a * rays * 2, b * 9))
    alpha = (between + (dense - between) * ray) * edge_alpha(a, b, rays, spiny, scallop, ragged, seed + 6)
    return ray, np.clip(np.maximum(alpha, paint.step(0.10, 0.02, b)), 0, 1)


def fin_pictures(fins, width, height, picture, relief):
    """Paints every fin's tiles into an RGBA picture and a normal map of the same size, in place."""
    painted = set()
    tiles = [(fin, fin.tile, fin.paint) for fin in fins]
    tiles += [(fin, fin.under, fin.paint_under) for fin in fins if fin.under]
    for fin, tile, painter in tiles:
        if tile in painted:
            continue
        painted.add(tile)
        x, y, w, h = tile
        pad = 3
        x0, y0 = max(int(round(x * width)) - pad, 0), max(int(round(y * height)) - pad, 0)
        x1, y1 = int(round((x + w) * width)) + pad, int(round((y + h) * height)) + pad
        px, py = np.meshgrid(np.arange(x0, min(x1, width)), np.arange(y0, min(y1, height)))
        a = ((px + 0.5) / width - x) / w
        b = ((py + 0.5) / height - y) / h
        a, b = np.clip(a, 0, 1), np.clip(b, 0, 1)
        colour, alpha, bumps = painter(a, b)
        if fin.flesh:
            out = b * np.interp(a, np.linspace(0, 1, len(fin.length)), fin.length) / fin.flesh
            out = out + 0.14 * np.sin(a * 160) + 0.2 * paint.noise(7, a * 40, b * 9)
            alpha = np.maximum(alpha, paint.step(2.2, 1.2, out)) * paint.step(0.25, 1.0, out)
        picture[py, px] = np.concatenate([colour, alpha[..., None]], -1)
        span = np.linalg.norm(np.diff(fin.root, axis=0), axis=1).sum() + 0.5 * fin.length.mean()
        relief[py, px] = paint.normal_map(bumps, span / (w * width), fin.length.mean() / (h * height))
