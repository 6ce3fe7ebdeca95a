"""A whole animal, written as glTF: an opaque body with its eyes, one primitive; fins, one more if they are translucent."""

from dataclasses import dataclass, field

import numpy as np

import paint
from body import Body
from eyes import eye_part
from fins import fin_pictures
from glb import Glb
from mesh import join, mirrored, unit
from motion import add_clip
from rig import Rig, SPINE_S

EYE_TEXELS = 64
PAD = 6  # texels around a tile that repeat its edge, for the smaller mip levels


class Sheet:
    """The body's pictures: its skin above, a strip of tiles below. Colours sRGB, G roughness, B metallic."""

    def __init__(self, skin, height):
        colour, normal, gloss = skin
        self.rows, self.width = colour.shape[:2]
        self.height = height

        def grown(picture):
            return np.concatenate([picture, np.repeat(picture[-1:], height - self.rows, 0)])
        self.colour, self.normal, self.gloss = grown(colour), grown(normal), grown(gloss)

    @property
    def skin_tile(self):
        return np.array([0, 0, 1, self.rows / self.height])

    def add(self, x, colour, normal=None, rough=0.45, metal=0.0):
        """Puts a tile into the strip at column x. Returns its rectangle: u, v, width, height in 0..1."""
        h, w = colour.shape[:2]
        y = self.rows + PAD * 2
        flat = np.broadcast_to([0.5, 0.5, 1.0], colour.shape)
        gloss = np.broadcast_to([1.0, rough, metal], colour.shape)
        for sheet, tile in ((self.colour, colour), (self.normal, flat if normal is None else normal),
                            (self.gloss, gloss)):
            padded = np.pad(tile, ((PAD, PAD), (PAD, PAD), (0, 0)), 'edge')
            sheet[y - PAD:y + h + PAD, x - PAD:x + w + PAD] = padded[:self.height - y + PAD]
        return np.array([x / self.width, y / self.height, w / self.width, h / self.height])


def placed(part, tile):
    """The part with its uv, 0..1, squeezed into the tile."""
    part.uvs = tile[:2] + part.uvs * tile[2:]
    return part


@dataclass
class Animal:
    name: str
    body: Body
    fins: list
    eye: tuple               # s, h, radius, in fractions of the length
    eye_picture: np.ndarray
    skin: tuple              # body pictures: colour, normal, metal_rough
    clips: list              # dicts for add_clip
    height: int = 512        # of the body's pictures with the strip
    rings: int = 36
    around: int = 17
    fin_size: tuple = (512, 256)
    fin_rough: float = 0.42
    thick_fins: bool = False  # opaque foils, painted into the strip, as sharks have
    spine: tuple = SPINE_S
    centre: float = 0.5      # s of the model's origin
    extra_joints: list = field(default_factory=list)
    extra_parts: list = field(default_factory=list)  # (part with uv 0..1, colour tile), in the strip too

    def rig(self):
        joints, known = list(self.extra_joints), {e[0] for e in self.extra_joints}
        for fin in self.fins:
            if not fin.joint or fin.joint in known:
                continue
            middle = fin.root[len(fin.root) // 2] * ([-1, 1, 1] if fin.mirror else [1, 1, 1])
            parent = int(np.searchsorted(self.spine, 0.5 - middle[2] / self.body.length)) - 1
            joints.append((fin.joint, max(parent, 0), middle))
        return Rig(self.body.length, self.spine, joints)

    def eyes(self):
        s, h, r = self.eye
        centre, outward = self.body.on_side(s, h)
        outward = unit(outward + [0.25, 0.0, 0.12])  # eyes look a little more sideways and ahead than the skin's normal
        left = eye_part(centre - outward * 0.18 * r * self.body.length, outward, r * self.body.length)
        return join([left, mirrored(left)])

    def write(self, path):
        """Returns the file's size, and how many triangles and vertices it has."""
        rig, sheet = self.rig(), Sheet(self.skin, self.height)
        skin = placed(rig.bind(self.body.part(self.rings, self.around)), sheet.skin_tile)
        eyes = placed(self.eyes(), sheet.add(PAD, self.eye_picture, rough=0.30))
        rig.bind_rigid(eyes, 0)
        opaque, column = [skin, eyes], 3 * PAD + self.eye_picture.shape[1]
        for part, tile in self.extra_parts:
            opaque.append(placed(rig.bind(part), sheet.add(column, tile)))
            column += tile.shape[1] + 2 * PAD
        fins = join([rig.bind_fin(fin.part(), fin.joint) for fin in self.fins]) if self.fins else None

        glb = Glb()
        if self.thick_fins:
            self.paint_into(sheet)
            opaque.append(fins)
        body_material = glb.material('skin', glb.texture(paint.jpeg(sheet.colour, 91)),
                                     glb.texture(paint.jpeg(sheet.normal, 88)),
                                     glb.texture(paint.jpeg(paint.shrink(sheet.gloss, 2), 88)))
        primitives = [glb.primitive(join(opaque), body_material)]
        counted = list(opaque)
        if fins and not self.thick_fins:
            width, height = self.fin_size
            picture = np.zeros((height, width, 4))
            relief = np.ones((height, width, 3)) * [0.5, 0.5, 1.0]
            fin_pictures(self.fins, width, height, picture, relief)
            material = glb.material('fins', glb.texture(paint.png(paint.bled(picture))),
                                    glb.texture(paint.jpeg(relief, 88)), rough=self.fin_rough, metal=0.0, blend=True)
            primitives.append(glb.primitive(fins, material))
            counted.append(fins)
        nodes, skin_index = rig.add_nodes(glb, (self.centre - 0.5) * self.body.length)
        glb.node(self.name, mesh=glb.mesh(self.name, primitives), skin=skin_index)
        for clip in self.clips:
            add_clip(glb, rig, nodes, **clip)
        return glb.save(path), sum(len(p.triangles) for p in counted), sum(len(p.positions) for p in counted)

    def paint_into(self, sheet):
        """Fins as tiles of the strip: their rectangles are fractions of the whole sheet."""
        picture = np.concatenate([sheet.colour, np.ones(sheet.colour.shape[:2] + (1,))], -1)
        fin_pictures(self.fins, sheet.width, sheet.height, picture, sheet.normal)
        sheet.colour = picture[..., :3]
        sheet.gloss[sheet.rows + PAD * 3 + self.eye_picture.shape[0]:, :, 1:] = [self.fin_rough, 0]
