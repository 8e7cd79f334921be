"""Users move workers in mid-run: every tick has the hash of an undisturbed run in one process."""
import csv
import os
import signal

from harness import CONFIGS, FINISHED, LauncherTest, children_of, words_of
from world.case import controller, experiment

EXPERIMENT = CONFIGS / "diffusion_10.xml"
TICKS = 1500


class Moves(LauncherTest):
    def begin(self, *options, experiment=EXPERIMENT, ticks=TICKS):
        run = self.start("run", experiment, "--ticks", ticks, "--paused", "--hash-log", "cluster", "--output", "out",
                         "--controller-hosts", 2, *options)
        self.wait_for_experiment(experiment.stem)
        return run

    def refused(self, *words, says):
        answer = self.run_it("control", *words)
        self.assertEqual(answer.process.returncode, 2, answer.stdout + answer.stderr)
        for text in says:
            self.assertIn(text, answer.stderr)

    def assert_undisturbed(self, run, said="", experiment=EXPERIMENT):
        self.assertEqual(run.wait(), 0, said + run.stderr)
        hash_of_run = self.assert_finished(run)
        ticks = int(FINISHED.match(run.stdout.splitlines()[-1])[1])
        one = self.run_it("run", experiment, "--ticks", ticks, "--single-process", "--quiet", "--hash-log", "one", "--output", "one_out")
        self.assertEqual(hash_of_run, self.assert_finished(one, ticks))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assertEqual((self.folder / "out/positions.txt").read_bytes(), (self.folder / "one_out/positions.txt").read_bytes())
        self.assert_nothing_left(run)

    def moves(self):
        with (self.folder / "out/events.csv").open() as file:
            return [(row["request"], row["entity"], row["from"]) for row in csv.DictReader(file) if row["request"].startswith("move")]

    def test_to_other_processes_while_the_run_is_paused(self):
        run = self.begin()
        self.control("step", 777)
        for words, program, of_it in ((["move-host", "1"], "controller_host", ["--host", "1"]), (["move-engine", "ground"], "engine_worker", []),
                                      (["move-host", "1", "here"], "controller_host", ["--host", "1"])):
            before = run.find(program, *of_it)
            answer = self.control(*words)
            after = run.find(program, *of_it)
            self.assertNotEqual(before, after)
            self.assertRegex(answer, rf"is process \S+:{after} now, at tick 777")
        said = run.read_until("engine 'ground' moves to another process of this machine")
        self.control("step", 100)
        self.run_it("control", "resume")
        self.assert_undisturbed(run, said)
        self.assertEqual([move[:2] for move in self.moves()], [("move-host", "1"), ("move-engine", "ground"), ("move-host", "1")])
        for _, _, asker in self.moves():
            self.assertRegex(asker, r"^\S+@\S+:\d+$")

    def test_while_it_runs(self):
        # In the midst of ticks, and without an end that could come too early.
        run = self.begin("--real-time", 20, ticks=0)
        self.control("resume")
        for words in (["move-host", "0"], ["move-engine", "ground"], ["move-host", "1"]):
            self.assertIn("at tick", self.control(*words))
        self.control("stop")
        self.assert_undisturbed(run)
        # They held no lock: the run had been held before they were killed.
        self.assertNotIn("start again", run.stderr)

    def test_what_cannot_be(self):
        run = self.begin()
        self.refused("move-host", "7", says=["the run has no controller host 7; it has controller host 0, controller host 1, engine 'ground'"])
        self.refused("move-host", "x", says=["'x' is no number of a controller host; write move-host N [MACHINE]"])
        self.refused("move-host", says=["write move-host N"])
        self.refused("move-engine", "grund", says=["the run has no engine 'grund'"])
        self.refused("move-host", "0", "beta", says=["the run has no machine 'beta'; it has here", "machines = alpha beta"])
        self.refused("drain", "beta", says=["the run has no machine 'beta'"])
        self.refused("drain", "here", says=["the space server is at 'here', and cannot be moved"])
        self.refused("hosts", "+9", says=["the run has 2 controller hosts, and can have 10"])
        self.refused("hosts", "-2", says=["the run has 2 controller hosts, and one must remain"])
        self.refused("hosts", "-1", "beta", says=["the run has no machine 'beta'"])
        self.refused("hosts", "3", says=["'3' is no number of controller hosts more or fewer; write hosts +N/-N/again"])
        self.refused("hosts", says=["write hosts +N"])
        self.refused("move-hots", "0", says=["did you mean 'move-host'?"])
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)

    def test_drain_knows_who_arrived(self):
        """A worker whose new machine cannot be reached returns, and does not count there; a worker that arrived does."""
        reach = self.folder / "reach.sh"
        reach.write_text('#!/bin/sh\n[ "$1" = nowhere ] && exit 255\nshift\nexec sh -c "$*"\n')
        reach.chmod(0o755)
        hosts = self.folder / "hosts.txt"
        hosts.write_text(f"command = {reach} {{host}} {{shell_command}}\nmachines = nowhere beta\noptions = --interface lo\n")
        run = self.begin("--hosts", hosts)
        self.control("step", 300)
        self.control("move-host", "1", "nowhere")
        self.assertIn("no worker is at nowhere", self.control("drain", "nowhere"))
        said = run.read_until("controller host 1 moves to nowhere")
        self.control("move-host", "0", "beta")
        self.assertRegex(self.control("drain", "beta"), "controller host 0 is process .* now, at tick 300")
        self.run_it("control", "resume")
        self.assert_undisturbed(run, said)

    def hosts_of(self, run):
        return sorted(words[words.index("--host") + 1] if "--host" in words else "0" for words in map(words_of, children_of(run.process.pid))
                      if words and os.path.basename(words[0]) == "controller_host")

    def test_more_controller_hosts_and_fewer(self):
        run = self.begin()
        self.control("step", 777)
        for words, hosts in ((["+2"], "0123"), (["-3", "here"], "0"), (["+1"], "01"), (["again"], "01")):
            answer = self.control("hosts", *words)
            self.assertIn("one controller host has all robots now" if len(hosts) == 1 else f"{len(hosts)} controller hosts share the robots now", answer)
            self.wait_until("so many hosts", lambda: self.hosts_of(run) == list(hosts), run)
            self.control("step", 100)
            self.control("move-host", len(hosts) - 1)
        self.run_it("control", "resume")
        self.assert_undisturbed(run)
        with (self.folder / "out/events.csv").open() as file:
            asked = [(row["tick"], row["numbers"], row["entity"]) for row in csv.DictReader(file) if row["request"] == "hosts"]
        self.assertEqual(asked, [("777", "+2", ""), ("877", "-3", "here"), ("977", "+1", ""), ("1077", "again", "")])
        # Looking back, and going on, from a journal of several numbers of hosts.
        self.assertIn(f"equal: {TICKS + 1} states", self.run_it("replay", "out", "--verify").stdout)
        for options in (["--controller-hosts", 3], ["--single-process"]):
            branch = self.run_it("run", "--branch", "out@950", "--ticks", TICKS, *options, "--no-visualisers", "--output", f"branch{len(options)}{options[:1]}")
            self.assertEqual(self.assert_finished(branch, TICKS), self.assert_finished(run, TICKS))

    def test_robots_are_shared_out_by_where_they_are(self):
        run = self.begin()
        self.refused("hosts", "again", "beta", says=["write hosts +N/-N/again"])
        self.control("step", 777)
        self.assertFalse((self.folder / "out/journal/1").exists())
        self.assertIn("2 controller hosts share the robots now", self.control("hosts", "again"))
        run.read_until("assigned again to 2 controller hosts")
        # Other hosts begin a segment, and so do as many with other robots.
        self.wait_until("a segment", lambda: (self.folder / "out/journal/1").exists(), run)
        self.control("step", 100)
        self.control("move-host", 1)
        # So does a start of all processes for another reason.
        self.control("step", 300)
        os.kill(run.find("space_server"), signal.SIGKILL)
        run.read_until("space server was killed by signal 9 (Killed)")
        self.wait_for_experiment("diffusion_10")
        self.control("step", 100)
        self.control("move-host", 0)
        self.run_it("control", "resume")
        self.assert_undisturbed(run)
        self.assertIn(f"equal: {TICKS + 1} states", self.run_it("replay", "out", "--verify").stdout)
        # A branch begins with robots that are shared out by where they are, too.
        branch = self.run_it("run", "--branch", "out@950", "--ticks", TICKS, "--controller-hosts", 2, "--no-visualisers", "--output", "branch")
        self.assertEqual(self.assert_finished(branch, TICKS), self.assert_finished(run, TICKS))
        self.assertIn("fb_3", self.run_it("inspect", "out@600", "fb_3").stdout)

    def test_hosts_that_share_mixed_robots_again_over_a_network(self):
        """Hosts hear of what is near their robots. Two groups, far apart, of one host each; then half of each changes places."""
        place_of = {f"fb_{k}": f"{1 + 30 * (k // 4)},{1 + k % 4},0" for k in range(8)}
        robots = "".join(f'<footbot id="{robot}" position="{place}" controller="c"/>' for robot, place in place_of.items())
        file = experiment(self.folder / "groups.xml", "<maxclock>0</maxclock>",
                          controller("footbot_diffusion", ["dummy_footbot_wheels"], ["generic_footbot_proximity"],
                                     "<velocity>0.01</velocity><alpha>7.5</alpha><delta>0.1</delta>", library="footbot_diffusion"), robots, "40,6,1")
        network = ["--interface", "127.0.0.1"]
        (self.folder / "hosts.txt").write_text(f"options = {' '.join(network)}\n")
        run = self.start("run", file, "--controller-hosts", 2, "--real-time", 20, "--hosts", "hosts.txt", "--output", "out")
        self.wait_until("the run", lambda: self.run_it("control", "machines", *network).process.returncode == 0, run)
        for robot, place in (("fb_0", "31,5,0"), ("fb_1", "32,5,0"), ("fb_4", "1,5,0"), ("fb_5", "2,5,0")):
            self.control("move", robot, place, *network)
        self.assertIn("2 controller hosts share the robots now", self.control("hosts", "again", *network))
        self.control("move", "fb_2", "2,1,0", *network)
        self.control("stop", *network)
        self.assertEqual(run.wait(), 0, run.stderr)
        self.assertIn("equal: ", self.run_it("replay", "out", "--verify").stdout)
        self.assert_nothing_left(run)

    def test_hosts_of_controllers_that_cannot_be_saved(self):
        """They do all ticks again, whose commands other hosts gave, and find the same."""
        robots = "".join(f'<footbot id="fb_{k}" position="{k % 3}.5,{k // 3}.5,0" orientation="0,0,{40 * k}" controller="c"/>' for k in range(6))
        file = experiment(self.folder / "stateless.xml", f"<maxclock>{TICKS}</maxclock>",
                          controller("sample_footbot_controller", ["noisy_footbot_wheels"], library="sample_footbot_controller"), robots, "3,2,1",
                          "kinematics2d", more='<visualisations><text_render id="positions" file="positions.txt" every="10"/></visualisations>')
        # So slow that the space server and the engine, which can be saved, are in between: all go on from there, the hosts from the start.
        run = self.begin("--real-time", 20, experiment=file, ticks=600)
        for words in (["+1"], ["-2"], ["+3"]):
            self.control("step", 150)
            self.control("hosts", *words)
        self.control("move-host", "3")
        self.run_it("control", "resume")
        self.assert_undisturbed(run, experiment=file)

    def test_more_controller_hosts_while_it_runs(self):
        run = self.begin("--real-time", 20, ticks=0)
        self.control("resume")
        for words in (["+2"], ["-1"]):
            self.assertIn("now", self.control("hosts", *words))
        os.kill(run.find("controller_host", "--host", "2"), signal.SIGKILL)
        run.read_until("controller host 2 was killed by signal 9 (Killed)")
        self.control("stop")
        self.assert_undisturbed(run)

    def test_hosts_are_as_many_after_everything_died(self):
        run = self.begin()
        self.control("step", 777)
        self.control("hosts", "+1")
        self.control("step", 300)
        # A run that goes on with a journal has as many as the journal ends with.
        self.kill_all(run)
        resumed = self.run_it("resume", "out")
        one = self.run_it("run", EXPERIMENT, "--ticks", TICKS, "--single-process", "--quiet", "--output", "one_out")
        self.assertEqual(self.assert_finished(resumed, TICKS), self.assert_finished(one, TICKS))
        self.assertTrue((self.folder / "out/resumed/controller_host-2.log").exists())

    def test_not_without_replacements(self):
        run = self.begin("--no-recovery")
        self.refused("move-host", "0", says=["no process of this run can be moved"])
        self.control("stop")
        self.assertEqual(run.wait(), 0, run.stderr)
