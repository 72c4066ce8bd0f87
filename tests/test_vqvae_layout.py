"""Where values go: space-to-depth, which cells a token covers, and the shuffle of the decoder."""

from itertools import product

import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from simart_kit_plugins.simart.vqvae.blocks import pixel_shuffle_3d
from simart_kit_plugins.simart.vqvae.cells import occupied_cells, voxels_of_cells
from simart_kit_plugins.simart.vqvae.config import VqvaeConfig
from simart_kit_plugins.simart.vqvae.space_to_depth import depth_to_space, space_to_depth

from .vqvae_cases import generator, small, two_grids, two_grids_occupied

PAPER = VqvaeConfig()
LONG = VqvaeConfig(grid="16x8x8")


def numbered(edge, channels):
    """(1, C, L, L, L) latent in which the value tells its place: 1000000 x + 10000 y + 100 z + channel."""
    axis = torch.arange(edge)
    place = axis[:, None, None] * 1_000_000 + axis[:, None] * 10_000 + axis * 100
    return (place + torch.arange(channels)[:, None, None, None])[None]


def place(x, y, z, channel):
    return 1_000_000 * x + 10_000 * y + 100 * z + channel


@pytest.mark.parametrize(("cells", "block"), [((8, 8, 8), (2, 2, 2)), ((16, 8, 8), (1, 2, 2))])
def test_a_spatial_token_holds_the_latent_cells_of_its_own_box_and_no_others(cells, block):
    tokens = space_to_depth(numbered(16, 8), cells, "spatial")
    assert tokens.shape == (1, *cells, 8 * block[0] * block[1] * block[2])
    for x, y, z in product(*map(range, cells)):
        corner = (x * block[0], y * block[1], z * block[2])
        box = [
            place(corner[0] + i, corner[1] + j, corner[2] + k, channel)
            for i, j, k in product(*map(range, block))
            for channel in range(8)
        ]
        assert tokens[0, x, y, z].tolist() == box


@pytest.mark.parametrize(
    ("cells", "token", "run"),
    [
        # 16^3 cells of 8 numbers in memory order, cut into tokens of 32 (4 cells) or 64 (8 cells) numbers.
        ((8, 8, 16), (0, 0, 1), [(0, 0, z) for z in (4, 5, 6, 7)]),
        ((8, 8, 16), (0, 0, 4), [(0, 1, z) for z in (0, 1, 2, 3)]),
        ((8, 8, 8), (0, 0, 1), [(0, 0, z) for z in range(8, 16)]),
        ((8, 8, 8), (1, 0, 0), [(2, 0, z) for z in range(8)]),
    ],
)
def test_a_token_of_a_flat_view_holds_a_run_of_memory_wherever_that_lies(cells, token, run):
    tokens = space_to_depth(numbered(16, 8), cells, "flat-view")
    assert tokens[0][token].tolist() == [place(*cell, channel) for cell in run for channel in range(8)]


@settings(max_examples=60, deadline=None)
@given(
    batch=st.integers(1, 3),
    channels=st.integers(1, 3),
    edge=st.sampled_from([2, 4, 6]),
    data=st.data(),
    layout=st.sampled_from(["spatial", "flat-view"]),
    seed=st.integers(0, 2**32),
)
def test_depth_to_space_undoes_space_to_depth(batch, channels, edge, data, layout, seed):
    divisors = st.sampled_from([n for n in range(1, edge + 1) if edge % n == 0])
    cells = data.draw(st.tuples(divisors, divisors, divisors))
    latent = torch.randn(batch, channels, edge, edge, edge, generator=generator(seed))
    tokens = space_to_depth(latent, cells, layout)
    assert tokens.shape[:4] == (batch, *cells)
    assert torch.equal(depth_to_space(tokens, edge, layout), latent)
    assert torch.equal(tokens.flatten().sort().values, latent.flatten().sort().values)


def test_gradients_pass_through_both_directions_unchanged():
    latent = torch.randn(1, 2, 4, 4, 4, generator=generator(), requires_grad=True)
    depth_to_space(space_to_depth(latent, (4, 2, 2), "spatial"), 4, "spatial").backward(latent.detach())
    assert torch.equal(latent.grad, latent)


@pytest.mark.parametrize(("config", "edges"), [(PAPER, (8, 8, 8)), (LONG, (4, 8, 8))])
def test_a_voxel_occupies_the_one_token_whose_box_it_is_in(config, edges):
    for voxel in ((0, 0, 0), (63, 63, 63), (7, 8, 31), (40, 3, 60)):
        grid = torch.zeros(1, 1, 64, 64, 64, dtype=torch.uint8)
        grid[(0, 0, *voxel)] = 1
        token = tuple(v // edge for v, edge in zip(voxel, edges, strict=True))
        assert torch.nonzero(occupied_cells(grid, config)[0]).tolist() == [list(token)]


def test_cells_of_a_batch_are_occupied_each_by_its_own_grid():
    assert torch.equal(occupied_cells(two_grids(), small()), two_grids_occupied())


def test_occupancy_follows_the_flat_view_where_the_tokens_do():
    # Voxel z = 32 is latent z = 8, the second run of 8 latent cells: token (0, 0, 1) of (8, 8, 8).
    grid = torch.zeros(1, 1, 64, 64, 64)
    grid[0, 0, 0, 0, 32] = 1
    flat = VqvaeConfig(layout="flat-view")
    assert torch.nonzero(occupied_cells(grid, flat)[0]).tolist() == [[0, 0, 1]]
    # The same token covers latent (0, 0, 8..15): voxels x < 4, y < 4, z >= 32.
    expected = torch.zeros(64, 64, 64, dtype=torch.bool)
    expected[:4, :4, 32:] = True
    assert torch.equal(voxels_of_cells(occupied_cells(grid, flat), flat)[0, 0], expected)


@pytest.mark.parametrize(("config", "edges"), [(PAPER, (8, 8, 8)), (LONG, (4, 8, 8))])
def test_a_token_covers_exactly_the_voxels_of_its_box(config, edges):
    occupied = torch.zeros(1, *config.cells, dtype=torch.bool)
    occupied[0, 2, 5, 7] = True
    expected = torch.zeros(64, 64, 64, dtype=torch.bool)
    x, y, z = (n * edge for n, edge in zip((2, 5, 7), edges, strict=True))
    expected[x : x + edges[0], y : y + edges[1], z : z + edges[2]] = True
    assert torch.equal(voxels_of_cells(occupied, config)[0, 0], expected)


@pytest.mark.parametrize("layout", ["spatial", "flat-view"])
@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_occupied_cells_cover_every_voxel_that_is_on(layout, seed):
    config = small(layout=layout, grid="4x2x2")
    grid = torch.rand(2, 1, 16, 16, 16, generator=generator(seed)) < 0.003
    occupied = occupied_cells(grid, config)
    assert not (grid & ~voxels_of_cells(occupied, config)).any()
    assert torch.equal(occupied_cells(voxels_of_cells(occupied, config), config), occupied)


def test_the_shuffle_puts_channel_8c_4i_2j_k_at_offset_ijk():
    x = torch.arange(1 * 16 * 2 * 3 * 2).reshape(1, 16, 2, 3, 2)
    shuffled = pixel_shuffle_3d(x)
    assert shuffled.shape == (1, 2, 4, 6, 4)
    for c, i, j, k in product(range(2), range(2), range(2), range(2)):
        assert torch.equal(shuffled[0, c, i::2, j::2, k::2], x[0, 8 * c + 4 * i + 2 * j + k])
