"""The sheet of tests/bench/panoramas: sheet.py FOLDER [PHOTO ...]. FOLDER holds what bench_panorama wrote."""

import subprocess
import sys
from pathlib import Path

from PIL import Image, ImageDraw

ROOT = Path(__file__).resolve().parents[3]
SHOAL = ROOT / 'build/release/game/shoal'
FISH = ROOT / 'content/models/snapper.glb'
WIDE, SIDE = (684, 342), 186     # pixels: a surround, a view
VIEWS = [('ahead', 0, 90), ('right', -90, 90), ('behind', 180, 90), ('left', 90, 90), ('down', 0, 20), ('up', 0, 160)]
MOST_BYTES = 400_000


def view(surround, scratch, size, *more):
    subprocess.run([SHOAL, 'view', FISH, '--photo', surround, '--layout', 'mono', '--size', f'{size[0]}x{size[1]}',
                    '--out', scratch, *map(str, more)], check=True, stdout=subprocess.DEVNULL)
    return Image.open(scratch).convert('RGB')


def titled(picture, words):
    draw = ImageDraw.Draw(picture)
    draw.text((7, 5), words, fill='black')
    draw.text((6, 4), words, fill='white')
    return picture


def rows_of(name, photo, folder):
    """Two rows: photo, stretched, grown; then what is seen from within."""
    grown, stretched, scratch = folder / f'{name}.png', folder / f'{name}_stretched.png', folder / 'scratch.png'
    Image.open(photo).convert('RGB').resize((2048, 1024), Image.LANCZOS).save(stretched)
    small = Image.open(photo).convert('RGB')
    small.thumbnail(WIDE, Image.LANCZOS)
    first = [titled(small, f'{name}: the photo')]
    first += [titled(Image.open(f).convert('RGB').resize(WIDE, Image.LANCZOS), words)
              for f, words in ((stretched, 'stretched'), (grown, 'grown'))]
    second = [titled(view(f, scratch, (2 * SIDE, SIDE), '--orbit', '-55,84,0.55', '--fov', '40'), f'lit by the {words}')
              for f, words in ((stretched, 'stretched'), (grown, 'grown'))]
    # A fish too far away to be seen: the camera looks past it.
    second += [titled(view(grown, scratch, (SIDE, SIDE), '--fov', '90', f'--orbit={theta},{phi},2000'), words)
               for words, theta, phi in VIEWS]
    scratch.unlink()
    return [first, second]


def page(rows):
    width = max(sum(p.width for p in row) for row in rows)
    sheet, y = Image.new('RGB', (width, sum(max(p.height for p in row) for row in rows))), 0
    for row in rows:
        x = 0
        for picture in row:
            sheet.paste(picture, (x, y))
            x += picture.width
        y += max(p.height for p in row)
    return sheet


def main():
    folder = Path(sys.argv[1])
    photos = {name: folder / f'{name}_photo.jpg' for name in ('beach', 'forest')}
    photos |= {Path(photo).stem: Path(photo) for photo in sys.argv[2:]}
    sheet = page([row for name, photo in photos.items() for row in rows_of(name, photo, folder)])
    out = folder / 'panoramas.jpg'
    for quality in range(90, 30, -5):
        sheet.save(out, quality=quality)
        if out.stat().st_size <= MOST_BYTES:
            break
    print(out)


main()
