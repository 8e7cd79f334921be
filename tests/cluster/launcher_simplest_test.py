"""The experiments of configs/ with no robot and with one, in one process and as a cluster."""
import re

from harness import CONFIGS, DIFFUSION, LauncherTest

TICKS = 12
# Each kind of engine, and entities of each source.
IN_CLUSTERS = ("prey_supply", "three_engines", "urdf_rover")
QUANTITY = re.compile(r"(<distribute\b(?:(?!</distribute>).)*?(?:<quantity>|quantity=\"))\d+", re.DOTALL)


class Simplest(LauncherTest):
    def files(self, quantity):
        """The experiments that distribute entities, with so many in each <distribute>."""
        for path in sorted(CONFIGS.glob("*.xml")):
            text, count = QUANTITY.subn(rf"\g<1>{quantity}", path.read_text())
            if count == 0:
                continue
            # Names of files in it are relative to its folder.
            file = self.folder / "configs" / path.name
            file.parent.mkdir(exist_ok=True)
            for other in CONFIGS.iterdir():
                if other.is_dir() and not (file.parent / other.name).exists():
                    (file.parent / other.name).symlink_to(other)
            file.write_text(text)
            yield file

    def compare(self, quantity, *options):
        count = 0
        for file in self.files(quantity):
            with self.subTest(file=file.name, quantity=quantity):
                hashes = []
                for way in (["--single-process"], [])[:2 if file.stem in IN_CLUSTERS else 1]:
                    folder = self.folder / f"{file.stem}{len(way)}"
                    run = self.run_it("run", file, "--ticks", TICKS, "--quiet", "--output", folder, *options, *way)
                    self.assertEqual(run.process.returncode, 0, run.stderr)
                    hashes.append(self.assert_finished(run))
                self.assertEqual(len(set(hashes)), 1, hashes)
            count += 1
        self.assertGreater(count, 20)

    def test_without_a_robot(self):
        self.compare(0, "--no-visualisers")

    def test_with_one_robot(self):
        self.compare(1, "--no-visualisers")

    def test_a_run_in_one_process_loads_no_dds_and_no_solver(self):
        """DDS takes half of the start. The command that starts a cluster does without it, too, and without the libraries of studies."""
        needed = {"--single-process": {"libswarmanoid_space"}, "--controller-hosts=1": {"libswarmanoid_run"}}
        unneeded = re.compile(r"lib(fastrtps|fastdds|fastcdr|crypto|ssl|sqlite3|nlopt|ode|box2d.*|"
                              r"swarmanoid_(bus|launcher_bus|space_server_node|commands|studies|rigid_bodies))$")
        for way, libraries in needed.items():
            with self.subTest(way=way):
                run = self.run_it("run", DIFFUSION, "--ticks", 2, "--quiet", "--no-visualisers", "--output", self.folder / way[2:8], way,
                                  environment={"LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(self.folder / "loader")})
                self.assertEqual(run.process.returncode, 0, run.stderr)
                log = (self.folder / f"loader.{run.process.pid}").read_text()
                loaded = {name.split(".so")[0] for name in re.findall(r"calling init: \S*/(lib\S+)", log)}
                self.assertLessEqual(libraries, loaded)
                self.assertEqual([name for name in sorted(loaded) if unneeded.match(name)], [])

    def test_what_draws_beside_one_robot(self):
        """A visualiser of a cluster hears of the run by the bus."""
        for quantity in (0, 1):
            for file in self.files(quantity):
                if file.name != "diffusion_10.xml":
                    continue
                for renderer, output in (("image", "*.png"), ("figure", "*.svg")):
                    with self.subTest(file=file.name, quantity=quantity, renderer=renderer):
                        folder = self.folder / f"{file.stem}_{quantity}_{renderer}"
                        run = self.run_it("run", file, "--ticks", 2, "--quiet", "--no-visualisers", "--show", renderer, "--output", folder)
                        self.assertEqual(run.process.returncode, 0, run.stderr)
                        self.assert_finished(run, 2)
                        self.assertTrue(list(folder.rglob(output)), list(folder.rglob("*")))
