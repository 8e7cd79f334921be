"""The Debian packages of this build: what is in which, and that they run where they are unpacked."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
SOURCE = pathlib.Path(os.environ["SWARMANOID_SOURCE"])
HAS_PYTHON = os.environ["PYTHON_MODULE"] == "1"
PACKAGES = ("swarmanoid-core", "swarmanoid", "swarmanoid-dev", "swarmanoid-doc") + (("python3-swarmanoid",) if HAS_PYTHON else ())
ROLES = {"space_server", "engine_worker", "controller_host", "visualiser"}
GRAPHICS = re.compile(r"lib(GL|EGL|epoxy|glfw|Ogre|cairo|pango|gtk|Qt|X11|xcb|wayland|av(codec|format|util)|swscale)")

for tool in ("dpkg", "dpkg-deb", "dpkg-architecture", "dpkg-shlibdeps", "file", "ldd", "readelf", "pkg-config"):
    if shutil.which(tool) is None:
        print(f"there is no {tool}")
        sys.exit(77)


def output_of(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **options).stdout


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


LIBRARIES = "usr/lib/" + output_of("dpkg-architecture", "-qDEB_HOST_MULTIARCH").strip()


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        # Quick instead of small.
        made = subprocess.run([os.environ["CPACK"], "-G", "DEB", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip"],
                              cwd=BUILD, capture_output=True, text=True, check=False)
        if made.returncode != 0:
            raise RuntimeError(made.stdout + made.stderr)
        cls.files = {}
        for name in PACKAGES:
            package = next(cls.folder.glob(f"{name}_*.deb"))
            root = cls.folder / "each" / name
            for folder in (root, cls.folder / "control"):
                folder.mkdir(parents=True, exist_ok=True)
            output_of("dpkg-deb", "-x", package, root)
            output_of("dpkg-deb", "-x", package, cls.folder / "root")
            output_of("dpkg-deb", "-e", package, cls.folder / "control" / name)
            cls.files[name] = {str(path.relative_to(root)) for path in root.rglob("*") if not path.is_dir() or path.is_symlink()}
        cls.root = cls.folder / "root"
        cls.usr = cls.root / "usr"
        cls.environment = {**os.environ, "SWARMANOID_SHARED_FOLDER": f"/dev/shm/swarmanoid-test-{os.getpid()}"}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.environment["SWARMANOID_SHARED_FOLDER"], ignore_errors=True)
        cls.scratch.cleanup()

    def environment_of(self, root):
        """Variables for programs that are unpacked below a folder."""
        return {**self.environment, "PATH": f"{root / 'usr' / 'bin'}:{os.environ['PATH']}", "LD_LIBRARY_PATH": str(root / LIBRARIES)}

    def control(self, package, field):
        control = (self.folder / "control" / package / "control").read_text()
        return re.search(rf"^{field}: (.*)$", control, re.MULTILINE).group(1)

    def test_no_file_is_in_two_packages(self):
        for package in PACKAGES:
            for other in PACKAGES:
                if package < other:
                    self.assertEqual(self.files[package] & self.files[other], set())

    def test_only_what_users_call_is_on_their_path(self):
        self.assertEqual({path.name for path in (self.usr / "bin").iterdir()}, {"swarmanoid", "swarmanoid_robot"})
        self.assertEqual({path.name for path in (self.usr / "libexec" / "swarmanoid").iterdir()}, ROLES)

    def test_names_of_libraries_carry_the_minor_version(self):
        version = self.control("swarmanoid-core", "Version")
        soname = ".so." + ".".join(version.split(".")[:2])
        libraries = [path for path in (self.root / LIBRARIES).iterdir() if ".so" in path.name and not path.is_symlink()]
        self.assertGreater(len(libraries), 10)
        for library in libraries:
            name = library.name.split(".so")[0]
            said = re.search(r"SONAME.*\[(.*)\]", output_of("readelf", "-d", library)).group(1)
            self.assertEqual(said, name + soname)
            is_core = f"{LIBRARIES}/{library.name}" in self.files["swarmanoid-core"]
            # Only users who build against a library need the name without version.
            self.assertEqual(f"{LIBRARIES}/{name}.so" in self.files["swarmanoid-dev"], is_core)
            package = "swarmanoid-core" if is_core else "swarmanoid"
            self.assertIn(f"{name} {soname[4:]} {package} (", (self.folder / "control" / package / "shlibs").read_text())

    def test_everything_of_one_architecture_is_in_its_folder(self):
        self.assertEqual({path.name for path in (self.usr / "lib").iterdir()},
                         {LIBRARIES.split("/")[-1]} | ({"python3"} if HAS_PYTHON else set()))
        for name in ("cmake/Swarmanoid/SwarmanoidConfig.cmake", "cmake/ARGoS/ARGoSConfig.cmake", "pkgconfig/swarmanoid.pc"):
            self.assertIn(f"{LIBRARIES}/{name}", self.files["swarmanoid-dev"])
        self.assertIn(f"{LIBRARIES}/swarmanoid/libfootbot_diffusion.so", self.files["swarmanoid-core"])

    def test_the_core_needs_no_graphics(self):
        root = self.folder / "each" / "swarmanoid-core"
        for name in self.files["swarmanoid-core"]:
            if not (root / name).is_symlink() and is_elf(root / name):
                self.assertNotRegex(output_of("ldd", root / name, env=self.environment_of(root)), GRAPHICS, name)
        self.assertNotRegex(self.control("swarmanoid-core", "Depends"), GRAPHICS)
        self.assertRegex(self.control("swarmanoid", "Depends"), GRAPHICS)

    def test_the_core_runs_alone(self):
        root = self.folder / "each" / "swarmanoid-core"
        environment = self.environment_of(root)
        configs = root / "usr" / "share" / "swarmanoid" / "configs"
        run = ("swarmanoid", "run", configs / "sample_footbot.xml", "--controller-hosts", "1", "--quiet", "--output")
        ends = {re.search("hash [0-9a-f]{16}", output_of(*run, self.folder / name, *options, env=environment)).group()
                for name, options in (("cluster", ()), ("one", ("--single-process",)))}
        self.assertEqual(len(ends), 1)
        for options in ((), ("--single-process",)):
            done = subprocess.run(["swarmanoid", "run", configs / "drawn_swarm.xml", "--output", self.folder / f"drawn{len(options)}", *options],
                                  env=environment, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertRegex(done.stderr, r"drawn_swarm\.xml:\d+:\d+: image_render is not installed, there is no .*; install the package "
                                          "swarmanoid, .*--no-visualisers")
        check = ("swarmanoid", "check", configs / "drawn_swarm.xml")
        checked = subprocess.run(check, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual((checked.returncode, checked.stderr), (3, done.stderr))
        output_of(*check, "--no-visualisers", env=environment)
        for name in ("libswarmanoid_web_render.so", "web/index.html", "web/meshes.json.gz"):
            self.assertIn(f"{LIBRARIES}/swarmanoid/{name}", self.files["swarmanoid-core"])
        shown = subprocess.run([*run, self.folder / "page", "--show", "web", "--single-process"], env=environment, capture_output=True,
                               text=True, check=True)
        self.assertRegex(shown.stdout + shown.stderr, r"web_render: http://127\.0\.0\.1:\d+/")

    def test_packages_of_0_1_are_upgraded(self):
        """Until 0.1, the package swarmanoid had the files of the core, in /usr/lib."""
        old, root = self.folder / "old", self.folder / "upgraded"
        shutil.copytree(self.folder / "each" / "swarmanoid-core", old, symlinks=True)
        shutil.copytree(self.folder / "each" / "swarmanoid", old, symlinks=True, dirs_exist_ok=True)
        for path in (old / LIBRARIES).iterdir():
            path.rename(old / "usr" / "lib" / path.name.replace(".so.1.0", ".so.0.1"))
        (old / LIBRARIES).rmdir()
        (old / "DEBIAN").mkdir()
        (old / "DEBIAN" / "control").write_text("Package: swarmanoid\nVersion: 0.1.0\nArchitecture: all\nMaintainer: tester <a@b.c>\n"
                                                "Description: as it was\n")
        output_of("dpkg-deb", "-Znone", "--build", old, self.folder / "old.deb")
        (root / "var" / "lib" / "dpkg" / "info").mkdir(parents=True)
        (root / "var" / "lib" / "dpkg" / "updates").mkdir()
        for name in ("status", "available"):
            (root / "var" / "lib" / "dpkg" / name).touch()
        dpkg = ("dpkg", f"--root={root}", "--log=/dev/null", "--force-not-root", "--force-depends", "--auto-deconfigure")
        output_of(*dpkg, "--install", self.folder / "old.deb")
        self.assertTrue((root / "usr" / "lib" / "libswarmanoid_common.so.0.1.0").exists())
        # Unpacking replaces and removes files. Configuring would run ldconfig of this machine.
        output_of(*dpkg, "--unpack", *(next(self.folder.glob(f"{name}_*.deb")) for name in PACKAGES))
        here = {str(path.relative_to(root)) for path in root.rglob("*") if not path.is_dir() or path.is_symlink()}
        self.assertEqual({name for name in here if not name.startswith("var/")}, set().union(*self.files.values()))
        self.assertEqual({path.name for path in (root / "usr" / "lib").iterdir()}, {path.name for path in (self.usr / "lib").iterdir()})

    def test_nothing_remembers_where_it_was_built(self):
        for name in set().union(*self.files.values()):
            path = self.root / name
            if path.is_symlink() or not is_elf(path):
                continue
            dynamic = output_of("readelf", "-d", path)
            self.assertNotIn("RUNPATH", dynamic, name)
            self.assertNotIn("RPATH", dynamic, name)

    def test_dependencies_are_those_of_the_libraries(self):
        depends = self.control("swarmanoid-core", "Depends")
        for library in ("libfast", "libode", "libbox2d", "liboctomap"):
            self.assertIn(library, depends)
        for package in PACKAGES:
            if package not in ("swarmanoid-core", "swarmanoid-doc"):
                self.assertIn(f"swarmanoid-core (= {self.control('swarmanoid-core', 'Version')})", self.control(package, "Depends"))

    @unittest.skipUnless(HAS_PYTHON, "the module of Python was not built")
    def test_python_finds_the_module_and_its_types(self):
        folder = "usr/lib/python3/dist-packages/swarmanoid/"
        files = {name.removeprefix(folder) for name in self.files["python3-swarmanoid"] if name.startswith(folder)}
        self.assertEqual({name for name in files if not name.startswith("_module.cpython-")},
                         {path.name for path in (SOURCE / "python" / "swarmanoid").iterdir() if path.is_file()})
        self.assertLessEqual({"_module.pyi", "py.typed"}, files)
        self.assertEqual({name.split("/")[1] for name in self.files["python3-swarmanoid"]}, {"lib", "share"})
        depends = self.control("python3-swarmanoid", "Depends")
        for other in ("python3 (<< 3.", "python3-numpy", "libc6"):
            self.assertIn(other, depends)
        for script in ("postinst", "prerm"):
            self.assertTrue(os.access(self.folder / "control" / "python3-swarmanoid" / script, os.X_OK))

    def test_there_is_a_manual_page_for_each_command(self):
        said = output_of(BUILD / "bin" / "swarmanoid", "--help")
        commands = re.findall(r"^  ([a-z]+)  +[A-Z]", said, re.MULTILINE)
        self.assertGreater(len(commands), 6)
        for name in ["swarmanoid", "swarmanoid_robot"] + [f"swarmanoid-{command}" for command in commands]:
            self.assertIn(f"usr/share/man/man1/{name}.1.gz", self.files["swarmanoid-core"])
        if shutil.which("groff"):
            for page in (self.usr / "share" / "man" / "man1").iterdir():
                text = output_of("gzip", "-dc", page)
                warnings = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z"], input=text, capture_output=True, text=True,
                                          check=True).stderr
                self.assertEqual(warnings, "", page.name)

    def test_debian_finds_what_it_wants(self):
        for package in PACKAGES:
            for name in ("copyright", "changelog.gz"):
                self.assertIn(f"usr/share/doc/{package}/{name}", self.files[package])
        self.assertIn("usr/share/swarmanoid/experiment.xsd", self.files["swarmanoid-core"])
        self.assertIn("usr/share/doc/swarmanoid/docs/tutorial.md", self.files["swarmanoid-doc"])

    def test_a_newcomer_gets_to_a_controller_of_their_own(self):
        environment = {**self.environment_of(self.root), "SWARMANOID_PREFIX": str(self.usr),
                       "PKG_CONFIG_PATH": str(self.root / LIBRARIES / "pkgconfig")}
        done = subprocess.run([SOURCE / "tests/packaging/smoke.sh", SOURCE / "README.md", SOURCE / "tests/python/notebooks_test.py"],
                              env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
