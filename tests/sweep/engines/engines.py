"""Runs a study on an engine, kills one of its workers at a third of the points and the engine at two
thirds, and holds the table against that of a serial run. With --calm nothing is killed, and the time
of a point beside its run is measured.

    python engines.py dask|dask-store|hyperqueue|slurm [--points N] [--chunk N] [--calm] [--drape PROGRAM]
"""

import argparse
import pathlib
import sys
import tempfile
import time

from dask_engine import Dask, DaskStore
from hyperqueue_engine import HyperQueue
from slurm_engine import Slurm
from study import ROOT, Study

ENGINES = {"dask": Dask, "dask-store": DaskStore, "hyperqueue": HyperQueue, "slurm": Slurm}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("engine", choices=ENGINES)
    parser.add_argument("--points", type=int, default=60)
    parser.add_argument("--chunk", type=int, default=5)
    parser.add_argument("--calm", action="store_true")
    parser.add_argument("--drape", type=pathlib.Path, default=ROOT / "target/release/drape")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="drape-", ignore_cleanup_errors=True) as folder:
        study = Study(folder, arguments.points, arguments.drape.resolve())
        engine = ENGINES[arguments.engine](study, arguments.chunk)
        begin = time.monotonic()
        engine.start()
        try:
            said = "nothing killed" if arguments.calm else disturb(engine, study)
            engine.finish()
        finally:
            engine.kill()
        wall = time.monotonic() - begin
        serial = study.verify()
        beside = {"engine": 2 * wall - study.seconds(), "serial": serial - study.seconds("serial")}
    print(
        f"{arguments.engine}: {arguments.points} points, each once, {said}; {wall:.1f} s with two workers, "
        f"{serial:.1f} s one by one"
    )
    if arguments.calm:
        times = [f"{1e3 * time / arguments.points:.1f} ms ({name})" for name, time in beside.items()]
        print(f"{arguments.engine}: a point takes {' and '.join(times)} beside its run")


def disturb(engine, study):
    """Kills a worker at a third of the points, and the engine at two thirds, which begins again."""
    study.wait_for(1 / 3)
    engine.kill_worker()
    study.wait_for(2 / 3)
    engine.kill()
    done = study.records()
    engine.start()
    return f"{done} done when the engine was killed"


if __name__ == "__main__":
    sys.exit(main())
