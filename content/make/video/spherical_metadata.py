#!/usr/bin/env python3
"""Marks an MP4 as a mono lat-long 360-degree video: Google's spherical metadata V1 and V2.

    spherical_metadata.py IN.mp4 OUT.mp4

V1 is a uuid box with RDF in the video's trak; V2 are the boxes st3d and sv3d in its sample entry. Where moov lies before
mdat, the chunk offsets grow by what was added.
"""
import os
import struct
import sys

V1_ID = bytes.fromhex("ffcc8263f8554a938814587a02521fdd")
V1_TEXT = b"""<?xml version="1.0"?><rdf:SphericalVideo
xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
xmlns:GSpherical="http://ns.google.com/videos/1.0/spherical/"><GSpherical:Spherical>true</GSpherical:Spherical>\
<GSpherical:Stitched>true</GSpherical:Stitched><GSpherical:StitchingSoftware>Shoal</GSpherical:StitchingSoftware>\
<GSpherical:ProjectionType>equirectangular</GSpherical:ProjectionType></rdf:SphericalVideo>"""


def box(kind, body):
    return struct.pack(">I4s", 8 + len(body), kind) + body


def boxes(data):
    """(kind, body) of each box in data, in order."""
    at = 0
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        header = 8
        if size == 1:
            size, header = struct.unpack_from(">Q", data, at + 8)[0], 16
        elif size == 0:
            size = len(data) - at
        yield kind, data[at + header:at + size]
        at += size


def v2():
    full = b"\0\0\0\0"
    st3d = box(b"st3d", full + b"\0")  # mono
    projection = box(b"prhd", full + struct.pack(">iii", 0, 0, 0)) + box(b"equi", full + struct.pack(">IIII", 0, 0, 0, 0))
    return st3d + box(b"sv3d", box(b"svhd", full + b"Shoal\0") + box(b"proj", projection))


def mark(kind, body, within_video, grow):
    """The box again, with metadata added to the video's trak and chunk offsets grown by `grow`."""
    if kind == b"trak":
        within_video = b"vide" in body
    if kind in (b"moov", b"trak", b"mdia", b"minf", b"stbl"):
        body = b"".join(mark(k, b, within_video, grow) for k, b in boxes(body))
        if kind == b"trak" and within_video:
            body += box(b"uuid", V1_ID + V1_TEXT)
    elif kind == b"stsd" and within_video:
        (entry_kind, entry), = list(boxes(body[8:]))
        body = body[:8] + box(entry_kind, entry + v2())
    elif kind == b"stco":
        count, = struct.unpack_from(">I", body, 4)
        offsets = struct.unpack_from(f">{count}I", body, 8)
        body = body[:8] + struct.pack(f">{count}I", *(o + grow for o in offsets))
    elif kind == b"co64":
        count, = struct.unpack_from(">I", body, 4)
        offsets = struct.unpack_from(f">{count}Q", body, 8)
        body = body[:8] + struct.pack(f">{count}Q", *(o + grow for o in offsets))
    return box(kind, body)


def main(source, target):
    data = open(source, "rb").read()
    top = list(boxes(data))
    kinds = [kind for kind, _ in top]
    moov = dict(top)[b"moov"]
    added = len(mark(b"moov", moov, False, 0)) - len(box(b"moov", moov))
    grow = added if kinds.index(b"moov") < kinds.index(b"mdat") else 0
    with open(target + ".part", "wb") as out:
        for kind, body in top:
            out.write(mark(kind, body, False, grow) if kind == b"moov" else box(kind, body))
    os.replace(target + ".part", target)


if __name__ == "__main__":
    main(*sys.argv[1:])
