"""Programs of others under the keeper: what they print and how they end, and that nothing of them stays."""

import os
import signal
import sys
import time
from textwrap import dedent

import pytest
from simart_kit_plugins.workers import running
from simart_kit_plugins.workers.failures import last_lines, reason
from simart_kit_plugins.workers.running import Ended, run

from simart_kit.errors import BadInputError

from .p3sam_stand_in import run_alone, still_there

# Starts a child in a session of its own, writes both ids, and waits.
STUBBORN = """
import os, signal, subprocess, time
signal.signal(signal.SIGTERM, signal.SIG_IGN)
child = subprocess.Popen(["sleep", "60"], start_new_session=True)
open("pids.partial", "w").write(f"{os.getpid()} {child.pid}")
os.rename("pids.partial", "pids.txt")
"""


def pids(folder):
    """The ids that were written, once they are."""
    file, latest = folder / "pids.txt", time.monotonic() + 10
    while not file.exists():
        assert time.monotonic() < latest, "the program did not start"
        time.sleep(0.01)
    return [int(word) for word in file.read_text().split()]


def gone(processes, seconds=5.0):
    latest = time.monotonic() + seconds
    while still_there(processes) and time.monotonic() < latest:
        time.sleep(0.01)
    return still_there(processes) == []


def test_output_and_status_are_told(tmp_path):
    code = "import os, sys; print(os.getcwd(), flush=True); print('oh', file=sys.stderr); sys.exit(3)"
    assert run(run_alone(code), tmp_path, 10) == Ended(3, f"{tmp_path}\noh\n")


def test_the_last_of_a_long_output_is_kept(tmp_path):
    ended = run(run_alone("print('x' * 3_000_000, 'end')"), tmp_path, 10)
    assert ended.status == 0
    assert len(ended.output) == 1 << 20
    assert ended.output.endswith("x end\n")


def test_a_signal_is_told_as_by_a_shell(tmp_path):
    ended = run(run_alone("import os; os.kill(os.getpid(), 11)"), tmp_path, 10)
    assert ended.status == 128 + signal.SIGSEGV


def test_a_program_that_cannot_start_is_told(tmp_path):
    (tmp_path / "text").write_text("no program")
    ended = run([str(tmp_path / "text")], tmp_path, 10)
    assert ended.status == 127
    assert "cannot start" in ended.output


def test_a_program_is_not_led_astray_by_this_ones_python(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "/ours")
    monkeypatch.setenv("PYTHONHOME", "/ours")
    monkeypatch.setenv("CUDA_VISIBLE_DEVICES", "3")
    code = (
        "import os; print([os.environ.get(k) for k in ('PYTHONPATH', 'PYTHONHOME', 'CUDA_VISIBLE_DEVICES')])"
    )
    assert run(run_alone(code), tmp_path, 10).output == "[None, None, '3']\n"


def test_too_long_is_ended_with_what_it_started(tmp_path):
    start = time.monotonic()
    ended = run(run_alone(STUBBORN + "time.sleep(60)"), tmp_path, 0.5)
    assert time.monotonic() - start < 5
    assert ended.status is None
    assert still_there(pids(tmp_path)) == []


def test_what_a_program_leaves_running_is_ended(tmp_path):
    ended = run(run_alone(STUBBORN), tmp_path, 10)
    assert ended.status == 0
    assert still_there(pids(tmp_path)) == []


def test_an_interrupt_ends_it(tmp_path):
    def interrupt(number, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGUSR1, interrupt)
    code = f"{STUBBORN}\nos.kill({os.getpid()}, signal.SIGUSR1)\ntime.sleep(60)"
    try:
        with pytest.raises(KeyboardInterrupt):
            run(run_alone(code), tmp_path, 60)
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert still_there(pids(tmp_path)) == []


def test_it_ends_when_who_asked_is_killed(tmp_path):
    asker = dedent(f"""
        import sys
        from pathlib import Path
        from simart_kit_plugins.workers.running import run
        run({run_alone(STUBBORN + "time.sleep(60)")!r}, Path({str(tmp_path)!r}), 60)
    """)
    process = os.posix_spawn(sys.executable, [sys.executable, "-c", asker], os.environ)
    found = pids(tmp_path)
    assert still_there(found) == found
    os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)
    assert gone(found)


def test_a_killed_keeper_leaves_no_program(tmp_path):
    code = """
    import os, signal, time
    open("pids.txt", "w").write(str(os.getpid()))
    os.kill(os.getppid(), signal.SIGKILL)
    time.sleep(60)
    """
    ended = run(run_alone(code), tmp_path, 60)
    assert ended.status == -signal.SIGKILL
    assert gone(pids(tmp_path))


def test_other_systems_are_told_that_it_is_linux_only(tmp_path, monkeypatch):
    monkeypatch.setattr(running.sys, "platform", "win32")
    with pytest.raises(BadInputError, match="Linux only"):
        run(run_alone(""), tmp_path, 1)


@pytest.mark.parametrize(
    ("status", "output", "told"),
    [
        (1, "torch.OutOfMemoryError: CUDA out of memory. Tried", "ran out of GPU memory"),
        (137, "", "was killed (SIGKILL): most likely the memory was full"),
        (139, "", "crashed (SIGSEGV)"),
        (255, "", "crashed (signal 127)"),
        (2, "usage: infer.py", "failed with status 2"),
        (1, "ModuleNotFoundError: No module named 'torch.fake'", "No module named 'torch.fake'"),
        (-9, "", "was killed (SIGKILL)"),
        (None, "CUDA out of memory", "took longer than 9 s"),
    ],
)
def test_reasons(status, output, told):
    assert told in reason(Ended(status, output), 9)


def test_last_lines_are_one_line_without_control_characters():
    assert last_lines("") == ""
    assert last_lines("a\n\x1b[31mred\x1b[0m\n\n 5%\r10%\n\x07end\n") == "5% | 10% | end"
    assert last_lines("x" * 1000) == "..." + "x" * 240
