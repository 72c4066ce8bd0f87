"""Where a part is: where its codes decode to, or the object's own voxels in the cells it names."""

import numpy as np
import pytest
from simart_kit_plugins.simart.looking import Seen
from simart_kit_plugins.simart.seeding import Decoder
from simart_kit_plugins.simart.tokens import TokenGrid, VoxelTokens

from simart_kit.voxels import GridFrame

from .token_models import Dictionary


@pytest.fixture
def seen() -> Seen:
    """An object with a voxel in cell (0, 0, 0), two in cell (1, 0, 0), of a grid of 8x8x8."""
    occupancy = np.zeros((64, 64, 64), dtype=np.bool_)
    occupancy[3, 3, 3] = occupancy[8, 0, 0] = occupancy[15, 7, 7] = True
    whole = VoxelTokens(TokenGrid(), np.array([0, 64]), np.array([1, 1]))
    return Seen(GridFrame((0.0, 0.0, 0.0), 1 / 64, 64), occupancy, whole)


def test_by_cells_a_part_has_the_objects_voxels_there_whatever_its_codes(seen):
    part = VoxelTokens(TokenGrid(), np.array([64]), np.array([77]))
    (voxels,) = Decoder(Dictionary(), "cells").voxels([part], seen)
    assert np.argwhere(voxels).tolist() == [[8, 0, 0], [15, 7, 7]]


def test_a_cell_that_two_parts_name_is_of_both(seen):
    parts = [VoxelTokens(TokenGrid(), np.array(cells), np.ones(len(cells), int)) for cells in ([0, 64], [64])]
    voxels = Decoder(Dictionary(), "cells").voxels(parts, seen)
    assert voxels.sum(axis=(1, 2, 3)).tolist() == [3, 2]
