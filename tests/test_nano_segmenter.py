"""From a mesh to parts and joints: grouping, sampling, a network's words as joints, and its weights."""

import shutil
from dataclasses import dataclass

import numpy as np
import pytest
import torch
from simart_kit_plugins.nano import predicting
from simart_kit_plugins.nano.array_network import ArrayNetwork
from simart_kit_plugins.nano.candidates import EDGE, SLIDE, Candidates, alike
from simart_kit_plugins.nano.config import NanoConfig
from simart_kit_plugins.nano.grouping import groups, piece_parts
from simart_kit_plugins.nano.knowledge import Knowledge
from simart_kit_plugins.nano.meshes import MOST_PIECES, mesh_cloud
from simart_kit_plugins.nano.network import NanoNetwork
from simart_kit_plugins.nano.proposals import of_geometry
from simart_kit_plugins.nano.reading import PartsRead, PiecesRead
from simart_kit_plugins.nano.segmenter import Nano
from simart_kit_plugins.nano.stored_model import SKINS_FILE, shipped_folder
from simart_kit_plugins.nano.trusting import enough
from simart_kit_plugins.nano.truth import KINDS
from simart_kit_plugins.nano.weights import load_model, save_network

from simart_kit.errors import BadInputError
from simart_kit.kinematics import rotation
from simart_kit.mesh import Mesh
from simart_kit.recipe import read_options
from simart_kit.segments import find_segments
from simart_kit.spec.reading import read_spec
from simart_kit.srgb import linear_to_srgb, srgb_to_linear
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset

from .test_skins import SLAB, skin

TINY = {"channels": 16, "layers": 1, "heads": 2, "hidden": 16, "point_channels": 8}
CONFIG = NanoConfig(**TINY, labels=("door", "drawer"), categories=("cabinet",))
SURE = 12.0
KNOWN = Knowledge(materials={"/door": "glass"})


class Oracle(ArrayNetwork):
    """Says what the faces' true parts say, by the pieces that it is told of."""

    def __init__(self, part, slides):
        super().__init__(CONFIG, {})
        self.truth, self.slides = np.asarray(part), slides

    def read(self, rows):
        sides, most = rows.there.shape
        truth = np.full(most, -1)
        truth[: len(self.truth)] = self.truth
        same = np.where(truth[:, None] == truth[None], SURE, -SURE)
        label = np.zeros((sides, most, 3))
        label[:, truth > 0, 1] = SURE
        return PiecesRead(
            np.zeros((sides, most, 16), np.float32),
            np.broadcast_to(same, (sides, most, most)),
            np.broadcast_to(np.where(truth > 0, SURE, -SURE), (sides, most)),
            np.zeros((sides, most, len(KINDS))),
            label,
            np.broadcast_to(np.array([0.0, SURE]), (sides, 2)),
            np.full(sides, 0.5),
            np.zeros((sides, most, 16), np.float32),
        )

    def paired(self, given):
        return given.together

    def parts(self, tokens, owner, share, numbers, real):
        kind = np.zeros((len(owner), len(KINDS)))
        kind[:, KINDS.index("prismatic" if self.slides else "revolute")] = SURE
        sense, near = np.full(real.shape, -SURE), np.full(len(owner), -SURE)
        reach = np.broadcast_to(np.log([0.5 * np.pi, 0.5]), (len(owner), 2))
        first = np.where(real, 0.0, -np.inf)
        first[:, 0] = 1.0
        return PartsRead(kind, first, sense, near, reach, np.zeros((len(owner), 16)))

    def carriers(self, child, parent):
        return np.full((len(child), len(parent)), -SURE)


@dataclass(frozen=True)
class Told:
    """A model as `read_model` reads it."""

    network: ArrayNetwork
    known: Knowledge
    statistics: None = None

    def stand_in(self, patch: pytest.MonkeyPatch) -> None:
        """Be the model of every folder."""
        patch.setattr("simart_kit_plugins.nano.stored_model.read_model", lambda folder, weights_file: self)
        patch.setattr("simart_kit_plugins.nano.stored_model.read_knowledge", lambda folder: self.known)


def test_groups_are_the_blocks_of_a_matrix_of_chances_the_surest_first():
    part = np.array([0, 0, 1, 1, 2, 2, 2, 0])
    together = np.where(part[:, None] == part[None], 0.9, 0.1)
    moves = np.where(part > 0, 0.95, 0.02)
    moves[part == 2] = 0.8
    found = groups(moves, together, np.ones(8), least=0.3)
    assert [group.pieces.tolist() for group in found] == [[2, 3], [4, 5, 6]]
    assert found[0].score == pytest.approx(0.95 * 0.9)
    assert piece_parts([group.pieces for group in found], 8).tolist() == [0, 0, 1, 1, 2, 2, 2, 0]
    assert [group.pieces.tolist() for group in groups(moves, together, np.ones(8), least=0.8)] == [[2, 3]]
    assert groups(np.zeros(8), together, np.ones(8), least=0.0) == []


def test_where_all_pieces_move_the_largest_part_stands_still():
    part = np.array([1, 1, 2])
    together = np.where(part[:, None] == part[None], 0.9, 0.1)
    found = groups(np.full(3, 0.9), together, np.array([1.0, 1.0, 5.0]), least=0.0)
    assert [group.pieces.tolist() for group in found] == [[0, 1]]


def test_a_lone_voice_does_not_pull_a_piece_from_its_part():
    together = np.full((6, 6), 0.9)
    together[0, 4] = together[4, 0] = 0.6
    together[4, 1:4] = together[1:4, 4] = 0.1
    np.fill_diagonal(together, 1)
    found = groups(np.array([0.99, 0.9, 0.9, 0.9, 0.7, 0.1]), together, np.ones(6), least=0.0)
    assert [group.pieces.tolist() for group in found] == [[0, 1, 2, 3], [4]]


def test_each_of_two_parts_alike_keeps_its_own_pieces():
    together = np.array(
        [[1, 0.95, 0.7, 0.6], [0.95, 1, 0.55, 0.3], [0.7, 0.55, 1, 0.95], [0.6, 0.3, 0.95, 1]]
    )
    found = groups(np.array([0.99, 0.9, 0.98, 0.9, 0.0]), np.pad(together, (0, 1)), np.ones(5), least=0.0)
    assert [group.pieces.tolist() for group in found] == [[0, 1], [2, 3]]


def seen(mesh):
    return mesh_cloud(mesh, find_segments(mesh), np.random.default_rng(0))


def test_a_mesh_is_read_by_its_segments_in_a_cube_about_its_middle():
    mesh = cabinet_asset().mesh
    found = seen(mesh)
    assert not found.skin
    assert np.array_equal(found.face_piece, find_segments(mesh).face_segment)
    assert np.allclose(
        found.cloud.points * found.size + found.center,
        np.clip(found.cloud.points * found.size + found.center, mesh.bounds[0] - 1e-9, mesh.bounds[1] + 1e-9),
    )
    assert np.abs(found.cloud.points).max() <= 0.5 + 1e-9
    assert found.cloud.area.sum() == pytest.approx(1)


def test_colours_are_those_of_the_vertices():
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1)), ((2, 0, 0), (3, 1, 1))])
    colors = np.full((len(mesh.vertices), 4), 255, dtype=np.uint8)
    colors[len(colors) // 2 :] = (200, 100, 50, 255)
    painted = Mesh(mesh.vertices, mesh.faces, colors=colors)
    cloud = seen(painted).cloud
    right = cloud.points[:, 0] > 0
    # Colours are multiplied by the material's factor, which is linear.
    factor = painted.materials[0].base_color[:3]
    expected = [
        linear_to_srgb(factor * srgb_to_linear(np.array(c) / 255)) for c in ((200, 100, 50), (255,) * 3)
    ]
    assert np.allclose(cloud.colors[right], expected[0], atol=0.005)
    assert np.allclose(cloud.colors[~right], expected[1], atol=0.005)


def test_one_skin_is_cut_into_patches_and_every_face_has_one():
    mesh = boxes_mesh([((0, 0, 0), (1, 1, 1))])
    found = seen(mesh)
    assert found.skin
    assert found.cloud.count > 100
    assert len(found.face_piece) == 12
    assert found.face_piece.max() < found.cloud.count


def test_very_many_pieces_become_fewer_near_ones():
    boxes = [((x, y, z), (x + 0.5, y + 0.5, z + 0.5)) for x in range(8) for y in range(8) for z in range(8)]
    mesh = boxes_mesh(boxes)
    found = seen(mesh)
    assert find_segments(mesh).count == 512
    assert found.cloud.count == MOST_PIECES
    assert len(np.unique(found.face_piece)) == MOST_PIECES


@pytest.mark.parametrize(("turns", "leans", "askew"), [(30.0, 0.0, "30.0"), (0.0, 3.0, "3.0")])
def test_what_stands_askew_is_read_straight_and_turned_back(monkeypatch, turns, leans, askew):
    asset = cabinet_asset()
    pieces = find_segments(asset.mesh).face_segment
    part = [int(asset.face_part[pieces == k][0]) for k in range(pieces.max() + 1)]
    model = Told(Oracle(part, slides=False), KNOWN)
    model.stand_in(monkeypatch)
    nano = Nano(read_options(Nano, {"model": "any", "pool": False, "votes": 1, "least": 0.0}))
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(np.radians([leans, 0.0, turns]))
    straight, found = nano.segment(asset.mesh), nano.segment(asset.mesh.transformed(matrix))
    assert np.array_equal(found.face_part, straight.face_part)
    assert len(straight.joints) == 2
    for one, other in zip(straight.joints, found.joints, strict=True):
        expected = one.transformed(matrix)
        np.testing.assert_allclose(other.axis, expected.axis, atol=1e-5)
        np.testing.assert_allclose(other.origin, expected.origin, atol=1e-5)
        assert other.limits == one.limits
    points = straight.evidence[1].points @ matrix[:3, :3].T
    np.testing.assert_allclose(found.evidence[1].points, points, atol=1e-5)
    assert [note.text for note in found.notes if note not in straight.notes] == [
        f"it stands askew by {askew} degrees, and was read straight"
    ]


@pytest.mark.parametrize("slides", [False, True])
def test_what_the_network_says_becomes_parts_and_joints_in_metres(tmp_path, monkeypatch, slides):
    asset = cabinet_asset()
    pieces = find_segments(asset.mesh).face_segment
    part = [int(asset.face_part[pieces == k][0]) for k in range(pieces.max() + 1)]
    model = Told(Oracle(part, slides), KNOWN)
    model.stand_in(monkeypatch)
    options = read_options(Nano, {"model": "any", "pool": False, "votes": 1, "least": 0.0})
    found = Nano(options).segment(asset.mesh)
    assert [guess.name for guess in found.parts] == ["body", "door", "door_2"]
    # Parts are numbered by how sure the network is; which is which, their faces tell.
    for number in (1, 2):
        assert len(set(asset.face_part[found.face_part == number].tolist())) == 1
    assert ((found.face_part == 0) == (asset.face_part == 0)).all()
    size = float(np.ptp(asset.mesh.bounds, axis=0).max())
    for joint, name in zip(found.joints, ("door", "door_2"), strict=True):
        assert (joint.parent, joint.child) == ("body", name)
        assert joint.kind == ("prismatic" if slides else "revolute")
        # Limits of -0.5..0 about a candidate are 0..0.5 about its reverse.
        expected = 0.5 * size if slides else 0.5 * np.pi
        assert (joint.limits.lower, joint.limits.upper) == (0, pytest.approx(expected))
    assert any("taken for a cabinet" in note.text for note in found.notes)
    assert [guess.material for guess in found.parts] == ["plastic", "glass", "glass"]
    chance, points = found.evidence
    moving = np.unique(asset.mesh.faces[asset.face_part > 0])
    still = np.unique(asset.mesh.faces[asset.face_part == 0])
    assert chance.values[moving].min() > 0.99
    assert chance.values[still].max() < 0.01
    assert points.names[0] == "body"
    assert len(points.names) == 3


def test_parts_that_carry_each_other_in_a_ring_hang_on_the_body():
    assert predicting._without_loops([2, 1, 1]) == [0, 1, 1]


def test_weights_come_back_in_half_precision_and_say_the_same(tmp_path):
    network = NanoNetwork(CONFIG, 3).eval()
    save_network(network, tmp_path / "model")
    found = load_model(tmp_path / "model").network
    assert found.config == CONFIG
    for name, tensor in network.state_dict().items():
        assert torch.equal(found.state_dict()[name], tensor.half().float())
    first = (tmp_path / "model" / "model.safetensors").read_bytes()
    save_network(network, tmp_path / "again")
    assert (tmp_path / "again" / "model.safetensors").read_bytes() == first


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (lambda f: (f / "config.json").unlink(), "cannot read"),
        (lambda f: (f / "model.safetensors").write_bytes(b"no"), "holds no simart-nano"),
        (lambda f: (f / "config.json").write_text("{}"), "holds no simart-nano"),
        (
            lambda f: (f / "config.json").write_text(
                (f / "config.json").read_text().replace('"heads": 2', '"heads": 3')
            ),
            "holds no simart-nano",
        ),
        (
            lambda f: (f / "config.json").write_text(
                (f / "config.json").read_text().replace('"channels": 16', '"channels": 32')
            ),
            "of different ones",
        ),
    ],
)
def test_weights_that_do_not_fit_are_refused(tmp_path, damage, told):
    save_network(NanoNetwork(CONFIG, 0), tmp_path / "model")
    damage(tmp_path / "model")
    with pytest.raises(BadInputError, match=told):
        load_model(tmp_path / "model")


def test_parts_that_are_not_sure_enough_stay_with_the_body_and_are_told(monkeypatch):
    asset = cabinet_asset()
    pieces = find_segments(asset.mesh).face_segment
    part = [int(asset.face_part[pieces == k][0]) for k in range(pieces.max() + 1)]
    model = Told(Oracle(part, False), KNOWN)
    model.stand_in(monkeypatch)
    found = Nano(read_options(Nano, {"model": "any", "pool": False, "least": 0.9})).segment(asset.mesh)
    assert found.face_part.max() == 0
    assert found.joints == ()
    told = [note.text for note in found.notes if "not sure enough" in note.text]
    assert len(told) == 2
    assert all(text.startswith("a door that the network took for revolute") for text in told)


@pytest.mark.parametrize(("of_skins", "pool"), [(True, False), (False, True), (False, False)])
def test_a_recording_of_a_skin_shows_the_pieces_that_its_parts_were_found_by(tmp_path, of_skins, pool):
    """Those of relief, unless a network that knows no other looks at patches, and geometry at nothing."""
    mesh, folder = skin(SLAB), tmp_path / "model"
    shutil.copytree(shipped_folder(), folder, ignore=None if of_skins else shutil.ignore_patterns(SKINS_FILE))
    found = Nano(read_options(Nano, {"model": str(folder), "pool": pool})).segment(mesh)
    by_relief = find_segments(mesh, relief=True).face_segment
    assert np.array_equal(found.face_segment, by_relief) == (of_skins or pool)


@pytest.mark.parametrize(
    ("pool", "found", "alone"), [(True, False, True), (True, True, False), (False, False, False)]
)
def test_the_network_is_alone_where_geometry_is_asked_and_finds_nothing(monkeypatch, pool, found, alone):
    asset = cabinet_asset()
    model = Told(Oracle([0] * 5, False), KNOWN)
    model.stand_in(monkeypatch)
    if not found:
        monkeypatch.setattr("simart_kit_plugins.nano.proposals.of_geometry", lambda mesh, seed: [])
    told = []
    monkeypatch.setattr(
        "simart_kit_plugins.nano.trusting.enough",
        lambda said, least, skin, alone: told.append(alone) or enough(said, least, skin, alone),
    )
    Nano(read_options(Nano, {"model": "any", "pool": pool})).segment(asset.mesh)
    assert told == [alone]


@pytest.mark.parametrize(("pool", "asked"), [(True, True), (False, False)])
def test_a_spec_asks_geometry_for_more_only_where_it_is_pooled(monkeypatch, pool, asked):
    Told(Oracle([0] * 5, False), KNOWN).stand_in(monkeypatch)
    calls = []
    monkeypatch.setattr(
        "simart_kit_plugins.nano.proposals.of_geometry",
        lambda mesh, seed, spec=None: calls.append(spec) or [],
    )
    wanted = read_spec({"schema": 1, "kinds": {"door": {"count": 3}}})
    Nano(read_options(Nano, {"model": "any", "pool": pool})).segment_to(cabinet_asset().mesh, wanted)
    assert (wanted in calls) == bool(calls) == asked


@pytest.mark.parametrize(
    ("still", "most", "asked"), [((), 0, 1), ((), 1000, 1), (("cabinet",), 0, 0), (("cabinet",), 1000, 1)]
)
def test_of_many_faces_that_stand_still_geometry_is_not_asked(monkeypatch, still, most, asked):
    asset = cabinet_asset()
    model = Told(Oracle([0] * 5, False), Knowledge(materials={}, still=still))
    model.stand_in(monkeypatch)
    monkeypatch.setattr("simart_kit_plugins.nano.segmenter._MANY", most)
    calls = []
    monkeypatch.setattr(
        "simart_kit_plugins.nano.proposals.of_geometry",
        lambda mesh, seed: calls.append(mesh) or of_geometry(mesh, seed),
    )
    # Seen from one side alone the network is not sure enough to speak against geometry.
    found = Nano(read_options(Nano, {"model": "any", "votes": 1})).segment(asset.mesh)
    assert len(calls) == asked
    assert bool(found.joints) == (not still)


def test_candidates_that_say_the_same_are_alike():
    axis = np.array([[0, 0, 1.0], [0, 0, -1], [0, 0, 1], [1, 0, 0], [0, 0, 1]])
    origin = np.array([[0, 0, 0], [0.01, 0, 0.7], [0.1, 0, 0], [0, 0, 0], [0, 0, 0]])
    found = Candidates(axis, origin, np.array([EDGE, EDGE, EDGE, EDGE, SLIDE]), np.zeros(5, int), np.zeros(5))
    expected = np.eye(5, dtype=bool)
    expected[0, 1] = expected[1, 0] = True
    assert np.array_equal(alike(found), expected)
