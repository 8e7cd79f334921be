"""Machines for tests of what is started by ssh: real servers of it on this machine, of the present user, with keys, ports and folders of
their own."""
import contextlib
import getpass
import grp
import os
import shlex
import shutil
import signal
import subprocess
import time

from harness import GENEROUS_S, children_of, end, skip, stat_of, words_of
from world.case import free_ports

SSHD = shutil.which("sshd", path="/usr/sbin:/usr/local/sbin:" + os.environ["PATH"])
SSH = shutil.which("ssh")
# Settings of the preset that the programs are built with.
OF_SANITIZERS = " ".join(f'"{name}={os.environ[name]}"' for name in ("ASAN_OPTIONS", "TSAN_OPTIONS") if name in os.environ)


def make_key(file):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", file], check=True, stdin=subprocess.DEVNULL)


class Machine:
    """A sshd with its keys."""

    def __init__(self, name, folder, user_key, shared):
        self.name = name
        self.folder = folder / name
        self.folder.mkdir()
        make_key(self.folder / "host_key")
        # What programs there keep for a while.
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()
        self.log = self.folder / "sshd.log"
        # Another may take the port between the look and the start.
        for _ in range(20):
            (self.port,) = free_ports(1)
            (self.folder / "sshd_config").write_text(
                f"Port {self.port}\nListenAddress 127.0.0.1\nHostKey {self.folder}/host_key\nPidFile none\n"
                f"AuthorizedKeysFile {user_key}.pub\nPubkeyAuthentication yes\nPasswordAuthentication no\n"
                "KbdInteractiveAuthentication no\nUsePAM no\nStrictModes no\nPermitRootLogin prohibit-password\n"
                f"SetEnv SWARMANOID_SHARED_FOLDER={shared} TMPDIR={self.temporary} {OF_SANITIZERS}\n")
            with self.log.open("w") as log:
                self.process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", SSHD, "-D", "-e", "-f",
                                                 self.folder / "sshd_config"],
                                                stdin=subprocess.DEVNULL, stderr=log, start_new_session=True)
            deadline = time.monotonic() + GENEROUS_S
            while self.process.poll() is None and "Server listening" not in self.log.read_text():
                assert time.monotonic() < deadline, self.log.read_text()
                time.sleep(0.01)
            if self.process.poll() is None:
                return
        raise AssertionError("no sshd: " + self.log.read_text())

    def known_host(self):
        kind, key = (self.folder / "host_key.pub").read_text().split()[:2]
        return f"[127.0.0.1]:{self.port} {kind} {key}\n"

    def descendants(self):
        found, fresh = [], [self.process.pid]
        while fresh:
            children = [child for pid in fresh for child in children_of(pid)]
            found += children
            fresh = children
        return found

    def find(self, program):
        """The process of a program that was started on this machine, or None."""
        for pid in self.descendants():
            words = words_of(pid)
            if words and os.path.basename(words[0]) == program:
                return pid
        return None

    def session_of(self, pid):
        """The sshd that serves the connection of a process."""
        while True:
            parent = stat_of(pid)[0]
            if words_of(parent) and words_of(parent)[0].startswith("sshd:"):
                return parent
            pid = parent

    def stop(self):
        for pid in self.descendants():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        end(self.process)


class Machines:
    """alpha and beta, and a command ssh that reaches them; "lost" is a machine that refuses connections."""

    def __init__(self, folder, shared):
        self.folder = folder
        key = folder / "user_key"
        make_key(key)
        self.alpha = Machine("alpha", folder, key, shared)
        self.beta = Machine("beta", folder, key, shared)
        self.all = (self.alpha, self.beta)
        self.known_hosts = folder / "known_hosts"
        self.known_hosts.write_text("".join(m.known_host() for m in self.all))
        config = folder / "ssh_config"
        config.write_text("".join(f"Host {m.name}\n  HostName 127.0.0.1\n  Port {m.port}\n" for m in self.all) +
                          "Host lost\n  HostName 127.0.0.1\n" f"  Port {free_ports(1)[0]}\n"
                          f"Host *\n  User {getpass.getuser()}\n  IdentityFile {key}\n  IdentitiesOnly yes\n"
                          f"  UserKnownHostsFile {self.known_hosts}\n  GlobalKnownHostsFile none\n"
                          "  StrictHostKeyChecking yes\n")
        # The command is the built-in one; only the configuration of ssh is ours.
        programs = folder / "bin"
        programs.mkdir()
        (programs / "ssh").write_text(f'#!/bin/sh\nexec {SSH} -F {shlex.quote(str(config))} "$@"\n')
        (programs / "ssh").chmod(0o755)
        self.environment = {"PATH": f"{programs}:{os.environ['PATH']}"}

    def stop(self):
        for machine in self.all:
            machine.stop()


def terminals_are_of_tty():
    """Whether new terminals belong to the group tty: only root can give them to it."""
    ours, theirs = os.openpty()
    group = os.fstat(theirs).st_gid
    os.close(ours)
    os.close(theirs)
    return group == grp.getgrnam("tty").gr_gid


def require_servers(terminals):
    """Leaves the test, with a word, if they cannot be here."""
    if SSH is None or SSHD is None:
        skip("ssh and its server are missing (package openssh-server)")
    if os.geteuid() == 0:
        # What the package's service makes when it starts.
        os.makedirs("/run/sshd", mode=0o755, exist_ok=True)
    elif terminals and not terminals_are_of_tty():
        skip("a sshd that is not root's cannot hand over terminals: /dev/pts is not mounted with gid=5,mode=620")
