"""A user shares a directory by `swarmanoid pack`; another one installs, builds and runs it, and sees what changed since."""
import json
import os
import shutil
import subprocess

from harness import LauncherTest

BUILD = os.environ["SWARMANOID_BUILD"]
META = ("--author", "A. User", "--licence", "MIT")


class Packages(LauncherTest):
    def run_in(self, folder, *words, environment=None):
        outside, self.folder = self.folder, self.folder / folder
        run = self.run_it(*words, environment=environment)
        self.folder = outside
        return run

    def done(self, run):
        self.assertEqual(run.process.returncode, 0, run.stderr)
        return run.stdout

    def setUp(self):
        super().setUp()
        (self.folder / "alice_home").mkdir()
        (self.folder / "bob_home").mkdir()

    def test_a_directory_travels_from_one_user_to_another(self):
        self.done(self.run_in("alice_home", "new", "user", "alice"))
        self.done(self.run_in("alice_home/alice", "new", "behavior-controller", "wall_follower"))
        # Without the samples there is less to compile.
        for sample in ("controllers/sample_footbot_controller", "controllers/footbot_diffusion", "controllers/prey_retrieval", "functions"):
            shutil.rmtree(self.folder / "alice_home/alice" / sample)
        packed = self.done(self.run_in("alice_home/alice", "pack", "--release", "1.0", *META, "--output", "../alice-1.0.tar.gz"))
        self.assertIn("packed alice 1.0 by A. User, MIT", packed)
        self.assertIn("wall_follower", packed)

        self.done(self.run_in("bob_home", "new", "user", "bob"))
        # Beside one's own directory, wherever in it one is.
        said = self.run_in("bob_home/bob/controllers", "install", "../../../alice_home/alice-1.0.tar.gz")
        self.assertIn("installed alice 1.0 by A. User, MIT: ../../alice", self.done(said))
        self.assertIn("../../alice/build.sh", said.stderr)
        listed = self.done(self.run_in("bob_home/bob", "list", "packages"))
        self.assertRegex(listed, r"alice 1\.0 by A\. User, MIT\n  controllers  .*wall_follower\n(.*\n)*  files +unchanged\n  libraries +not built")

        installed = self.folder / "bob_home/alice"
        built = subprocess.run(["./build.sh", f"-DCMAKE_PREFIX_PATH={BUILD}", f"-DSwarmanoid_DIR={BUILD}"], cwd=installed,
                               capture_output=True, text=True)
        self.assertEqual(built.returncode, 0, built.stdout + built.stderr)
        hashes = []
        for way in (["--single-process"], []):
            run = self.run_in("bob_home", "run", "alice/experiments/wall_follower.xml", "--quiet", "--ticks", 50, *way)
            self.done(run)
            hashes.append(self.assert_finished(run, 50))
        self.assertEqual(hashes[0], hashes[1])

        # Bob's own experiment takes the library of Alice's.
        experiment = (installed / "experiments/wall_follower.xml").read_text()
        (self.folder / "bob_home/bob/experiments/mine.xml").write_text(
            experiment.replace("../simulation_build", "../../alice/simulation_build"))
        run = self.run_in("bob_home/bob", "run", "experiments/mine.xml", "--quiet", "--ticks", 50, "--single-process")
        self.done(run)
        self.assertEqual(self.assert_finished(run, 50), hashes[0])

        with open(installed / "controllers/wall_follower/wall_follower.cpp", "a") as source:
            source.write("// Bob was here.\n")
        (self.folder / "bob_home/alice/experiments/more.xml").write_text("<ahss-config/>")
        row, = json.loads(self.done(self.run_in("bob_home/bob", "list", "packages", "--json")))
        self.assertEqual((row["name"], row["built"], row["changed"], row["added"]),
                         ("alice", True, ["controllers/wall_follower/wall_follower.cpp"], ["experiments/more.xml"]))
        self.done(self.run_in("alice_home/alice", "pack", "--release", "1.1", "--output", "../alice-1.1.tar.gz"))
        again = self.run_in("bob_home/bob", "install", "../../alice_home/alice-1.1.tar.gz", "--replace")
        self.assertEqual(again.process.returncode, 2)
        self.assertIn("has changed or added files", again.stderr)

    def test_scripts_run_at_once_from_a_folder_of_packages(self):
        self.done(self.run_in("alice_home", "new", "user", "alice"))
        self.done(self.run_in("alice_home/alice", "new", "lua", "avoid"))
        shared = self.folder / "shared"
        shared.mkdir()
        self.done(self.run_in("alice_home", "pack", "alice", "--name", "avoiders", "--release", "2.0-beta", *META,
                              "--output", shared / "avoiders-2.0-beta.tar.gz"))
        environment = {"SWARMANOID_PACKAGES": f"/nowhere:{shared}"}
        self.done(self.run_in("bob_home", "install", "avoiders", environment=environment))
        run = self.run_in("bob_home", "run", "avoiders/experiments/avoid.xml", "--quiet", "--ticks", 20, "--single-process")
        self.done(run)
        again = self.run_in("bob_home", "install", "avoiders", environment=environment)
        self.assertEqual(again.process.returncode, 2)
        self.assertIn("avoiders 2.0-beta is installed already", again.stderr)
        self.done(self.run_in("bob_home", "install", "avoiders", "--replace", environment=environment))

    def test_a_damaged_package_is_refused_in_words(self):
        self.done(self.run_in("alice_home", "new", "user", "alice"))
        self.done(self.run_in("alice_home", "pack", "alice", "--release", "1", *META))
        package = self.folder / "alice_home/alice-1.tar.gz"
        damaged = bytearray(package.read_bytes())
        damaged[len(damaged) // 2] ^= 0x40
        package.write_bytes(damaged)
        run = self.run_in("bob_home", "install", package)
        self.assertEqual(run.process.returncode, 3, run.stderr)
        self.assertIn("cannot be installed", run.stderr)
        self.assertEqual(list((self.folder / "bob_home").iterdir()), [])
        self.assertIn("no package is in", self.done(self.run_in("bob_home", "list", "packages")))
