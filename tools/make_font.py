#!/usr/bin/env python3
"""Writes src/render/font_outlines.inc: the outlines of a TrueType font's letters, for the legends of pictures.

Usage: make_font.py FONT.ttf [OUTPUT]. Needs fontTools. Made from DejaVu Sans 2.37; its licence lies beside the output.
"""
import sys
from pathlib import Path

from fontTools.pens.basePen import decomposeQuadraticSegment
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

CHARACTERS = [*range(0x20, 0x7F), *range(0xA1, 0xAD), *range(0xAE, 0x100), 0x2026]


def segments(font, name):
    """Quadratic curves as six numbers each; lines are curves whose middle point is their first."""
    pen = DecomposingRecordingPen(font.getGlyphSet())
    font.getGlyphSet()[name].draw(pen)
    start = at = None
    for operator, points in pen.value:
        if operator == "moveTo":
            start = at = points[0]
        elif operator == "lineTo":
            yield (*at, *at, *points[0])
            at = points[0]
        elif operator == "qCurveTo":
            assert points[-1] is not None, "a contour without a point on it"
            for middle, end in decomposeQuadraticSegment(points):
                yield (*at, *middle, *end)
                at = end
        elif operator == "closePath" and at != start:
            yield (*at, *at, *start)


def main():
    font = TTFont(sys.argv[1])
    output = Path(sys.argv[2]) if len(sys.argv) > 2 else Path(__file__).parent.parent / "src/render/font_outlines.inc"
    names, metrics, head = font.getBestCmap(), font["hmtx"], font["hhea"]
    glyphs, curves = [], []
    for code in CHARACTERS:
        first = len(curves)
        curves.extend(segments(font, names[code]))
        glyphs.append((code, metrics[names[code]][0], first, len(curves) - first))
    lines = ["// Made by tools/make_font.py from DejaVu Sans 2.37; licence: font_LICENSE.md. Units: 1 / kUnitsPerEm of the letters' size, y up.",
             f"constexpr int kUnitsPerEm = {font['head'].unitsPerEm}, kAscent = {head.ascent}, kDescent = {-head.descent};",
             "// Unicode code, advance, first curve, number of curves; ascending.", "constexpr Glyph kGlyphs[] = {"]
    lines += [f"    {{{code}, {advance}, {first}, {count}}}," for code, advance, first, count in glyphs]
    lines += ["};", "// Begin, middle and end of each quadratic curve.", "constexpr std::int16_t kCurves[][6] = {"]
    lines += ["    {" + ", ".join(str(round(x)) for x in curve) + "}," for curve in curves]
    output.write_text("\n".join([*lines, "};", ""]))


if __name__ == "__main__":
    main()
