"""Spotted eagle ray, Aetobatus narinari: a harmless guest that flies by. A disc of wings, a blunt head, a whip of a tail.

Its skin is painted as seen from above (left half of the picture) and from below (right half); t runs from the middle
(0) to the wing tip (1), c from the leading edge (0) to the trailing one (1).
"""

import numpy as np

import paint
from animal import Animal
from eyes import slit_eye
from fins import Fin, median_fin, with_mirror
from mesh import (Curve, Part, facing, grid_triangles, join, mirrored, quaternion, quaternion_product, tangent_frame, unit,
                  without_slivers)
from motion import thrash, wave
from paint import bump, line, mix, rgb, step

LENGTH = 1.40  # metres, the unit of what follows
SPAN, CHORD, TAIL_END = 0.385, 0.47, 0.84  # half the span, where disc and tail end
EYE = (0.060, 0.0, 0.0105)
SPINE = (0.0, 0.16, 0.28, 0.38, 0.45, 0.52, 0.60, 0.68, 0.76)
WING = (0.075, 0.165, 0.265)  # x of a wing's joints
LEADING = Curve([(0, 0.0), (0.035, 0.003), (0.07, 0.013), (0.10, 0.030), (0.125, 0.058), (0.145, 0.083), (0.18, 0.103),
                 (0.30, 0.128), (0.50, 0.172), (0.70, 0.232), (0.85, 0.294), (0.95, 0.352), (1, 0.398)])
TRAILING = Curve([(0, 0.460), (0.10, 0.458), (0.20, 0.440), (0.32, 0.408), (0.50, 0.372), (0.70, 0.362), (0.85, 0.374),
                  (0.95, 0.394), (1, 0.402)])
HEIGHT = Curve([(0, 0.058), (0.06, 0.056), (0.12, 0.047), (0.20, 0.034), (0.35, 0.020), (0.6, 0.010), (0.85, 0.005), (1, 0.0008)])


def airfoil(c):
    """Half thickness along a chord, at most 1 (NACA's four-digit series, Jacobs et al. 1933)."""
    return 10 * (0.2969 * np.sqrt(c) - 0.126 * c - 0.3516 * c ** 2 + 0.2843 * c ** 3 - 0.1036 * c ** 4)


class RayBody:
    length, end = LENGTH, CHORD

    def point(self, t, c, above):
        t, c = np.broadcast_arrays(np.asarray(t, float), np.asarray(c, float))
        s = LEADING(t) + (TRAILING(t) - LEADING(t)) * c
        middle = 0.022 * t * t - 0.012 * step(0.10, 0.0, s) - 0.012 * step(0.2, 0.46, s) * step(0.3, 0, t)
        brow = 0.010 * bump(np.hypot((t - 0.10) / 0.028, (s - 0.065) / 0.028), 1)
        y = middle + HEIGHT(t) * airfoil(np.clip(c, 0, 1)) * (1.0 if above else -0.62) + (brow if above else 0)
        return np.stack([t * SPAN, y, 0.5 - s], -1) * LENGTH

    def profile(self, which, s):
        """Height of the ridge, for what stands on it."""
        c = np.clip(np.asarray(s, float) / TRAILING(0.0), 0, 1)
        return self.point(0 * c, c, which == 'upper')[..., 1] / LENGTH

    def on_side(self, s, h):
        t = np.linspace(0.02, 0.2, 400)
        k = int(np.argmin(np.abs(LEADING(t) - s)))
        ahead = self.point(t[k + 1], 0.0, True) - self.point(t[k - 1], 0.0, True)
        return self.point(t[k], 0.01, True) + np.array([0, 0.006, 0]) * LENGTH, unit([-ahead[2], 0.012, ahead[0]])

    def part(self, along, across):
        t = np.concatenate([np.linspace(0, 0.16, 7), np.linspace(0.16, 1, across)[1:]])
        c = 0.5 - 0.5 * np.cos(np.linspace(0, 1, along) * np.pi)
        t, c = np.meshgrid(t, c, indexing='ij')
        skins = []
        for above in (True, False):
            p, e = self.point(t, c, above), 2e-3
            ct, tt = np.clip(c, e, 1 - e), np.clip(t, e, 1 - e)
            du = self.point(t, ct + e, above) - self.point(t, ct - e, above)
            dv = self.point(tt + e, c, above) - self.point(tt - e, c, above)
            n = np.cross(dv, du) * (1 if above else -1)
            n[c < 0.01] = [0, 0, 0]
            n[0, :, 0] = 0
            n = unit(n)
            edge = unit(np.cross(np.gradient(p[:, 0], axis=0), [0, -1.0, 0]))  # outward in the wing's plane
            n[:, 0] = unit(edge + [0, 0.3 if above else -0.3, 0])
            n[-1] = [0, 1 if above else -1, 0]
            uv = np.stack([((0.5 - p[..., 2] / LENGTH) / CHORD * 0.98 + 0.01) * 0.5 + (0 if above else 0.5), t * 0.985 + 0.005], -1)
            skins.append(facing(without_slivers(Part(
                p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, du, -dv).reshape(-1, 4), uv.reshape(-1, 2),
                grid_triangles(*t.shape)))))
        left = join(skins)
        return with_wings(join([left, mirrored(left)]))


def with_wings(part):
    x = part.positions[:, 0] / LENGTH
    part.follow = {}
    for side, sign in (('left', 1), ('right', -1)):
        for k, at in enumerate(WING):
            part.follow[f'wing_{side}_{k}'] = step(at - 0.035, at + 0.045, sign * x)
    return part


def tail():
    """A whip of seven sides."""
    s, g = np.meshgrid(np.linspace(0.41, TAIL_END, 13), np.linspace(0, 2 * np.pi, 8), indexing='ij')
    r = Curve([(0.41, 0.003), (0.435, 0.0085), (0.465, 0.0115), (0.50, 0.0092), (0.58, 0.0060), (0.7, 0.0036), (TAIL_END, 0.0010)])(s)
    across = np.stack([np.cos(g), np.sin(g), 0 * g], -1)
    p = (np.stack([0 * s, 0.004 - 0.012 * step(0.2, 0.46, s), 0.5 - s], -1) + across * r[..., None]) * LENGTH
    uv = np.stack([g / (2 * np.pi), (s - 0.41) / (TAIL_END - 0.41)], -1)
    n = unit(across + [0, 0, -0.03])
    return facing(Part(p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, np.gradient(p, axis=1), -np.gradient(p, axis=0)).reshape(-1, 4),
                       uv.reshape(-1, 2), grid_triangles(*s.shape)))


DARK, SLATE, WHITE = '#2b3238', '#49555c', '#e6e7e2'


def dorsal_colour(s, x, shade=0.0):
    """The back: slate with white spots and rings, smaller towards the edges."""
    tone = paint.fbm(231, s * 14, x * 14, octaves=4)
    colour = mix(rgb(DARK), rgb(SLATE), step(-0.5, 0.6, tone) * 0.8)
    colour = mix(colour, rgb('#5c5a4c'), 0.25 * step(0.1, 0.6, paint.fbm(232, s * 5, x * 5, octaves=2)))
    wob = 0.07 * paint.noise(233, s * 110, x * 110)
    near, _, which = paint.cells(234, s / 0.030, x / 0.030, 0.75)
    near = near + wob
    size = (0.17 + 0.13 * which) * (1 - 0.5 * step(0.24, 0.38, x)) * step(0.03, 0.10, s) * step(0.002, 0.016, x)  # none on the ridge, where the halves mirror
    spot = step(size + 0.05, size - 0.05, near) * step(0.12, 0.2, which)
    ring = step(0.075, 0.03, np.abs(near - size * 1.15)) * step(0.72, 0.76, which)
    colour = mix(colour, rgb('#171b1f'), 0.5 * step(size + 0.24, size + 0.05, near))
    colour = mix(colour, rgb(WHITE), 0.92 * np.where(which > 0.74, ring, spot))
    fine, _, small = paint.cells(235, s / 0.011, x / 0.011, 0.8)
    colour = mix(colour, rgb('#c9cdca'), 0.75 * step(0.24, 0.12, fine + wob) * step(0.72, 0.78, small) * step(0.16, 0.04, s))
    return colour * (1 - np.asarray(shade))[..., None]


def skin_pictures(size=512, rows=384):
    u, v = np.meshgrid((np.arange(size) + 0.5) / size, (np.arange(rows) + 0.5) / rows)
    s, t = (u - 0.01) / 0.98 * CHORD, (v - 0.005) / 0.985
    x = t * SPAN
    c = (s - LEADING(t)) / (TRAILING(t) - LEADING(t))
    rim = np.minimum(s - LEADING(t), TRAILING(t) - s)
    grain = paint.noise(236, u * 300, v * 300) + 0.7 * paint.noise(237, u * 150, v * 150)
    muscle = 0.5 + 0.5 * np.sin(s * 210 - 34 * np.sqrt(np.maximum(x - 0.03, 0)))  # bands that beat the wing
    fibre = muscle * step(0.06, 0.12, x) * step(0.36, 0.26, x) * step(0.0, 0.3, c) * step(1.0, 0.8, c)
    # above
    top = dorsal_colour(s, x, 0.22 * step(0.010, 0.0, rim))
    top = top * (1 + 0.05 * grain + 0.05 * (fibre - 0.5))[..., None]
    spiracle = np.hypot((s - 0.098) / 0.016, (x - 0.040) / 0.007)
    top = mix(top, rgb('#0a0c0e'), 0.85 * step(1.0, 0.6, spiracle))
    high = 0.0010 * fibre + 0.00022 * grain - 0.006 * bump(spiracle, 0.8) + 0.002 * bump(spiracle - 1.5, 0.4)
    # below
    tone = paint.fbm(238, s * 12, x * 12, octaves=4)
    under = mix(rgb('#e9eae5'), rgb('#c9ccc8'), step(-0.3, 0.7, tone))
    under = mix(under, rgb('#7d8484'), 0.75 * step(0.030, 0.004, rim + 0.006 * tone) * step(0.10, 0.20, x))
    under = mix(under, rgb('#d8b9b0'), 0.25 * step(0.10, 0.02, x) * bump(s - 0.11, 0.06))
    low = 0.0008 * fibre + 0.00018 * grain
    for k in range(5):
        d = s - (0.128 + 0.017 * k) - 0.10 * (x - 0.052) ** 1
        span = bump(x - (0.056 - 0.003 * k), 0.011)
        under = mix(under, rgb('#3b3433'), 0.85 * line(d, 0.0006, 0.0018) * step(0.35, 0.6, span))
        under = under * (1 - 0.16 * bump(d - 0.004, 0.004) * span)[..., None]
        low = low + (0.0020 * bump(d + 0.003, 0.003) - 0.0026 * bump(d, 0.0018)) * span
    lip = s - 0.072 - 1.2 * x * x
    mouth = step(0.036, 0.030, x)
    under = mix(under, rgb('#4a2f2c'), 0.85 * line(lip, 0.0008, 0.0020) * mouth)
    under = under * (1 - 0.12 * bump(lip - 0.006, 0.005) * mouth)[..., None]
    low = low + (0.0024 * bump(lip + 0.005, 0.004) - 0.003 * bump(lip, 0.002)) * mouth
    nostril = np.hypot((s - 0.056) / 0.006, (x - 0.020) / 0.004)
    under = mix(under, rgb('#2a2222'), 0.8 * step(1.0, 0.5, nostril))
    texel = CHORD * LENGTH / size, SPAN * LENGTH / rows
    colour = np.concatenate([top, under], 1)
    normal = np.concatenate([paint.normal_map(high, *texel), paint.normal_map(low, *texel)], 1)
    rough = np.clip(0.40 + 0.04 * np.concatenate([grain, grain], 1), 0.3, 0.6)
    return np.clip(colour, 0, 1), normal, np.stack([np.ones_like(rough), rough, 0 * rough], -1)


def fin_paint(a, b):
    colour = mix(rgb(DARK), rgb(SLATE), 0.5 + 0.5 * paint.fbm(241, a * 6, b * 6, octaves=3))
    return mix(colour, rgb(WHITE), 0.8 * step(0.30, 0.20, paint.cells(242, a * 4, b * 4, 0.7)[0])), np.ones(a.shape), 0 * a


def pale_paint(a, b):
    return mix(rgb('#d9dbd6'), rgb('#8f9594'), step(0.5, 1.0, b)), np.ones(a.shape), 0 * a


def pelvic(body):
    a = np.linspace(0, 1, 17)
    root = np.stack([0.010 + 0.034 * a, -0.006 + 0 * a, 0.5 - 0.425 + 0.006 * a], -1) * LENGTH
    direction = unit(np.stack([0.05 + 0.55 * a, -0.06 + 0 * a, -np.ones(17)], -1))
    return Fin('pelvic', root, direction, Curve([(0, 0.055), (0.4, 0.088), (0.8, 0.072), (1, 0.05)])(a) * LENGTH,
               (0.36, 0.80, 0.16, 0.18), fin_paint, 0.006 * LENGTH, foil='wing', columns=7, rows=4,
               under=(0.55, 0.80, 0.16, 0.18), paint_under=pale_paint)


def beat(strength, cycles=1, rest=0.04):
    """Wings: a wave that runs from the body to the tips, whose leading edges dip as they go down."""
    def clip(phase):
        turns = {}
        for k, swing in enumerate((0.24, 0.30, 0.36)):
            angle = 2 * np.pi * cycles * phase - 0.65 * k
            up = rest + strength * swing * np.sin(angle)
            twist = 0.16 * strength * np.cos(angle)
            left = quaternion_product(quaternion([0, 0, 1], up), quaternion([1, 0, 0], -twist))
            turns[f'wing_left_{k}'] = left
            turns[f'wing_right_{k}'] = left * [1, -1, -1, 1]
        return turns
    return clip


def make():
    body = RayBody()
    fin = median_fin(body, 'dorsal', 'upper', 0.432, 0.462, lengths=[(0, 0.030), (0.4, 0.028), (1, 0.018)],
                     leans=[(0, 0.7), (1, 1.35)], tile=(0.74, 0.80, 0.12, 0.18), sink=0.008, thickness=0.0035, foil='wing',
                     columns=6, rows=4, paint=fin_paint)
    joints = []
    for side, sign in (('left', 1), ('right', -1)):
        for k, at in enumerate(WING):
            parent = 2 if k == 0 else len(SPINE) + len(joints) - 1
            joints.append((f'wing_{side}_{k}', parent, np.array([sign * at, 0.004, 0.5 - 0.30]) * LENGTH))
    s = np.linspace(0.41, TAIL_END, 32)[:, None] + 0 * np.ones((1, 24))
    whip = mix(dorsal_colour(s, s * 0.3), rgb('#1b1f22'), step(0.43, 0.52, s))
    below = bump((np.arange(24) + 0.5) / 24 - 0.75, 0.22)[None, :]
    whip = mix(whip, rgb('#dcded9'), below * step(0.56, 0.46, s))
    clips = [
        dict(name='swim', duration=1.6, keys=32, lateral=wave(0.45, 1.4), fins=beat(1.0),
             lift=lambda p: -0.016 * np.sin(2 * np.pi * p - 0.3)),
        dict(name='dart', duration=0.8, keys=24, lateral=wave(0.40, 1.4), fins=beat(1.35, 1, 0.0),
             lift=lambda p: -0.02 * np.sin(2 * np.pi * p - 0.3)),
        dict(name='struggle', duration=1.2, keys=36, lateral=thrash(0.25), fins=beat(0.9, 3, 0.10),
             roll=lambda p: 0.22 * np.sin(2 * np.pi * 2 * p))]
    return Animal('ray', body, [fin, *with_mirror(pelvic(body))], EYE, slit_eye('#a89a62', '#4a4632'), skin_pictures(), clips,
                  height=512, rings=13, around=12, thick_fins=True, fin_rough=0.42, centre=0.30, spine=SPINE, extra_joints=joints,
                  extra_parts=[(tail(), whip)])
