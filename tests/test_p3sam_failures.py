"""What goes wrong with P3-SAM is one clear line, and leaves no process behind."""

import ast
import sys
import time
from pathlib import Path

import pytest
from simart_kit_plugins.p3sam import worker
from simart_kit_plugins.workers.failures import WorkerError

from simart_kit.errors import BadInputError

from .p3sam_stand_in import StandIn, segment, still_there


def failure(tmp_path, behaviour, **options):
    """How the stand-in's going wrong is told, and how long that took; nothing is left of it."""
    stand_in = StandIn(tmp_path, behaviour)
    start = time.monotonic()
    with pytest.raises(WorkerError) as error:
        segment(stand_in, **options)
    text = str(error.value)
    assert "\n" not in text
    assert text.startswith("P3-SAM ")
    assert len(stand_in.pids) == (2 if behaviour == "hang" else 1), "it ran"
    assert still_there(stand_in.pids) == []
    (log,) = stand_in.kept
    assert log.endswith(".log")
    assert str(stand_in.cache / "p3sam" / log) in text
    assert "imported" in (stand_in.cache / "p3sam" / log).read_text()
    return text, time.monotonic() - start


def test_a_hang_is_stopped_with_all_that_it_started(tmp_path):
    text, seconds = failure(tmp_path, "hang", timeout=1.0)
    assert "took longer than 1 s and was stopped: raise segmenter.options.timeout" in text
    assert "NMS: 50%" in text
    assert seconds < 4


@pytest.mark.parametrize(
    ("behaviour", "told"),
    [
        ("segfault", "crashed (SIGSEGV)"),
        ("killed", "was killed (SIGKILL): most likely the memory was full; it printed: imported; all"),
        ("gpu memory", "ran out of GPU memory: free some of it"),
        ("silent", "wrote no result.json"),
        ("nan", "wrote a 'vertices' with values that are NaN or infinite"),
    ],
)
def test_what_goes_wrong_is_one_line_and_leaves_no_process(tmp_path, behaviour, told):
    text, _ = failure(tmp_path, behaviour)
    assert told in text


def test_no_gpu_is_told_in_p3sams_own_words(tmp_path):
    stand_in = StandIn(tmp_path)
    (stand_in.folder / "XPart/partgen/models/sonata.py").write_text("GPUS = 0\n")
    with pytest.raises(WorkerError, match=r"failed: RuntimeError: Found no NVIDIA driver on your system\."):
        segment(stand_in)


def test_a_missing_library_is_named(tmp_path):
    stand_in = StandIn(tmp_path)
    (stand_in.demo.parent / "model.py").write_text("import fpsample\n")
    with pytest.raises(WorkerError, match=r"No module named 'fpsample'.*in its own environment"):
        segment(stand_in)


def test_what_is_not_installed_is_said_before_anything_runs(tmp_path):
    stand_in = StandIn(tmp_path)
    with pytest.raises(BadInputError, match=r"has no P3-SAM/demo/auto_mask\.py"):
        segment(stand_in, folder=str(tmp_path))
    with pytest.raises(BadInputError, match="there is no program /no/python"):
        segment(stand_in, python="/no/python")
    with pytest.raises(BadInputError, match=r"no such file of weights: gone\.safetensors"):
        segment(stand_in, checkpoint="gone.safetensors")
    assert stand_in.pids == []


def test_the_worker_imports_nothing_that_its_environment_may_lack():
    tree = ast.parse(Path(worker.__file__).read_text(encoding="utf-8"))
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0
            names.add(node.module.partition(".")[0])
    assert names <= {"numpy", "trimesh"} | set(sys.stdlib_module_names)
