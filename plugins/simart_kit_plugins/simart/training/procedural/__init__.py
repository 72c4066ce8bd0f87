"""Made-up household objects: as many shapes as a training run wants, from a seed."""

from .generate import object_grids, procedural_grids
from .shapes import procedural_object

__all__ = ["object_grids", "procedural_grids", "procedural_object"]
