"""Building blocks of the sounds of the sea: noise, bands, swishes, bubbles, struck bars, the reverberation of the water.

Times in seconds, frequencies in hertz, radii in metres; 48 kHz. Every source of chance is seeded by its caller.
"""
import numpy as np

RATE = 48000


def time(seconds):
    return np.arange(int(round(seconds * RATE))) / RATE


def noise(seconds, seed):
    return np.random.default_rng(seed).standard_normal(int(round(seconds * RATE)))


def unit(x):
    """Scaled to a root mean square of 1."""
    return x / np.sqrt(np.mean(x * x))


def band(x, low, high, slope=2.0):
    """Band-pass without phase, in the frequency domain: periodic, so a loop stays a loop."""
    f = np.fft.rfftfreq(len(x), 1 / RATE)
    gain = 1 / (1 + (low / np.maximum(f, 1e-3)) ** (2 * slope)) / (1 + (f / high) ** (2 * slope))
    return np.fft.irfft(np.fft.rfft(x) * gain, len(x))


def fade(x, attack, release):
    """Raised-cosine ends: starts and ends in silence."""
    t = np.arange(len(x)) / RATE
    ends = np.clip(t / attack, 0, 1) * np.clip((len(x) / RATE - t) / release, 0, 1)
    return x * np.sin(0.5 * np.pi * ends) ** 2


def add(out, x, at, wrap=False):
    """x added to out from time `at`; what goes beyond the end is lost, or comes round to the start."""
    first = int(round(at * RATE))
    if wrap:
        np.add.at(out, (first + np.arange(len(x))) % len(out), x)
    elif first < len(out):
        end = min(len(out), first + len(x))
        out[first:end] += x[:end - first]


def swish(seconds, peak, layers, seed):
    """Water parted by something that goes by. layers: (low, high, width, gain); narrow bright layers over wide dark ones
    make it brighten as it comes and dull as it goes. Quicker to come than to go, as what passes has its wake behind it."""
    t = time(seconds)
    out = np.zeros(len(t))
    for i, (low, high, width, gain) in enumerate(layers):
        side = np.where(t < peak, 1.0, 1.6)
        out += gain * unit(band(noise(seconds, seed * 100 + i), low, high)) * np.exp(-((t - peak) / (width * side)) ** 2)
    return out


def bubble(radius, rise=0.1, depth=1.0):
    """A bubble rings at 3.26 / radius (Minnaert 1933), at 1 m of depth a little higher; it dies away as 0.13 / r +
    0.0072 r^-1.5 per second and rises in pitch with that rate (van den Doel 2005, "Physically-based models for liquid
    sounds"); a large one is louder, as r^1.5."""
    f = 3.26 / radius * np.sqrt(1 + depth / 10)
    damping = 0.13 / radius + 0.0072 * radius ** -1.5
    t = time(min(0.4, 7 / damping))
    phase = 2 * np.pi * f * (t + 0.5 * rise * damping * t * t)
    ring = np.sin(phase) * np.exp(-damping * t) * np.clip(t * f, 0, 1)  # the neck snaps within one period
    return ring * (radius / 0.003) ** 1.5 * np.clip((t[-1] - t) / 0.002, 0, 1)


def bubbles_at(out, times, seed, low, high, rise=0.1, wrap=False):
    """A bubble at each time; small ones are the many (log-uniform radii)."""
    random = np.random.default_rng(seed)
    for at in times:
        radius = low * (high / low) ** random.random()
        add(out, bubble(radius, rise * random.uniform(0.5, 1.8)) * random.uniform(0.3, 1), at, wrap)
    return out


def bar(f, seconds, warmth=1.0):
    """A marimba's bar: tuned partials 1 : 3.93 : 9.2, the upper ones short; the tube below sings on the first."""
    t = time(seconds)
    x = np.zeros(len(t))
    for ratio, gain, decay in ((1, 1, 0.42), (3.93, 0.2, 0.1), (9.2, 0.05, 0.03)):
        x += gain * np.sin(2 * np.pi * f * ratio * t) * np.exp(-t / (decay * (300 / f) ** 0.35))
    x += 0.25 * warmth * np.sin(2 * np.pi * f * 0.5 * t) * np.exp(-t / 0.5)
    return x * np.clip(t / 0.003, 0, 1) * np.clip((seconds - t) / (0.3 * seconds), 0, 1)


def phrase(seconds, notes, length):
    """Bars struck: (time, frequency, gain)."""
    out = np.zeros(len(time(seconds)))
    for at, f, gain in notes:
        add(out, bar(f, length) * gain, at)
    return out


def answer(x, seconds, low, high, wet, seed, wrap=False):
    """x with the answer of the water: it comes back from all around, dying away (noise under an exponential)."""
    tail = band(noise(seconds, seed), low, high) * np.exp(-time(seconds) / (seconds / 5))
    tail /= np.sqrt(np.sum(tail * tail))
    n = len(x) if wrap else 2 ** int(np.ceil(np.log2(len(x) + len(tail))))
    return x + wet * np.fft.irfft(np.fft.rfft(x, n) * np.fft.rfft(tail, n), n)[:len(x)]
