"""Ground-truth parts of real objects, encoded, decoded and transferred: how many faces come back."""

from functools import cache

import numpy as np
import pytest
from simart_kit_plugins.simart.codec import decode_tokens, encode_parts, part_seeds
from simart_kit_plugins.simart.default_model import default_model_folder, load_model

from simart_kit.loading import read_source
from simart_kit.plugins import Plugins
from simart_kit.segments import find_segments
from simart_kit.transfer import transfer

from .real_objects import DATA, needs_data, overlap
from .token_models import Dictionary

pytestmark = [needs_data, pytest.mark.slow]

# Furniture with textures, a fridge of five drawers, small handles, and a drawer that fills its box.
OBJECTS = ("painted_wooden_cabinet", "jsk_fridge", "bigym_base_drawers", "gz_hinged_door", "calvin_table_A")
needs_weights = pytest.mark.skipif(
    not (default_model_folder() / "model.safetensors").is_file(), reason="no weights of the shipped model"
)
LEAST = {"segments": 0.95, "seeds": 0.85}


@cache
def labelled(name):
    """The object's mesh, its segments, and the part of each face, counted from 0."""
    mesh = read_source(DATA / name / "input.glb", Plugins(installed=False)).mesh
    with np.load(DATA / name / "gt.npz") as stored:
        ids, face_part = np.unique(stored["face_part"], return_inverse=True)
    assert ids[0] >= 0
    return mesh, find_segments(mesh), face_part.reshape(-1)


@cache
def decoded_seeds(model, name):
    mesh, _, face_part = labelled(name)
    names = [f"part {part}" for part in range(int(face_part.max()) + 1)]
    made = encode_parts(model, mesh, face_part, names)
    return part_seeds(decode_tokens(model, made.parts), made.frame, names)


def scores(model, name, mode):
    """IoU of each part, by the areas of its faces."""
    mesh, segments, face_part = labelled(name)
    moved = transfer(mesh, decoded_seeds(model, name), mode=mode, segments=segments)
    areas = mesh.face_areas
    return [
        overlap(areas, moved.face_part == part, face_part == part) for part in range(int(face_part.max()) + 1)
    ]


@needs_weights
@pytest.mark.parametrize("name", OBJECTS)
def test_parts_come_back_by_the_shipped_model(name):
    for mode, least in LEAST.items():
        assert min(scores(shipped(), name, mode)) >= least, mode


@pytest.mark.parametrize("name", OBJECTS)
def test_parts_come_back_where_the_model_loses_nothing(name):
    for mode, least in LEAST.items():
        assert min(scores(lossless(), name, mode)) >= least, mode


@cache
def shipped():
    return load_model().model


@cache
def lossless():
    return Dictionary()
