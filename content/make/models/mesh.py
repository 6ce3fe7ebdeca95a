"""Triangle meshes as arrays, and the vector arithmetic that shaping them needs."""

from dataclasses import dataclass
from typing import Optional

import numpy as np


@dataclass
class Part:
    """The geometry of one glTF primitive: n vertices, m triangles, counter-clockwise seen from outside."""
    positions: np.ndarray                    # n x 3, metres
    normals: np.ndarray                      # n x 3
    tangents: np.ndarray                     # n x 4
    uvs: Optional[np.ndarray]                # n x 2
    triangles: np.ndarray                    # m x 3
    joints: Optional[np.ndarray] = None      # n x 4
    weights: Optional[np.ndarray] = None     # n x 4


def unit(v):
    v = np.asarray(v, float)
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-12)


def tangent_frame(normals, along, up):
    """glTF tangents: `along` is where u grows, `up` where v shrinks; both n x 3."""
    t = along - normals * np.sum(normals * along, -1, keepdims=True)
    bad = np.linalg.norm(t, axis=-1) < 1e-9
    spare = np.where(np.abs(normals[..., :1]) < 0.9, [1.0, 0, 0], [0, 1.0, 0])
    t = np.where(bad[..., None], np.cross(normals, spare), t)
    t = unit(t)
    w = np.where(np.sum(np.cross(normals, t) * up, -1, keepdims=True) < 0, -1.0, 1.0)
    return np.concatenate([t, w], -1)


def grid_triangles(rows, columns, flip=False):
    """Two triangles for each cell of a rows x columns grid of vertices, row after row."""
    i = np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)[None, :]
    a, b, c, d = i, i + 1, i + columns, i + columns + 1
    t = np.stack([np.stack([a, c, b], -1), np.stack([b, c, d], -1)], 2).reshape(-1, 3)
    return t[:, ::-1] if flip else t


def join(parts):
    parts = list(parts)
    offsets = np.cumsum([0] + [len(p.positions) for p in parts[:-1]])

    def gather(name):
        rows = [getattr(p, name) for p in parts]
        return None if rows[0] is None else np.concatenate(rows)
    return Part(gather('positions'), gather('normals'), gather('tangents'), gather('uvs'),
                np.concatenate([p.triangles + o for p, o in zip(parts, offsets)]),
                gather('joints'), gather('weights'))


def without_slivers(part):
    """Drops triangles without area, which the poles of a grid leave behind."""
    p = part.positions[part.triangles]
    area = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    part.triangles = part.triangles[area > 1e-10]
    return part


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


def strongest_four(weights):
    """n x joints of weights -> (n x 4 joint indices, n x 4 weights that sum to one)."""
    order = np.argsort(-weights, axis=1, kind='stable')[:, :4]
    w = np.take_along_axis(weights, order, 1)
    w = np.where(w < 0.004, 0.0, w)
    w = (w / w.sum(1, keepdims=True)).astype('<f4')
    w[:, 0] = np.float32(1) - w[:, 1:].sum(1)
    return np.where(w > 0, order, 0), w


def quaternion(axis, angle):
    """x y z w; angle may be an array."""
    angle = np.asarray(angle, float)[..., None]
    return np.concatenate([unit(axis) * np.sin(angle / 2), np.cos(angle / 2)], -1)


def quaternion_product(a, b):
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    return np.concatenate([aw * bv + bw * av + np.cross(av, bv),
                           aw * bw - np.sum(av * bv, -1, keepdims=True)], -1)


class Curve:
    """A monotone cubic through points (Fritsch and Carlson 1980): no overshoot between them."""

    def __init__(self, points):
        points = np.asarray(points, float)
        self.x, self.y = points[:, 0], points[:, 1]
        h = np.diff(self.x)
        slope = np.diff(self.y) / h
        d = np.zeros_like(self.y)
        d[0], d[-1] = slope[0], slope[-1]
        same = slope[:-1] * slope[1:] > 0
        w1, w2 = 2 * h[1:] + h[:-1], h[1:] + 2 * h[:-1]
        with np.errstate(divide='ignore', invalid='ignore'):
            d[1:-1] = np.where(same, (w1 + w2) / (w1 / slope[:-1] + w2 / slope[1:]), 0)
        self.d = d

    def __call__(self, x):
        x = np.clip(np.asarray(x, float), self.x[0], self.x[-1])
        i = np.clip(np.searchsorted(self.x, x, side='right') - 1, 0, len(self.x) - 2)
        h = self.x[i + 1] - self.x[i]
        t = (x - self.x[i]) / h
        return ((1 + 2 * t) * (1 - t) ** 2 * self.y[i] + t * (1 - t) ** 2 * h * self.d[i]
                + t * t * (3 - 2 * t) * self.y[i + 1] + t * t * (t - 1) * h * self.d[i + 1])
