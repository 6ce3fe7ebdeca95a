"""A diving glove, painted in space as the skin is: knitted neoprene, seams along the fingers, a palm that grips."""

import numpy as np

import paint
from hand_shape import FINGERS
from paint import bump, mix, rgb, step


class Glove:
    def __init__(self, hand):
        self.hand = hand

    def seams(self, p, n_up):
        """1 on a seam: along both sides of every finger, and around each finger's root."""
        total, hand = np.zeros(len(p)), self.hand
        for finger in FINGERS:
            chain = hand.chain(finger)
            for k in chain[1:-1]:
                q = hand.local(hand.names[k], p)
                r = hand.radii[k]
                length = np.linalg.norm(hand.positions[k + 1] - hand.positions[k])
                on = step(2.0 * r, 1.5 * r, np.hypot(q[:, 0], q[:, 1])) * step(0.25 * r, 0, q[:, 2]) * step(-1.1 * length, -0.95 * length, q[:, 2])
                total = np.maximum(total, on * bump(q[:, 1], 0.0009) * step(0.4 * r, 0.7 * r, np.abs(q[:, 0])))
        return total

    def grip(self, p, n_up):
        """1 on the raised dots of palm and fingers."""
        d = paint.cells(301, p[:, 0] / 0.0042, p[:, 2] / 0.0042, 0.0)[0]
        return step(0.34, 0.24, d) * step(-0.35, -0.65, n_up) * step(0.015, 0.0, p[:, 2])

    def relief(self, p, n_up):
        """Metres above the smooth solid."""
        x, y, z = p.T
        knit = np.sin(x * 5200) * np.sin(z * 5200 + 1.5 * np.sin(x * 2600)) + np.sin(y * 5200) * 0.5
        folds = paint.noise(302, x * 60, y * 60, z * 420) * step(0.2, 0.5, np.abs(paint.noise(303, *(p.T * 45))))
        seam = self.seams(p, n_up)
        return 0.000020 * knit + 0.00007 * folds - 0.00040 * seam + 0.00022 * bump(seam - 0.45, 0.2) + 0.00035 * self.grip(p, n_up)

    def colours(self, p, n_up):
        wear = paint.fbm(304, *(p.T * 90), octaves=4)
        c = mix(rgb('#23282c'), rgb('#343b40'), step(-0.4, 0.6, wear))
        panel = step(0.12, 0.30, n_up) * step(0.012, 0.004, p[:, 2]) * step(-0.108, -0.098, p[:, 2])
        c = mix(c, rgb('#1f4a63') * (1 + 0.10 * wear)[:, None], 0.9 * panel)
        c = mix(c, rgb('#0d0f11'), 0.75 * self.seams(p, n_up))
        c = mix(c, rgb('#111416'), 0.80 * self.grip(p, n_up))
        return {'glove': c * (1 + 0.05 * paint.noise(305, *(p.T * 700)))[:, None]}

    def rough(self, p, n_up):
        return 0.60 - 0.10 * self.grip(p, n_up) + 0.04 * paint.noise(306, *(p.T * 400))
