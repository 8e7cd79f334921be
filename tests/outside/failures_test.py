"""Whatever the code of a user does, the run ends at once with exit code 4, and the first line names whose code it was and
the tick."""
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile

from outside import PREFIX, WAYS, OutsideTest

from signals import send_and_wait

TICK = 17
# What the first line says of each fault. None: as the C++ library or the kernel words it.
FAULTS = {
    "throw": "failed: cannot go on",
    "throw_number": "failed: the number 42 was thrown",
    "throw_foreign": "failed: an exception of type faults::Foreign",
    "exit": r"called exit\(0\)",
    "_exit": r"called _exit\(0\)",
    "_Exit": r"called _Exit\(0\)",
    "quick_exit": r"called quick_exit\(0\)",
    "abort": "aborted",
    "terminate": "called std::terminate",
    "segfault": r"crashed by signal 11 \(Segmentation fault\) at address 0x0",
    "stack": "overflowed its stack",
    "memory": "failed: no memory is left",
}
# The processes of a cluster find them by the same code as one process. One of each way to the launcher is enough.
FAULTS_OF_CLUSTERS = ("throw", "_exit", "segfault", "memory")
# What nothing within the process can see: a cluster is told from outside.
UNSEEN = {"system_call": "ended before the last tick", "kill": r"was killed by signal 9 \(Killed\)"}
ROBOT = f"robot 'robot_one', controller 'c': ControlStep at tick {TICK}"
# Enough for any of our processes, and soon used up.
MEMORY = 768 << 20


class Failures(OutsideTest):
    def setUp(self):
        super().setUp()
        self.file = self.experiment(controller="outside_faults", ticks=100)

    def first_line(self, who, fault, *options, file=None, tick=TICK):
        """The first line of a run that fails, long before its lease is over."""
        output = pathlib.Path(tempfile.mkdtemp(prefix="run_", dir=self.folder))
        # Others would take the place of a process that dies: cluster.launcher_recovery.
        options = options if "--single-process" in options else (*options, "--no-recovery", "--lease", "600")
        done = subprocess.run([PREFIX / "bin" / "swarmanoid", "run", file or self.file, "--quiet", "--output", output, *options], cwd=self.folder,
                              capture_output=True, text=True, timeout=100,
                              env=self.environment({"OUTSIDE_FAULT": f"{who} {fault} {tick}"}),
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, resource.RLIM_INFINITY)))
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertNotIn("finished:", done.stdout)
        first = done.stderr.splitlines()[0] if done.stderr else ""
        manifest = json.loads((output / "manifest.json").read_text())
        self.assertEqual([manifest["exit_code"], manifest["failure"]], [4, first])
        self.assertRegex(manifest["ended"], re.sub(r"\d", r"\\d", re.escape(manifest["started"])))
        self.assertGreaterEqual(manifest["ended"], manifest["started"])
        return first

    def test_whatever_a_controller_does_the_robot_is_named(self):
        for way, options in WAYS.items():
            for fault in FAULTS if options else FAULTS_OF_CLUSTERS:
                with self.subTest(fault, way=way):
                    self.assertRegex(self.first_line("controller", fault, *options), "^" + re.escape(ROBOT) + " " + FAULTS[fault])

    def test_a_cluster_names_the_robot_when_its_process_could_say_nothing(self):
        for fault, words in UNSEEN.items():
            with self.subTest(fault):
                first = self.first_line("controller", fault)
                self.assertRegex(first, f"^controller host 0 {words}, during {re.escape(ROBOT)}; its log is ")

    def test_others_are_named_by_their_id(self):
        text = self.file.read_text()
        path = f"{self.build_path('functions')}:{self.build_path('engines')}:{self.build_path('renderers')}"
        text = re.sub("<plugin_path>.*</plugin_path>", f"<plugin_path>{path}</plugin_path>", text)
        text = re.sub(r"<dummy_engine id=\"ground\">.*</dummy_engine>",
                      '<outside_faulty_engine id="ground" library="outside_faulty_engine"/>', text)
        text = text.replace("</ahss-config>", """
  <experiment_functions><outside_faulty_functions id="goal" library="outside_faulty_functions"/></experiment_functions>
  <visualisations><outside_faulty_render id="picture" library="outside_faulty_render"/></visualisations>
</ahss-config>""")
        file = self.folder / "others.xml"
        file.write_text(text)
        names = {"engine": f"engine 'ground' (outside_faulty_engine): Update at tick {TICK}",
                 "functions": f"experiment functions 'goal' (outside_faulty_functions): PostStep at tick {TICK}",
                 "render": f"visualisation 'picture' (outside_faulty_render): Draw at tick {TICK}"}
        for way, options in WAYS.items():
            for who, name in names.items():
                for fault in ("throw", "_exit", "segfault") if options else ("throw", "segfault"):
                    with self.subTest(who, fault=fault, way=way):
                        first = self.first_line(who, fault, *options, file=file)
                        self.assertRegex(first, "^" + re.escape(name) + " " + FAULTS[fault])

    @staticmethod
    def build_path(kind):
        return pathlib.Path(os.environ["SWARMANOID_USER"]) / "simulation_build" / kind

    def test_the_first_failure_is_the_headline_each_time(self):
        text = self.file.read_text().replace("</ahss-config>", """
  <visualisations><text_render id="positions"><file>positions.txt</file></text_render></visualisations>
</ahss-config>""")
        self.file.write_text(text)
        for turn in range(3):
            for fault in ("throw", "_exit"):
                with self.subTest(fault, turn=turn):
                    self.assertRegex(self.first_line("controller", fault, tick=50),
                                     "^robot 'robot_one', controller 'c': ControlStep at tick 50 " + FAULTS[fault])

    def test_one_that_never_ends_is_named_and_can_be_ended(self):
        for way, options in WAYS.items():
            with self.subTest(way):
                output = self.folder / way
                run = subprocess.Popen([PREFIX / "bin" / "swarmanoid", "run", self.file, "--output", output, *options], cwd=self.folder,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                       env=self.environment({"OUTSIDE_FAULT": f"controller loop {TICK}"}))
                self.addCleanup(run.kill)
                said = ""

                def read_until(*words):
                    nonlocal said
                    while not all(word in said for word in words):
                        line = run.stderr.readline()
                        self.assertNotEqual(line, "", said)
                        said += line

                read_until("waiting", "robot_one")
                send_and_wait(run, signal.SIGINT)
                if way == "cluster":
                    read_until("Ctrl-C again")
                run.send_signal(signal.SIGINT)
                run.communicate(timeout=100)
                self.assertEqual(run.returncode, 130)
                self.assertEqual(json.loads((output / "manifest.json").read_text())["exit_code"], 130)

    def test_a_step_that_takes_too_long_ends_the_run(self):
        for way, options in WAYS.items():
            with self.subTest(way):
                self.assertRegex(self.first_line("controller", "loop", "--step-timeout", "0.5", *options),
                                 "^" + re.escape(ROBOT) + r" did not return within 0.5 s \(--step-timeout\)")

    def test_a_memory_limit_is_told(self):
        for way, options in WAYS.items():
            with self.subTest(way):
                self.assertRegex(self.first_line("controller", "memory", "--memory-limit", "640MiB", *options),
                                 "^" + re.escape(ROBOT) + r" failed: no memory is left: it may take 640 MiB")


class Surroundings(OutsideTest):
    def within(self, script, *arguments):
        """Runs a shell script in namespaces of its own: no network but a loopback interface that is down, own mounts."""
        # Within, everybody is root: the folder in /tmp that bears the number of root may be that of the real one.
        runtime = self.folder / "runtime"
        runtime.mkdir(mode=0o700, exist_ok=True)
        done = subprocess.run(["unshare", "-rnm", "sh", "-c", script, "sh", *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True, timeout=60,
                              env={**self.environment(), "XDG_RUNTIME_DIR": str(runtime)})
        if "unshare" in done.stderr or "mount:" in done.stderr:
            self.skipTest(done.stderr)
        return done

    def test_a_loopback_interface_that_is_down_is_named_with_the_cure(self):
        file = self.experiment()
        done = self.within('"$1" run "$2" --quiet', PREFIX / "bin" / "swarmanoid", file)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("ip link set lo up", done.stderr.splitlines()[0])

    def test_full_shared_memory_is_named_with_the_cure(self):
        file = self.experiment(ticks=1000)
        memory = self.folder / "memory"
        memory.mkdir()
        for size in ("64k", "256k", "1m"):
            with self.subTest(size):
                done = self.within('ip link set lo up; mount -t tmpfs -o size="$3" none "$4"; SWARMANOID_SHARED_FOLDER="$4/runs" '
                                   '"$1" run "$2" --quiet', PREFIX / "bin" / "swarmanoid", file, size, memory)
                if done.returncode == 0:
                    continue  # it was enough
                self.assertEqual(done.returncode, 4, done.stderr)
                first = done.stderr.splitlines()[0]
                self.assertRegex(first, f"{memory}.*.*(is full|KiB left)")
                self.assertIn("SWARMANOID_SHARED_FOLDER", first)

    def test_a_full_disk_is_named(self):
        file = self.experiment(ticks=100000)
        file.write_text(file.read_text().replace("</ahss-config>", """
  <visualisations><text_render id="positions"><file>positions.txt</file></text_render></visualisations>
</ahss-config>"""))
        disk = self.folder / "disk"
        disk.mkdir()
        for way, options in WAYS.items():
            with self.subTest(way):
                done = self.within('ip link set lo up; mount -t tmpfs -o size=512k none "$3"; f="$3/out"; p="$1"; x="$2"; shift 3; '
                                   '"$p" run "$x" --quiet --output "$f" "$@"', PREFIX / "bin" / "swarmanoid", file, disk, *options)
                self.assertEqual(done.returncode, 4, done.stderr)
                first = done.stderr.splitlines()[0]
                # A cluster also writes a journal. Either may meet the end of the disk first.
                self.assertRegex(first, "visualisation 'positions'|the journal")
                self.assertIn("No space left on device", first)

    def test_a_window_without_a_display_is_named(self):
        file = self.experiment()
        for kind in ("opengl_render", "ogre_render"):
            file.write_text(re.sub("<visualisations>.*</visualisations>", "", file.read_text(), flags=re.DOTALL).replace(
                "</ahss-config>", f'<visualisations><{kind} id="window"/></visualisations></ahss-config>'))
            done = self.command("swarmanoid", "run", file, "--quiet", environment={"DISPLAY": "", "WAYLAND_DISPLAY": ""})
            if "is not installed" in done.stderr:
                continue
            self.assertEqual(done.returncode, 4, done.stderr)
            first = done.stderr.splitlines()[0]
            self.assertIn("visualisation 'window'", first)
            self.assertIn("DISPLAY", first)
