"""Loudness as ITU-R BS.1770 measures it, and the levels that sounds leave with."""
import numpy as np

from synth import RATE

PEAK = 10 ** (-3.2 / 20)  # the highest sample; -3 dB with a little room for rounding


def weight(x):
    """K-weighted: BS.1770-4's two biquads for 48 kHz, as gains on the spectrum."""
    n = len(x)
    z = np.exp(-2j * np.pi * np.fft.rfftfreq(n))

    def biquad(b, a):
        return np.abs((b[0] + b[1] * z + b[2] * z * z) / (1 + a[0] * z + a[1] * z * z))

    gain = biquad((1.53512485958697, -2.69169618940638, 1.19839281085285), (-1.69065929318241, 0.73248077421585))
    gain *= biquad((1, -2, 1), (-1.99004745483398, 0.99007225036621))
    return np.fft.irfft(np.fft.rfft(x) * gain, n)


def loudness(channels, loop):
    """LUFS: of a loop over all of it, of a single sound its loudest 400 ms."""
    power = 0
    for x in channels:
        k = weight(x if loop else np.concatenate((x, np.zeros(RATE // 2)))) ** 2
        if loop:
            power += np.mean(k)
        else:
            sums = np.concatenate(((0,), np.cumsum(k)))
            window = int(0.4 * RATE)
            power += np.max(sums[window:] - sums[:-window]) / window
    return -0.691 + 10 * np.log10(power)


def master(channels, target, loop):
    """Brought to `target` LUFS; less where the peak would go above PEAK (deep sounds weigh little)."""
    gain = 10 ** ((target - loudness(channels, loop)) / 20)
    gain = min(gain, PEAK / max(np.max(np.abs(x)) for x in channels))
    return [x * gain for x in channels]
