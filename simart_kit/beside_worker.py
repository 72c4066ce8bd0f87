"""The process beside: calls the functions that it reads from stdin, and writes what they return to stdout.

What one of them raises ends it; the caller then calls that one itself, and sees.
"""

from __future__ import annotations

import os
import pickle
import sys
from importlib import import_module

# What drawing, shaping and sweeping import, which takes as long as a picture: it is there when they begin.
_NEEDED = (
    "simart_kit.drawing.preview",
    "embreex.mesh_construction",
    "PIL.ImageDraw",
    "PIL.ImageFont",
    "simart_kit.waiting",
    "simart_kit.decompose",
    "manifold3d",
    "scipy.spatial",
)


def main() -> None:
    """Answer until nobody asks any more."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a function prints is no answer
    for module in _NEEDED:
        import_module(module)
    while True:
        try:
            asked = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        pickle.dump(asked(), answers, pickle.HIGHEST_PROTOCOL)
        answers.flush()


if __name__ == "__main__":
    main()
