"""Yellow boxfish, Ostracion cubicus: an armoured box of fused plates, yellow with dark spots, fins like small fans."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from motion import flap, thrash, wave
from paint import bump, mix, rgb, step
from skin import Skin

LENGTH, END = 0.20, 0.79
EYE = (0.168, 0.092, 0.0290)


def displace(s, h, v):
    ridge = 0.010 * (bump(v - 0.265, 0.06) + bump(v - 0.745, 0.06)) * step(0.15, 0.24, s) * step(0.66, 0.55, s)
    hollow = -0.006 * bump(v - 0.5, 0.12) * step(0.2, 0.3, s) * step(0.62, 0.5, s)
    socket = 0.004 * bump(np.hypot(s - EYE[0], h - EYE[1]), 0.036)
    lips = 0.007 * bump(s - 0.012, 0.010) - 0.006 * bump(s - 0.034, 0.012)
    gill = 0.004 * bump(s - 0.225, 0.02) * bump(v - 0.56, 0.1)
    return ridge + hollow + socket + lips + gill


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.012, 0.020), (0.035, 0.030), (0.06, 0.058), (0.10, 0.118), (0.15, 0.168), (0.22, 0.196),
               (0.34, 0.206), (0.46, 0.198), (0.56, 0.165), (0.63, 0.112), (0.69, 0.066), (0.74, 0.052), (END, 0.054)],
        lower=[(0, -0.012), (0.012, -0.034), (0.035, -0.050), (0.06, -0.078), (0.10, -0.122), (0.16, -0.158),
               (0.26, -0.178), (0.42, -0.176), (0.54, -0.146), (0.62, -0.096), (0.68, -0.060), (0.74, -0.050),
               (END, -0.052)],
        width=[(0, 0.0), (0.012, 0.019), (0.035, 0.030), (0.06, 0.058), (0.10, 0.100), (0.16, 0.138), (0.26, 0.158),
               (0.42, 0.154), (0.54, 0.122), (0.62, 0.072), (0.68, 0.036), (0.74, 0.020), (END, 0.004)],
        widest=[(0, 0.5), (END, 0.5)], boxy=[(0, 2), (0.06, 2.1), (0.16, 3.2), (0.28, 4.2), (0.5, 4.2), (0.62, 2.8),
                                             (0.70, 2), (1, 2)], displace=displace)


def paint_body(body, pectoral):
    skin = Skin(body)
    at, arc = skin.at, skin.at.arc
    tone = paint.fbm(211, at.s * 9, arc * 9, octaves=4)
    skin.colour = mix(rgb('#f4bd14'), rgb('#ffdf4a'), step(-0.4, 0.5, tone))
    skin.tint('#e0940c', 0.40 * step(0.35, 0.05, at.v))
    skin.tint('#f8e9a0', 0.55 * step(0.66, 0.92, at.v))
    skin.tint('#f3d789', 0.6 * step(0.05, 0.01, at.s))
    box = step(0.17, 0.24, at.s) * step(0.68, 0.60, at.s)
    # six-sided plates, felt more than seen
    d1, d2, which = paint.cells(212, at.s / 0.052, arc / 0.047, 0.30)
    seam = step(0.16, 0.02, d2 - d1)
    skin.height += 0.00042 * (1 - seam) * box
    skin.height += 0.00010 * paint.noise(213, at.s * 230, arc * 230) * box  # their grains
    skin.shade(1 - 0.16 * seam + 0.10 * (which - 0.5), box)
    # spots, one to most plates, smaller towards head and tail; the larger have a pale heart
    d1, d2, which = paint.cells(215, at.s / 0.070, arc / 0.062, 0.42)
    d1 = d1 + 0.05 * paint.noise(216, at.s * 90, arc * 90)
    size = (0.19 + 0.12 * which) * (0.55 + 0.45 * box) * (1 - 0.35 * step(0.70, 0.95, at.v))
    shown = step(0.07, 0.10, at.s) * step(1.0, 0.86, at.v) * step(0.02, 0.09, at.v)
    dark = step(size + 0.035, size - 0.035, d1) * shown
    skin.tint('#d99a14', 0.5 * step(size + 0.14, size, d1) * shown)
    skin.tint('#1d1712', 0.92 * dark)
    skin.tint('#cfe0e6', 0.80 * step(size * 0.55, size * 0.32, d1) * shown * step(0.24, 0.27, size))
    d1, _, which = paint.cells(217, at.s / 0.026, arc / 0.026, 0.8)
    skin.tint('#3a2a12', 0.75 * step(0.24, 0.14, d1) * step(0.5, 0.6, which) * (1 - box) * step(0.06, 0.09, at.s))
    skin.shade(0.86, bump(at.v - 0.30, 0.03) * box)
    skin.shade(0.84, bump(at.v - 0.78, 0.03) * box)
    skin.gill([(-0.10, 0.216), (-0.04, 0.222), (0.03, 0.220)], dark=0.65, width=0.004)
    skin.socket(EYE[0], EYE[1], EYE[2], '#5b3c08', 0.55)
    skin.mouth((0.030, -0.020), tip_h=-0.008, droop=0.002, width=0.0026, lip=0.010, lip_colour='#f3c9a0')
    skin.nostril(0.085, 0.060, 0.0035)
    skin.mottle(218, 0.03, 0.07)
    skin.countershade(0.80, 1.10)
    skin.grain()
    skin.beneath_fin(pectoral, 0.5, 0.016)
    skin.rough -= 0.03
    return skin.pictures()


def fin_paint(rays, clear=0.30, seed=1, spots=0.0):
    def picture(a, b):
        ray, alpha = membrane(a, b, rays, 0, clear, 0.92, seed)
        colour = mix(rgb('#f2b51c'), rgb('#ffe680'), step(0.05, 0.8, b))
        colour = mix(colour, rgb('#c98a10'), 0.55 * ray)
        d = paint.cells(seed + 40, a * 7, b * 4, 0.6)[0]
        colour = mix(colour, rgb('#2a1d10'), spots * step(0.30, 0.20, d) * step(0.1, 0.2, b))
        return colour, alpha, 0.0002 * ray
    return picture


def make():
    body = make_body()
    dorsal = median_fin(body, 'dorsal', 'upper', 0.545, 0.650, sink=0.016, thickness=0.009, columns=9,
                        lengths=[(0, 0.06), (0.25, 0.125), (0.55, 0.128), (0.85, 0.09), (1, 0.04)],
                        leans=[(0, 0.35), (0.5, 0.85), (1, 1.35)], tile=(0.02, 0.04, 0.28, 0.40), ripple=0.0008, waves=1,
                        paint=fin_paint(9, 0.30, 2))
    anal = median_fin(body, 'anal', 'lower', 0.580, 0.672, sink=0.014, thickness=0.008, columns=9,
                      lengths=[(0, 0.05), (0.3, 0.112), (0.6, 0.112), (0.9, 0.07), (1, 0.035)],
                      leans=[(0, 0.45), (0.5, 0.95), (1, 1.40)], tile=(0.34, 0.04, 0.28, 0.40), ripple=0.0008, waves=1,
                      paint=fin_paint(9, 0.30, 4))
    tail = tail_fin(body, lengths=[(0, 0.150), (0.15, 0.195), (0.5, 0.212), (0.85, 0.195), (1, 0.150)], spread=0.34,
                    tile=(0.02, 0.54, 0.46, 0.42), ripple=0.0012, waves=1.2, columns=11,
                    paint=fin_paint(10, 0.55, 6, 0.85))
    pectoral = paired_fin(body, 'pectoral', 0.255, (0.005, -0.055), sink=0.008,
                          lengths=[(0, 0.070), (0.2, 0.135), (0.5, 0.155), (0.8, 0.130), (1, 0.060)],
                          first=(0.55, 0.55, -0.70), last=(0.50, -0.80, -0.45), tile=(0.54, 0.54, 0.42, 0.42),
                          bend=(0, 0, -0.004), joint='pectoral_left', slant=0.01, columns=10, flesh=0.006,
                          paint=fin_paint(10, 0.26, 8))
    beat = (0.15, 1.0, 0.30)
    clips = [dict(name='swim', duration=1.0, keys=30, lateral=wave(0.34, 1.3), fins=flap(beat, 4, 0.50, 0.15),
                  lift=lambda p: 0.0014 * np.sin(4 * np.pi * p), roll=lambda p: 0.04 * np.sin(2 * np.pi * p)),
             dict(name='dart', duration=0.44, keys=22, lateral=wave(0.95, 1.2), fins=flap(beat, 3, 0.35, 0.35)),
             dict(name='struggle', duration=0.9, keys=32, lateral=thrash(0.55), fins=flap(beat, 8, 0.55),
                  roll=lambda p: 0.34 * np.sin(2 * np.pi * 3 * p + 0.4))]
    return Animal('boxfish', body, [dorsal, anal, tail, *with_mirror(pectoral)], EYE, fish_eye('#b98a26', '#f0e6b0', 0.46),
                  paint_body(body, pectoral), clips, around=19, fin_size=(256, 256))
