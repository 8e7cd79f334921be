#!/usr/bin/env python3
"""A run over two machines whose link loses packets. The hash must be that of one process, and what is lost is all that is sent again.
Needs root and /dev/net/tun; skipped otherwise."""
import os
import signal

import two_machines
from harness import CONFIGS, REPLACED, LauncherTest

setUpModule = two_machines.require

TICKS = 60
FRAME_BYTES = 1514  # the largest of a link whose packets have 1,500


class Network(LauncherTest):
    def setUp(self):
        super().setUp()
        self.machines = two_machines.TwoMachines(os.environ["SWARMANOID_BUILD"])
        self.addCleanup(self.machines.remove)

    def run_over(self, loss, options="--lease 60", experiment="diffusion_10.xml", ticks=TICKS):
        """Frames carried, and those lost."""
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts(options))
        self.machines.connect(loss, 1)
        try:
            run = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, timeout=90)
        finally:
            carried, lost, largest = self.machines.disconnect()
        self.assertEqual(run.process.returncode, 0, run.stderr)
        one = self.run_it("run", CONFIGS / experiment, "--ticks", ticks, "--no-visualisers", "--single-process")
        self.assertEqual(self.assert_finished(run, ticks), self.assert_finished(one, ticks))
        self.assertLessEqual(largest, FRAME_BYTES)
        return carried, lost

    def test_same_hash_with_delay(self):
        # The engine is on the other machine: its traffic went over the link.
        self.assertGreater(self.run_over(0)[0], TICKS)

    def test_same_hash_with_delay_and_loss(self):
        self.assertGreater(self.run_over(0.05)[1], 0)

    def test_large_messages_are_mended_packet_by_packet(self):
        """1,000 robots: 32 kB of poses each way in a tick, 16 kB of commands; some 70 packets, and few more for what is lost."""
        ticks = 40
        carried, lost = self.run_over(0.02, experiment="diffusion_1000.xml", ticks=ticks)
        self.assertGreater(lost, ticks / 2)
        self.assertLess(carried / ticks, 200)

    def test_a_host_on_another_machine_that_dies_is_replaced(self):
        """Three hosts, each of which is told what is near its robots."""
        experiment, ticks = CONFIGS / "diffusion_1000.xml", 150
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts() + "".join(f"controller_host {k} = {self.machines.names[1]}\n" for k in range(3)))
        expected = self.one_process(experiment, ticks, "--no-visualisers")
        self.machines.connect(0.01, 1)
        run = self.start("run", experiment, "--ticks", ticks, "--no-visualisers", "--hosts", hosts, "--controller-hosts", 3, "--paused",
                         "--hash-log", "cluster")
        try:
            self.wait_for_experiment("diffusion_1000")
            self.control("step", 20)
            os.kill(run.find("controller_host"), signal.SIGKILL)
            run.read_until(REPLACED)
            self.control("resume")
            run.wait()
        finally:
            self.machines.disconnect()
        self.assert_same(run, ticks, expected)

    def test_engines_that_are_told_of_others(self):
        """Entities that several engines see, those that functions move, and groups that hold one another."""
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts() + f"controller_host 1 = {self.machines.names[1]}\n")
        self.machines.connect(0, 0.1)
        self.addCleanup(self.machines.disconnect)
        for name in ("mirrors", "prey_supply", "gripped_chain"):
            with self.subTest(name):
                words = ("run", CONFIGS / f"{name}.xml", "--ticks", 150, "--no-visualisers")
                one = self.run_it(*words, "--single-process")
                run = self.run_it(*words, "--hosts", hosts, "--controller-hosts", 2, timeout=90)
                self.assertEqual(self.assert_finished(run, 150), self.assert_finished(one, 150), run.stderr)

    def test_without_multicast_by_peers(self):
        self.machines.forget_multicast()
        self.run_over(0, "--lease 60 --peers 10.78.0.1 10.78.0.2")

    def test_a_link_that_is_cut_for_longer_than_the_lease(self):
        hosts = self.folder / "hosts.txt"
        hosts.write_text(self.machines.hosts("--lease 3"))
        experiment = CONFIGS / "diffusion_10.xml"
        one = self.run_it("run", experiment, "--ticks", 100, "--no-visualisers", "--single-process", "--hash-log", "one")
        self.machines.connect(0, 1)
        run = self.start("run", experiment, "--ticks", 100, "--no-visualisers", "--hosts", hosts, "--paused", "--hash-log", "cluster")
        self.wait_for_experiment("diffusion_10")
        self.control("step", 20)
        self.machines.disconnect()
        said = run.read_until(REPLACED)
        self.machines.connect(0, 1)
        self.control("resume")
        run.wait()
        self.machines.disconnect()
        self.assertEqual(run.process.returncode, 0, said + run.stderr)
        self.assertEqual(self.assert_finished(run, 100), self.assert_finished(one, 100))
        self.assertEqual((self.folder / "cluster").read_text(), (self.folder / "one").read_text())
        self.assert_nothing_left(run)
