"""Studies on two machines by ssh: two sshd on this machine. The table has to be that of one machine whatever happens to the others, and
nothing may be left there."""
import contextlib
import functools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from harness import children_of, words_of
from ssh_machines import Machines, require_servers
from study_case import CONFIGS, SWARMANOID, StartedStudyCase

setUpModule = functools.partial(require_servers, terminals=False)
FINISHED = re.compile(r"^finished: (\d+) runs, (\d+) failed, [0-9.]+ s, table (\S+)$", re.MULTILINE)


class SweepHosts(StartedStudyCase):
    def setUp(self):
        super().setUp()
        self.ssh = Machines(self.folder, self.folder)
        self.addCleanup(self.ssh.stop)
        self.alpha, self.beta = self.ssh.all
        self.environment.update(self.ssh.environment)

    def hosts(self, *lines):
        path = self.folder / "hosts.txt"
        path.write_text("\n".join(lines) + "\n")
        return path

    def left_on(self, machine):
        """Processes that were started there, also those whose connection has gone, and files."""
        mark = f"TMPDIR={machine.temporary}".encode()
        found = list(machine.temporary.iterdir())
        for pid in os.listdir("/proc"):
            try:
                if pid.isdigit() and mark in pathlib.Path("/proc", pid, "environ").read_bytes().split(b"\0"):
                    found.append(words_of(pid))
            except OSError:
                pass
        return found

    def assert_machines_empty(self):
        for machine in self.ssh.all:
            self.wait_until(f"the end of what runs at {machine.name}", lambda: not self.left_on(machine))

    def assert_same(self, name, table):
        self.assertEqual((self.folder / name / "table.csv").read_bytes(), table)
        self.assert_machines_empty()

    def service_of(self, machine):
        """The process there that runs the study: the child of the one that sees to its end."""
        self.wait_until("the service", lambda: machine.find("swarmanoid") and children_of(machine.find("swarmanoid")))
        return children_of(machine.find("swarmanoid"))[0]

    def test_the_table_is_that_of_this_machine(self):
        study = self.study("1-12", inside='<factor id="robots" path="arena.distribute.quantity" values="4 8"/>'
                           '<metrics every="20"><distance id="way"/><trajectories id="ways"/><coverage id="seen" cell="0.5"/></metrics>')
        table = self.here(study)
        out, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha beta here  # all", "cores alpha = 2"))
        self.assertEqual(FINISHED.search(out).groups(), ("24", "0", "out/table.csv"), errors)
        self.assert_same("out", table)
        for name in ("ways", "grids"):
            self.assertEqual(self.query("out", f"SELECT * FROM {name} ORDER BY point, seed"), self.query("here", f"SELECT * FROM {name} ORDER BY point, seed"))
        self.assertLessEqual({host for host, in self.query("out", "SELECT DISTINCT host FROM runs")}, {"alpha", "beta", os.uname().nodename})

    def test_each_machine_of_the_file_runs_some(self):
        # More than one of them can run before the other one is there.
        study = self.study("1-4000", ticks=4000)
        process = self.start(study, "--output", "out", "--hosts", self.hosts("runs = alpha beta"))
        self.wait_for_runs("out", 1, process)
        self.wait_until("runs of both", lambda: process.poll() is not None or
                        {host for host, in self.query("out", "SELECT DISTINCT host FROM runs WHERE state = 'done'")} == {"alpha", "beta"})
        process.send_signal(signal.SIGINT)
        self.end_of(process, 130)

    def test_the_progress_tells_what_runs_where(self):
        study = self.study("1-4000", ticks=4000)
        ours, theirs = os.openpty()
        self.addCleanup(os.close, ours)
        process = subprocess.Popen([SWARMANOID, "sweep", study, "--output", "out", "--hosts", self.hosts("runs = alpha beta")], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=theirs, env=self.environment)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        os.close(theirs)
        wanted = [re.compile(rb"of 4000 runs \(\d+ %\).*[;,] (running )?0-\d+ on " + machine) for machine in (b"alpha", b"beta")]
        text, has_ended = b"", False
        with contextlib.suppress(OSError):  # the end of a terminal
            while more := os.read(ours, 4096):
                text += more
                wanted = [line for line in wanted if not line.search(text)]
                if not wanted and not has_ended:
                    process.send_signal(signal.SIGINT)
                    has_ended = True
        self.assertEqual(process.wait(), 130, text)

    def test_a_cluster_each(self):
        study = self.study("1-3", attributes='cluster="true" controller_hosts="2"')
        self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha beta"))
        self.assert_same("out", self.here(self.study("1-3")))

    def test_what_runs_write_comes_back(self):
        study = self.study("1-2", experiment=CONFIGS / "prey_retrieval.xml", inside='<metrics><published id="to_nest" name="to_nest"/></metrics>')
        table = self.here(study)
        self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha"))
        self.assert_same("out", table)
        for run in ("0-1", "0-2"):
            files = {path.name: path.read_bytes() for path in (self.folder / "here/runs" / run).iterdir()}
            self.assertIn("retrieval.csv", files)
            self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "out/runs" / run).iterdir()}, files)

    def test_the_log_of_a_failed_run_comes_back(self):
        text = (CONFIGS / "diffusion_10.xml").read_text()
        text = text.replace("footbot_diffusion", "faulty_controller").replace("<velocity>0.05</velocity>", "<fault>none</fault><tick>5</tick>")
        text = re.sub(r"<alpha>.*?</delta>", "", text, flags=re.DOTALL)
        text = text.replace("<maxclock>", f"<controller_path>{os.environ['TEST_CONTROLLERS']}</controller_path><maxclock>")
        (self.folder / "faulty.xml").write_text(text)
        study = self.study("1-2", experiment=self.folder / "faulty.xml",
                           inside='<factor id="fault" path="controllers.diffusion.parameters.fault" values="none step_crashes"/>')
        _, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha"), code=4)
        self.assertIn("ControlStep at tick 5 aborted", errors)
        self.assertEqual(self.query("out", "SELECT fault, state, host FROM runs WHERE seed = 2"),
                         [("none", "done", "alpha"), ("step_crashes", "failed", "alpha")])
        self.assertIn("ControlStep at tick 5 aborted", (self.folder / "out/runs/1-2/log.txt").read_text())
        self.assertFalse((self.folder / "out/runs/0-2").exists())
        self.assert_machines_empty()

    def test_the_runs_of_a_machine_that_dies_go_to_the_others(self):
        # Enough for some to be left when the machine dies, however quick it is.
        study = self.study("1-48", ticks=10000)
        table = self.here(study)

        def kill_service():
            os.kill(self.service_of(self.alpha), signal.SIGKILL)

        def kill_guard():
            os.kill(self.alpha.find("swarmanoid"), signal.SIGKILL)

        def cut_connection():
            os.kill(self.alpha.session_of(self.alpha.find("swarmanoid")), signal.SIGKILL)

        def stop_service():
            os.kill(self.service_of(self.alpha), signal.SIGSTOP)

        for number, (act, says) in enumerate(((kill_service, "exit code 137"), (kill_guard, "its connection "), (cut_connection, "its connection ended with exit code 255"),
                                              (stop_service, "nothing was heard of it for 8 s"))):
            process = self.start(study, "--output", f"out{number}", "--hosts", self.hosts("runs = alpha beta", "lease = 8" if act is stop_service else ""))
            # Before a run of it is done, its processes may still be those that tell what it has.
            self.wait_for_runs(f"out{number}", 1, process, at="alpha")
            act()
            _, errors = self.end_of(process)
            self.assertRegex(errors, f"(?m)^alpha is left out: .*{re.escape(says)}.*; its runs go to the others$")
            self.assert_same(f"out{number}", table)
            attempts = self.query(f"out{number}", "SELECT DISTINCT attempts, state FROM runs")
            self.assertEqual(attempts, [(1, "done")], "no run may fail because its machine did")

    def test_a_machine_that_is_not_there(self):
        study = self.study("1-6")
        table = self.here(study)
        _, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = lost beta"))
        self.assertRegex(errors, r"(?m)^lost is left out: its connection ended with exit code 255: .*Connection refused")
        self.assert_same("out", table)
        _, errors = self.sweep(study, "--output", "alone", "--hosts", self.hosts("runs = lost"), code=4)
        self.assertRegex(errors, r"(?m)^no machine of --hosts is left: lost: its connection .*Connection refused.*; what was stored before stays: mend the cause, "
                         r"then go on: swarmanoid sweep alone --resume --hosts \S+hosts.txt$")
        self.sweep("alone", "--resume")
        self.assert_same("alone", table)

    def wrapper(self, *lines):
        path = self.folder / "other_swarmanoid"
        path.write_text("#!/bin/sh\n" + "\n".join(lines) + "\n")
        path.chmod(0o755)
        return path

    def test_what_differs_there_is_told_exactly(self):
        study = self.study("1-4")
        # A library of the controller whose build-id is another one.
        libraries = self.folder / "libraries"
        libraries.mkdir()
        for library in (pathlib.Path(SWARMANOID).parents[1]).rglob("libfootbot_diffusion.so"):
            shutil.copy(library, libraries)
            break
        found = next(libraries.iterdir())
        content = bytearray(found.read_bytes())
        at = content.index(b"GNU\0", content.index(b"\x14\0\0\0\x03\0\0\0")) + 4
        before = content[at:at + 8].hex()
        content[at] ^= 0xff
        after = content[at:at + 8].hex()
        found.write_bytes(content)
        other_version = os.environ["OTHER_VERSION"]
        for lines, says in (
                ([f"exec env LD_PRELOAD={other_version} {SWARMANOID} \"$@\""], r"its Swarmanoid has version 0\.0\.7 \(other\), that of the study \d+\.\d+\.\d+"),
                ([f"exec env SWARMANOID_PLUGIN_PATH={libraries} {SWARMANOID} \"$@\""],
                 rf"the library 'libfootbot_diffusion\.so' is another one there \({after}\) than here \({before}\)"),
                (["echo 'a greeting of the shell'", "exit 3"], "its connection ended with exit code 3: a greeting of the shell")):
            _, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha", f"swarmanoid = {self.wrapper(*lines)}"), code=4)
            self.assertRegex(errors, "(?m)^alpha is left out: " + says)
            self.assertEqual(self.query("out", "SELECT DISTINCT attempts FROM runs"), [(0,)])
            self.assert_machines_empty()
            shutil.rmtree(self.folder / "out")
        _, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts("runs = alpha", "swarmanoid = /nowhere/swarmanoid"), code=4)
        self.assertRegex(errors, r"(?m)^alpha is left out: its connection ended with exit code 127: .*/nowhere/swarmanoid.*(No such file|not found)")
        # What a shell says before is no harm.
        greeting = self.wrapper("echo welcome", f'exec {SWARMANOID} "$@"')
        self.sweep("out", "--resume", "--hosts", self.hosts("runs = alpha", f"swarmanoid = {greeting}"))

    def test_ends_leave_nothing_there(self):
        study = self.study("1-400", ticks=3000)
        for number, signals in enumerate(([signal.SIGINT], [signal.SIGINT, signal.SIGINT], [signal.SIGKILL])):
            process = self.start(study, "--output", f"out{number}", "--hosts", self.hosts("runs = alpha beta"))
            self.wait_for_runs(f"out{number}", 3, process)
            for sent in signals:
                process.send_signal(sent)
                time.sleep(0.05)
            self.assertIn(process.wait(100), (130, -9))
            errors = process.said.read_text()
            self.assert_machines_empty()
            if signals == [signal.SIGINT]:
                self.assertRegex(errors, rf"\d+ of 400 runs are done; to go on: swarmanoid sweep out{number} --resume --hosts \S+hosts.txt")
                done, = self.query(f"out{number}", "SELECT COUNT(*) FROM runs WHERE state = 'done'")[0]
                self.assertEqual(int(re.search(r"(\d+) of 400", errors)[1]), done)

    def test_bad_files_are_told_with_their_line(self):
        study = self.study("1-4")
        for lines, says in ((["runs = alpha alpha"], "hosts.txt:1: runs names 'alpha' a second time"),
                            (["runs = alpha", "cores alhpa = 3"], "hosts.txt:2: `runs` does not name 'alhpa'; it has alpha; did you mean 'alpha'?"),
                            (["runs = alpha", "cores alpha = none"], "hosts.txt:2: cores alpha is 'none'; write a whole number of runs at a time from 1 to 10000"),
                            (["runs = alpha", "lease = 0"], "hosts.txt:2: lease is '0'; write a whole number of seconds"),
                            (["engine = alpha"], "names no machine for runs; write a line such as `runs = alpha beta`"),
                            (["run = alpha"], "did you mean 'runs'?")):
            _, errors = self.sweep(study, "--output", "out", "--hosts", self.hosts(*lines), code=2)
            self.assertIn(says, errors)
            self.assertFalse((self.folder / "out").exists(), "nothing begins with a bad file")
        _, errors = self.sweep(study, "--output", "out", "--jobs", "3", "--hosts", self.hosts("runs = alpha"), code=2)
        self.assertIn("--jobs and --hosts", errors)

    def test_a_full_disk_keeps_what_was_stored(self):
        study = self.study("1-200", experiment=CONFIGS / "prey_retrieval.xml", ticks=400)
        small = self.folder / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", small], stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("no file system of limited size can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", small])
        _, errors = self.sweep(study, "--output", "small/out", "--hosts", self.hosts("runs = alpha beta"), code=4)
        self.assertRegex(errors, r"(No space left on device|database or disk is full).*; what was stored before stays: mend the cause, then go on: ")
        self.assert_machines_empty()
        done = self.query("small/out", "SELECT COUNT(*) FROM runs WHERE state = 'done'")[0][0]
        subprocess.run(["mount", "-o", "remount,size=100m", small], check=True)
        out, _ = self.sweep("small/out", "--resume", "--hosts", self.hosts("runs = alpha beta"))
        self.assertEqual(FINISHED.search(out)[1], "200")
        self.assertGreater(done, 0)
