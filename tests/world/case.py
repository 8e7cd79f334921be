"""What Python tests share: folders that go with a test, free ports, the hash of a run, and the text of experiments in which a test
writes only what matters to it."""
import contextlib
import os
import pathlib
import re
import shutil
import socket
import subprocess
import tempfile
import time
import unittest

HASH = re.compile(r"hash ([0-9a-f]{16})")


def temporary_folder(test, name="test"):
    """A folder that goes with a test, or with a class of tests."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix=f"swarmanoid_{name}_"))
    (test.addClassCleanup if isinstance(test, type) else test.addCleanup)(shutil.rmtree, folder, ignore_errors=True)
    return folder


def shared_folder(test):
    """A name in shared memory for the runs of a test: other runs on the machine come and go."""
    folder = pathlib.Path(f"/dev/shm/swarmanoid-test-{os.getpid()}-{time.monotonic_ns()}")
    test.addCleanup(shutil.rmtree, folder, ignore_errors=True)
    return folder


class FolderCase(unittest.TestCase):
    """Each test has a folder and shared memory of its own."""

    def setUp(self):
        self.folder = temporary_folder(self)
        self.shared = shared_folder(self)
        self.variables = {**os.environ, "SWARMANOID_SHARED_FOLDER": str(self.shared)}

    def hash_in(self, text):
        found = HASH.search(text)
        self.assertIsNotNone(found, text)
        return found[1]


class InFolderCase(FolderCase):
    """The test works in its folder."""

    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)


def run_on_a_terminal(words, folder, environment=None):
    """Exit code and standard error of a program whose standard error is a terminal."""
    ours, theirs = os.openpty()
    process = subprocess.Popen([str(word) for word in words], cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    seen = b""
    with contextlib.suppress(OSError):  # the end of a terminal
        while part := os.read(ours, 1 << 14):
            seen += part
    os.close(ours)
    return process.wait(), seen.decode()


def free_ports(count):
    """Ports of this machine. Another program may take one between the look and the use."""
    probes = [socket.socket() for _ in range(count)]
    for probe in probes:
        probe.bind(("127.0.0.1", 0))
    ports = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return ports


def devices(implementations):
    """The elements of devices that have the names of their implementations: the tag is the name without its first word."""
    return "".join(f'<{name.split("_", 1)[1]} implementation="{name}"/>' for name in implementations)


def controller(tag, actuators=(), sensors=(), parameters="", name="c", library="", attributes=""):
    """Devices are names of implementations, or elements as a text."""
    lists = [one if isinstance(one, str) else devices(one) for one in (actuators, sensors)]
    library = f'library="{library}"' if library else ""
    return (f'<{tag} id="{name}" {attributes} {library}><actuators>{lists[0]}</actuators><sensors>{lists[1]}</sensors>'
            f"<parameters>{parameters}</parameters></{tag}>")


def experiment(path, framework="", controllers="", arena="", size="4,4,2", engine="dummy_engine", physics="<all/>", more=""):
    """Writes the file of an experiment with one engine, 'ground'. The texts are contents of the elements with these names; `more`
    follows behind them."""
    path.write_text(f"""<ahss-config>
  <framework>{framework}</framework>
  <controllers>{controllers}</controllers>
  <arena size="{size}" optimization="2D">{arena}</arena>
  <engines><{engine} id="ground"/></engines>
  <arena_physics><engine id="ground">{physics}</engine></arena_physics>
  {more}
</ahss-config>
""")
    return path
