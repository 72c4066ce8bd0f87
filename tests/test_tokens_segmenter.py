"""Tokens of an object and its parts, through a file, to face labels; and what is told when that fails."""

import json
import re

import numpy as np
import pytest
from simart_kit_plugins.simart.codec import encode_parts
from simart_kit_plugins.simart.tokens_evidence import token_cells
from simart_kit_plugins.simart.tokens_file import PartTokens, TokensFile, write_tokens_file
from simart_kit_plugins.simart.tokens_segmenter import Tokens

from simart_kit.asset_io import load_asset
from simart_kit.cli.main import run
from simart_kit.errors import BadInputError
from simart_kit.provenance import file_hash
from simart_kit.recipe import read_options
from simart_kit.testing.meshes import boxes_mesh, cabinet_asset
from simart_kit.voxels import GridFrame

from .recordings import paths_in, text
from .token_models import Dictionary, DictionaryConfig, use_dictionary

NAMES = ("body", "door", "drawer")


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A working folder with a cabinet, and its tokens by a model that loses nothing, the shipped one here."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("simart_kit.render.write_preview", lambda asset, path: path)
    model = use_dictionary(monkeypatch, tmp_path / "model")
    asset = cabinet_asset(textured=False)
    lines = [f"v {x:.6f} {z:.6f} {-y:.6f}" for x, y, z in asset.mesh.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in face) for face in asset.mesh.faces]
    (tmp_path / "cabinet.obj").write_text("\n".join(lines))
    write(tmp_path / "parts.json", model, asset)
    return tmp_path


def write(path, model, asset, names=NAMES):
    made = encode_parts(model, asset.mesh, asset.face_part, names)
    parts = [PartTokens(name, tokens, name, "steel") for name, tokens in zip(names, made.parts, strict=True)]
    fingerprint = file_hash(path.parent / "model" / "model.safetensors")[:16]
    write_tokens_file(TokensFile(fingerprint, made.whole, tuple(parts)), path)


def segmented(mesh, **options):
    return Tokens(read_options(Tokens, {"file": "parts.json"} | options)).segment(mesh)


@pytest.mark.parametrize("mode", ["segments", "seeds"])
def test_the_parts_come_back_with_their_names(home, mode):
    asset = cabinet_asset()
    found = segmented(asset.mesh, transfer=mode)
    assert [(p.name, p.label, p.material) for p in found.parts] == [(n, n, "steel") for n in NAMES]
    areas = asset.mesh.face_areas
    for part in range(3):
        mine, true = found.face_part == part, asset.face_part == part
        # Boards are as thin as a voxel, so that single faces may go to the part that they touch.
        assert areas[mine & true].sum() / areas[mine | true].sum() > (0.99 if mode == "segments" else 0.9)


def test_segments_give_whole_boxes_one_label(home):
    found = segmented(cabinet_asset().mesh)
    assert all(len(set(found.face_part[box : box + 12])) == 1 for box in range(0, 108, 12))
    assert found.face_segment is not None


def test_evidence_shows_every_step(home):
    found = segmented(cabinet_asset().mesh)
    tokens, whole, errors, seeds, chances = found.evidence
    assert [piece.name for piece in found.evidence] == [
        "Tokens by code",
        "Reconstruction",
        "Errors",
        "Part seeds",
        "Probability",
    ]
    assert tokens.categorical
    assert len(whole.indices) > len(tokens.indices)
    assert len(errors.indices) == 0
    assert seeds.names == chances.names == NAMES
    assert len(seeds.points) >= len(whole.indices)
    assert chances.values.shape == (len(cabinet_asset().mesh.vertices), 3)
    np.testing.assert_allclose(chances.values.sum(axis=1), 1, atol=1e-5)


def test_wrong_voxels_are_told_apart(home, monkeypatch):
    class Shifted(Dictionary):
        def decode(self, codes, occupied):
            return super().decode(codes, occupied).roll(1, dims=-1)

    model = Shifted()
    use_dictionary(monkeypatch, home / "model", model)
    block = boxes_mesh([((0, 0, 0), (1, 1, 0.5))])
    made = encode_parts(model, block, np.zeros(12, dtype=int), ("body",))
    fingerprint = file_hash(home / "model" / "model.safetensors")[:16]
    file = TokensFile(fingerprint, made.whole, (PartTokens("body", made.parts[0]),))
    write_tokens_file(file, home / "block.json")
    errors = segmented(block, file="block.json").evidence[2]
    kinds = [errors.names[kind] for kind in errors.values]
    # The block spans 16..48 of the 64 voxels in z, so that 15, 16, 47 and 48 are on as wide as it is, and
    # its walls between. One voxel up, 15 and the inside of 47 are missing; 49 and the inside of 17 are added.
    assert kinds.count("missing") == kinds.count("added") == 64 * 64 + 62 * 62
    assert set(errors.indices[np.array(kinds) == "missing"][:, 2]) == {15, 47}
    assert set(errors.indices[np.array(kinds) == "added"][:, 2]) == {17, 49}


def test_cells_that_are_no_cubes_are_shown_as_cubes():
    model = Dictionary(DictionaryConfig(cells=(16, 8, 8), codebook_size=8192))
    tokens = encode_parts(model, boxes_mesh([((0, 0, 0), (1, 1, 1))]), np.zeros(12, int), ("body",)).whole
    piece = token_cells(tokens, GridFrame((0.0, 0.0, 0.0), 1 / 64, 64))
    assert (piece.frame.resolution, piece.frame.voxel_size) == (16, 1 / 16)
    assert len(piece.indices) == 4 * len(tokens.index)
    first = piece.values[(piece.indices < [1, 2, 2]).all(axis=1)]
    assert first.tolist() == [tokens.code[0]] * 4


def test_tokens_of_another_mesh_are_noticed(home):
    notes = segmented(boxes_mesh([((0, 0, 0), (1, 1, 1)), ((0, 0, 1), (0.3, 0.3, 2))])).notes
    assert any(n.level == "warning" and "check that the tokens are of this mesh" in n.text for n in notes)
    assert not any(n.level == "warning" for n in segmented(cabinet_asset().mesh).notes)


def test_a_part_that_decodes_to_nothing_is_named(home, monkeypatch):
    class Deaf(Dictionary):
        def decode(self, codes, occupied):
            logits = super().decode(codes, occupied)
            logits[2] = -1  # the object, the body, and then the door
            return logits

    use_dictionary(monkeypatch, home / "model", model := Deaf())
    write(home / "parts.json", model, cabinet_asset())
    with pytest.raises(BadInputError, match="part 'door' decodes to no voxel"):
        segmented(cabinet_asset().mesh)


def test_no_file_is_told_with_how_to_write_one():
    with pytest.raises(BadInputError, match=r"no tokens file is named.*simart-kit tokens MESH --out"):
        Tokens().segment(cabinet_asset().mesh)


def convert(*arguments):
    stages = ["--set", "modify=[]", "--set", "export=[]"]
    return run(["convert", "cabinet.obj", "--recipe", "tokens", "--quiet", *stages, *arguments])


FILE = ("--set", "segmenter.options.file=parts.json")


@pytest.mark.parametrize("mode", ["seeds", "segments"])
def test_convert_takes_tokens_and_a_transfer(home, mode, capfd):
    assert convert(*FILE, "--transfer", mode) == 0, capfd.readouterr().err
    asset = load_asset(home / "out" / "cabinet")
    assert {p.name for p in asset.parts} == set(NAMES)
    recipe = json.loads((home / "out" / "cabinet" / "provenance.json").read_text())["recipe"]
    assert recipe["segmenter"]["options"]["transfer"] == mode
    shown = paths_in(home / "out" / "cabinet" / "cabinet.rrd")
    assert {"/voxels", "/parts/door", "/evidence/tokens_by_code", "/evidence/part_seeds/door"} <= shown
    assert "/evidence/probability/drawer" in shown


def test_transfer_needs_a_segmenter_that_decodes_voxels(home, capfd):
    before = sorted(home.rglob("*"))
    assert run(["convert", "cabinet.obj", "--transfer", "seeds"]) == 2
    err = capfd.readouterr().err
    assert re.fullmatch(
        "error: --transfer seeds: segmenter 'nano' decodes no voxels; .*--recipe tokens\n", err
    )
    assert sorted(home.rglob("*")) == before


def cell_of(table, part):
    """The first cell of a part, without its code: `<voxel> 43`."""
    return " ".join(table["parts"][part]["tokens"].split()[:2])


@pytest.mark.parametrize(
    ("break_it", "told"),
    [
        (lambda t: t["parts"][1].update(tokens="<voxel> 999 1"), "part 'door': cell index out of range"),
        (lambda t: t["parts"][1].update(tokens=cell_of(t, 1) + " 4096"), "part 'door': code out of range"),
        (lambda t: t["parts"][1].update(tokens=cell_of(t, 1)), "part 'door': triplet cut short"),
        (lambda t: t.update(model="0" * 16), "its codes are of model 0000000000000000"),
        (lambda t: t.pop("grid"), "grid: Field required"),
    ],
)
def test_a_bad_file_is_one_line_and_the_recording_keeps_what_was_there(home, break_it, told, capfd):
    table = json.loads((home / "parts.json").read_text())
    break_it(table)
    (home / "parts.json").write_text(json.dumps(table))
    assert convert(*FILE) == 1
    (line,) = capfd.readouterr().err.splitlines()
    assert re.match(f"error: segmenter 'tokens' failed .*{told}", line), line
    assert {path.name for path in (home / "out" / "cabinet").iterdir()} == {"failed"}
    recording = home / "out" / "cabinet" / "failed" / "cabinet.rrd"
    assert {"/voxels", "/source/mesh/surface"} <= paths_in(recording)
    assert told.split(":")[0] in text(recording, "/failure")


def test_a_missing_file_is_told_by_its_name(home, capfd):
    assert convert("--set", "segmenter.options.file=gone.json") == 1
    assert "cannot read tokens file gone.json" in capfd.readouterr().err
