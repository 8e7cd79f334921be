"""Faults of devices: the same hash in one process and in clusters, also after the kill of a host and from a checkpoint; and their lines in the log of events."""
import os
import re
import signal

from harness import CONFIGS, REPLACED, LauncherTest
from world.case import controller, experiment

TICKS = 200
FAULTS = """<faults>
  <fault id="lost" device="range_and_bearing" side="sensor" kind="drop" value="0.4" from="10" to="180"/>
  <fault id="late" entities="fb_1*" device="footbot_proximity" kind="delay" value="7" from="20"/>
  <fault id="shaky" share="0.5" device="footbot_wheels" kind="noise" value="0.3" from="5"/>
  <fault id="jammed" share="0.3" device="footbot_wheels" kind="stuck" from="60" to="150"/>
  <fault id="asleep" share="0.2" from="40" to="120" kind="off"/>
</faults>"""
EVENTS = ["5,fault,shaky,,begins: noise of footbot_wheels; robots: 10", "10,fault,lost,,begins: drop of range_and_bearing; robots: 20",
          "20,fault,late,,begins: delay of footbot_proximity; robots: 11", "40,fault,asleep,,begins: off of all; robots: 4",
          "60,fault,jammed,,begins: stuck of footbot_wheels; robots: 6", "120,fault,asleep,,ends: off of all; robots: 4",
          "150,fault,jammed,,ends: stuck of footbot_wheels; robots: 6", "180,fault,lost,,ends: drop of range_and_bearing; robots: 20"]


class DeviceFaultsTest(LauncherTest):
    def write(self, faults=FAULTS):
        return experiment(
            self.folder / "faulty.xml",
            f"<maxclock>{TICKS}</maxclock><canonical_period>50</canonical_period>",
            controller("footbot_diffusion", ["dummy_footbot_wheels", "generic_range_and_bearing"], ["generic_footbot_proximity", "generic_range_and_bearing"],
                       library="footbot_diffusion"),
            '<distribute quantity="20"><footbot id="fb" controller="c"/></distribute>', "3,3,1", more=faults)

    def done(self, file, name, *options):
        run = self.run_it("run", file, "--hash-log", name, "--output", name + "_out", *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        return (self.folder / name).read_text()

    def events(self, name):
        lines = (self.folder / f"{name}_out/events.csv").read_text().splitlines()[1:]
        return [re.sub(r",0,,[0-9a-f]{8}$", "", line) for line in lines]

    def test_the_same_everywhere(self):
        file = self.write()
        one = self.done(file, "one", "--single-process")
        self.assertNotEqual(one, self.done(self.write("<faults/>"), "none", "--single-process"))
        file = self.write()
        self.assertEqual(self.events("one"), EVENTS)
        for name, options in (("threads", ("--single-process", "--threads", 2)), ("cluster", ()), ("hosts", ("--controller-hosts", 2))):
            self.assertEqual(self.done(file, name, *options), one, name)
            self.assertEqual(self.events(name), EVENTS, name)

    def test_a_host_that_is_killed(self):
        file = self.write()
        one = self.done(file, "one", "--single-process")
        run = self.start("run", file, "--paused", "--hash-log", "cluster", "--output", "cluster_out", "--controller-hosts", 2)
        self.wait_for_experiment("faulty")
        self.control("step", 90)
        os.kill(run.find("controller_host"), signal.SIGKILL)
        said = run.read_until(REPLACED)
        self.run_it("control", "resume")
        self.assertEqual(run.wait(), 0, said + run.stderr)
        self.assertEqual((self.folder / "cluster").read_text(), one)

    def test_from_a_checkpoint(self):
        one = self.done(self.write(), "one", "--single-process", "--checkpoint-every", 100)
        restored = self.done(self.folder / "one_out/experiment.xml", "restored", "--single-process", "--restore", "one_out/checkpoint-00000100")
        self.assertTrue(one.endswith(restored[restored.index("\n") + 1:]))
        hosts = self.done(self.folder / "one_out/experiment.xml", "hosts", "--controller-hosts", 2, "--restore", "one_out/checkpoint-00000100")
        self.assertEqual(hosts, restored)

    def test_check_names_what_a_device_cannot_have(self):
        checked = self.run_it("check", self.write('<faults><fault id="f" device="range_and_bearing" kind="stuck"/></faults>'))
        self.assertEqual(checked.process.returncode, 3)
        self.assertIn("the fault 'f' cannot change the sensor <range_and_bearing> (generic_range_and_bearing): it has a list, for which there is no 'stuck'; "
                      "choose dead or drop", checked.stdout + checked.stderr)

    def test_the_sample(self):
        run = self.run_it("run", CONFIGS / "faulty_aggregation.xml", "--single-process", "--ticks", 200, "--output", "out")
        self.assertEqual(run.process.returncode, 0, run.stderr)
        self.assertEqual((self.folder / "out/events.csv").read_text().count(",fault,"), 3)
