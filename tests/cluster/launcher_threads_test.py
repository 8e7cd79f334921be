"""Threads share the sensors and the controllers of a run: the same bits for any number of them, in one process and in the hosts of a cluster. The scenes are those of the benchmark, with robots
that all their readings steer. Needs bench_swarm."""
import os
import subprocess
import sys
import unittest

from harness import CONFIGS, LauncherTest, children_of, end, stat_of, words_of

SCENES = CONFIGS.parent / "tests" / "bench" / "scenes"


class Threads(LauncherTest):
    def write(self, folder, word, *options):
        libraries = os.path.join(os.environ["SWARMANOID_BUILD"], "tests", "bench", "controllers")
        subprocess.run([sys.executable, SCENES, "--write", folder, "--controller", libraries, "--only", word, *options], check=True)
        return sorted(folder.iterdir())

    def hash_of(self, experiment, threads, *options, way="--single-process"):
        run = self.run_it("run", experiment, way, "--quiet", "--ticks", 12, "--threads", threads, *options)
        self.assertEqual(run.process.returncode, 0, run.stderr)
        return run.stdout.split("hash ")[1].split(",")[0]

    def test_their_number_changes_no_bit(self):
        # The last one: many enough to share the grid of neighbours, the commands and the poses, too.
        for word in ("foraging set, 4 bulbs", "light, 4 bulbs, 500 walls", "diffusion, 10,000 robots"):
            for experiment in self.write(self.folder / word.replace(" ", "_").replace(",", ""), word, "--steer-by-all"):
                with self.subTest(experiment.name):
                    one = self.hash_of(experiment, 1)
                    for threads in (2, 3, 0):
                        self.assertEqual(self.hash_of(experiment, threads), one, f"{threads} threads")

    def test_engines_solve_groups_in_threads(self):
        for name in ("diffusion_100_dynamics2d", "diffusion_100_dynamics3d"):
            with self.subTest(name):
                one = self.hash_of(CONFIGS / f"{name}.xml", 1)
                for threads in (2, 3):
                    self.assertEqual(self.hash_of(CONFIGS / f"{name}.xml", threads), one, f"{threads} threads")

    def test_hosts_of_a_cluster_have_threads(self):
        [experiment] = self.write(self.folder / "cluster", "light, 4 bulbs, 500 walls", "--steer-by-all")
        one = self.hash_of(experiment, 1)
        for hosts in (1, 2):
            self.assertEqual(self.hash_of(experiment, 3, "--controller-hosts", hosts, way="--no-journal"), one)

    @unittest.skipIf(len(os.sched_getaffinity(0)) < 2, "needs two cores")
    def test_runs_side_by_side_take_different_cores(self):
        """Where another test has a run, too, nothing is known."""
        def cores_of(number):
            run = self.start("run", CONFIGS / "diffusion_10.xml", "--paused", "--no-visualisers", "--output", f"beside{number}")
            server = run.find("space_server")
            self.wait_until("a core", lambda: len(os.sched_getaffinity(server)) == 1, run)
            return run, server, os.sched_getaffinity(server)

        _, _, first = cores_of(0)
        for number in range(1, 5):
            run, server, second = cores_of(number)
            if self.servers_here() == 2:
                self.assertNotEqual(second, first)
            end(run.process)
            self.wait_until("its end", lambda server=server: (stat_of(server) or "Z")[-1] == "Z")

    def servers_here(self):
        return sum(os.path.basename((words_of(pid) or [""])[0]) == "space_server" for pid in filter(str.isdigit, os.listdir("/proc")))

    @unittest.skipIf(len(os.sched_getaffinity(0)) < 2, "needs two cores")
    def test_processes_that_work_one_after_the_other_share_a_core(self):
        for number, (share, options) in enumerate(((True, []), (False, ["--controller-hosts", 2]), (False, ["--ahead", 1]),
                                                   (False, ["--set", "engines.ground.threads=2"]), (False, ["--placement", "spread"]))):
            with self.subTest(options):
                run = self.start("run", CONFIGS / "diffusion_1000.xml", "--paused", "--no-visualisers", "--output", f"out{number}", *options)
                self.wait_for_experiment("diffusion_1000")
                workers = [pid for pid in children_of(run.process.pid)
                           if os.path.basename((words_of(pid) or [""])[0]) in ("space_server", "engine_worker", "controller_host")]
                self.assertGreaterEqual(len(workers), 3)
                cores = {frozenset(os.sched_getaffinity(pid)) for pid in workers}
                self.assertEqual(len(cores), 1, cores)
                self.assertEqual(len(cores.pop()) == 1, share)
                self.control("stop")
                self.assertEqual(run.wait(), 0, run.stderr)

    def test_readings_reach_the_hash(self):
        word = "light, 4 bulbs, 500 walls"
        [steered] = self.write(self.folder / "steered", word, "--steer-by-all")
        [blind] = self.write(self.folder / "blind", word)
        self.assertNotEqual(self.hash_of(steered, 1), self.hash_of(blind, 1))
