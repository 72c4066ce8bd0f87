"""Reading data sets, and the command that builds them."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from simart_kit_plugins.simart.dataset.manifest import MANIFEST, read_manifest
from simart_kit_plugins.simart.dataset.reading import (
    check_hashes,
    read_records,
    read_shard,
    record_count,
)
from simart_kit_plugins.simart.dataset.shards import Entry, ShardWriter

from simart_kit.cli.main import run
from simart_kit.errors import BadInputError

from .dataset_objects import built, few


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Seven records in three shards, of a lidded box, a clamp and a stool that does not move."""
    import torch

    torch.set_num_threads(1)
    out = tmp_path_factory.mktemp("data")
    built(out, few(["box", "clamp", "stool"]), states=3, shard_size=3)
    return out


def copied(folder: Path, to: Path) -> Path:
    to.mkdir()
    for path in folder.iterdir():
        (to / path.name).write_bytes(path.read_bytes())
    return to


def test_records_come_in_order_with_all_that_they_hold(folder: Path) -> None:
    records = list(read_records(folder))
    assert [record.key for record in records] == [
        *(f"generated-box-0-00000-0{state}" for state in range(3)),
        *(f"generated-clamp-0-00000-0{state}" for state in range(3)),
        "generated-stool-0-00000-00",
    ]
    assert record_count(folder) == 7
    assert {record.source for record in records} == {"generated"}
    assert records[-1].answer.parts[0].motion is None
    check_hashes(folder)


def test_a_shuffle_is_another_order_of_the_same_records_and_its_seed_decides_it(folder: Path) -> None:
    plain = [record.key for record in read_records(folder)]
    orders = [[record.key for record in read_records(folder, shuffle_seed=seed)] for seed in (1, 1, 2, 3)]
    assert orders[0] == orders[1]
    assert all(sorted(order) == sorted(plain) for order in orders)
    assert len({tuple(order) for order in orders} | {tuple(plain)}) >= 3


def test_tasks_can_be_chosen(folder: Path) -> None:
    urdf = list(read_records(folder, tasks=("urdf",)))
    assert [len(record.pairs) for record in urdf] == [1] * 7
    grounding = list(read_records(folder, tasks=("grounding",)))
    assert {pair.task for record in grounding for pair in record.pairs} == {"grounding"}
    assert list(read_records(folder, tasks=())) == []


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (lambda data: data[:2000], r"shard-000001\.tar has 2000 bytes, not"),
        (
            lambda data: data.replace(b'"scale"', b'"scare"', 1),
            r"shard-000001\.tar: generated-clamp.* is damaged",
        ),
        (lambda data: b"\xff" * 600 + data[600:], r"shard-000001\.tar is damaged"),
    ],
)
def test_a_damaged_shard_is_named_when_it_is_reached(
    folder: Path, tmp_path: Path, damage: Any, told: str
) -> None:
    broken = copied(folder, tmp_path / "broken")
    path = broken / "shard-000001.tar"
    path.write_bytes(damage(path.read_bytes()))
    records = read_records(broken)
    assert [next(records).state for _ in range(3)] == [0, 1, 2]
    with pytest.raises(BadInputError, match=told):
        list(records)
    with pytest.raises(BadInputError, match=r"shard-000001\.tar is missing or damaged"):
        check_hashes(broken)


def test_files_of_no_record_and_records_too_few_are_refused(folder: Path, tmp_path: Path) -> None:
    writer = ShardWriter(tmp_path / "odd.tar", tmp_path / "partial")
    writer.add([Entry("a.b", b"{}", None)])
    writer.close()
    data = (tmp_path / "odd.tar").read_bytes()
    name = b"a.b.json\0"
    # A tar header's checksum is a sum of bytes, so that two letters may change places.
    (tmp_path / "odd.tar").write_bytes(data.replace(name, b"a.b.josn\0"))
    with pytest.raises(BadInputError, match=r"odd\.tar holds 'a\.b\.josn', which belongs to no record"):
        list(read_shard(tmp_path / "odd.tar"))
    shard = read_manifest(folder).shards[0]
    with pytest.raises(BadInputError, match="has 3 records, not 4"):
        list(read_shard(folder / shard.file, shard.model_copy(update={"records": 4})))


def test_what_is_no_finished_data_set_is_refused(folder: Path, tmp_path: Path) -> None:
    with pytest.raises(BadInputError, match="no such folder"):
        record_count(tmp_path / "nowhere")
    with pytest.raises(BadInputError, match=r"manifest\.json is missing.*run the same command again"):
        list(read_records(tmp_path))
    broken = copied(folder, tmp_path / "broken")
    (broken / "shard-000002.tar").unlink()
    with pytest.raises(BadInputError, match=r"shard-000002\.tar is missing"):
        list(read_records(broken))
    (broken / MANIFEST).write_text("{}")
    with pytest.raises(BadInputError, match=r"manifest\.json is damaged: options: Field required"):
        record_count(broken)
    with pytest.raises(BadInputError, match="is missing"):
        next(read_shard(tmp_path / "x.tar"))


ARGUMENTS = ["--generate", "box", "-n", "2", "--states", "2", "--no-pictures", "--workers", "1"]


def test_the_command_prints_statistics_with_the_paper_s_numbers(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "out")
    assert run(["dataset", "build", out, *ARGUMENTS]) == 0
    shown = capsys.readouterr()
    assert "4 records in 1 shards" in shown.out
    assert "516" in shown.out
    assert "862" in shown.out
    assert "4138" in shown.out
    assert run(["dataset", "build", out, *ARGUMENTS, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["statistics"]["records"] == 4
    assert document["options"]["generate"] == ["box"]


def test_the_command_says_what_is_wrong_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = str(tmp_path / "out")
    assert run(["dataset", "build", out]) == 2
    assert "--data FOLDER or --generate CATEGORY|all" in capsys.readouterr().err
    assert run(["dataset", "build", out, "--generate", "dragon"]) == 2
    assert "unknown category 'dragon'" in capsys.readouterr().err
    assert run(["dataset", "build", out, "--data", str(tmp_path / "no")]) == 2
    assert capsys.readouterr().err.strip() == f"error: no such folder: {tmp_path / 'no'}"
    assert not (tmp_path / "out").exists()


def started(out: Path, workers: int) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "simart_kit", "dataset", "build", str(out), "--generate", "all"]
    options = ["--limit", "8", "--states", "3", "--shard-size", "6", "--workers", str(workers)]
    return subprocess.Popen([*command, *options], stderr=subprocess.PIPE, text=True)


def whole(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def stopped(out: Path, signum: signal.Signals) -> list[str]:
    """Send a build with two workers a signal after its next shard; lines of its stderr."""
    before = len(list(out.glob("*.tar")))
    with started(out, workers=2) as process:
        deadline = time.monotonic() + 100
        while process.poll() is None and len(list(out.glob("*.tar"))) == before:
            assert time.monotonic() < deadline
            time.sleep(0.05)
        process.send_signal(signum)
        _, told = process.communicate()
        assert process.returncode != 0
    return told.splitlines()


@pytest.mark.slow
def test_two_workers_killed_and_resumed_give_the_bytes_of_one(tmp_path: Path) -> None:
    for name, workers in (("one", 1), ("two", 2)):
        if name == "two":
            stopped(tmp_path / name, signal.SIGKILL)
            assert stopped(tmp_path / name, signal.SIGINT)[-1] == "interrupted"
        with started(tmp_path / name, workers) as process:
            process.communicate()
            assert process.returncode == 0
    assert whole(tmp_path / "two") == whole(tmp_path / "one")
