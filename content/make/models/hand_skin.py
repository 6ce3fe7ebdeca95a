"""The skin of a hand, painted in space (right hand's rest pose): colour, relief and gloss at any point."""

import numpy as np

import paint
from hand_shape import FINGERS
from mesh import unit
from paint import bump, line, mix, rgb, step


def rounded(points, times=3):
    """Cuts the corners of a polyline (Chaikin 1974)."""
    for _ in range(times):
        a, b = points[:-1], points[1:]
        points = np.concatenate([points[:1], np.stack([0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b], 1).reshape(-1, 2),
                                 points[-1:]])
    return points


class HandSkin:
    def __init__(self, hand):
        self.hand = hand

    def along(self, finger, p):
        """For each bone from the proximal one on: (local coordinates, length, radius, weight 0..1 that p lies on it)."""
        hand, out = self.hand, []
        chain = hand.chain(finger)
        first = 1
        for k in range(first, len(chain) - 1):
            i, j = chain[k], chain[k + 1]
            q = hand.local(hand.names[i], p)
            length = np.linalg.norm(hand.positions[j] - hand.positions[i])
            r = 0.5 * (hand.radii[i] + hand.radii[j])
            lateral = np.hypot(q[:, 0], q[:, 1])
            near = step(2.1 * r, 1.45 * r, lateral)
            out.append((q, length, hand.radii[i], near))
        return out

    def nail(self, finger, p):
        """Coordinates on the nail: across -1..1, along 0 (root) .. 1 (free edge), and 1 where p is on its side."""
        chain = self.hand.chain(finger)
        name = self.hand.names[chain[-2]]
        q = self.hand.local(name, p)
        length = np.linalg.norm(self.hand.positions[chain[-1]] - self.hand.positions[chain[-2]])
        r = self.hand.radii[chain[-1]]
        z0, z1 = 0.50 * length, length + 0.62 * r
        along = (-q[:, 2] - z0) / (z1 - z0)
        width = r * (0.80 if finger != 'thumb' else 0.86)
        across = q[:, 0] / width
        return across, along, step(0.10 * r, 0.35 * r, q[:, 1]), (z1 - z0), width

    def nail_inside(self, finger, p):
        """Metres inside (+) the nail's outline, and its coordinates."""
        across, along, up, long, width = self.nail(finger, p)
        root = along - 0.16 * across ** 2 * 0 - 0.10 * (1 - np.sqrt(np.clip(1 - across ** 2, 0, 1)))
        tip = 1.0 - 0.20 * across ** 2 - along
        inside = np.minimum(np.minimum(root * long, tip * long), (1 - np.abs(across)) * width)
        return np.where(up > 0.5, inside, -1.0), across, along

    def creases(self, p, n_up):
        """Depth 0..1 of lines where the skin folds. n_up: how much the skin faces the back of the hand."""
        palm, back = step(0.15, -0.35, n_up), step(0.0, 0.5, n_up)
        total = np.zeros(len(p))
        wob = 0.0006 * paint.noise(81, *(p.T * 180))
        for finger in FINGERS:
            bones = self.along(finger, p)
            for k, (q, length, r, near) in enumerate(bones):
                z = q[:, 2] + wob + 0.10 * np.abs(q[:, 0]) ** 1.3
                if k > 0 or finger == 'thumb':  # palm side: one deep and one light fold at the joint
                    total = np.maximum(total, near * palm * (0.9 * bump(z, 0.00055) + 0.5 * bump(z + 0.0021, 0.0004)
                                                             + 0.35 * bump(z - 0.0019, 0.0004)))
                else:  # where the finger meets the palm
                    total = np.maximum(total, near * palm * 0.7 * bump(z + 0.43 * length, 0.0006))
                if k > 0:  # wrinkles over the knuckle
                    spread = 1.0 if k == 1 else 0.6
                    waves = paint.noise(83, q[:, 2] * 950 + 0.8 * paint.noise(84, *(p.T * 260)), q[:, 0] * 70)
                    bow = bump(q[:, 2] - 0.002, 0.0048 * spread) * bump(q[:, 0], r * 0.8)
                    total = np.maximum(total, near * back * bow * 0.75 * step(0.05, 0.55, waves))
        # the lines of the palm, as polylines in x, z
        lines = (((-0.030, -0.080), (-0.020, -0.070), (-0.006, -0.060), (0.012, -0.053), (0.026, -0.046)),  # head
                 ((-0.016, -0.094), (-0.008, -0.082), (0.008, -0.074), (0.024, -0.068), (0.036, -0.066)),   # heart
                 ((-0.032, -0.076), (-0.018, -0.064), (-0.008, -0.048), (-0.005, -0.030), (-0.010, -0.012)),  # life
                 ((-0.024, 0.004), (-0.008, 0.001), (0.008, 0.001), (0.024, 0.004)),   # the wrist
                 ((-0.022, 0.010), (-0.006, 0.0075), (0.010, 0.0075), (0.022, 0.010)))
        flat = p[:, [0, 2]] + 0.0012 * np.stack([paint.noise(85, *(p.T * 110)), paint.noise(86, *(p.T * 110))], -1)
        for k, points in enumerate(lines):
            d = np.full(len(p), 1.0)
            points = rounded(np.array(points))
            for a, b in zip(points[:-1], points[1:]):
                t = np.clip((flat - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
                d = np.minimum(d, np.linalg.norm(flat - a - t[:, None] * (b - a), axis=1))
            total = np.maximum(total, palm * (0.75 if k < 3 else 0.5) * bump(d, 0.0007))
        return total * (0.72 + 0.4 * paint.noise(87, *(p.T * 130)))

    def relief(self, p, n_up):
        """Metres above the smooth solid."""
        x, y, z = p.T
        back = step(0.0, 0.5, n_up)
        h = -0.00034 * self.creases(p, n_up)
        # fine net of skin lines and pores
        a = paint.noise(91, x * 1300, y * 1300, z * 900) + 0.6 * paint.noise(92, x * 2300, y * 2300, z * 2300)
        h = h + 0.000030 * a + 0.00006 * paint.fbm(93, x * 330, y * 330, z * 330, octaves=2)
        # sinews and veins of the back
        hand = self.hand
        for finger in FINGERS[1:]:
            head, base = hand.at(f'{finger}_proximal'), hand.at('wrist') * 0.5 + hand.at(f'{finger}_metacarpal') * 0.5
            t = np.clip((z - base[2]) / (head[2] - base[2]), 0, 1)
            d = x - (base[0] + (head[0] - base[0]) * t)
            h = h + 0.00045 * back * bump(d, 0.0022) * step(0.1, 0.5, t) * step(1.04, 0.93, (z - base[2]) / (head[2] - base[2]))
        h = h + 0.00028 * back * self.veins(p)
        for finger in FINGERS:
            inside, across, along = self.nail_inside(finger, p)
            plate = step(-0.0002, 0.0003, inside)
            h = h * (1 - plate) + plate * (0.00012 + 0.00001 * np.sin(across * 40)) \
                - 0.00030 * bump(inside + 0.0002, 0.00035)
            wall = step(-0.0022, -0.0006, inside) * (1 - plate)
            h = h + 0.00030 * wall
        return h

    def veins(self, p):
        x, y, z = p.T
        bend = 0.0045 * paint.noise(95, x * 28, z * 34)
        total = np.zeros(len(p))
        for x0, slope in ((-0.013, 0.10), (0.004, -0.12), (0.017, 0.14)):
            total = np.maximum(total, bump(x + bend - x0 - slope * (z + 0.055), 0.0016))
        return total * step(-0.095, -0.080, z) * step(0.035, 0.0, z)

    def colour(self, p, n_up):
        x, y, z = p.T
        palm = step(0.25, -0.45, n_up)
        c = mix(rgb('#c9967a'), rgb('#dba88f'), palm)
        large = paint.fbm(101, x * 60, y * 60, z * 60, octaves=3)
        small = paint.fbm(102, x * 330, y * 330, z * 330, octaves=3)
        c = c * (1 + 0.07 * large[:, None] * np.array([0.6, 1.0, 1.1]) + 0.055 * small[:, None] * np.array([0.5, 1, 1]))
        red = np.zeros(len(p))
        hand = self.hand
        for finger in FINGERS:
            chain = hand.chain(finger)
            tip = hand.positions[chain[-1]]
            d = np.linalg.norm(p - tip, axis=1)
            red = np.maximum(red, 0.75 * step(0.022, 0.004, d))
            for k in chain[1:-1]:
                d = np.linalg.norm(p - hand.positions[k], axis=1) / hand.radii[k]
                red = np.maximum(red, (0.55 * step(0.0, 0.5, n_up) + 0.20 * palm) * step(2.0, 0.9, d))
        for centre, size in (((-0.030, -0.02, -0.035), 0.030), ((0.026, -0.02, -0.035), 0.028), ((0.004, -0.016, -0.086), 0.022)):
            red = np.maximum(red, 0.50 * palm * step(size, size * 0.3, np.linalg.norm(p - np.array(centre), axis=1)))
        blotch = 0.75 + 0.5 * paint.fbm(103, x * 140, y * 140, z * 140, octaves=3)
        c = mix(c, rgb('#c4705f'), 0.62 * np.clip(red * blotch, 0, 1))
        c = mix(c, rgb('#8a8f8c'), 0.20 * step(0.0, 0.5, n_up) * self.veins(p))
        fold = self.creases(p, n_up)
        c = mix(c, rgb('#8d4d3c'), 0.42 * np.clip(fold, 0, 1))
        speck = paint.noise(104, x * 420, y * 420, z * 420)
        c = mix(c, rgb('#9b6448'), 0.20 * step(0.55, 0.85, speck) * step(0.0, 0.5, n_up))
        for finger in FINGERS:
            inside, across, along = self.nail_inside(finger, p)
            c = mix(c, rgb('#a3584c'), 0.50 * bump(inside + 0.0001, 0.0006))
            nail = mix(rgb('#dc9f92'), rgb('#e5b3a6'), step(0.3, 0.9, along))
            moon = along - 0.20 + 0.30 * across ** 2
            nail = mix(nail, rgb('#ecd0c4'), 0.7 * step(0.03, -0.03, moon))
            nail = mix(nail, rgb('#eee3d2'), 0.9 * step(0.885, 0.915, along + 0.10 * across ** 2))
            nail = nail * (1 + 0.02 * np.sin(across * 34))[:, None]
            c = mix(c, nail, step(0.0, 0.0004, inside))
        return c

    def rough(self, p, n_up):
        r = 0.50 + 0.03 * paint.fbm(105, *(p.T * 250), octaves=2) + 0.04 * step(0.2, -0.4, n_up)
        for finger in FINGERS:
            inside = self.nail_inside(finger, p)[0]
            r = mix(r, 0.34, step(0.0, 0.0005, inside))
        return r


def pictures(skin, points, normals, u_axis, up_axis, mask):
    """Colour, normal map and roughness of the texels whose points (h x w x 3) lie under mask."""
    p, n = points[mask], unit(normals[mask])
    up = n @ np.array([0.0, 1.0, 0.0])
    colour = np.ones(points.shape) * rgb('#c99a80')
    colour[mask] = skin.colour(p, up)
    e = 1.2e-4
    here = skin.relief(p, up)
    t = unit(u_axis[mask] - n * (u_axis[mask] * n).sum(1, keepdims=True))
    b = np.cross(n, t)
    b = b * np.sign((b * up_axis[mask]).sum(1, keepdims=True))
    slope = np.stack([-(skin.relief(p + e * t, up) - here) / e, -(skin.relief(p + e * b, up) - here) / e,
                      np.ones(len(p))], -1)
    normal = np.ones(points.shape) * [0.5, 0.5, 1.0]
    normal[mask] = unit(slope) * 0.5 + 0.5
    metal_rough = np.ones(points.shape) * [1, 0.5, 0]
    metal_rough[mask, 1] = skin.rough(p, up)
    return colour, normal, metal_rough
