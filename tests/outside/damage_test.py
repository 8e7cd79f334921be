"""Damaged files, devices and pipes as files: refused by `check` as by `run`, in one process and as a cluster, with the same
words; checkpoints that are not what was written; folders of others."""
import os
import pathlib
import random
import re
import shutil
import struct

from outside import BUILT, WAYS, OutsideTest

FLAT_PNG = bytes.fromhex("89504e470d0a1a0a0000000d494844520000000200000002080000000057dd52f8")


class Damage(OutsideTest):
    def refusals(self, file, code=3):
        """What `check` and both ways of `run` say, which must be the same; the places of clusters are absolute."""
        said = {"check": self.command("swarmanoid", "check", file)}
        for way, options in WAYS.items():
            said[way] = self.run_experiment(file, *options)
        for way, done in said.items():
            self.assertEqual(done.returncode, code, f"{way}: {done.stdout}{done.stderr}")
        words = [re.search(r"^\S+\.xml:\d+:\d+: .*$", done.stderr, re.MULTILINE) for done in said.values()]
        self.assertNotIn(None, words, {way: done.stderr for way, done in said.items()})
        self.assertEqual(len({word[0] for word in words}), 1, [word[0] for word in words])
        return words[0][0]

    def line_of(self, file, text):
        return 1 + next(k for k, line in enumerate(file.read_text().split("\n")) if text in line)

    def test_terrain_is_refused_by_check_as_by_run(self):
        (self.folder / "deep.bt").write_bytes(
            b"# Octomap OcTree binary file\nid OcTree\nsize 1000000\nres 0.1\ndata\n" + b"\xff" * 200_000)
        (self.folder / "cut.png").write_bytes(FLAT_PNG)
        os.mkfifo(self.folder / "pipe.bt")
        for source, expected in (('<octomap file="deep.bt"/>', "is damaged"),
                                 ('<heightmap file="cut.png" size="2,2" height="1"/>', "it is cut short"),
                                 ('<octomap file="pipe.bt"/>', "pipe.bt'"),
                                 ('<octomap file="absent.bt"/>', "absent.bt'")):
            with self.subTest(source):
                file = self.experiment(arena=f'<terrain id="t"><position>0,0,0</position>'
                                             f'<orientation>0,0,0</orientation>{source}</terrain>')
                words = self.refusals(file)
                self.assertIn(expected, words)
                self.assertTrue(words.startswith(f"{file}:{self.line_of(file, source)}:"), words)

    def test_a_library_that_is_cut_short_is_refused_and_kills_no_process(self):
        whole = (BUILT / "controllers" / "liboutside_still.so").read_bytes()
        for size in (len(whole) // 2, len(whole) - 100, 60, 3, 0):
            with self.subTest(size):
                (self.folder / "cut.so").write_bytes(whole[:size])
                file = self.experiment()
                file.write_text(file.read_text().replace('library="outside_still"', f'library="{self.folder}/cut.so"'))
                words = self.refusals(file)
                self.assertIn("cut.so cannot be loaded: it is ", words)
                listed = self.command("swarmanoid", "list", "plugins", self.folder / "cut.so")
                self.assertEqual(listed.returncode, 2, listed.stderr)

    def test_what_a_controller_refuses_names_the_users_line_in_a_cluster_too(self):
        file = self.experiment(controller="outside_needy", parameters="\n        <sped>3</sped>")
        for options in ([], ["--set", "controllers.c.parameters.speed=fast"]):
            said = {"check": self.command("swarmanoid", "check", file, *options)}
            for way, choice in WAYS.items():
                said[way] = self.run_experiment(file, *choice, *options)
            line = self.line_of(file, "<sped>")
            place = "--set controllers.c.parameters.speed: " if options else f"{file}:{line}:9: "
            for way, done in said.items():
                with self.subTest(f"{way} {options}"):
                    self.assertEqual(done.returncode, said["check"].returncode, done.stderr)
                    self.assertEqual(done.returncode, 3)
                    self.assertEqual(done.stderr.splitlines()[0], said["check"].stderr.splitlines()[0])
                    self.assertTrue(done.stderr.startswith(place), done.stderr)

    def test_check_survives_what_controllers_do_in_init(self):
        for how, words in (("exit", r"called exit\(0\)"), ("crash", "crashed by signal 11")):
            with self.subTest(how):
                file = self.experiment(controller="outside_needy", parameters=f"<speed>{how}</speed>")
                done = self.command("swarmanoid", "check", file)
                self.assertEqual(done.returncode, 4, done.stdout)
                self.assertRegex(done.stderr, f"^robot 'robot_one', controller 'c': Init at tick 0 {words}")

    def test_pipes_and_devices_are_no_files(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        good = self.experiment()
        for way, options in WAYS.items():
            for file in (pipe, "/dev/zero"):
                with self.subTest(f"{way} {file}"):
                    said = self.run_experiment(file, *options)
                    self.assertEqual(said.returncode, 3, said.stderr)
                    self.assertIn("not a file", said.stderr)
                    for option in ("--restore", "--events"):
                        said = self.run_experiment(good, option, file, *options)
                        self.assertEqual(said.returncode, 2, said.stderr)
                        self.assertRegex(said.stderr, "it is a (pipe|device), not a file")
        hosts = self.run_experiment(good, "--hosts", pipe)
        self.assertEqual(hosts.returncode, 2, hosts.stderr)
        self.assertIn("it is a pipe, not a file", hosts.stderr)

    def checkpoint(self, file):
        self.hash_of(self.run_experiment(file, "--single-process", "--checkpoint-every", 100, "--output", "first"))
        return self.folder / "first" / "checkpoint-00000100"

    def test_no_damaged_checkpoint_is_accepted(self):
        file = self.experiment(controller="outside_needy", parameters="<speed>1</speed>", ticks=200)
        good = self.checkpoint(file).read_bytes()
        chance = random.Random(9)
        damaged = [good[:n] for n in (0, 1, 7, 8, 24, len(good) // 2, len(good) - 1)] + [good + b"x"]
        for start, value in ((24, 2**61), (24, 2**64 - 1), (8, 2**63)):
            damaged.append(good[:start] + struct.pack("<Q", value) + good[start + 8:])
        for _ in range(8):  # each bit: tests/unit/space/checkpoint_test.cpp
            flipped = bytearray(good)
            flipped[chance.randrange(len(good))] ^= 1 << chance.randrange(8)
            damaged.append(bytes(flipped))
        bad = self.folder / "bad"
        for number, content in enumerate(damaged):
            bad.write_bytes(content)
            for way, options in WAYS.items():
                if way == "cluster" and number % 4 != 0:  # both ways read the file before anything starts
                    continue
                done = self.run_experiment(file, "--restore", bad, *options)
                self.assertEqual(done.returncode, 2, f"{number} {way}: {done.stdout}{done.stderr}")
                self.assertIn(f"--restore: checkpoint '{bad}': it", done.stderr.replace("its format", "it"))

    def test_checkpoints_belong_to_the_builds_of_their_libraries(self):
        library = self.folder / "liboutside_needy.so"
        shutil.copy(BUILT / "controllers" / "liboutside_needy.so", library)
        file = self.experiment(controller="outside_needy", parameters="<speed>1</speed>", ticks=200)
        file.write_text(file.read_text().replace('library="outside_needy"', f'library="{library}"'))
        checkpoint = self.checkpoint(file)
        whole = self.hash_of(self.run_experiment(file, "--single-process"))
        for way, options in WAYS.items():
            self.assertEqual(self.hash_of(self.run_experiment(file, "--restore", checkpoint, *options)), whole, way)
        content = library.read_bytes()
        note = content.index(b"\x14\0\0\0\x03\0\0\0GNU\0") + 12
        library.unlink()
        library.write_bytes(content[:note] + bytes(20) + content[note + 20:])
        for way, options in WAYS.items():
            done = self.run_experiment(file, "--restore", checkpoint, *options)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("taken with another build of the library 'liboutside_needy.so'; go on with that one", done.stderr)
            self.assertIn("or let --any-build take it", done.stderr)
            done = self.run_experiment(file, "--restore", checkpoint, "--any-build", *options)
            self.assertEqual(self.hash_of(done), whole, "nothing but the note differs")
            self.assertIn("warning: the checkpoint was taken with another build of the library 'liboutside_needy.so'", done.stderr)
        refused = self.run_experiment(file, "--any-build")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("name it with --restore", refused.stderr)

    def test_a_shared_folder_keeps_what_is_not_of_a_run(self):
        thesis = self.shared / "thesis" / "chapters"
        thesis.mkdir(parents=True)
        (thesis / "one.tex").write_text("text")
        file = self.experiment()
        self.hash_of(self.run_experiment(file))
        self.assertEqual((thesis / "one.tex").read_text(), "text")
        self.assertEqual(os.listdir(self.shared), ["thesis"])
        link = pathlib.Path(str(self.shared) + ".link")
        link.symlink_to(self.shared)
        self.addCleanup(link.unlink)
        refused = self.run_experiment(file, environment={"SWARMANOID_SHARED_FOLDER": str(link)})
        self.assertEqual(refused.returncode, 4, refused.stderr)
        self.assertIn("is a link or a file, not a folder", refused.stderr)
        self.assertEqual(os.listdir(self.shared), ["thesis"])
