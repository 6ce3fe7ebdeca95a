"""Yellowtail snapper, Ocyurus chrysurus: silver blue, a yellow band from snout to a deeply forked yellow tail."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from motion import flap, thrash, wave
from paint import bump, mix, rgb, step
from skin import Skin

LENGTH, END = 0.32, 0.745
EYE = (0.110, 0.022, 0.0205)
YELLOW = '#fbd428'


def displace(s, h, v):
    gill = 0.004 * bump(s - 0.195, 0.045) * bump(v - 0.55, 0.25)
    socket = 0.003 * bump(np.hypot(s - EYE[0], h - EYE[1]), 0.026)
    jaw = 0.003 * bump(s - 0.05, 0.03) * bump(v - 0.72, 0.12)
    return gill + socket + jaw


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.02, 0.022), (0.06, 0.048), (0.12, 0.080), (0.20, 0.110), (0.29, 0.124), (0.39, 0.120),
               (0.50, 0.098), (0.60, 0.066), (0.68, 0.042), (END, 0.038)],
        lower=[(0, -0.006), (0.02, -0.027), (0.06, -0.050), (0.12, -0.075), (0.20, -0.096), (0.29, -0.104),
               (0.39, -0.098), (0.50, -0.080), (0.60, -0.054), (0.68, -0.038), (END, -0.036)],
        width=[(0, 0.0), (0.02, 0.018), (0.06, 0.033), (0.12, 0.048), (0.20, 0.060), (0.29, 0.064), (0.39, 0.060),
               (0.50, 0.047), (0.60, 0.030), (0.68, 0.017), (END, 0.003)],
        widest=[(0, 0.5), (0.3, 0.48), (END, 0.5)], keel=1.05, displace=displace)


def paint_body(body, pectoral):
    skin = Skin(body)
    at = skin.at
    tone = paint.fbm(61, at.s * 8, at.h * 14, octaves=4)
    skin.colour = mix(rgb('#8fb0c6'), rgb('#e6e9ea'), step(0.35, 0.75, at.v + 0.04 * tone))
    skin.tint('#4d7896', 0.9 * step(0.40, 0.12, at.v + 0.05 * tone))
    skin.tint('#2f5570', 0.7 * step(0.20, 0.0, at.v))
    skin.tint('#d9b9b4', 0.30 * bump(at.v - 0.66, 0.10) * step(0.16, 0.3, at.s))
    # thin yellow lines on the belly, one to a row of scales
    lines = 1 - step(0.14, 0.34, np.abs((at.v * 40) % 1.0 - 0.5))
    skin.tint('#e3c24a', 0.40 * lines * step(0.52, 0.60, at.v) * step(0.92, 0.80, at.v) * step(0.2, 0.3, at.s))
    # yellow blotches over the back
    cell_s, cell_v = np.floor(at.s / 0.042), np.floor((at.v + 0.04 * (np.floor(at.s / 0.042) % 2)) / 0.085)
    cx = (cell_s + 0.3 + 0.4 * paint.scatter(63, cell_s, cell_v)) * 0.042
    cv = (cell_v + 0.3 + 0.4 * paint.scatter(64, cell_s, cell_v)) * 0.085 - 0.04 * (cell_s % 2)
    spot = np.hypot((at.s - cx) / 0.011, (at.v - cv) / 0.026) + 0.35 * paint.noise(65, at.s * 120, at.h * 120)
    skin.tint('#d8bb3c', 0.75 * step(1.05, 0.55, spot) * step(0.31, 0.25, at.v) * step(0.16, 0.24, at.s))
    # the band: narrow on the snout, wide at the tail
    middle = 0.018 - 0.01 * at.s + 0.006 * np.sin(at.s * 5)
    half = 0.0075 + 0.018 * step(0.15, 0.60, at.s) + 0.035 * step(0.52, 0.72, at.s)
    wob = 0.0025 * paint.noise(66, at.s * 60, at.h * 60)
    band = step(0.006, -0.004, np.abs(at.h - middle) - half + wob)
    skin.tint(mix(rgb(YELLOW), rgb('#d99f0c'), step(0.5, 0.2, at.v)), 0.95 * band * step(0.015, 0.06, at.s))
    skin.tint('#f0c71f', step(0.66, 0.72, at.s + 0.1 * np.abs(at.h)))
    skin.tint('#b9a9a0', 0.25 * step(0.10, 0.02, at.s))
    trunk = step(0.185, 0.225, at.s)
    pale = step(0.30, 0.5, at.v)
    skin.scales(46, 0.00020, 0.12 + 0.88 * trunk, edge=0.20, variety=0.16, metal=0.30)
    skin.metal += 0.14 * pale * (1 - 0.75 * band)
    skin.rough -= 0.04 * pale
    skin.mottle(67, 0.05, 0.05)
    skin.gill([(-0.088, 0.150), (-0.04, 0.192), (0.01, 0.210), (0.05, 0.200), (0.085, 0.178)], dark=0.42)
    skin.gill([(-0.070, 0.110), (-0.035, 0.146), (0.02, 0.152), (0.045, 0.148)], dark=0.12, relief=0.002)
    skin.iridescence(68, ('#b9a7d8', '#8fd0cf'), 0.22, step(0.30, 0.45, at.v) * (1 - band))
    # cheek and crown are scaled and blotched too
    skin.mottle(69, 0.018, 0.10)
    skin.lateral_line([(0.205, 0.062), (0.35, 0.075), (0.5, 0.052), (0.64, 0.016), (0.72, 0.002), (0.745, 0.0)], 0.18)
    skin.socket(EYE[0], EYE[1], EYE[2], '#30342f', 0.45)
    skin.mouth((0.066, -0.020), tip_h=-0.004, droop=0.003, width=0.0020, lip=0.0065, lip_colour='#a3aeb4')
    # the upper jaw's plate behind the mouth
    skin.height += 0.0006 * bump(np.hypot((at.s - 0.060) / 1.6, at.h + 0.020), 0.010)
    skin.nostril(0.060, 0.026, 0.0025)
    skin.nostril(0.070, 0.030, 0.0018)
    skin.countershade(0.72, 1.06)
    skin.rough -= 0.04
    skin.grain()
    skin.beneath_fin(pectoral)
    return skin.pictures()


def fin_paint(colours, rays, spiny=0.0, clear=0.45, seed=1, scallop=0.10):
    def picture(a, b):
        ray, alpha = membrane(a, b, rays, spiny, clear, 0.92, seed, scallop)
        colour = mix(rgb(colours[0]), rgb(colours[1]), step(0.0, 0.9, b))
        colour = mix(colour, rgb(colours[2]), 0.6 * ray) * (0.86 + 0.14 * step(0, 0.35, b))[..., None]
        return colour, alpha, 0.0003 * ray
    return picture


def make():
    body = make_body()
    dorsal = median_fin(
        body, 'dorsal', 'upper', 0.225, 0.645,
        lengths=[(0, 0.010), (0.08, 0.050), (0.2, 0.075), (0.4, 0.066), (0.58, 0.048), (0.68, 0.050), (0.85, 0.046),
                 (1, 0.040)],
        leans=[(0, 0.60), (0.5, 0.85), (1, 1.15)], tile=(0.02, 0.02, 0.96, 0.18), sink=0.010,
        ripple=0.0012, waves=2, paint=fin_paint(('#f6cf33', '#f8e070', '#d8ae34'), 24, 0.52, 0.50, 2))
    anal = median_fin(
        body, 'anal', 'lower', 0.485, 0.640, lengths=[(0, 0.02), (0.15, 0.062), (0.5, 0.052), (1, 0.035)],
        leans=[(0, 0.65), (1, 1.15)], tile=(0.02, 0.22, 0.40, 0.16), sink=0.010,
        paint=fin_paint(('#f0dc8c', '#f6e9b4', '#d8bd62'), 12, 0.2, 0.38, 4))
    tail = tail_fin(
        body, lengths=[(0, 0.292), (0.06, 0.278), (0.2, 0.190), (0.35, 0.118), (0.5, 0.085), (0.65, 0.116),
                       (0.8, 0.186), (0.94, 0.272), (1, 0.286)], spread=0.60,
        tile=(0.44, 0.22, 0.54, 0.36), ripple=0.0015, waves=1, columns=21, rows=9,
        paint=fin_paint((YELLOW, '#f6d23c', '#c9960f'), 19, 0.0, 0.78, 6))
    pectoral = paired_fin(
        body, 'pectoral', 0.216, (-0.024, -0.052),
        lengths=[(0, 0.060), (0.10, 0.150), (0.22, 0.175), (0.45, 0.150), (0.75, 0.090), (0.93, 0.050), (1, 0.022)],
        first=(0.46, 0.16, -0.88), last=(0.36, -0.80, -0.48), tile=(0.02, 0.42, 0.38, 0.26), bend=(0, -0.004, -0.004),
        joint='pectoral_left', slant=0.008, columns=11, flesh=0.010,
        paint=fin_paint(('#e8d9a8', '#f0e6c8', '#d9c58e'), 15, 0, 0.14, 8))
    pelvic = paired_fin(
        body, 'pelvic', 0.255, (-0.090, -0.098), lengths=[(0, 0.098), (0.3, 0.100), (1, 0.04)],
        first=(0.26, -0.72, -0.62), last=(0.18, -0.35, -0.92), tile=(0.44, 0.62, 0.34, 0.26), slant=0.028, columns=9,
        paint=fin_paint(('#f1e6bd', '#f8f2da', '#d8c88e'), 6, 0.16, 0.45, 10))
    beat = (0.1, 1.0, 0.25)
    clips = [
        dict(name='swim', duration=0.9, keys=24, lateral=wave(0.80, 1.0), fins=flap(beat, 1, 0.20, 0.18)),
        dict(name='dart', duration=0.42, keys=20, lateral=wave(1.3, 0.95), fins=flap(beat, 1, 0.05, 0.35)),
        dict(name='struggle', duration=0.8, keys=32, lateral=thrash(1.0), fins=flap(beat, 5, 0.40),
             roll=lambda p: 0.30 * np.sin(2 * np.pi * 3 * p + 0.4))]
    return Animal('snapper', body, [dorsal, anal, tail, *with_mirror(pectoral), *with_mirror(pelvic)],
                  EYE, fish_eye('#a39a78', '#e8cf72'), paint_body(body, pectoral), clips)
