"""False clownfish, Amphiprion ocellaris: orange, three white bands edged in black, rounded fins."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from motion import flap, thrash, wave
from paint import bump, mix, rgb, step
from skin import Skin

LENGTH, END = 0.11, 0.79
EYE = (0.105, 0.032, 0.0300)


def displace(s, h, v):
    gill = 0.006 * bump(s - 0.215, 0.05) * bump(v - 0.55, 0.28)
    socket = 0.004 * bump(np.hypot(s - EYE[0], h - EYE[1]), 0.035)
    mouth = -0.006 * bump(np.hypot(np.maximum(s - 0.05, 0), h + 0.008 + 0.1 * s), 0.008)
    return gill + socket + mouth


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.02, 0.040), (0.06, 0.078), (0.12, 0.122), (0.20, 0.164), (0.30, 0.190), (0.42, 0.190),
               (0.54, 0.162), (0.64, 0.118), (0.72, 0.080), (END, 0.072)],
        lower=[(0, -0.006), (0.02, -0.040), (0.06, -0.076), (0.12, -0.112), (0.20, -0.148), (0.30, -0.170),
               (0.42, -0.168), (0.54, -0.140), (0.64, -0.098), (0.72, -0.070), (END, -0.066)],
        width=[(0, 0.0), (0.02, 0.030), (0.06, 0.054), (0.12, 0.076), (0.20, 0.092), (0.30, 0.098), (0.42, 0.090),
               (0.54, 0.070), (0.64, 0.046), (0.72, 0.026), (END, 0.004)],
        widest=[(0, 0.5), (0.3, 0.48), (END, 0.5)], keel=1.05, displace=displace)


# Bands as hind and front edges s(h).
BANDS = (
    ([(-0.20, 0.150), (-0.08, 0.158), (0.02, 0.165), (0.10, 0.150), (0.20, 0.125)],
     [(-0.20, 0.200), (-0.08, 0.225), (0.02, 0.245), (0.10, 0.225), (0.20, 0.190)]),
    ([(-0.20, 0.400), (-0.06, 0.395), (0.01, 0.345), (0.08, 0.385), (0.22, 0.420)],
     [(-0.20, 0.490), (-0.06, 0.500), (0.01, 0.515), (0.08, 0.505), (0.22, 0.500)]),
    ([(-0.10, 0.690), (0.0, 0.672), (0.10, 0.690)],
     [(-0.10, 0.738), (0.0, 0.748), (0.10, 0.738)]))
ORANGE, DEEP, WHITE, BLACK = '#ef6c12', '#c63f06', '#f2f1ec', '#130d0b'


def paint_body(body, pectoral):
    skin = Skin(body)
    at = skin.at
    flame = paint.fbm(11, at.s * 9, at.h * 9, octaves=3)
    skin.colour = mix(rgb(ORANGE), rgb('#f98b1c'), step(0.35, 0.85, at.v + 0.10 * flame))
    skin.tint(DEEP, 0.75 * step(0.40, 0.02, at.v + 0.06 * flame))
    skin.tint('#f59a2e', 0.5 * step(0.16, 0.02, at.s))
    bands = np.zeros_like(at.s)
    for front, back in BANDS:
        wob = 0.004 * paint.noise(21, at.h * 40, at.s * 12) + 0.0015 * paint.noise(22, at.h * 150, at.s * 90)
        d0, d1 = skin.curve(front) + wob, -(skin.curve(back) + wob)
        inside = np.minimum(d0, d1)
        thick = 0.0115 + 0.005 * paint.noise(23, at.h * 25, at.s * 3)
        skin.tint(BLACK, 0.96 * step(-thick - 0.003, -thick + 0.002, inside))
        white = step(-0.001, 0.003, inside)
        skin.tint(mix(rgb(WHITE), rgb('#c9d3dc'), 0.55 * step(0.30, 0.0, at.v) + 0.25 * step(0.75, 1.0, at.v)), white)
        bands = np.maximum(bands, white)
    body_mask = step(0.17, 0.23, at.s)
    skin.scales(26, 0.00011, 0.35 + 0.65 * body_mask, edge=0.16, variety=0.10, metal=0.12)
    skin.mottle(31, 0.06, 0.05, warm=0.4)
    skin.gill([(-0.13, 0.170), (-0.06, 0.232), (0.02, 0.252), (0.08, 0.236), (0.12, 0.205)], dark=0.40)
    skin.gill([(-0.11, 0.120), (-0.05, 0.172), (0.03, 0.180), (0.07, 0.172)], dark=0.16, relief=0.002)
    skin.lateral_line([(0.24, 0.115), (0.40, 0.135), (0.55, 0.11), (0.64, 0.075), (0.66, 0.07)], 0.12)
    skin.socket(EYE[0], EYE[1], EYE[2], '#2a1206', 0.55)
    skin.mouth((0.062, -0.022), tip_h=-0.006, droop=0.004, width=0.0022, lip_colour='#f0a24a')
    skin.nostril(0.055, 0.036)
    skin.countershade(0.82, 1.10)
    skin.rough[:] += 0.02
    skin.grain()
    skin.beneath_fin(pectoral)
    return skin.pictures()


def fin_paint(rays, spiny=0.0, base=ORANGE, seed=1, white_root=0.0, black=0.85, band=0.13, clear=0.82):
    def picture(a, b):
        ray, alpha = membrane(a, b, rays, spiny, clear, 0.96, seed)
        colour = mix(rgb(base), rgb('#fb9c35'), step(0.1, 0.9, b) * 0.5)
        colour = mix(colour, rgb(DEEP), 0.40 * ray)
        if white_root:
            colour = mix(colour, rgb(WHITE), step(white_root, white_root - 0.08, b))
            colour = mix(colour, rgb(BLACK), 0.8 * bump(b - white_root - 0.02, 0.05))
        wob = 0.02 * paint.noise(seed, a * rays, b * 4)
        colour = mix(colour, rgb(BLACK), black * step(0.965 - band - 0.05, 0.965 - band + 0.02, b + wob))
        colour = mix(colour, rgb('#f6ead8'), 0.55 * step(0.945, 0.975, b))
        return colour, alpha, 0.00016 * ray
    return picture


def make():
    body = make_body()
    dorsal = median_fin(
        body, 'dorsal', 'upper', 0.235, 0.735,
        lengths=[(0, 0.015), (0.05, 0.055), (0.25, 0.080), (0.45, 0.072), (0.55, 0.070), (0.72, 0.112), (0.88, 0.110),
                 (0.96, 0.080), (1, 0.045)],
        leans=[(0, 0.75), (0.5, 0.80), (0.75, 0.95), (1, 1.15)], tile=(0.02, 0.02, 0.96, 0.20), ripple=0.0012,
        waves=2.5, paint=fin_paint(25, spiny=0.55, seed=2))
    anal = median_fin(
        body, 'anal', 'lower', 0.50, 0.735, lengths=[(0, 0.02), (0.12, 0.075), (0.5, 0.108), (0.85, 0.100), (1, 0.04)],
        leans=[(0, 0.7), (0.6, 0.9), (1, 1.15)], tile=(0.02, 0.26, 0.46, 0.20), ripple=0.001, waves=1.5,
        paint=fin_paint(14, spiny=0.12, seed=4))
    tail = tail_fin(
        body, lengths=[(0, 0.165), (0.12, 0.190), (0.5, 0.208), (0.88, 0.190), (1, 0.165)], spread=0.40,
        tile=(0.52, 0.26, 0.46, 0.34), ripple=0.0012, waves=1.5, columns=15,
        paint=fin_paint(17, seed=6, band=0.16))
    pectoral = paired_fin(
        body, 'pectoral', 0.262, (-0.015, -0.085), lengths=[(0, 0.070), (0.15, 0.135), (0.4, 0.165), (0.7, 0.150), (0.9, 0.10), (1, 0.05)],
        first=(0.60, 0.55, -0.70), last=(0.50, -0.85, -0.40), tile=(0.02, 0.50, 0.44, 0.30), bend=(0, 0, -0.004),
        ripple=0.0006, waves=1.0, joint='pectoral_left', slant=0.01, columns=11, flesh=0.005,
        paint=fin_paint(17, seed=8, band=0.14, clear=0.62))
    pelvic = paired_fin(
        body, 'pelvic', 0.315, (-0.150, -0.163), lengths=[(0, 0.115), (0.4, 0.140), (1, 0.06)],
        first=(0.30, -0.85, -0.45), last=(0.22, -0.42, -0.92), tile=(0.52, 0.64, 0.40, 0.28), slant=0.04,
        columns=11, paint=fin_paint(6, spiny=0.16, seed=10, band=0.22))
    clips = [
        dict(name='swim', duration=0.8, keys=24, lateral=wave(0.85, 0.9),
             fins=flap((0.2, 1.0, 0.25), 2, 0.55, 0.10), lift=lambda p: 0.0012 * np.sin(2 * np.pi * p),
             roll=lambda p: 0.05 * np.sin(2 * np.pi * p + 1)),
        dict(name='dart', duration=0.4, keys=20, lateral=wave(1.4, 0.9), fins=flap((0.2, 1.0, 0.25), 1, 0.15, 0.5)),
        dict(name='struggle', duration=0.8, keys=32, lateral=thrash(1.0), fins=flap((0.2, 1.0, 0.25), 6, 0.6),
             roll=lambda p: 0.28 * np.sin(2 * np.pi * 3 * p + 0.4))]
    return Animal('clownfish', body, [dorsal, anal, tail, *with_mirror(pectoral), *with_mirror(pelvic)],
                  EYE, fish_eye('#7a3408', '#f0983a'), paint_body(body, pectoral), clips)
