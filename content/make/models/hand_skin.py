"""The skin of a hand, painted in space (right hand's rest pose): colour, relief and gloss at any point."""

from dataclasses import dataclass

import numpy as np

import paint
from hand_shape import FINGERS
from paint import bump, mix, rgb, step


@dataclass(frozen=True)
class Tone:
    """A complexion: the back, the palm, where blood shows, folds, veins, specks, and the nails."""
    back: str
    palm: str
    flush: str
    fold: str
    vein: str
    speck: str
    nail: str
    moon: str


TONES = {
    'light': Tone('#d8ab94', '#e4b9a6', '#cc7867', '#9a5848', '#9a9c9c', '#a8735a', '#e2a99c', '#f0d6cc'),
    'medium': Tone('#a9764f', '#cf9f7e', '#9c553c', '#6a3c28', '#7f6a58', '#7c4c30', '#cf9a84', '#e6c3b0'),
    'dark': Tone('#5a3827', '#a5775e', '#63342a', '#331d15', '#4a3328', '#3c2318', '#b28270', '#cda592')}


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
        root = along - 0.10 * (1 - np.sqrt(np.clip(1 - across ** 2, 0, 1)))
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
        h = -0.00050 * self.creases(p, n_up)
        # fine net of skin lines and pores
        a = paint.noise(91, x * 1300, y * 1300, z * 900) + 0.6 * paint.noise(92, x * 2300, y * 2300, z * 2300)
        h = h + 0.000050 * a + 0.00011 * paint.fbm(93, x * 330, y * 330, z * 330, octaves=2)
        # sinews and veins of the back
        hand = self.hand
        for finger in FINGERS[1:]:
            head, base = hand.at(f'{finger}_proximal'), hand.at('wrist') * 0.5 + hand.at(f'{finger}_metacarpal') * 0.5
            t = np.clip((z - base[2]) / (head[2] - base[2]), 0, 1)
            d = x - (base[0] + (head[0] - base[0]) * t)
            h = h + 0.00060 * back * bump(d, 0.0022) * step(0.1, 0.5, t) * step(1.04, 0.93, (z - base[2]) / (head[2] - base[2]))
        h = h + 0.00038 * back * self.veins(p)
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

    def flush(self, p, n_up):
        """How much blood shows, 0..1: fingertips, knuckles, the heels of the palm."""
        palm, red, hand = step(0.25, -0.45, n_up), np.zeros(len(p)), self.hand
        for finger in FINGERS:
            chain = hand.chain(finger)
            d = np.linalg.norm(p - hand.positions[chain[-1]], axis=1)
            red = np.maximum(red, 0.75 * step(0.022, 0.004, d))
            for k in chain[1:-1]:
                d = np.linalg.norm(p - hand.positions[k], axis=1) / hand.radii[k]
                red = np.maximum(red, (0.55 * step(0.0, 0.5, n_up) + 0.20 * palm) * step(2.0, 0.9, d))
        for centre, size in (((-0.030, -0.02, -0.035), 0.030), ((0.026, -0.02, -0.035), 0.028), ((0.004, -0.016, -0.086), 0.022)):
            red = np.maximum(red, 0.50 * palm * step(size, size * 0.3, np.linalg.norm(p - np.array(centre), axis=1)))
        return red * (0.75 + 0.5 * paint.fbm(103, *(p.T * 140), octaves=3))

    def colours(self, p, n_up):
        """Returns the skin's colours at p, by the names of the tones."""
        x, y, z = p.T
        palm, back = step(0.25, -0.45, n_up), step(0.0, 0.5, n_up)
        large = paint.fbm(101, x * 60, y * 60, z * 60, octaves=3)
        small = paint.fbm(102, x * 330, y * 330, z * 330, octaves=3)
        uneven = 1 + 0.07 * large[:, None] * np.array([0.6, 1.0, 1.1]) + 0.055 * small[:, None] * np.array([0.5, 1, 1])
        red, veins, folds = self.flush(p, n_up), self.veins(p), np.clip(self.creases(p, n_up), 0, 1)
        speck = step(0.55, 0.85, paint.noise(104, x * 420, y * 420, z * 420)) * back
        nails = [self.nail_inside(finger, p) for finger in FINGERS]
        out = {}
        for name, tone in TONES.items():
            c = mix(rgb(tone.back), rgb(tone.palm), palm) * uneven
            c = mix(c, rgb(tone.flush), 0.60 * np.clip(red, 0, 1))
            c = mix(c, rgb(tone.vein), 0.17 * back * veins)
            c = mix(c, rgb(tone.fold), 0.50 * folds)
            c = mix(c, rgb(tone.speck), 0.20 * speck)
            for inside, across, along in nails:
                c = mix(c, rgb(tone.fold), 0.40 * bump(inside + 0.0001, 0.0006))
                nail = rgb(tone.nail) * (0.97 + 0.05 * step(0.3, 0.9, along))[:, None]
                nail = mix(nail, rgb(tone.moon), 0.6 * step(0.03, -0.03, along - 0.20 + 0.30 * across ** 2))
                nail = mix(nail, rgb('#eee3d2'), 0.85 * step(0.885, 0.915, along + 0.10 * across ** 2))
                c = mix(c, nail * (1 + 0.02 * np.sin(across * 34))[:, None], step(0.0, 0.0004, inside))
            out[name] = c
        return out

    def rough(self, p, n_up):
        r = 0.50 + 0.03 * paint.fbm(105, *(p.T * 250), octaves=2) + 0.04 * step(0.2, -0.4, n_up)
        for finger in FINGERS:
            inside = self.nail_inside(finger, p)[0]
            r = mix(r, 0.34, step(0.0, 0.0005, inside))
        return r
