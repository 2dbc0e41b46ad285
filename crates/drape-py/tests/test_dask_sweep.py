"""The program that runs a study on Dask, with a command that stands for `drape sweep run`."""

import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).resolve().parent.parent / "programs" / "dask_sweep.py"

# Writes a record and a file for its part of two points a task, and leaves out what is recorded.
WORKER = """
import pathlib, sys
options = dict(zip(sys.argv[1::2], sys.argv[2::2]))
task, tasks = options["--shard"].split("/")
keys = [f"{task}{point}abc" for point in (1, 2)]
if "--list" in sys.argv:
    print("\\n".join(f"todo\\t{key}" for key in keys))
    sys.exit()
if task == "2" and pathlib.Path("broken").exists():
    sys.exit("the disk of the worker is full")
for key in keys:
    record = pathlib.Path(options.get("--results", "out"), "points", key[:2], f"{key}.json")
    if record.exists():
        continue
    folder = record.with_suffix("")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "summary.json").write_text(task)
    record.write_text(task)
    with open("ran.txt", "a") as ran:
        ran.write(f"{key}\\n")
"""


@pytest.fixture
def study(tmp_path):
    pytest.importorskip("distributed")
    (tmp_path / "worker.py").write_text(WORKER)
    command = [sys.executable, str(tmp_path / "worker.py")]
    batch = f"Batch(command={command!r}, folder={str(tmp_path)!r}, output={str(tmp_path / 'out')!r}, tasks=3)"
    call = f'\n\nif __name__ == "__main__":\n    main({batch})\n'
    (tmp_path / "sweep.py").write_text(PROGRAM.read_text() + call)
    return tmp_path


def sweep(study, *options):
    command = [sys.executable, "sweep.py", *options]
    return subprocess.run(command, cwd=study, capture_output=True, text=True, timeout=120)


def records(folder):
    return sorted(path.stem for path in folder.glob("points/*/*.json"))


def test_all_tasks_run_and_done_points_are_left_out(study):
    expected = sorted(f"{task}{point}abc" for task in (1, 2, 3) for point in (1, 2))
    for _ in range(2):
        ended = sweep(study)
        assert (ended.returncode, ended.stdout) == (0, "3 of 3 tasks are done\n"), ended.stderr
        assert records(study / "out") == expected
    assert sorted((study / "ran.txt").read_text().split()) == expected


def test_results_meet_in_a_store_and_are_fetched(study):
    (study / "store").mkdir()
    for _ in range(2):
        ended = sweep(study, "--store", f"file://{study / 'store'}")
        assert (ended.returncode, ended.stdout) == (0, "3 of 3 tasks are done\n"), ended.stderr
        assert len(records(study / "store")) == 6
        assert records(study / "out") == records(study / "store")
        assert len(list((study / "out").glob("points/*/*/summary.json"))) == 6
    assert len((study / "ran.txt").read_text().split()) == 6


def test_a_task_that_fails_is_tried_again_and_reported(study):
    (study / "broken").touch()
    ended = sweep(study)
    assert (ended.returncode, ended.stdout) == (6, "2 of 3 tasks are done\n"), ended.stderr
    assert "the disk of the worker is full" in ended.stderr
    (study / "broken").unlink()
    assert sweep(study).returncode == 0
    assert len(records(study / "out")) == 6
