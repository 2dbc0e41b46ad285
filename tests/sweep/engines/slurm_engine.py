"""Slurm: a controller and two daemons on this machine, as root, with the packages `slurm-wlm` and
`munge` of Debian. The queue is full when the array is submitted."""

import os
import re
import shutil
import socket
import subprocess
import time

CONFIGURATION = """ClusterName=test
SlurmctldHost={host}
SlurmUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=10
KillWait=5
SlurmctldPort=16817
SlurmctldPidFile={folder}/slurmctld.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmdLogFile={folder}/slurmd-%n.log
SlurmdSpoolDir={folder}/spool-%n
StateSaveLocation={folder}/state
MaxArraySize=1001
MaxJobCount={most}
MinJobAge=2
NodeName=node1 NodeHostname={host} NodeAddr=127.0.0.1 Port=16821 CPUs=1 RealMemory=1000
NodeName=node2 NodeHostname={host} NodeAddr=127.0.0.1 Port=16822 CPUs=1 RealMemory=1000
PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Slurm:
    """Controller with two daemons, and the exported array of jobs."""

    def __init__(self, study, chunk):
        self.study, self.file = study, study.export("slurm", chunk)
        # Below /tmp, since names of sockets are short.
        self.folder = study.folder / "slurm"
        (self.folder / "state").mkdir(parents=True)
        for node in ["node1", "node2"]:
            (self.folder / f"spool-{node}").mkdir()
        self.tasks = int(re.search(r"--array=1-(\d+)", self.file.read_text())[1])
        most = self.tasks + 1
        text = CONFIGURATION.format(host=socket.gethostname(), folder=self.folder, most=most)
        (self.folder / "slurm.conf").write_text(text)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.processes, self.job = {}, None
        self._munge()

    def _munge(self):
        """Begins the daemon that signs messages, unless it is there."""
        if shutil.which("munge") and subprocess.run(["munge", "-n"], capture_output=True).returncode == 0:
            return
        os.makedirs("/run/munge", exist_ok=True)
        shutil.chown("/run/munge", "munge", "munge")
        subprocess.run(["runuser", "-u", "munge", "--", "munged"], check=True)

    def _begin(self, name, *command):
        log = open(self.folder / f"{name}.out", "a")
        self.processes[name] = subprocess.Popen(
            command, env=self.environment, stdout=log, stderr=log, start_new_session=True
        )

    def _node(self, node):
        self._begin(node, "slurmd", "-D", "-N", node)

    def _run(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, cwd=self.study.folder)

    def start(self):
        """Begins the daemons, and submits the array unless it is in the queue already."""
        self._begin("controller", "slurmctld", "-D")
        self._node("node1")
        self._node("node2")
        if self.job is None:
            # The queue has room for one of two such arrays: `sbatch` waits until the first is done.
            self._submit(f"--array=1-{self.tasks}", "--wrap", "sleep 2")
            self.job, said = self._submit(str(self.file))
            assert "temporarily unable to accept job" in said, f"the queue was not full: {said}"

    def _submit(self, *arguments):
        """Submits a job once the controller is there; returns its number, and what is said besides."""
        deadline = time.monotonic() + 60
        while (ended := self._run("sbatch", "--parsable", "--output=%x-%a.log", *arguments)).returncode:
            assert time.monotonic() < deadline, f"no job was taken: {ended.stderr}"
            time.sleep(0.5)
        return ended.stdout.strip().split(";")[0], ended.stderr

    def kill_worker(self):
        """Kills a daemon and all that it has started, as when its machine fails; it begins again."""
        session = str(os.getsid(self.processes["node1"].pid))
        self.processes["node1"].kill()
        self.processes["node1"].wait()
        subprocess.run(["pkill", "-KILL", "-s", session])
        # Its steps have sessions of their own.
        subprocess.run(["pkill", "-KILL", "slurmstepd"])
        self._node("node1")

    def kill(self):
        """Kills the controller and the daemons."""
        for process in self.processes.values():
            process.kill()
            process.wait()
        self.processes.clear()

    def finish(self):
        """Waits until the queue is empty."""
        deadline = time.monotonic() + 1800
        while (queue := self._run("squeue", "-h")).returncode or queue.stdout:
            assert time.monotonic() < deadline, queue.stdout
            time.sleep(0.5)
        self.kill()
