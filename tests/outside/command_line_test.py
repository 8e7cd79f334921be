"""Words and numbers at the command line: what cannot be meant is refused at once, with the limit and the cure."""
import re
import signal
import subprocess

from outside import PREFIX, WAYS, OutsideTest

PROGRAMS = ["swarmanoid", "space_server", "engine_worker", "controller_host", "visualiser", "swarmanoid_robot"]


class CommandLine(OutsideTest):
    def refused(self, *words, says, code=2):
        done = self.command(*words)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for text in [says] if isinstance(says, str) else says:
            self.assertIn(text, done.stderr)

    def test_numbers_that_mean_nothing(self):
        file = self.experiment()
        for program in [["swarmanoid", "run"], ["space_server"]]:
            self.refused(*program, file, "--real-time", "nan", says=["--real-time is 'nan'", "from 0 to", "for example"])
            self.refused(*program, file, "--real-time", "inf", says="--real-time is 'inf'")
            self.refused(*program, file, "--ticks", "-1", says=["--ticks is -1", "from 0 to"])
            self.refused(*program, file, "--ahead", "2", says=["--ahead is 2", "from 0 to 1"])
            self.refused(*program, file, "--seed", "1.5", says=["--seed is '1.5'", "a whole number"])
            self.refused(*program, file, "--controller-hosts", "0", says="from 1 to 1000")
            self.refused(*program, file, "--set", "framework.seed", says="PATH=VALUE")
            self.refused(*program, file, "--restore", "/dev/zero", says="a device")
            self.refused(*program, file, "--journal-budget", "plenty", says=["--journal-budget is 'plenty'", "a number of bytes"])
        self.refused("swarmanoid", "run", file, "--controller-hosts", "many", says=["--controller-hosts is 'many'", "a whole number"])
        self.refused("swarmanoid", "run", "--branch", "runs/first", says=["--branch is 'runs/first'", "RUN@TICK", "for example"])
        self.refused("swarmanoid", "run", file, "--sed", "3",
                     says="swarmanoid run does not take '--sed'; did you mean '--set'? All options: swarmanoid run --help")
        self.refused("swarmanoid", "convert", "-o", "there", "here.argos",
                     says="swarmanoid convert does not take '-o'; its options with that letter: --output. All options: swarmanoid convert --help")
        self.refused("swarmanoid", "attach", says=["attach needs KIND: text, ", "for example: swarmanoid attach text\n"])
        self.refused("swarmanoid", "replay", self.folder, "text", "--verify", says="leave out it or 'text'")
        self.refused("swarmanoid", "edit", "first_try.xml", says="make one: swarmanoid new experiment first_try", code=3)
        self.refused("swarmanoid", "run", "--no-such", says="All options: swarmanoid run --help")
        self.refused("swarmanoid", "run", self.folder, says="this is a folder", code=3)
        self.refused("swarmanoid", "sweep", file, says="an experiment is run by: swarmanoid run", code=3)
        self.refused("swarmanoid", "run", says="name an experiment file, or a run to branch off with --branch RUN@TICK")
        self.assertFalse((self.folder / "runs").exists())
        self.refused("engine_worker", "--engine", "ground", "--discovery-server", "127.0.0.1:11811junk",
                     says=["--discovery-server is '127.0.0.1:11811junk'", "a port from 1 to 65535"])
        self.refused("controller_host", "--host", "-1", says="--host is -1")
        self.refused("controller_host", "--threads", "0", says=["--threads is 0", "from 1 to 64"])
        self.refused("visualiser", "--attach", "text", "--hz", "nan", says="--hz is 'nan'")
        self.refused("swarmanoid_robot", file, "--wait", "nan", says="--wait is 'nan'")
        self.refused("swarmanoid", "control", "move-hsot", "1", says="did you mean 'move-host'?")
        self.refused("swarmanoid", "control", "reset", "7", says="write reset [--seed N]")
        self.refused("swarmanoid", "control", "pause", "--seed", "7", says="pause: it takes no 'seed'")
        self.refused("swarmanoid", "control", "reset", "--seed", "-1", says="--seed is -1")
        self.refused("swarmanoid", "sweep", file, "--runs-per-task", "1.5", says=["--runs-per-task is '1.5'", "a whole number"])
        self.refused("swarmanoid", "sweep", file, "--hosts", self.folder / "nothing.txt", says="--hosts: cannot read '")

    def test_lines_to_paste_are_quoted(self):
        run = self.folder / "my run"
        run.mkdir()
        (run / "manifest.json").write_text("{}")
        (run / "experiment.xml").write_text(self.experiment().read_text())
        self.refused("swarmanoid", "run", run, code=3,
                     says=[f"swarmanoid replay '{run}'; ", f"swarmanoid resume '{run}'; ", f"swarmanoid run '{run}/experiment.xml'"])
        self.refused("swarmanoid", run / "experiment.xml", says=f"swarmanoid run '{run}/experiment.xml'")
        self.refused("swarmanoid", "sweep", run / "experiment.xml", says=f"swarmanoid run '{run}/experiment.xml'", code=3)
        made = self.command("swarmanoid", "new", "user", self.folder / "my robots")
        self.assertIn(f"\n  {str(self.folder / 'my robots' / 'build.sh').replace(' ', chr(92) + ' ')}\n", made.stderr)

    def test_shares(self):
        self.refused("swarmanoid", "share", says="give one of --watch, --operate, --open, --list and --revoke ID")
        self.refused("swarmanoid", "share", "--watch", "--for", "2 hours", says="such as 90s, 30m, 2h or 7d")
        self.refused("swarmanoid", "share", "--watch", "--for", "nans", says="--for nans")
        self.refused("swarmanoid", "share", "--watch", "nothing", says="no experiment runs on this machine")

    def test_near_names(self):
        self.refused("swarmanoid", "rnu", says="did you mean 'run'?")
        self.refused("swarmanoid", "help", "rnu", says="did you mean 'run'?")
        self.refused("swarmanoid", "control", "spede", "2", says=["there is no request 'spede'", "did you mean 'speed'?"])
        file = self.experiment()
        self.refused("swarmanoid", "run", file, "--tick", "3", says="did you mean '--ticks'?")
        self.refused("space_server", file, "--tick", "3", says="did you mean '--ticks'?")
        self.refused("swarmanoid_robot", "--chek", says="did you mean '--check'?")
        self.refused("swarmanoid", "run", self.folder / "experimnt.xml", says=f"did you mean '{file}'?", code=3)

    def test_help_of_every_program(self):
        for program in PROGRAMS:
            done = self.command(program, "--help")
            self.assertEqual((done.returncode, done.stderr), (0, ""), program)
            self.assertRegex(done.stdout, r"--[a-z]", program)
        wanted = self.command("swarmanoid", "--help").stdout
        self.assertEqual(self.command("swarmanoid", "help").stdout, wanted)
        self.assertEqual(self.command("swarmanoid", "help", "run").stdout, self.command("swarmanoid", "run", "--help").stdout)
        bare = self.command("swarmanoid")
        self.assertEqual((bare.returncode, bare.stdout), (2, wanted))
        help_of_run = self.command("swarmanoid", "run", "--help").stdout
        self.assertRegex(help_of_run, r"(?s)--real-time.*from 0 to.*for\s+example\s+--real-time\s+2")
        # What the server takes is what the launcher takes, from one table.
        options = {name: set(re.findall(r"^ +(--[a-z-]+)", self.command(*name, "--help").stdout, re.MULTILINE))
                   for name in [("swarmanoid", "run"), ("space_server",)]}
        own = {"--status-fd", "--await-replacements", "--go-on", "--machine", "--place", "--domain", "--interface", "--peers", "--discovery-server", "--lease", "--datagram",
               "--key", "--key-fd", "--version"}
        self.assertLessEqual(options[("space_server",)] - own, options[("swarmanoid", "run")])

    def test_what_functions_print_is_no_word_of_the_server(self):
        file = self.experiment(functions='<outside_printer id="prints" library="outside_printer"/>')
        hashes = {way: self.hash_of(self.run_experiment(file, "--output", self.folder / way, *options))
                  for way, options in WAYS.items()}
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertIn("finished 1 1 00000000000000ff 1 1", (self.folder / "cluster" / "space_server.log").read_text(errors="replace"))

    def test_attach_notices_that_its_run_has_ended(self):
        # A run whose space server has been stopped before it speaks, and dies while the visualiser looks for it.
        gone = subprocess.Popen(["/bin/sleep", "60"])
        watcher = subprocess.Popen([PREFIX / "bin" / "visualiser", "--attach", "text", "--experiment", "absent", "--domain",
                                    "76", "--server", str(gone.pid)], cwd=self.folder, env=self.environment(), text=True,
                                   stderr=subprocess.PIPE)
        self.addCleanup(watcher.stderr.close)
        self.assertIn("waiting for the space server of 'absent'", watcher.stderr.readline())
        gone.send_signal(signal.SIGKILL)
        gone.wait()
        _, errors = watcher.communicate(timeout=100)
        self.assertEqual(watcher.returncode, 4)
        self.assertIn("experiment 'absent' has ended", errors)
