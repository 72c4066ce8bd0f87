"""What things are made of: the material table with its sources, and how thick its walls usually are."""

from __future__ import annotations

from dataclasses import dataclass

from .asset import Material

DEFAULT_MATERIAL = "wood"

# Friction in the table is sliding, dry, against hard smooth things. Restitution is our own estimate: balls
# rebound with 0.6 to 0.8 [PF], but furniture lands on edges and rattles, so about a third of that.
SOURCES: dict[str, str] = {
    "EC1": "EN 1991-1-1:2002, tables A.1 to A.4 (densities)",
    "EC3": "EN 1993-1-1:2005, 3.2.6 (steel)",
    "EC9": "EN 1999-1-1:2007, 3.2.5 (aluminium)",
    "EC2": "EN 1992-1-1:2004, table 3.1 (concrete)",
    "EN572": "EN 572-1:2012 (soda-lime glass)",
    "HRW": "Halliday, Resnick, Walker: Fundamentals of Physics, 5th edition, table 13-1 (elastic properties)",
    "WH": "Wood Handbook, FPL-GTR-190, Forest Products Laboratory 2010, chapter 5",
    "MIF": "makeitfrom.com, medium density fiberboard, after the Wood Handbook of 1999",
    "SJ": "Serway, Jewett: Physics for Scientists and Engineers, coefficients of friction",
    "Marks": "Marks' Standard Handbook for Mechanical Engineers, coefficients of friction",
    "ETB": "engineeringtoolbox.com, tables of friction coefficients and of Young's moduli",
    "PF": "Elert: The Physics Factbook, coefficients of restitution",
    "MP": "material-properties.org, porcelain",
    "own": "our own estimate",
}


@dataclass(frozen=True, slots=True)
class Build:
    """How things of a material are usually built.

    Attributes:
        wall: thickness of a board, sheet or wall [m].
        solid_up_to: mean thickness up to which things are solid [m]; thicker ones are hollow.
    """

    wall: float
    solid_up_to: float


@dataclass(frozen=True, slots=True)
class Entry:
    """A row of the material table.

    Attributes:
        material: its physical properties.
        build: how things of it are built, by common products.
        sources: where density, Young's modulus and friction come from: keys of `SOURCES`.
    """

    material: Material
    build: Build
    sources: tuple[str, str, str]


def _entry(
    name: str,
    density: float,
    friction: float,
    restitution: float,
    gigapascal: float,
    millimetres: tuple[float, float],
    sources: tuple[str, str, str],
) -> Entry:
    wall, solid_up_to = (length / 1000 for length in millimetres)
    material = Material(name, density, friction, restitution, gigapascal * 1e9)
    return Entry(material, Build(wall, solid_up_to), sources)


# name, density [kg/m^3], friction, restitution, Young's modulus [GPa], (wall, solid up to) [mm],
# sources of density, modulus and friction. Wood is between black cherry and red oak, along the grain.
TABLE: tuple[Entry, ...] = (
    _entry("wood", 600, 0.5, 0.2, 11, (16, 45), ("WH", "WH", "Marks")),
    _entry("plywood", 600, 0.5, 0.2, 9, (16, 45), ("EC1", "own", "Marks")),
    _entry("mdf", 750, 0.5, 0.2, 4, (16, 45), ("MIF", "MIF", "Marks")),
    _entry("glass", 2500, 0.4, 0.2, 70, (5, 12), ("EN572", "EN572", "SJ")),
    _entry("steel", 7850, 0.5, 0.2, 210, (1.2, 5), ("EC1", "EC3", "SJ")),
    _entry("aluminium", 2700, 0.45, 0.2, 70, (2, 6), ("EC9", "EC9", "SJ")),
    _entry("brass", 8400, 0.45, 0.2, 100, (2, 10), ("EC1", "ETB", "Marks")),
    _entry("plastic", 1050, 0.35, 0.25, 3, (3, 6), ("HRW", "HRW", "ETB")),
    _entry("ceramic", 2400, 0.4, 0.2, 60, (8, 20), ("MP", "own", "own")),
    _entry("stone", 2600, 0.6, 0.2, 50, (40, 150), ("EC1", "ETB", "own")),
    _entry("concrete", 2400, 0.6, 0.2, 30, (50, 200), ("EC1", "EC2", "own")),
    _entry("rubber", 1100, 0.8, 0.6, 0.01, (10, 40), ("own", "ETB", "SJ")),
    _entry("fabric", 300, 0.5, 0.05, 0.01, (20, 45), ("own", "own", "own")),
    _entry("foam", 40, 0.6, 0.1, 0.0001, (50, 1000), ("own", "own", "own")),
)
MATERIALS: dict[str, Material] = {entry.material.name: entry.material for entry in TABLE}
_BUILDS: dict[str, Build] = {entry.material.name: entry.build for entry in TABLE}


def build_of(material: Material) -> Build:
    """How things of a material are usually built; those that are not in the table like wood."""
    return _BUILDS.get(material.name, _BUILDS[DEFAULT_MATERIAL])
