"""Meshes and grids to voxel tokens and back to points."""

import numpy as np
import pytest
from simart_kit_plugins.simart.codec import (
    decode_tokens,
    encode_grids,
    encode_parts,
    object_frame,
    object_grids,
    occupancy,
    part_seeds,
    seeds,
    token_grid,
)
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.errors import BadInputError
from simart_kit.mesh import Mesh
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset
from simart_kit.voxels import GridFrame

from .token_models import GRID, Dictionary, DictionaryConfig, tiny_model

NAMES = ("body", "door", "drawer")


def two_boxes():
    """A box of 1 m, and on it one of a quarter of that; their cube is 1.25 m wide."""
    return boxes_mesh([((0, 0, 0), (1, 1, 1)), ((0, 0, 1), (0.25, 0.25, 1.25))])


def voxels(*places):
    grid = np.zeros((64, 64, 64), dtype=bool)
    grid[tuple(np.array(places).T)] = True
    return grid


def test_parts_share_the_objects_frame():
    made = encode_parts(Dictionary(), two_boxes(), np.repeat([0, 1], 12), ("low", "high"))
    # The cube is centred in x and y: from -0.125 to 1.125. The small box spans 0 .. 0.25 m in x and y,
    # 1 .. 1.25 in z: voxels of 1.25 / 64 m from 6.4 to 19.2 and from 51.2 to 64, cells 0..2 and 6..7.
    np.testing.assert_allclose(made.frame.origin, (-0.125, -0.125, 0.0))
    x, y, z = made.parts[1].coordinates.T
    assert (x.min(), x.max(), y.min(), y.max(), z.min(), z.max()) == (0, 2, 0, 2, 6, 7)
    assert set(made.parts[1].index) <= set(made.whole.index)
    assert set(made.parts[0].index) | set(made.parts[1].index) == set(made.whole.index)


def test_a_lossless_model_gives_every_part_back():
    asset, model = cabinet_asset(), Dictionary()
    grids = object_grids(asset.mesh, asset.face_part, NAMES)
    made = encode_parts(model, asset.mesh, asset.face_part, NAMES)
    decoded = decode_tokens(model, (made.whole, *made.parts))
    assert np.array_equal(decoded[0], grids.whole)
    assert np.array_equal(decoded[1:], grids.parts)
    assert [t.index.tolist() for t in made.parts] == [
        np.flatnonzero(GRID.occupied_cells(grid)).tolist() for grid in grids.parts
    ]


def test_more_grids_than_go_through_at_once_keep_their_order():
    places = [(7 * i, 3, 60 - i) for i in range(9)]
    model = Dictionary()
    tokens = encode_grids(model, np.stack([voxels(place) for place in places]))
    decoded = decode_tokens(model, tokens)
    assert [np.argwhere(grid).tolist() for grid in decoded] == [[list(place)] for place in places]


def test_a_network_decodes_nothing_outside_the_cells_that_are_named():
    model = tiny_model()
    model.decoder.out_layer[-1].bias.data.fill_(5.0)  # everything on, were it not for the mask
    (tokens,) = encode_grids(model, voxels((0, 0, 0), (63, 8, 0))[None])
    assert tokens.index.tolist() == [0, 7 * 64 + 8]
    decoded = decode_tokens(model, (tokens,))[0]
    assert decoded.any()
    assert set(np.flatnonzero(GRID.occupied_cells(decoded))) <= {0, 7 * 64 + 8}


def test_sixteen_cells_along_x():
    model = Dictionary(DictionaryConfig(cells=(16, 8, 8), codebook_size=8192))
    (tokens,) = encode_grids(model, voxels((4, 0, 0), (63, 63, 63))[None])
    assert tokens.index.tolist() == [64, 1023]
    assert np.array_equal(decode_tokens(model, (tokens,))[0], voxels((4, 0, 0), (63, 63, 63)))


def test_seeds_are_the_middles_of_voxels():
    frame = GridFrame((1.0, 2.0, 3.0), 0.5, 64)
    np.testing.assert_allclose(
        seeds(voxels((0, 0, 0), (2, 1, 3)), frame), [(1.25, 2.25, 3.25), (2.25, 2.75, 4.75)]
    )


@pytest.mark.parametrize(
    ("config", "reason"),
    [
        ({"mode": "dense"}, "mode 'dense' has no zero token"),
        ({"mode": "force-sparse"}, "mode 'force-sparse' has no zero token"),
        ({"resolution": 32}, r"32\^3 voxels"),
        ({"cells": (4, 4, 4)}, r"\(4, 4, 4\)"),
        ({"codebook_size": 100}, "codebook of 100"),
    ],
)
def test_a_model_without_token_sequences_is_refused(config, reason):
    with pytest.raises(BadInputError, match=reason):
        token_grid(Dictionary(DictionaryConfig(**config)))


def test_tokens_of_another_grid_are_not_decoded():
    tokens = VoxelTokens(TokenGrid((16, 8, 8), 8192), np.array([3]), np.array([5]))
    with pytest.raises(BadInputError, match=r"16x8x8 cells and 8192 codes .* 8x8x8 cells and 4096 codes"):
        decode_tokens(Dictionary(), (tokens,))


def test_an_empty_grid_has_no_tokens():
    with pytest.raises(BadInputError, match="grid 1 is empty"):
        encode_grids(Dictionary(), np.stack([voxels((1, 1, 1)), np.zeros((64, 64, 64), dtype=bool)]))


def test_a_grid_of_another_shape_is_refused():
    with pytest.raises(BadInputError, match=r"\(1, 32, 32, 32\)"):
        encode_grids(Dictionary(), np.ones((1, 32, 32, 32), dtype=bool))


def test_a_single_voxel_is_one_token():
    model = Dictionary()
    (tokens,) = encode_grids(model, voxels((9, 17, 63))[None])
    assert tokens.index.tolist() == [1 * 64 + 2 * 8 + 7]
    assert np.array_equal(decode_tokens(model, (tokens,))[0], voxels((9, 17, 63)))


def test_a_mesh_outside_the_cube_is_not_cut_off_in_silence():
    mesh = two_boxes()
    frame = GridFrame((0.0, 0.0, 0.0), 1 / 64, 64)  # ends 0.25 m below the top
    with pytest.raises(BadInputError, match=r"part 'high' lies up to 0\.25 m outside the cube"):
        occupancy(mesh.triangles[12:], frame, "part 'high'")


def test_a_mesh_that_is_a_point_has_no_voxels():
    with pytest.raises(BadInputError, match="cannot be divided into voxels"):
        object_frame(Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]])))


@pytest.mark.parametrize(
    ("labels", "reason"),
    [
        (np.zeros(24, dtype=int), "part 'high' has no faces"),
        (np.zeros(5, dtype=int), "5 labels for a mesh of 24 faces"),
        (np.full(24, 2), r"labels 2\.\.2 for 2 parts"),
    ],
)
def test_labels_that_do_not_fit_are_refused(labels, reason):
    with pytest.raises(BadInputError, match=reason):
        object_grids(two_boxes(), labels, ("low", "high"))


def test_a_part_that_decodes_to_nothing_is_named():
    grids = np.stack([voxels((1, 1, 1)), np.zeros((64, 64, 64), dtype=bool)])
    with pytest.raises(BadInputError, match="part 'door' decodes to no voxel"):
        part_seeds(grids, GridFrame((0.0, 0.0, 0.0), 1.0, 64), ("body", "door"))
