"""Parts of the skins of all fish: countershading, scales, gill cover, mouth, lateral line."""

import numpy as np

import paint
from mesh import Curve
from paint import bump, line, mix, rgb, step


class Skin:
    """Colour (sRGB), relief (metres), roughness and metal of one side, painted layer by layer."""

    def __init__(self, body, width=512, height=432):
        self.at = body.canvas(width, height)
        self.length = body.length
        shape = self.at.u.shape
        self.colour = np.ones(shape + (3,)) * 0.5
        self.height = np.zeros(shape)
        self.rough = np.full(shape, 0.42)
        self.metal = np.zeros(shape)

    def tint(self, colour, mask):
        colour = rgb(colour) if isinstance(colour, str) else colour
        self.colour = mix(self.colour, colour, np.clip(mask, 0, 1))

    def shade(self, factor, mask=1.0):
        self.colour = self.colour * (1 + (np.asarray(factor) - 1) * mask)[..., None]

    def curve(self, points):
        """Signed distance (fractions of the length, + behind) from a line s(h) given as (h, s) points."""
        return self.at.s - Curve(sorted(points))(self.at.h)

    def scales(self, rows, relief, mask, edge=0.12, variety=0.10, metal=0.25, seed=1):
        rise, rim, which = self.at.scales(rows, seed)
        self.height += relief * rise * mask
        self.shade(1 - edge * rim + variety * (which - 0.5), mask)
        self.metal += metal * (1 - 0.6 * rim) * mask * (0.6 + 0.4 * which)
        self.rough += (-0.05 + 0.06 * which + 0.05 * rim) * mask

    def gill(self, points, dark=0.45, width=0.0035, relief=0.004):
        """The hind edge of the gill cover along s(h): a step down, with a shadow behind it."""
        d = self.curve(points)
        low, high = min(p[0] for p in points), max(p[0] for p in points)
        span = step(low, low + 0.03, self.at.h) * step(high, high - 0.03, self.at.h)
        self.height += relief * self.length * step(-0.05, 0.0, d) * step(0.004, -0.001, d) * span
        uneven = 0.75 + 0.35 * paint.fbm(17, self.at.h * 30, self.at.s * 20, octaves=2)
        self.shade(1 - dark, step(-0.0015, 0.001, d) * step(width * 2.6, 0, d) * span * uneven)
        self.shade(1 - 0.35 * dark, step(0, 0.002, d) * step(width * 9, 0, d) * span)
        self.shade(1 + 0.25 * dark, bump(d + 0.006, 0.005) * span)  # the rim catches light

    def mouth(self, corner, tip_h=0.0, droop=0.0, width=0.0030, lip=0.010, lip_colour=None):
        """A slit from the snout's tip to corner (s, h)."""
        at = self.at
        t = np.clip(at.s / corner[0], 0, 1)
        h = tip_h + (corner[1] - tip_h) * t + droop * 4 * t * (1 - t)
        d = at.h - h
        span = step(corner[0] + 0.004, corner[0] - 0.003, at.s)
        ends = np.hypot(np.maximum(at.s - corner[0], 0), d)
        slit = line(ends, width * 0.35, width * 0.9)
        lips = bump(ends - lip * 0.55, lip * 0.5) * span
        if lip_colour is not None:
            self.tint(lip_colour, 0.7 * line(ends, lip * 0.8, lip * 0.6))
        self.height += self.length * (0.0016 * lips - 0.0030 * line(ends, 0, width * 1.3))
        self.tint('#1a0c0a', 0.85 * slit)

    def nostril(self, s, h, r=0.0035):
        d = self.at.near(s, h)
        self.height += self.length * 0.002 * (bump(d - 1.6 * r, 0.8 * r) - 1.6 * bump(d, r))
        self.shade(0.25, line(d, r * 0.6, r * 0.6))

    def socket(self, s, h, r, colour='#0c0c10', strength=0.6):
        """The skin around an eye: a fold, and shade that fades outwards."""
        d = self.at.near(s, h)
        self.height += self.length * r * 0.12 * bump(d - r * 1.14, r * 0.16)
        self.tint(colour, strength * line(d, r * 0.98, r * 0.30) * (0.55 + 0.45 * step(-r, r, self.at.h - h)))

    def lateral_line(self, points, strength=0.25, width=0.0022):
        """Along h(s): a row of fine pores."""
        d = self.at.h - Curve(points)(self.at.s)
        span = step(points[0][0], points[0][0] + 0.02, self.at.s)
        mask = line(d, width * 0.5, width) * span
        dots = 0.6 + 0.4 * np.sin(self.at.s * 2 * np.pi * 75)
        self.shade(1 - strength, mask * dots)
        self.height += self.length * 0.0012 * bump(d, width) * span

    def countershade(self, back, belly, mask=1.0):
        """back and belly: factors on brightness at the ridge and underneath."""
        v = self.at.v
        self.shade(1 + (back - 1) * step(0.42, 0.02, v) + (belly - 1) * step(0.62, 0.97, v), mask)

    def mottle(self, seed, size, strength, warm=0.0):
        """Irregular brightness, `size` in fractions of the length."""
        n = paint.fbm(seed, self.at.s / size, self.at.h / size, self.at.x / size, octaves=4)
        self.colour = self.colour * (1 + strength * n[..., None] * np.array([1 + warm, 1, 1 - warm]))

    def grain(self, relief=0.00003, strength=0.05, seed=90):
        """Pores and slime: the finest texture, so that no skin is as even as paint."""
        n = paint.noise(seed, self.at.u * 240, self.at.v * 200) + 0.7 * paint.noise(seed + 1, self.at.u * 130, self.at.v * 110)
        self.height += relief * n
        self.shade(1 + strength * n)
        self.rough += 0.03 * n

    def iridescence(self, seed, colours, strength, mask=1.0):
        """A sheen whose hue drifts over the flank, as thin plates of guanine have."""
        n = paint.fbm(seed, self.at.s * 6, self.at.h * 16, octaves=3)
        self.tint(colours[0], strength * step(0.05, 0.5, n) * mask)
        self.tint(colours[1], strength * step(-0.05, -0.5, n) * mask)

    def beneath_fin(self, fin, strength=0.45, width=0.02):
        """Shade where a fin leaves the body."""
        root = fin.root[::4] / self.length
        d = np.min([self.at.near(0.5 - p[2], p[1]) for p in root], axis=0)
        self.shade(1 - strength, bump(d, width))

    def pictures(self):
        normal = paint.normal_map(self.height, self.at.texel_u, self.at.texel_v)
        rough = np.clip(self.rough, 0.3, 0.7)
        metal = np.clip(self.metal, 0, 0.5)
        return np.clip(self.colour, 0, 1), normal, np.stack([np.ones_like(rough), rough, metal], -1)
