"""A Slurm of two nodes on this machine, for a test: munged, slurmctld and two slurmd's in a folder of their own, on free
ports of 127.0.0.1, without systemd. Needs root and Debian's slurm-wlm and munge.

    with Cluster(folder) as cluster:
        cluster.ask("sbatch", "--wrap", "hostname")

Nothing that it started outlives it: orphans of its daemons become its own children (PR_SET_CHILD_SUBREAPER).
"""
import ctypes
import os
import signal
import socket
import subprocess
import time
from pathlib import Path

PR_SET_CHILD_SUBREAPER = 36

CONF = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={control}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SchedulerParameters=sched_interval=1,batch_sched_delay=0
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port={first} CPUs=1 RealMemory=4000 State=UNKNOWN
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port={second} CPUs=1 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def children_of(parent):
    """(pid, command line) of all processes below one."""
    below, found = {}, []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rsplit(")", 1)[1].split()
                below.setdefault(int(fields[1]), []).append(int(entry.name))
            except OSError:
                pass
    waiting = [parent]
    while waiting:
        for pid in below.get(waiting.pop(), []):
            waiting.append(pid)
            try:
                found.append((pid, (Path("/proc") / str(pid) / "cmdline").read_bytes().replace(b"\0", b" ").decode()))
            except OSError:
                pass
    return found


class Cluster:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.conf = self.folder / "slurm.conf"
        self.daemons = {}

    def environment(self):
        return os.environ | {"SLURM_CONF": str(self.conf)}

    def start(self, name, *command):
        log = open(self.folder / f"{name}.out", "ab")
        self.daemons[name] = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                              env=self.environment(), start_new_session=True)
        log.close()

    def start_control(self, *more):
        self.start("slurmctld", "slurmctld", "-D", *more, "-f", str(self.conf))

    def kill_control(self):
        self.daemons["slurmctld"].kill()
        self.daemons["slurmctld"].wait()

    def ask(self, *command):
        """What a command of Slurm says; "" where it fails."""
        answer = subprocess.run(command, env=self.environment(), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                timeout=60, check=False)
        return answer.stdout if answer.returncode == 0 else ""

    def wait_for(self, what, seconds, words):
        until = time.monotonic() + seconds
        while not (found := what()):
            if time.monotonic() > until:
                raise TimeoutError(f"{words}: not within {seconds} s\n{self.ask('squeue')}\n{self.logs()}")
            time.sleep(0.3)
        return found

    def logs(self):
        return "\n".join(f"== {file.name}\n" + "\n".join(file.read_text(errors="replace").splitlines()[-15:])
                         for file in sorted(self.folder.glob("*.[lo][ou][gt]")))

    def __enter__(self):
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        try:
            control, first, second = free_ports(3)
            self.conf.write_text(CONF.format(folder=self.folder, control=control, first=first, second=second))
            (self.folder / "state").mkdir()
            key = self.folder / "munge.key"
            subprocess.run(["mungekey", "-c", "-f", "-k", str(key)], check=True, capture_output=True)
            self.start("munged", "munged", "--foreground", "--force", f"--key-file={key}",
                       f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                       f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munge.seed")
            self.wait_for((self.folder / "munge.socket").exists, 20, "munged")
            self.start_control("-c")
            for node in ("n1", "n2"):
                self.start(node, "slurmd", "-D", "-N", node, "-f", str(self.conf))
            self.wait_for(lambda: self.ask("sinfo", "-h", "-N", "-o", "%T").split() == ["idle", "idle"], 40, "two nodes")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        if "slurmctld" in self.daemons and self.daemons["slurmctld"].poll() is None:
            self.ask("scancel", "--user=root")
        for name in ("n1", "n2", "slurmctld", "munged"):
            if name in self.daemons and self.daemons[name].poll() is None:
                self.daemons[name].terminate()
        for daemon in self.daemons.values():
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        for pid, _ in children_of(os.getpid()):  # steps of jobs, orphaned
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        while True:
            try:
                if os.waitpid(-1, os.WNOHANG) == (0, 0):
                    time.sleep(0.05)
            except ChildProcessError:
                break
