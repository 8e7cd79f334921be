"""Archives: a run in one file, which runs again anywhere and says whether each state is equal."""
import gzip
import hashlib
import io
import json
import os
import pathlib
import shutil
import tarfile

from harness import CONFIGS, DIFFUSION, GENEROUS_S, SWARMANOID, TEST_CONTROLLERS, LauncherTest
from world.case import controller, experiment, run_on_a_terminal

ONE = ["--single-process"]


class Archives(LauncherTest):
    def go(self, *words, code=0):
        run = self.run_it(*words)
        self.assertEqual(run.process.returncode, code, run.stdout + run.stderr)
        self.assert_nothing_left(run)
        return run

    def run_of(self, file, *words, code=0, output="run"):
        return self.go("run", "--quiet", file, "--output", output, *words, code=code)

    def archive(self, *words, output="a.tar.gz"):
        return self.go("archive", "run", "--output", output, *words)

    def reproduce(self, *words, file="a.tar.gz", code=0):
        return self.go("reproduce", "--quiet", file, *words, code=code)

    def assert_equal_states(self, run, count):
        last = run.stdout.splitlines()[-1]
        self.assertRegex(last, rf"^equal: {count} states, from tick \d+ to \d+, hash [0-9a-f]{{16}}$")

    def members(self, file="a.tar.gz"):
        """The files of an archive by their names, without its top folder."""
        with tarfile.open(self.folder / file) as tar:
            return {name.split("/", 1)[1]: tar.extractfile(name).read() for name in tar.getnames()}

    def pack(self, members, change_digests=True, rename=None, kind=None, top="diffusion_10/"):
        """Writes a changed archive as b.tar.gz. `rename`: an old and a new name in the tar file alone. `kind`: a name and its type."""
        index = json.loads(members["archive.json"])
        if change_digests:
            index["members"] = [{"name": name, "bytes": len(content), "sha256": hashlib.sha256(content).hexdigest()}
                                for name, content in sorted(members.items()) if name != "archive.json"]
            members = {**members, "archive.json": json.dumps(index).encode()}
        bytes_ = io.BytesIO()
        with tarfile.open(fileobj=bytes_, mode="w", format=tarfile.USTAR_FORMAT) as tar:
            for name, content in sorted(members.items(), key=lambda item: (item[0] != "archive.json", item[0])):
                header = tarfile.TarInfo(rename[1] if rename and rename[0] == name else top + name)
                header.size = len(content)
                if kind and kind[0] == name:
                    header.type, header.linkname, header.size = kind[1], "/etc/passwd", 0
                tar.addfile(header, io.BytesIO(content))
        (self.folder / "b.tar.gz").write_bytes(gzip.compress(bytes_.getvalue()))

    def refused(self, *says):
        run = self.reproduce(file="b.tar.gz", code=4)
        for text in says:
            self.assertIn(text, run.stderr)
        self.assertEqual(run.stdout, "")


class RoundTrip(Archives):
    def test_a_run_in_one_process_has_the_hash_of_each_tick_of_its_log(self):
        self.run_of(DIFFUSION, *ONE, "--ticks", 50, "--hash-log", "log.txt")
        made = self.archive()
        self.assertRegex(made.stdout, r"^archived: a.tar.gz, \d+ bytes, 51 hashes, SHA-256 [0-9a-f]{64}\n$")
        self.assertEqual(hashlib.sha256((self.folder / "a.tar.gz").read_bytes()).hexdigest(), made.stdout.split()[-1])
        members = self.members()
        self.assertEqual(members["hashes.txt"].decode(), (self.folder / "log.txt").read_text())
        self.assertIn("libfootbot_diffusion.so (build-id ", made.stderr)
        self.assert_equal_states(self.reproduce(), 51)
        self.assert_equal_states(self.reproduce("--controller-hosts", 2), 51)

    def test_equal_runs_give_equal_bytes(self):
        self.run_of(DIFFUSION, *ONE, "--ticks", 5)
        self.archive()
        self.archive(output="again.tar.gz")
        self.assertEqual((self.folder / "a.tar.gz").read_bytes(), (self.folder / "again.tar.gz").read_bytes())

    def test_a_cluster_has_those_of_its_journal(self):
        self.run_of(DIFFUSION, "--ticks", 50, "--hash-log", "log.txt")
        log = (self.folder / "log.txt").read_text()
        (self.folder / "log.txt").write_text("of another run\n")
        self.archive("--journal")
        self.assertEqual(self.members()["hashes.txt"].decode(), log)
        self.assert_equal_states(self.reproduce("--cluster"), 51)
        # Unpacked, it is the folder of a run.
        shutil.rmtree(self.folder / "run")
        with tarfile.open(self.folder / "a.tar.gz") as tar:
            tar.extractall(self.folder, filter="data")
        self.assertIn("equal: 51 states", self.go("replay", "diffusion_10", "--verify").stdout)

    def test_without_log_and_journal_it_has_the_checkpoints_and_the_end(self):
        self.run_of(DIFFUSION, *ONE, "--ticks", 250, "--checkpoint-every", 100)
        self.archive()
        self.assertEqual([line.split()[0] for line in self.members()["hashes.txt"].decode().splitlines()], ["100", "200", "250"])
        self.assert_equal_states(self.reproduce(), 3)

    def test_a_run_that_began_with_a_checkpoint(self):
        self.run_of(DIFFUSION, *ONE, "--ticks", 150, "--checkpoint-every", 100, output="first")
        self.run_of(self.folder / "first/experiment.xml", "--restore", "first/checkpoint-00000100")
        shutil.rmtree(self.folder / "first")
        self.archive()
        self.assert_equal_states(self.reproduce(), 51)

    def test_requests_of_users_are_repeated(self):
        (self.folder / "asked.csv").write_text("tick,request,entity,numbers,from\n20,move,fb_1,1 1 0,\n")
        self.run_of(DIFFUSION, *ONE, "--ticks", 30, "--events", "asked.csv", "--hash-log", "log.txt")
        self.archive()
        self.assert_equal_states(self.reproduce(), 31)

    def test_a_run_that_was_killed_is_compared_up_to_its_last_tick(self):
        run = self.start("run", DIFFUSION, "--ticks", 0, "--quiet", "--output", "run", "--no-visualisers")
        # A tick is in the journal half a second later at the latest.
        self.wait_until("a tick in the journal", lambda: self.run_it("archive", "run", "--output", "first.tar.gz").process.returncode == 0, run)
        self.kill_all(run)
        self.assertIn("note: the run was killed or still goes on", self.run_it("archive", "run", "--output", "a.tar.gz").stderr)
        self.assert_equal_states(self.run_it("reproduce", "--quiet", "a.tar.gz"), r"\d+")

    def test_failures_of_controllers_are_repeated_and_not_measured_again(self):
        file = experiment(self.folder / "faulty.xml", f"<maxclock>60</maxclock><controller_path>{TEST_CONTROLLERS}</controller_path>",
                          controller("faulty_controller", parameters="<fault>step_throws</fault><tick>30</tick>", library="faulty_controller",
                                     attributes='on_failure="stop_robot"'),
                          '<footbot id="robot_one" position="1,1,0" controller="c"/>', size="2,2,1")
        self.run_of(file)
        self.archive()
        self.assertIn("journal/0", self.members())
        self.assert_equal_states(self.reproduce(), 61)


class Files(Archives):
    def test_maps_are_in_it_with_their_paths_from_each_other(self):
        shutil.copytree(CONFIGS / "terrain", self.folder / "maps/terrain")
        (self.folder / "mine").mkdir()
        text = (CONFIGS / "rough_terrain.xml").read_text().replace("terrain/hills.png", "../maps/terrain/hills.png")
        (self.folder / "mine/hills.xml").write_text(text)
        self.run_of("mine/hills.xml", *ONE, "--ticks", 20)
        self.archive()
        shutil.rmtree(self.folder / "maps")
        self.assertIn("files/maps/terrain/hills.png", self.members())
        self.assert_equal_states(self.reproduce(), 1)

    def test_scripts_bring_what_they_load_also_by_an_absolute_path(self):
        scripts = self.folder / "code"
        scripts.mkdir()
        (scripts / "walk.lua").write_text('local speed = require "parts.speed"\nfunction step() robot.wheels.set_velocity(speed, speed) end\n')
        (scripts / "parts").mkdir()
        (scripts / "parts/speed.lua").write_text("return 5\n")
        (self.folder / "walk.argos").write_text(f"""<?xml version="1.0"?>
<argos-configuration>
  <framework><experiment length="2" ticks_per_second="10" random_seed="11"/></framework>
  <controllers><lua_controller id="l"><actuators><differential_steering implementation="default"/></actuators><sensors/>
    <params script="{scripts}/walk.lua"/></lua_controller></controllers>
  <arena size="4,4,1" center="0,0,0.5">
    <foot-bot id="fb"><body position="0,0,0" orientation="0,0,0"/><controller config="l"/></foot-bot>
  </arena>
  <physics_engines><dynamics2d id="dyn2d"/></physics_engines><media/>
</argos-configuration>""")
        self.run_of("walk.argos", *ONE)
        self.archive()
        self.assertTrue({"files/code/walk.lua", "files/code/parts/speed.lua"} <= set(self.members()), self.members().keys())
        shutil.rmtree(scripts)
        self.assert_equal_states(self.reproduce(), 1)

    def test_a_script_in_python_brings_its_modules(self):
        if not (pathlib.Path(os.environ["SWARMANOID_BUILD"]) / "lib/swarmanoid/libpython.so").exists():
            self.skipTest("the build has no controllers in Python")
        (self.folder / "parts").mkdir()
        (self.folder / "parts/speed.py").write_text("SPEED = 5\n")
        (self.folder / "walk.py").write_text("from parts.speed import SPEED\n\n\ndef step(robots):\n    robots.actuators['footbot_wheels'][:] = SPEED\n")
        experiment(self.folder / "walk.xml", "<maxclock>20</maxclock>", controller("python_controller", ["dummy_footbot_wheels"],
                                                                                  parameters="<script>walk.py</script>", library="python"),
                   '<footbot id="fb" position="1,1,0" controller="c"/>')
        self.run_of("walk.xml", *ONE)
        self.archive()
        self.assertTrue({"files/walk.py", "files/parts/speed.py"} <= set(self.members()), self.members().keys())
        shutil.rmtree(self.folder / "parts")
        self.assert_equal_states(self.reproduce(), 1)

    def test_a_file_that_changed_since_the_run_is_refused(self):
        shutil.copytree(CONFIGS / "terrain", self.folder / "terrain")
        shutil.copy(CONFIGS / "rough_terrain.xml", self.folder)
        self.run_of("rough_terrain.xml", *ONE, "--ticks", 5)
        shutil.copy(self.folder / "terrain/hills.png", self.folder / "terrain/hills.old")
        with open(self.folder / "terrain/hills.png", "ab") as file:
            file.write(b"\0")
        self.assertIn("the file 'terrain/hills.png' has changed since the run", self.go("archive", "run", code=2).stderr)

    def test_an_experiment_that_changed_since_the_run_is_refused(self):
        self.run_of(DIFFUSION, *ONE, "--ticks", 5)
        with open(self.folder / "run/experiment.xml", "a") as file:
            file.write("\n")
        self.assertIn("was changed after the run", self.go("archive", "run", code=2).stderr)

    def test_a_study_is_refused_with_the_cure(self):
        (self.folder / "run").mkdir()
        (self.folder / "run/study.sqlite").touch()
        self.assertIn("an archive has one run", self.go("archive", "run", code=2).stderr)
        self.assertIn("is no folder of a run", self.go("archive", "nothing", code=2).stderr)


class Differences(Archives):
    def setUp(self):
        super().setUp()
        self.run_of(DIFFUSION, *ONE, "--ticks", 30, "--hash-log", "log.txt")
        self.archive()

    def test_another_experiment_names_the_first_tick_and_says_that_builds_are_equal(self):
        members = self.members()
        members["experiment.xml"] = members["experiment.xml"].replace(b"<velocity>0.05</velocity>", b"<velocity>0.06</velocity>")
        self.pack(members)
        run = self.reproduce(file="b.tar.gz", code=5)
        self.assertIn("different from tick 1 on: ", run.stdout)
        self.assertIn("Probable reason: the code of the experiment is not deterministic", run.stderr)

    def test_another_build_is_the_probable_reason(self):
        members = self.members()
        lines = members["hashes.txt"].decode().splitlines()
        lines[17] = f"17 {0:016x}"
        members["hashes.txt"] = "".join(line + "\n" for line in lines).encode()
        index = json.loads(members["archive.json"])
        index["libraries"]["libfootbot_diffusion.so"] = "0" * 40
        index["libraries"]["Swarmanoid"] = "another"
        index["swarmanoid"] = "0.9.9"
        members["archive.json"] = json.dumps(index).encode()
        self.pack(members)
        run = self.reproduce(file="b.tar.gz", code=5)
        self.assertRegex(run.stdout, rf"(?m)^different from tick 17 on: its hash is {0:016x} in the archive, and [0-9a-f]{{16}} computed again; 17 states before")
        self.assertIn("another build of Swarmanoid: 0.9.9", run.stderr)
        self.assertIn("another build of the library 'libfootbot_diffusion.so'", run.stderr)

    def test_a_run_that_ends_earlier_is_different(self):
        members = self.members()
        members["hashes.txt"] += b"31 0123456789abcdef\n"
        self.pack(members)
        self.assertIn("31 of 32 states were computed again; the run ended at tick 30, and in the archive at 31",
                      self.reproduce(file="b.tar.gz", code=5).stdout)

    def check_missing_library(self, path, library):
        """`path`: of the libraries, in the experiment."""
        mine = self.folder / "mine"
        mine.mkdir()
        shutil.copy(next(pathlib.Path(TEST_CONTROLLERS).glob("*faulty_controller.so")), mine / "libmy_own.so")
        file = experiment(self.folder / "own.xml", f"<maxclock>10</maxclock><controller_path>{path}</controller_path>",
                          controller("faulty_controller", library=library), '<footbot id="fb" position="1,1,0" controller="c"/>', size="2,2,1")
        self.run_of(file, *ONE, output="own")
        self.go("archive", "own", "--output", "own.tar.gz")
        mine.rename(self.folder / "elsewhere")
        run = self.reproduce(file="own.tar.gz", code=3)
        self.assertRegex(run.stderr, r"the run used the library 'libmy_own.so' \(build-id [0-9a-f]+\).*--plugins")
        self.assert_equal_states(self.reproduce("--plugins", "elsewhere", file="own.tar.gz"), 1)

    def test_a_missing_library_is_named_with_the_option_that_finds_it(self):
        self.check_missing_library("mine", "my_own")

    def test_a_library_with_an_absolute_path_too(self):
        self.check_missing_library("", f"{self.folder}/mine/libmy_own.so")


class Hostile(Archives):
    def setUp(self):
        super().setUp()
        self.run_of(DIFFUSION, *ONE, "--ticks", 5)
        self.archive()

    def test_a_flipped_byte_anywhere_is_found(self):
        whole = bytearray((self.folder / "a.tar.gz").read_bytes())
        for at in (100, len(whole) // 2, len(whole) - 6):
            damaged = whole.copy()
            damaged[at] ^= 4
            (self.folder / "b.tar.gz").write_bytes(damaged)
            self.refused("the archive 'b.tar.gz' cannot be used: ")
        (self.folder / "b.tar.gz").write_bytes(whole[:-100])
        self.refused("cut short")

    def test_a_member_without_its_digest(self):
        members = self.members()
        members["experiment.xml"] = members["experiment.xml"].replace(b"0.05", b"0.06")
        self.pack(members, change_digests=False)
        self.refused("'experiment.xml' in it is damaged: its SHA-256")

    def test_an_archive_of_a_newer_version(self):
        members = self.members()
        members["archive.json"] = members["archive.json"].replace(b'"version": 1', b'"version": 2')
        self.pack(members)
        self.refused("it is of version 2 of archives", "install a newer Swarmanoid")

    def test_paths_that_leave_the_folder(self):
        for name, why in (("/tmp/swarmanoid_evil", "an absolute path"), ("files/../../evil", "leads to another folder"), ("files//x", "another folder"),
                          ("files/a\nb", "a control character")):
            self.pack({**self.members(), name: b"x"})
            self.refused(why)
        self.assertFalse(pathlib.Path("/tmp/swarmanoid_evil").exists())
        self.pack(self.members(), rename=("manifest.json", "../manifest.json"))
        self.refused("where its list has 'diffusion_10/manifest.json'")

    def test_links_folders_and_devices(self):
        for kind in (tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.DIRTYPE, tarfile.CHRTYPE, tarfile.FIFOTYPE):
            self.pack(self.members(), kind=("manifest.json", kind))
            self.refused("is no plain file")

    def test_program_code(self):
        library = next(pathlib.Path(TEST_CONTROLLERS).glob("*faulty_controller.so")).read_bytes()
        self.pack({**self.members(), "files/libfootbot_diffusion.so": library})
        self.refused("is program code, which no archive has")

    def test_what_its_list_lacks_and_what_it_lacks_of_its_list(self):
        members = self.members()
        self.pack({name: content for name, content in members.items() if name != "hashes.txt"})
        self.refused("its list lacks 'hashes.txt'")
        self.pack({name: content for name, content in members.items() if name != "manifest.json"}, change_digests=False)
        self.refused("it has its end where its list has 'diffusion_10/manifest.json'")

    def test_no_hash(self):
        self.pack({**self.members(), "hashes.txt": b""})
        self.refused("its hashes.txt is empty")

    def test_what_is_no_archive(self):
        (self.folder / "b.tar.gz").write_text("text")
        self.refused("it is no tar.gz file")
        (self.folder / "b.tar.gz").write_bytes(gzip.compress(b"text" * 1000))
        self.refused("a header that is not of POSIX tar")
        self.assertIn("there is no such file", self.reproduce(file="nothing.tar.gz", code=2).stderr)


class Progress(Archives):
    def test_long_work_shows_its_share_on_a_terminal_and_nothing_in_a_pipe(self):
        self.run_of(DIFFUSION, "--ticks", 3000)
        for words, work in ((["export", "run", "--csv", "{}.csv"], "exporting"), (["archive", "run", "--output", "{}.tar.gz"], "reading the journal"),
                            (["replay", "run", "--verify"], "computing again")):
            code, seen = run_on_a_terminal([SWARMANOID, *(word.format("terminal") for word in words)], self.folder)
            self.assertEqual(code, 0, seen)
            self.assertRegex(seen, rf"\r{work}: \d+ %")
            self.assertNotIn("%", self.go(*[word.format("pipe") for word in words]).stderr)

    def test_a_film_of_a_sample(self):
        code, seen = run_on_a_terminal([SWARMANOID, "demo", "diffusion_10", "--film", "--output", "film"], self.folder)
        self.assertEqual(code, 0, seen)
        self.assertRegex(seen, r"running: tick \d+ of \d+ \(\d+ %\)")
        piped = self.run_it("demo", "diffusion_10", "--film", "--output", "piped", timeout=10 * GENEROUS_S)
        self.assertEqual(piped.process.returncode, 0, piped.stderr)
        self.assertNotIn("%", piped.stderr)
        self.assertTrue((self.folder / "piped/film.mp4").exists())
