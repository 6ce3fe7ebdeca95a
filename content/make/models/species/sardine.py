"""Sardine, Sardina pilchardus: small, silver, blue-green back, a row of dark spots."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from motion import flap, thrash, wave
from paint import bump, mix, rgb, step
from skin import Skin

LENGTH, END = 0.12, 0.80
EYE = (0.085, 0.010, 0.0205)


def displace(s, h, v):
    return 0.002 * bump(s - 0.17, 0.04) * bump(v - 0.55, 0.25) - 0.002 * bump(s - 0.23, 0.02) * bump(v - 0.55, 0.25)


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.02, 0.018), (0.08, 0.044), (0.16, 0.066), (0.28, 0.083), (0.42, 0.082), (0.56, 0.062),
               (0.68, 0.038), (0.76, 0.025), (END, 0.026)],
        lower=[(0, -0.004), (0.02, -0.022), (0.08, -0.050), (0.16, -0.076), (0.28, -0.098), (0.42, -0.098),
               (0.56, -0.072), (0.68, -0.042), (0.76, -0.026), (END, -0.026)],
        width=[(0, 0.0), (0.02, 0.013), (0.08, 0.028), (0.16, 0.040), (0.28, 0.048), (0.42, 0.046), (0.56, 0.034),
               (0.68, 0.020), (0.76, 0.011), (END, 0.003)],
        widest=[(0, 0.5), (0.3, 0.58), (END, 0.5)], keel=1.15, displace=displace)


def paint_body(body, pectoral):
    skin = Skin(body, 512, 176)
    at = skin.at
    tone = paint.fbm(71, at.s * 10, at.h * 20, octaves=4)
    skin.colour = mix(rgb('#a9bcc4'), rgb('#e9eef0'), step(0.30, 0.62, at.v + 0.03 * tone))
    skin.tint('#2f6a80', 0.95 * step(0.34, 0.22, at.v + 0.04 * tone))
    skin.tint('#173c52', 0.8 * step(0.20, 0.02, at.v))
    skin.tint('#9fb86a', 0.35 * bump(at.v - 0.31, 0.04))
    for k in range(9):
        s = 0.235 + 0.058 * k
        d = np.hypot((at.s - s) / 0.011, (at.h - 0.030 + 0.02 * (s - 0.3)) / 0.009)
        skin.tint('#1c2c38', 0.70 * (1 - 0.06 * k) * step(1.1, 0.6, d))
    skin.scales(22, 0.00010, step(0.18, 0.22, at.s), edge=0.16, variety=0.18, metal=0.30)
    skin.metal += 0.20 * step(0.28, 0.42, at.v)
    skin.rough -= 0.08 * step(0.28, 0.42, at.v)
    skin.gill([(-0.085, 0.140), (-0.03, 0.186), (0.02, 0.198), (0.055, 0.180)], dark=0.40)
    rays = np.sin((np.arctan2(at.h - 0.02, at.s - 0.12)) * 40)
    skin.shade(1 + 0.06 * rays, step(0.13, 0.15, at.s) * step(0.195, 0.18, at.s) * step(0.0, -0.02, at.h))
    skin.socket(EYE[0], EYE[1], EYE[2], '#9aa4a8', 0.4)
    skin.mouth((0.050, -0.024), tip_h=0.004, width=0.0022, lip=0.006)
    skin.nostril(0.040, 0.014, 0.0025)
    skin.countershade(0.80, 1.04)
    skin.rough -= 0.03
    skin.grain()
    skin.beneath_fin(pectoral)
    return skin.pictures()


def fin_paint(rays, seed, clear=0.30, dusk=0.2):
    def picture(a, b):
        ray, alpha = membrane(a, b, rays, 0, clear, 0.85, seed)
        colour = mix(rgb('#aab6b4'), rgb('#c8d0cc'), b) * np.ones(a.shape + (3,))
        colour = mix(colour, rgb('#4c5a5e'), np.clip(0.5 * ray + dusk * step(0.5, 1, b), 0, 1))
        return colour, alpha, 0.0001 * ray
    return picture


def make():
    body = make_body()
    dorsal = median_fin(body, 'dorsal', 'upper', 0.36, 0.49, lengths=[(0, 0.02), (0.15, 0.085), (0.5, 0.062), (1, 0.03)],
                        leans=[(0, 0.55), (1, 1.1)], tile=(0.02, 0.02, 0.45, 0.28), columns=9, rows=5, paint=fin_paint(14, 2))
    anal = median_fin(body, 'anal', 'lower', 0.64, 0.77, lengths=[(0, 0.02), (0.2, 0.030), (1, 0.018)],
                      leans=[(0, 0.7), (1, 1.1)], tile=(0.52, 0.02, 0.45, 0.16), columns=9, rows=4, sink=0.008,
                      paint=fin_paint(14, 4))
    tail = tail_fin(body, lengths=[(0, 0.225), (0.1, 0.205), (0.3, 0.130), (0.5, 0.085), (0.7, 0.130), (0.9, 0.205),
                                   (1, 0.225)], spread=0.56, tile=(0.02, 0.36, 0.6, 0.3), columns=17, rows=7,
                    paint=fin_paint(17, 6, 0.60, 0.5))
    pectoral = paired_fin(body, 'pectoral', 0.205, (-0.062, -0.080), lengths=[(0, 0.105), (0.3, 0.10), (1, 0.04)],
                          first=(0.30, -0.25, -0.90), last=(0.22, -0.60, -0.75), tile=(0.02, 0.70, 0.4, 0.24),
                          joint='pectoral_left', columns=7, rows=5, paint=fin_paint(12, 8))
    pelvic = paired_fin(body, 'pelvic', 0.43, (-0.086, -0.092), lengths=[(0, 0.055), (0.3, 0.05), (1, 0.02)],
                        first=(0.22, -0.65, -0.72), last=(0.16, -0.35, -0.92), tile=(0.52, 0.70, 0.3, 0.24), columns=5,
                        rows=4, paint=fin_paint(7, 10))
    beat = (0.1, 1.0, 0.2)
    clips = [dict(name='swim', duration=0.5, keys=20, lateral=wave(0.9, 0.9), fins=flap(beat, 1, 0.25, 0.1)),
             dict(name='dart', duration=0.4, keys=24, lateral=wave(1.5, 0.9, cycles=2)),
             dict(name='struggle', duration=0.6, keys=32, lateral=thrash(1.0), fins=flap(beat, 4, 0.4),
                  roll=lambda p: 0.25 * np.sin(2 * np.pi * 3 * p))]
    return Animal('sardine', body, [dorsal, anal, tail, *with_mirror(pectoral), *with_mirror(pelvic)],
                  EYE, fish_eye('#b9c3c3', '#e9efea'), paint_body(body, pectoral), clips, height=256, rings=32, around=13, fin_size=(256, 256))
