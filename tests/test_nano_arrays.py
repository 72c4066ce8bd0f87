"""The network without torch: it computes what the trained one does, and nothing imports torch for it."""

import subprocess
import sys

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano.array_layers import sigmoid, softmax
from simart_kit_plugins.nano.array_network import ArrayNetwork
from simart_kit_plugins.nano.array_pairs import rivalry
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.evidence import COUNT
from simart_kit_plugins.nano.network import Batch, NanoNetwork
from simart_kit_plugins.nano.reading import POINT_NUMBERS, PairInputs, PartsRead, PiecesRead, Rows
from simart_kit_plugins.nano.scene import COLOR, HALF, MIDDLE, PIECE_NUMBERS
from simart_kit_plugins.nano.weight_shapes import weight_shapes

CONFIG = NanoConfig(
    channels=24,
    layers=3,
    heads=4,
    hidden=40,
    point_channels=12,
    choice_channels=20,
    pair_channels=10,
    labels=("door", "lid"),
    categories=("box", "cabinet", "chair"),
)


@pytest.fixture(scope="module")
def networks():
    """A network with weights that matter all, and the same one of arrays."""
    network = NanoNetwork(CONFIG, 5).eval()
    generator = torch.Generator().manual_seed(5)
    for parameter in network.parameters():
        parameter.data += 0.1 * torch.randn(parameter.shape, generator=generator)
    arrays = {name: tensor.detach().numpy() for name, tensor in network.state_dict().items()}
    return network, ArrayNetwork(CONFIG, arrays)


@pytest.fixture(scope="module")
def rows():
    """Two objects, of 9 and of 5 pieces; the last piece of the second has no points."""
    generator = np.random.default_rng(0)
    there = np.arange(16) < np.array([[9], [5]])
    owner = np.concatenate([generator.integers(0, 9, 150), np.arange(9), 16 + generator.integers(0, 4, 80)])
    numbers = np.where(there[..., None], generator.uniform(-0.5, 0.5, (2, 16, PIECE_NUMBERS)), 0)
    numbers[..., 3:6] = np.abs(numbers[..., 3:6])
    gap = generator.uniform(0, 0.06, (2, 16, 16))
    points = generator.normal(size=(len(owner), POINT_NUMBERS))
    values = (points, owner, numbers, np.minimum(gap, gap.transpose(0, 2, 1)), there)
    return Rows(*(v.astype(np.float32) if v.dtype == np.float64 else v for v in values))


def agree(tensors, arrays, names):
    for name in names:
        array = getattr(arrays, name)
        assert array.dtype == np.float32, name
        np.testing.assert_allclose(array, getattr(tensors, name).numpy(), rtol=1e-5, atol=1e-5, err_msg=name)


def test_objects_are_read_as_the_trained_network_reads_them(networks, rows):
    trained, arrays = networks
    with torch.no_grad():
        expected = trained(Batch(*(torch.from_numpy(v) for v in vars(rows).values())))
    assert expected.moves.std() > 0.1
    agree(expected, arrays.read(rows), PiecesRead.__dataclass_fields__)


def test_pairs_are_read_as_the_trained_network_reads_them(networks, rows):
    trained, arrays = networks
    with torch.no_grad():
        batch = Batch(*(torch.from_numpy(v) for v in vars(rows).values()))
        expected = trained.paired(batch, trained(batch), torch.tensor([0, 1]), 16)
    read = arrays.read(rows)
    said = (read.tokens, read.together, read.moves, read.kind)
    found = arrays.paired(PairInputs(*said, rows.numbers, rows.gap, rows.there))
    assert np.abs(found - read.together).max() > 0.1
    for row, size in enumerate(rows.there.sum(axis=1)):
        seen = np.s_[row, :size, :size]
        assert found[seen].dtype == np.float32
        np.testing.assert_allclose(found[seen], expected[seen].numpy(), rtol=1e-5, atol=1e-5)


def test_a_handle_has_no_rival_but_for_the_drawers_that_are_not_its_own():
    """Two drawers side by side, each with a handle near it, and a padding that is near everything."""
    own = np.zeros((1, 5, PIECE_NUMBERS), dtype=np.float32)
    own[0, :, MIDDLE.start] = (0.0, 0.3, 0.0, 0.3, 0.1)
    own[0, :4, HALF] = np.array([[0.1] * 3, [0.1] * 3, [0.02] * 3, [0.02] * 3])
    own[0, 2:4, COLOR] = 0.5
    gap = np.full((1, 5, 5), 0.06, dtype=np.float32)
    gap[0, [0, 2], [2, 0]] = gap[0, [1, 3], [3, 1]] = 0.003
    there = np.array([[True, True, True, True, False]])
    larger, smaller, farther, _ = rivalry(own, gap, there)[0]
    assert larger[0, 2] == smaller[0, 2] == 0
    assert larger[0, 3] == smaller[0, 3] == pytest.approx(1 - 0.003 / 0.06)
    assert farther[0, 3] == pytest.approx(0.3 / 0.5)
    assert farther[0, 2] == 0


def test_parts_and_who_carries_them_are_read_as_the_trained_network_reads_them(networks):
    trained, arrays = networks
    generator = np.random.default_rng(1)
    tokens = generator.normal(size=(2, 16, CONFIG.channels)).astype(np.float32)
    share = generator.random((3, 16)) * (generator.random((3, 16)) < 0.4)
    share = (share / share.sum(axis=1, keepdims=True)).astype(np.float32)
    numbers = generator.normal(size=(3, 7, COUNT)).astype(np.float32)
    real = np.arange(7) < np.array([[7], [3], [5]])
    given = np.array([0, 1, 1]), share, numbers, real
    found = arrays.parts(tokens, *given)
    with torch.no_grad():
        seen = torch.from_numpy(tokens), torch.ones(2, 16, dtype=torch.bool)
        expected = trained.parts(*seen, *(torch.from_numpy(value) for value in given))
        carried = trained.carriers(expected.embedding, expected.embedding[:2]).numpy()
    assert np.array_equal(np.isneginf(found.right), ~real)
    agree(expected, found, PartsRead.__dataclass_fields__)
    own = arrays.carriers(found.embedding, found.embedding[:2])
    assert own.shape == (3, 2)
    np.testing.assert_allclose(own, carried, rtol=1e-5, atol=1e-5)


def test_the_shapes_that_a_config_asks_for_are_those_of_the_network():
    expected = {name: tuple(tensor.shape) for name, tensor in NanoNetwork(CONFIG).state_dict().items()}
    assert weight_shapes(CONFIG) == expected


def test_chances_of_logits_however_large():
    assert np.allclose(softmax(np.float32([[0, np.log(3)], [1000, -np.inf]])), [[0.25, 0.75], [1, 0]])
    assert np.allclose(sigmoid(np.float32([-1000, -np.log(3), 0, np.log(3), 1000])), [0, 0.25, 0.5, 0.75, 1])


def test_the_segmenter_imports_no_torch():
    program = (
        "import sys\n"
        "from simart_kit.testing.meshes import cabinet_asset\n"
        "from simart_kit_plugins.nano.segmenter import Nano\n"
        "found = Nano().segment(cabinet_asset().mesh)\n"
        "print(len(found.face_part) > 0, 'torch' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "False"]
