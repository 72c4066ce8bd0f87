"""Part surfaces: every face once, in its part's frame, with its looks, a material each."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import simart_kit as sk
from simart_kit.kinematics import rest_origin
from simart_kit.mesh import VisualMaterial
from simart_kit.surfaces import asset_surfaces
from simart_kit.testing.meshes import cabinet_asset, chain_asset, static_asset


def painted_cabinet() -> sk.Asset:
    """The cabinet in three materials that alternate from face to face; the third is on the door only."""
    asset = cabinet_asset()
    face_material = np.arange(108) % 2
    face_material[70:75] = 2
    looks = tuple(VisualMaterial(name) for name in ("red", "green", "blue"))
    colors = np.arange(4 * len(asset.mesh.vertices), dtype=np.uint8).reshape(-1, 4)
    mesh = replace(asset.mesh, materials=looks, face_material=face_material, colors=colors)
    return replace(asset, mesh=mesh)


@pytest.mark.parametrize("make", [painted_cabinet, chain_asset, static_asset])
def test_every_face_is_on_one_surface_of_its_part(make: Callable[[], sk.Asset]) -> None:
    asset = make()
    surfaces = asset_surfaces(asset)
    assert list(surfaces) == [p.name for p in asset.parts]
    for index, part in enumerate(asset.parts):
        faces = np.concatenate([s.source_faces for s in surfaces[part.name]])
        np.testing.assert_array_equal(np.sort(faces), np.flatnonzero(asset.face_part == index))


def test_a_surface_has_one_material() -> None:
    asset = painted_cabinet()
    surfaces = asset_surfaces(asset)
    names = {part: [s.material.name for s in found] for part, found in surfaces.items()}
    assert names == {"body": ["red", "green"], "door": ["red", "green", "blue"], "drawer": ["red", "green"]}
    for part, found in surfaces.items():
        assert [s.index for s in found] == list(range(len(found)))
        for surface in found:
            assert surface.part == part
            on = {asset.mesh.materials[i].name for i in asset.mesh.face_material[surface.source_faces]}
            assert on == {surface.material.name}


@pytest.mark.parametrize("make", [painted_cabinet, chain_asset, static_asset])
def test_points_and_looks_are_those_of_the_mesh(make: Callable[[], sk.Asset]) -> None:
    asset = make()
    for name, found in asset_surfaces(asset).items():
        for surface in found:
            source, mesh = asset.mesh.faces[surface.source_faces], asset.mesh
            placed = surface.vertices + rest_origin(asset, name)
            np.testing.assert_allclose(placed[surface.faces], mesh.vertices[source], atol=1e-12)
            for mine, its in ((surface.uv, mesh.uv), (surface.colors, mesh.colors)):
                assert (mine is None) == (its is None)
                if mine is not None and its is not None:
                    np.testing.assert_array_equal(mine[surface.faces], its[source])


def test_normals_are_the_boxes_own() -> None:
    asset = chain_asset()
    for found in asset_surfaces(asset).values():
        for surface in found:
            expected = np.repeat(asset.mesh.face_normals[surface.source_faces][:, None], 3, axis=1)
            np.testing.assert_allclose(surface.normals[surface.faces], expected, atol=1e-12)


def test_no_vertex_is_left_over() -> None:
    for found in asset_surfaces(painted_cabinet()).values():
        for surface in found:
            np.testing.assert_array_equal(np.unique(surface.faces), np.arange(len(surface.vertices)))
