"""Answers of workers: read only when they are what was agreed on, and kept for the next time."""

import io
import json
import threading
import zipfile

import numpy as np
import pytest
from simart_kit_plugins.workers import installation
from simart_kit_plugins.workers.array_files import Expected, read_arrays
from simart_kit_plugins.workers.asking import Call, Program, answer
from simart_kit_plugins.workers.caching import AnswerCache, answer_key, cache_folder
from simart_kit_plugins.workers.failures import WorkerError
from simart_kit_plugins.workers.protocol import check_status, write_request
from simart_kit_plugins.workers.surface import sent_surface

from simart_kit.errors import OutputError
from simart_kit.testing.meshes import cabinet_mesh, static_asset

from .p3sam_stand_in import StandIn, run_alone

EXPECTED = {"ids": Expected("whole numbers", (-1,)), "points": Expected("numbers", (-1, 3))}
GOOD = {"ids": np.arange(4), "points": np.zeros((2, 3))}


def written(path, **changes):
    arrays = {key: value for key, value in {**GOOD, **changes}.items() if value is not None}
    np.savez(path / "result.npz", **arrays)
    return path / "result.npz"


def test_arrays_are_read_as_written(tmp_path):
    points = np.asfortranarray(np.arange(6.0).reshape(2, 3))
    found = read_arrays(written(tmp_path, points=points, other=np.array([None])), EXPECTED, 1000)
    assert list(found) == ["ids", "points"]
    assert found["ids"].tolist() == [0, 1, 2, 3]
    assert found["points"].tolist() == [[0, 1, 2], [3, 4, 5]]


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"ids": None}, "wrote a result.npz without 'ids'"),
        ({"ids": np.zeros(4)}, "wrote a 'ids' of dtype float64: expected are whole numbers"),
        ({"ids": np.zeros(4, dtype=bool)}, "of dtype bool"),
        ({"ids": np.array([None] * 4)}, "of dtype object"),
        ({"ids": np.zeros((4, 1), dtype=int)}, r"of shape \(4, 1\): expected is \(-1,\)"),
        ({"points": np.zeros((3, 2))}, r"of shape \(3, 2\): expected is \(-1, 3\)"),
        ({"points": np.full((2, 3), np.nan)}, "'points' with values that are NaN or infinite"),
        ({"points": np.zeros((1000, 3))}, "'points' of 0 MB: more than there can be"),
    ],
)
def test_other_arrays_are_refused(tmp_path, changes, told):
    with pytest.raises(WorkerError, match=told):
        read_arrays(written(tmp_path, **changes), EXPECTED, 1000)


def test_a_header_that_promises_more_than_memory_is_refused_unread(tmp_path):
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<i8", "fortran_order": False, "shape": (10**15,)})
    with zipfile.ZipFile(tmp_path / "result.npz", "w") as archive:
        archive.writestr("ids.npy", header.getvalue())
    with pytest.raises(WorkerError, match="more than there can be"):
        read_arrays(tmp_path / "result.npz", EXPECTED, 1000)


def test_every_damage_to_a_file_is_noticed(tmp_path):
    path = written(tmp_path)
    content = path.read_bytes()
    data = content.index(np.arange(4).tobytes())
    for damaged in (
        b"",
        b"no archive",
        content[: len(content) // 2],
        content[:data] + b"\x07" + content[data + 1 :],
    ):
        path.write_bytes(damaged)
        with pytest.raises(WorkerError, match=r"wrote a result\.npz that cannot be read"):
            read_arrays(path, EXPECTED, 1000)
    path.unlink()
    with pytest.raises(WorkerError, match=r"wrote no result\.npz"):
        read_arrays(path, EXPECTED, 1000)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (None, "wrote no result.json"),
        ("{", "cannot be read"),
        ("[" * 100_000, "cannot be read"),
        ("[]", "cannot be read"),
        ('{"status": "ok"}', "cannot be read"),
        ('{"protocol": 2, "status": "ok"}', "speaks protocol 2: expected is 1"),
        ('{"protocol": 1, "status": "maybe"}', "says that its status is 'maybe'"),
        ('{"protocol": 1, "status": "error"}', "failed: it does not say why"),
        ('{"protocol": 1, "status": "error", "message": "A:\\nb"}', "failed: A: b"),
        ('{"protocol": 1, "status": "error", "message": "CUDA out of memory"}', "ran out of GPU memory"),
    ],
)
def test_a_status_that_is_not_ok_is_told(tmp_path, text, told):
    if text is not None:
        (tmp_path / "result.json").write_text(text)
    with pytest.raises(WorkerError) as error:
        check_status(tmp_path)
    assert told in str(error.value)
    assert "\n" not in str(error.value)


def test_a_request_is_what_the_protocol_says(tmp_path):
    sent = sent_surface(static_asset().mesh, "+z")
    write_request(tmp_path, sent, tmp_path / "checkout", {"seed": 3})
    assert json.loads((tmp_path / "request.json").read_text()) == {
        "protocol": 1,
        "folder": str(tmp_path / "checkout"),
        "options": {"seed": 3},
    }
    with np.load(tmp_path / "mesh.npz") as arrays:
        assert arrays["vertices"].dtype == np.float64
        assert arrays["vertices"].shape == (8, 3)
        assert arrays["faces"].shape == (12, 3)


def test_a_key_depends_on_mesh_options_and_version():
    sent, other = (sent_surface(mesh, "+z") for mesh in (cabinet_mesh(), static_asset().mesh))
    keys = {
        answer_key("a", 1, {"seed": 1}, sent),
        answer_key("b", 1, {"seed": 1}, sent),
        answer_key("a", 2, {"seed": 1}, sent),
        answer_key("a", 1, {"seed": 2}, sent),
        answer_key("a", 1, {"seed": 1}, other),
        answer_key("a", 1, {"seed": 1}, sent_surface(cabinet_mesh(), "+y")),
    }
    assert len(keys) == 6
    assert answer_key("a", 1, {"x": 1, "y": 2}, sent) == answer_key("a", 1, {"y": 2, "x": 1}, sent)


def test_answers_are_kept_below_the_cache_of_the_user(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folder("", "p3sam") == tmp_path / "simart-kit" / "p3sam"
    assert cache_folder("here", "p3sam").as_posix() == "here/p3sam"


class Echo(Program[list[int]]):
    """Answers with the ids 0..3, and notes that it ran; fails at first if told so."""

    name = "Echo"
    expected = EXPECTED

    def __init__(self, folder):
        self.folder = folder

    def prepare(self, place):
        return Call(run_alone(f"open({str(self.folder / 'runs')!r}, 'a').write('x')"), place)

    def collect(self, place, most):
        return GOOD

    def understand(self, arrays):
        if arrays["ids"].max() > 3:
            raise WorkerError("says nonsense")
        return arrays["ids"].tolist()


def runs(folder):
    return len((folder / "runs").read_text())


def test_an_answer_in_the_cache_that_makes_no_sense_is_asked_for_again(tmp_path):
    cache = AnswerCache(tmp_path / "cache")
    cache.check_writable()
    cache.put("key", {**GOOD, "ids": np.array([99])})
    for _ in range(2):
        assert answer(Echo(tmp_path), "key", 1, 10, cache) == [0, 1, 2, 3]
    assert runs(tmp_path) == 1


def test_runs_at_the_same_time_do_not_disturb_each_other(tmp_path):
    cache, found = AnswerCache(tmp_path / "cache"), []
    threads = [
        threading.Thread(target=lambda: found.append(answer(Echo(tmp_path), "key", 1, 10, cache)))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [[0, 1, 2, 3]] * 4
    assert [path.name for path in cache.folder.iterdir()] == ["key.npz"]


def test_a_cache_that_cannot_be_written_is_told_before_anything_runs(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"cannot write .*file/cache.*segmenter\.options\.cache"):
        answer(Echo(tmp_path), "key", 1, 10, AnswerCache(tmp_path / "file" / "cache"))
    assert not (tmp_path / "runs").exists()


def test_the_doctor_tells_what_is_missing_and_the_licence(tmp_path, monkeypatch):
    from simart_kit_plugins.p3sam import diagnose

    monkeypatch.delenv("SIMART_P3SAM_FOLDER", raising=False)
    monkeypatch.delenv("SIMART_P3SAM_PYTHON", raising=False)
    folder, python, gpu, licence = diagnose()
    assert (folder.state, folder.detail) == ("missing", "SIMART_P3SAM_FOLDER is not set")
    assert "SIMART_P3SAM_PYTHON to the python of its environment" in python.remedy
    assert gpu.subject == "GPU for P3-SAM"
    assert licence.ok
    assert "European Union" in licence.detail
    stand_in = StandIn(tmp_path)
    monkeypatch.setenv("SIMART_P3SAM_FOLDER", str(stand_in.folder))
    monkeypatch.setenv("SIMART_P3SAM_PYTHON", str(stand_in.python))
    assert [finding.state for finding in diagnose()[:2]] == ["ok", "ok"]
    (stand_in.demo / "auto_mask.py").unlink()
    assert diagnose()[0].state == "broken"
    from simart_kit_plugins.p3sam.system import P3SAM

    monkeypatch.setenv("SIMART_P3SAM_FOLDER", str(tmp_path / "gone"))
    assert "there is no folder" in installation.findings(P3SAM)[0].detail
