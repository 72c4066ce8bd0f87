"""Measures what a recipe finds on objects whose parts and joints are known.

Usage: python tests/bench_geometric.py FOLDER [--mesh fused.glb] [--recipe NAME|FILE]

FOLDER has a folder an object: a mesh `X.glb`; the true part of each face as `face_part` in `X.npz` (`gt.npz`
for `input.glb`); and `gt.json` with `parts`: `id`, `name` and `joint` of each, that is `type`, `axis` and
`origin` in the mesh's frame. `also` holds further joints of a part, any of which is right.

A part is found when it covers half of what it and the true part cover together, by area. Its joint is right
when the kind is, the axis is within 10 degrees (either way), and the line of a hinge passes within 0.05 of
the object's diagonal. A moving part that is no true one is invented.
"""

import argparse
import json
import tempfile
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import linear_sum_assignment

import simart_kit as sk

LEAST_OVERLAP, LEAST_COSINE, MOST_DISTANCE = 0.5, np.cos(np.deg2rad(10.0)), 0.05


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--mesh", default="input.glb")
    parser.add_argument("--recipe", default="geometric")
    arguments = parser.parse_args()
    total: Counter[str] = Counter()
    for source in sorted(arguments.folder.glob(f"*/{arguments.mesh}")):
        with tempfile.TemporaryDirectory() as out:
            options = {"sets": ["export=[]"], "record": False}
            asset = sk.convert(source, arguments.recipe, out=Path(out) / "run", **options).asset
        counts, told = compare(asset, source)
        total += counts
        print(f"{source.parent.name:<28} {line(counts)}{told}")
    print(f"{'all':<28} {line(total)}")


def line(counts: Counter[str]) -> str:
    rows = ("movable", "found", "right", "invented")
    return ", ".join(f"{counts[row]} {row}" for row in rows)


def compare(asset: sk.Asset, source: Path) -> tuple[Counter[str], str]:
    """Counts for one object, and what was missed or wrong."""
    truth = json.loads((source.parent / "gt.json").read_text())
    labels = np.load(source.parent / ("gt.npz" if source.stem == "input" else f"{source.stem}.npz"))
    true = [part for part in truth["parts"] if part["joint"]["type"] != "fixed"]
    moving = [j for j in asset.joints if j.moves]
    mine = np.array([asset.face_part == asset.part_index(j.child) for j in moving])
    theirs = np.array([labels["face_part"] == part["id"] for part in true])
    share = overlaps(mine, theirs, asset.mesh.face_areas)
    pairs = {
        b: a for a, b in zip(*linear_sum_assignment(-share), strict=True) if share[a, b] >= LEAST_OVERLAP
    }
    right = [b for b, a in pairs.items() if is_right(moving[a], true[b], asset)]
    invented = [j.child for a, j in enumerate(moving) if a not in pairs.values()]
    texts = [f"missed {part['name']}" for b, part in enumerate(true) if b not in pairs]
    texts += [f"wrong {moving[a].name}" for b, a in pairs.items() if b not in right]
    texts += [f"invented {name}" for name in invented]
    counts = {"movable": len(true), "found": len(pairs), "right": len(right), "invented": len(invented)}
    return Counter(counts), "".join(f"\n    {text}" for text in texts)


def overlaps(mine: np.ndarray, theirs: np.ndarray, areas: np.ndarray) -> np.ndarray:
    """(M, T) intersection over union, by area, of face sets (M, F) and (T, F)."""
    share = np.zeros((len(mine), len(theirs)))
    for a, b in np.ndindex(share.shape):
        share[a, b] = areas[mine[a] & theirs[b]].sum() / areas[mine[a] | theirs[b]].sum()
    return share


def is_right(joint: sk.Joint, part: dict[str, Any], asset: sk.Asset) -> bool:
    """Whether a joint is one of those that a true part has."""
    return any(agrees(joint, true, asset) for true in (part["joint"], *part.get("also", ())))


def agrees(joint: sk.Joint, true: dict[str, Any], asset: sk.Asset) -> bool:
    if joint.kind != true["type"]:
        return False
    matrix = asset.asset_from_source
    axis = matrix[:3, :3] @ true["axis"]
    axis /= np.linalg.norm(axis)
    away = np.array(joint.origin) - matrix[:3, :3] @ true["origin"] - matrix[:3, 3]
    distance = np.linalg.norm(np.cross(away, axis)) if joint.turns else 0.0
    return bool(abs(axis @ joint.axis) >= LEAST_COSINE and distance <= MOST_DISTANCE * asset.mesh.diagonal)


if __name__ == "__main__":
    main()
