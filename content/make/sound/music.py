"""The music of the dives: a theme for each site, in two layers of LENGTH seconds that play in step, each a loop.

`calm` has pads and a few struck notes, `tension` a low pulse and a close chord that swells; both are of one key and tempo.
All themes use the notes of G major, in which `catch` and `dive_over` stand. Every note may reach beyond the end, where it
comes round to the start, so that a layer loops without a seam. Notes are semitones above G2.
"""
import numpy as np

from synth import RATE, add, answer, band, bar, time

LENGTH = 32
G2 = 97.999


def pitch(note):
    return G2 * 2 ** (note / 12)


def pad(out, note, at, seconds, gain, side, bright):
    """A soft held tone: partials, of which each has two voices a little apart, other ones at each ear; the upper ones come
    later and go earlier."""
    t = time(seconds)
    random = np.random.default_rng(1000 + 10 * note + side)
    x = np.zeros(len(t))
    for k in range(1, 8):
        swell = np.sin(np.pi * t / seconds) ** (1 + 0.4 * k)
        for voice, share in ((-1, 1), (1, 0.6)):  # unequal, so that their beats are shallow
            f = pitch(note) * k * (1 + voice * random.uniform(0.0006, 0.0016))
            x += share * swell * bright ** (k - 1) / k * np.sin(2 * np.pi * (f * t + random.random()))
    add(out, gain * x, at, wrap=True)


def bell(out, note, at, gain, side, pan, decay):
    """Softly on glass, as `collect` has it, or where it decays fast on wood."""
    f = pitch(note)
    if decay < 1:
        x = bar(f, 2.5, 0.5)
    else:
        t = time(2.5 * decay)
        partials = ((1, 1, 1), (1.003, 0.6, 1.1), (2.32, 0.12, 0.4), (4.25, 0.03, 0.15))
        x = sum(g * np.sin(2 * np.pi * ratio * f * t) * np.exp(-t / (decay * share)) for ratio, g, share in partials)
        x *= np.clip(t / 0.02, 0, 1) * np.clip((t[-1] - t) / 0.5, 0, 1)
    level = np.cos(pan * np.pi / 2) if side == 0 else np.sin(pan * np.pi / 2)
    add(out, gain * level * x, at, wrap=True)


def calm(beats, chords, melody, bright, decay):
    """chords: notes of each, held for equal times and over into the next. melody: (beat, note, gain)."""
    hold = LENGTH / len(chords)
    channels = []
    for side in (0, 1):
        out = np.zeros(LENGTH * RATE)
        for i, chord in enumerate(chords):
            for k, note in enumerate(chord):
                pad(out, note, (i - 0.35) * hold % LENGTH, 1.7 * hold, 0.5 / (1 + 0.25 * k), side, bright)
        struck = np.zeros(LENGTH * RATE)
        for i, (beat, note, gain) in enumerate(melody):
            bell(struck, note, beat * LENGTH / beats, gain, side, (0.3, 0.7, 0.45, 0.6)[i % 4], decay)
        out += 0.8 * answer(band(struck, 80, 4000, 1.5), 4, 200, 3000, 0.8, 300 + side, wrap=True)
        channels.append(band(out, 60, 5000, 1.5))
    return channels


def tension(beats, root, close):
    """A drum's two soft beats, as a heart's, every second beat of the music; a close chord that swells four times."""
    channels = []
    step = LENGTH / beats
    for side in (0, 1):
        out = np.zeros(LENGTH * RATE)
        t = time(1.6)
        f = pitch(root)
        # The overtones tell of it where small speakers have no bass.
        drum = sum(g * np.sin(2 * np.pi * f * k * t) * np.exp(-t / d) for k, g, d in ((1, 0.7, 0.4), (2, 0.8, 0.3), (3, 0.4, 0.2)))
        drum *= np.clip(t / 0.03, 0, 1) ** 2 * np.clip((1.6 - t) / 0.4, 0, 1)
        for beat in range(0, beats, 2):
            add(out, drum, beat * step, wrap=True)
            add(out, 0.55 * drum, (beat + 0.4) * step, wrap=True)
        for quarter in range(4):
            for note in close:
                pad(out, note, (quarter + 0.12) * LENGTH / 4, 0.88 * LENGTH / 4, 0.12, side, 0.55)
        channels.append(band(answer(out, 2, 80, 1500, 0.25, 310 + side, wrap=True), 35, 3000, 1.5))
    return channels


def music_reef_calm():
    """G major with ninths, light: glass in the pentatonic scale. 60 beats a minute."""
    chords = ((0, 7, 16, 21, 26), (5, 12, 16, 23, 26), (-3, 9, 16, 19, 23), (-5, 7, 14, 21, 24))
    melody = ((2, 31, 0.5), (3.5, 33, 0.35), (5, 28, 0.45), (10, 26, 0.5), (11, 31, 0.4), (13.5, 35, 0.3), (18, 28, 0.5),
              (20, 33, 0.35), (21, 31, 0.4), (26, 26, 0.5), (27.5, 28, 0.35), (29, 24, 0.3))
    return calm(32, chords, melody, 0.5, 1.4)


def music_reef_tension():
    return tension(32, -12, (11, 12, 17))


def music_kelp_calm():
    """E minor, warm and low, as dusk: wood. 45 beats a minute."""
    chords = ((-3, 4, 12, 19, 23), (2, 9, 12, 17, 21), (5, 12, 14, 16, 23), (4, 7, 11, 14, 21))
    melody = ((1, 21, 0.6), (2, 23, 0.5), (4.5, 16, 0.5), (7, 21, 0.5), (8, 26, 0.4), (9.5, 23, 0.4), (13, 19, 0.6),
              (14, 23, 0.45), (16, 16, 0.5), (19, 14, 0.5), (20, 19, 0.45), (22, 21, 0.35))
    return calm(24, chords, melody, 0.4, 0.5)


def music_kelp_tension():
    return tension(24, -15, (16, 17, 23))


def music_night_calm():
    """A dorian, wide and dark: few notes, each long. 37.5 beats a minute."""
    chords = ((-10, 2, 9, 17, 23), (-8, 4, 11, 14, 21), (-12, 5, 12, 16, 23), (-10, 2, 9, 14, 21))
    melody = ((1.5, 33, 0.35), (3, 28, 0.4), (7, 29, 0.35), (9.5, 35, 0.25), (12.5, 33, 0.3), (13.5, 26, 0.4), (17, 28, 0.35))
    return calm(20, chords, melody, 0.35, 2.5)


def music_night_tension():
    return tension(20, -10, (16, 17, 21))


CALM = (music_reef_calm, music_kelp_calm, music_night_calm)
TENSION = (music_reef_tension, music_kelp_tension, music_night_tension)
