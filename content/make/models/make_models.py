#!/usr/bin/python3
"""Makes content/models/*.glb: every animal, both hands, both arms and every loose thing. Same program, same bytes.

Usage: make_models.py [NAME ...] [--out FOLDER]. Needs Python 3, numpy and Pillow.
"""

import argparse
import importlib
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

ANIMALS = ('clownfish', 'angelfish', 'snapper', 'sardine', 'boxfish', 'idol', 'ray', 'shark', 'jellyfish', 'humpback')
HANDS = ('hand_left', 'hand_right')
ARMS = ('arm_left', 'arm_right')
THINGS = ('mussel', 'stone', 'bottle')
ALL = ANIMALS + HANDS + ARMS + THINGS


def main():
    models = HERE.parent.parent / 'models'
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('names', nargs='*', metavar='NAME', help=', '.join(ALL))
    parser.add_argument('--out', type=Path, default=models, help='folder of the .glb files')
    options = parser.parse_args()
    unknown = set(options.names) - set(ALL)
    if unknown:
        parser.error(f'unknown: {", ".join(sorted(unknown))}')
    wanted = options.names or ALL
    options.out.mkdir(parents=True, exist_ok=True)

    def report(name, started, size, triangles, vertices):
        print(f'{name}: {triangles} triangles, {vertices} vertices, {size / 1e6:.2f} MB, '
              f'{time.monotonic() - started:.1f} s')

    for name in wanted:
        started = time.monotonic()
        if name in ANIMALS + THINGS:
            made = importlib.import_module(f'{"species" if name in ANIMALS else "things"}.{name}').make()
            report(name, started, *made.write(options.out / f'{name}.glb'))
    hands = [name for name in wanted if name in HANDS]
    if hands:
        started = time.monotonic()
        import hands as maker
        for name, *figures in maker.write(options.out, models / 'hand_skeleton.json', hands):
            report(name, started, *figures)
    arms = [name for name in wanted if name in ARMS]
    if arms:
        started = time.monotonic()
        import arms as maker
        for name, *figures in maker.write(options.out, arms):
            report(name, started, *figures)


if __name__ == '__main__':
    main()
