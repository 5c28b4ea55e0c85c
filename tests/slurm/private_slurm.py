"""A Slurm of its own on this machine: munged, slurmctld and slurmd as plain processes of this user, with
configuration, keys, sockets and state in one temporary directory, stopped by process id."""
import os
import pathlib
import pwd
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "sinfo"]
SEARCHED = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"

CONFIGURATION = """\
ClusterName=private
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={directory}/munge.socket
CredType=cred/munge
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.pid
SlurmctldLogFile={directory}/slurmctld.log
SlurmdLogFile={directory}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_min_interval=50000,batch_sched_delay=0,sched_interval=1,bf_interval=1
ReturnToService=2
KillWait=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing_programs():
    return [program for program in PROGRAMS if not shutil.which(program, path=SEARCHED)]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class PrivateSlurm:
    """Use as a context manager; `environment` makes Slurm's commands talk to it."""

    def __enter__(self):
        self.directory = pathlib.Path(tempfile.mkdtemp(prefix="slurm-"))
        self.directory.chmod(0o755)  # munge's clients look their socket up
        self.environment = dict(os.environ, PATH=SEARCHED, SLURM_CONF=str(self.directory / "slurm.conf"))
        self.processes = []
        try:
            self._start()
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(self, *_):
        self._stop()

    def output_of(self, *command):
        done = subprocess.run(command, env=self.environment, text=True, capture_output=True, timeout=60)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: {done.stderr or done.stdout}")
        return done.stdout

    def unfinished_jobs(self):
        """(id, state) of all that wait or run, tasks of an array one by one."""
        lines = self.output_of("squeue", "--noheader", "--array", "--format=%i %T").splitlines()
        return [tuple(line.split()) for line in lines]

    def wait_for_end(self, seconds=150):
        end = time.monotonic() + seconds
        while jobs := self.unfinished_jobs():
            if time.monotonic() > end:
                raise RuntimeError(f"still there after {seconds} s: {jobs}\n{self.logs()}")
            time.sleep(0.3)

    def job(self, number):
        """What `scontrol show job` says of a job that has ended not long ago."""
        words = self.output_of("scontrol", "--oneliner", "show", "job", str(number)).split()
        return dict(word.split("=", 1) for word in words if "=" in word)

    def logs(self):
        logs = [self.directory / name for name in ("munged.log", "slurmctld.log", "slurmd.log")]
        return "\n".join(f"{log.name}:\n{log.read_text(errors='replace')[-3000:]}" for log in logs if log.exists())

    def _start(self):
        key = self.directory / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        for name in ("state", "spool"):
            (self.directory / name).mkdir()
        controller_port, node_port = free_ports(2)
        (self.directory / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], user=pwd.getpwuid(os.getuid()).pw_name,
            directory=self.directory, controller_port=controller_port, node_port=node_port))
        self._launch("munged", "--foreground", "--force", f"--key-file={key}",
                     f"--socket={self.directory}/munge.socket", f"--pid-file={self.directory}/munged.pid",
                     f"--log-file={self.directory}/munged.log", f"--seed-file={self.directory}/munge.seed")
        self._wait_until(lambda: (self.directory / "munge.socket").exists(), "munged")
        self._launch("slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self._launch("slurmd", "-D", "-f", self.environment["SLURM_CONF"])
        self._wait_until(self._is_idle, "a node that is idle")

    def _is_idle(self):
        try:
            return self.output_of("sinfo", "--noheader", "--format=%T").strip() == "idle"
        except RuntimeError:
            return False  # the controller does not answer yet

    def _launch(self, *command):
        output = open(self.directory / f"{command[0]}.out", "w", encoding="utf-8")
        self.processes.append(subprocess.Popen(
            command, env=self.environment, stdout=output, stderr=output, start_new_session=True))
        output.close()

    def _wait_until(self, condition, what, seconds=30):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end or any(process.poll() is not None for process in self.processes):
                raise RuntimeError(f"no {what} after {seconds} s or a server ended\n{self.logs()}")
            time.sleep(0.1)

    def _stop(self):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        shutil.rmtree(self.directory, ignore_errors=True)
