"""Dask: a scheduler and two workers, each a process that can be killed."""

import signal
import socket
import subprocess
import sys


def free_port():
    """Returns a port that nobody listens to."""
    with socket.socket() as own:
        own.bind(("127.0.0.1", 0))
        return own.getsockname()[1]


class Dask:
    """Scheduler with two workers, and the exported program that uses them."""

    def __init__(self, study, chunk):
        self.study, self.file = study, study.export("dask", chunk)
        self.processes, self.client = {}, None

    def _begin(self, name, *command):
        log = open(self.study.folder / f"{name}.log", "a")
        self.processes[name] = subprocess.Popen(
            [sys.executable, "-m", *command], stdout=log, stderr=log, cwd=self.study.folder
        )

    def worker(self, name):
        """Begins a worker."""
        self._begin(name, "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny")

    def start(self):
        """Begins the scheduler, the workers and the program."""
        port = free_port()
        self.address = f"tcp://127.0.0.1:{port}"
        self._begin("scheduler", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        self.worker("worker-1")
        self.worker("worker-2")
        self.client = subprocess.Popen([sys.executable, self.file, self.address], cwd=self.study.folder)

    def kill_worker(self):
        """Kills a worker; another one takes its place."""
        self.processes["worker-1"].send_signal(signal.SIGKILL)
        self.processes["worker-1"].wait()
        self.worker("worker-3")

    def kill(self):
        """Kills the scheduler, the workers and the program."""
        for process in [*self.processes.values(), self.client]:
            process.kill()
            process.wait()
        self.processes.clear()

    def finish(self):
        """Waits for the end of the program."""
        assert self.client.wait(timeout=1800) == 0
        self.kill()
