"""HyperQueue: a server and two workers in one process, started by the interface to Python.

Its package has no command `hq`, so the exported file is read here and submitted as it is.
"""

import os
import signal
import subprocess
import sys
import tomllib

PROGRAM = """
import sys, tomllib
from hyperqueue.cluster import LocalCluster, WorkerConfig
from hyperqueue.job import Job

with open(sys.argv[1], "rb") as file:
    tasks = tomllib.load(file)["task"]
with LocalCluster() as cluster:
    for _ in range(2):
        cluster.start_worker(WorkerConfig(cores=1))
    client = cluster.client()
    job = Job()
    for task in tasks:
        job.program(task["command"], cwd=task["cwd"], stdout=None, stderr=None, crash_limit=task["crash_limit"])
    client.wait_for_jobs([client.submit(job)], raise_on_error=False)
"""


class HyperQueue:
    """Process with the server and the workers."""

    def __init__(self, study, chunk):
        self.study, self.file = study, study.export("hyperqueue", chunk)
        with open(self.file, "rb") as file:
            assert tomllib.load(file)["task"]

    def start(self):
        """Begins the process."""
        log = open(self.study.folder / "hyperqueue.log", "a")
        self.process = subprocess.Popen(
            [sys.executable, "-c", PROGRAM, self.file], stdout=log, stderr=log, cwd=self.study.folder
        )

    def kill_worker(self):
        """Kills what a worker runs: the worker itself has no process of its own."""
        children = ["pgrep", "-P", str(self.process.pid), "-x", "drape"]
        tasks = subprocess.run(children, capture_output=True, text=True).stdout.split()
        assert tasks, "no task runs"
        os.kill(int(tasks[0]), signal.SIGKILL)

    def kill(self):
        """Kills the server and the workers."""
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def finish(self):
        """Waits for the end of the job."""
        assert self.process.wait(timeout=1800) == 0
