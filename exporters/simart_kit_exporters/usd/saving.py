"""From a stage in memory to files: one layer, one with its arrays beside it, or payloads with variants."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, get_args

from .draft import Draft, Role, set_units

if TYPE_CHECKING:
    from pxr import Sdf

PAYLOADS, RUNTIMES = "payloads", "runnables/physics"
_VARIANTS: dict[str, Role] = {"Newton": "newton", "MuJoCo": "mujoco"}
_COMPOSED: tuple[Role, ...] = ("physics", "materials", "instances", "geometries")


def save_flat(draft: Draft, path: Path) -> None:
    """Write the root layer at `path`, and the layer of the arrays below it if that is one of its own."""
    layer = _copy(draft.layers["base"])
    layer.subLayerPaths.clear()
    if draft.layers["geometries"] != draft.layers["base"]:
        layer.subLayerPaths.append(_save(draft, "geometries", path.parent, PAYLOADS))
    layer.Export(str(path))


def save_layered(draft: Draft, path: Path) -> None:
    """Write an interface at `path`, with payloads and a variant set for each simulator's own attributes.

    The layout is that of Isaac Sim's asset structure and of SimReady's requirements ISA.001 and RV.001-011:
    https://docs.omniverse.nvidia.com/isaacsim/latest/features/scene_generation/assets/usd_assets_best_practices.html
    """
    folder, root = path.parent, draft.layers["base"]
    for role in _COMPOSED:
        _save(draft, role, folder, PAYLOADS)
    base = _copy(root)
    base.customLayerData = {}
    base.subLayerPaths[:] = [f"./{_file(role)}" for role in _COMPOSED]
    base.Export(str(folder / PAYLOADS / _file("base")))
    targets = {name: _save(draft, role, folder, RUNTIMES) for name, role in _VARIANTS.items()}
    _interface(root, f"./{PAYLOADS}/{_file('base')}", targets).Export(str(path))


def layers_of(format_: str, layered: bool) -> tuple[Role, ...]:
    """The roles that get layers of their own: text holds no long arrays, which it is slow to read from."""
    if layered:
        return tuple(role for role in get_args(Role) if role != "base")
    return ("geometries",) if format_ == "usda" else ()


def _interface(root: Sdf.Layer, base: str, runtimes: dict[str, str]) -> Sdf.Layer:
    """The layer that others refer to: what the asset is, and which payloads it has."""
    from pxr import Sdf

    layer, name = Sdf.Layer.CreateAnonymous(".usda"), root.defaultPrim
    set_units(layer, name)
    prim = Sdf.CreatePrimInLayer(layer, f"/{name}")
    prim.specifier, prim.typeName = Sdf.SpecifierDef, "Xform"
    prim.kind = "component"
    prim.payloadList.Prepend(Sdf.Payload(base))
    for runtime, target in runtimes.items():
        _add_variants(prim, runtime, target)
    entries = {
        runtime: {"prim": f"/{name}", "variantSetName": runtime, "activateOption": "Enabled"}
        for runtime in runtimes
    }
    data = dict(root.customLayerData)
    data["SimReady_Metadata"] = {**data["SimReady_Metadata"], "Variants": {"Physics": entries}}
    layer.customLayerData = data
    return layer


def _add_variants(prim: Sdf.PrimSpec, name: str, target: str) -> None:
    """A variant set whose "Enabled" loads a payload; "Disabled", which is chosen, is empty."""
    from pxr import Sdf

    variants = Sdf.VariantSetSpec(prim, name)
    Sdf.VariantSpec(variants, "Disabled")
    Sdf.VariantSpec(variants, "Enabled").primSpec.payloadList.Prepend(Sdf.Payload(target))
    prim.variantSetNameList.Prepend(name)
    prim.variantSelections[name] = "Disabled"


def _save(draft: Draft, role: Role, folder: Path, below: str) -> str:
    """Write a role's layer; return its path relative to `folder`."""
    path = folder / below / _file(role)
    path.parent.mkdir(parents=True, exist_ok=True)
    draft.layers[role].Export(str(path))
    return f"./{below}/{path.name}"


def _file(role: Role) -> str:
    return f"{role}.usdc" if role == "geometries" else f"{role}.usda"


def _copy(layer: Sdf.Layer) -> Sdf.Layer:
    """The same opinions in a layer that no stage looks at, so that its paths may name files to come."""
    from pxr import Sdf

    result = Sdf.Layer.CreateAnonymous(".usda")
    result.TransferContent(layer)
    return result
