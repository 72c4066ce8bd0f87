"""PartNet-Mobility of SAPIEN (Xiang et al. 2020, https://sapien.ucsd.edu): a folder an object.

Shapes and joints are read from mobility.urdf, whose link_3 is the entry of id 3 in mobility_v2.json; that
file says what kind of thing a link is. A shape stands with +y up in its OBJ file; the joint to the root link
`base` turns it, so that +z is up in the frame of the root, which is the object's here. A part that slides and
turns hangs on an empty link_3_helper, which is folded away. The unit of length is not known.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ...errors import BadInputError
from ..articulation import Link
from ..cases import Truth
from . import DEFAULT_VARIANT, TruthFormat
from .found_files import files_below
from .urdf import PARTNET_FILE, check_variant, read_urdf

URDF_FILE, META_FILE = "mobility.urdf", "meta.json"


class PartNetMobility(TruthFormat):
    """Objects of PartNet-Mobility, as SAPIEN hands them out."""

    name = "partnet-mobility"
    layout = f"ID/{PARTNET_FILE}, ID/{URDF_FILE}, ID/textured_objs/*.obj; ID/{META_FILE} for the category"

    def find(self, root: Path) -> dict[str, Path]:
        """Folders by name; folders of the same name get their path below `root`, with _ for /."""
        folders = [path.parent for path in files_below(root, PARTNET_FILE) if path.name == PARTNET_FILE]
        names = [folder.resolve().name for folder in folders]
        return {
            name if names.count(name) == 1 else "_".join(folder.relative_to(root).parts): folder
            for name, folder in zip(names, folders, strict=True)
        }

    def read(self, path: Path, variant: str = DEFAULT_VARIANT) -> Truth:
        """Read one folder."""
        check_variant(path, variant)
        urdf, name = path / URDF_FILE, path.resolve().name
        if not urdf.is_file():
            raise BadInputError(f"{path} has no {URDF_FILE}, which holds the shapes and joints of the object")
        kinds = link_kinds(path / PARTNET_FILE)
        articulation, notes = read_urdf(urdf, name)
        links = tuple(labelled(link, kinds) for link in articulation.links)
        return Truth(
            name,
            replace(articulation, links=links),
            category=_category(path / META_FILE),
            up="+z",
            metres_per_unit=None,
            notes=notes,
        )


def labelled(link: Link, kinds: Mapping[int, str]) -> Link:
    """The link with what kind of thing it is, if it is one that `kinds` knows."""
    found = re.fullmatch(r"link_(\d+)", link.name)
    return replace(link, label=kinds.get(int(found[1]), "")) if found else link


def link_kinds(path: Path) -> dict[int, str]:
    """What kind of thing each link is, by id; raises BadInputError when the file is damaged."""
    entries = _json(path)
    kinds = {}
    for entry in entries if isinstance(entries, list) else [None]:
        if not isinstance(entry, dict) or not isinstance(entry.get("id"), int):
            raise BadInputError(f"{path} is damaged: it should be a list of links, each with an id")
        if not isinstance(entry.get("name"), str):
            raise BadInputError(f"{path} is damaged: link {entry['id']} has no name")
        kinds[entry["id"]] = entry["name"]
    return kinds


def _category(path: Path) -> str:
    if not path.exists():
        return ""
    table = _json(path)
    found = table.get("model_cat", "") if isinstance(table, dict) else None
    if not isinstance(found, str):
        raise BadInputError(f"{path} is damaged: it should be a table with the category as model_cat")
    return found


def _json(path: Path) -> Any:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise BadInputError(f"{path} is missing or no JSON: {error}") from error
