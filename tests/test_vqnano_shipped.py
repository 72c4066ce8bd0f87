"""The voxel codec that comes with the package, on objects that it never saw."""

import pytest
from simart_kit_plugins.simart.commands.training_data import held_out_grids
from simart_kit_plugins.simart.default_model import load_model
from simart_kit_plugins.simart.training.evaluation import evaluate
from simart_kit_plugins.simart.training.grids import objects_of

# A minute; what the model card tells is of 200.
OBJECTS = 24


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_generated_objects_and_their_parts_come_back():
    model = load_model().model
    grids = held_out_grids(OBJECTS, model.config.resolution, lambda *told: None)
    wholes = {rows[0] for rows in objects_of(grids.names)}
    parts = set(range(len(grids))) - wholes
    assert len(wholes) == OBJECTS
    for kind in (wholes, parts):
        found = evaluate(model, (grids.occupancy([row])[0] for row in sorted(kind)))
        assert found.iou >= 0.93
        assert found.cd_squared <= 4.2e-5
