"""The process that draws a preview: reads an asset's folder from stdin, and writes `preview.png` there."""

from __future__ import annotations

import os
import sys
from importlib import import_module
from pathlib import Path

from ..asset_io import load_asset
from ..render import write_preview

# What drawing imports, which takes as long as a picture: it is there when the folder comes.
_NEEDED = ("simart_kit.drawing.preview", "embreex.mesh_construction", "PIL.ImageDraw", "PIL.ImageFont")


def main() -> None:
    """Draw one preview; with nothing to draw, end."""
    for module in _NEEDED:
        import_module(module)
    folder = os.fsdecode(sys.stdin.buffer.read())
    if folder:
        write_preview(load_asset(folder), Path(folder) / "preview.png")


if __name__ == "__main__":
    main()
