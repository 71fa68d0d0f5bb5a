# SPDX-License-Identifier: GPL-3.0-or-later
"""panels.py OUT.png WxH PICTURE LABEL...: pictures beside each other, two in a row, each with a label, in few colours."""
import sys

from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
GAP = 4
COLOURS = 200
FEW_COLOURS = 90  # of several panels: more make files of twice the size and show nothing else

width, height = (int(n) for n in sys.argv[2].split("x"))
panels = list(zip(sys.argv[3::2], sys.argv[4::2]))
columns = min(2, len(panels))
rows = -(-len(panels) // columns)
sheet = Image.new("RGB", (columns * (width + GAP) - GAP, rows * (height + GAP) - GAP), "white")
for i, (picture, label) in enumerate(panels):
    corner = (i % columns * (width + GAP), i // columns * (height + GAP))
    sheet.paste(Image.open(picture).convert("RGB").resize((width, height), Image.LANCZOS), corner)
    if label:
        ImageDraw.Draw(sheet).text((corner[0] + 10, corner[1] + height - 8), label, "black",
                                   ImageFont.truetype(FONT, 18), anchor="ls")
sheet.quantize(FEW_COLOURS if len(panels) > 1 else COLOURS, dither=Image.Dither.NONE).save(sys.argv[1], optimize=True)
