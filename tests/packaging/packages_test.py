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
PACKAGES = ("swarmanoid", "swarmanoid-dev", "swarmanoid-doc") + (("python3-swarmanoid",) if HAS_PYTHON else ())
ROLES = {"space_server", "engine_worker", "controller_host", "visualiser"}

for tool in ("dpkg-deb", "dpkg-shlibdeps", "file", "readelf", "pkg-config"):
    if shutil.which(tool) is None:
        print(f"there is no {tool}")
        sys.exit(77)


def output_of(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **options).stdout


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


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

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

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
        version = self.control("swarmanoid", "Version")
        soname = ".so." + ".".join(version.split(".")[:2])
        libraries = [path for path in (self.usr / "lib").iterdir() if path.name.startswith("lib") and not path.is_symlink()]
        self.assertGreater(len(libraries), 10)
        for library in libraries:
            said = re.search(r"SONAME.*\[(.*)\]", output_of("readelf", "-d", library)).group(1)
            self.assertEqual(said, library.name.split(".so")[0] + soname)
            # Only those who build against it need the name without version.
            self.assertIn(f"usr/lib/{library.name.split('.so')[0]}.so", self.files["swarmanoid-dev"])
            self.assertIn(f"{library.name.split('.so')[0]} {soname[4:]} swarmanoid",
                          (self.folder / "control" / "swarmanoid" / "shlibs").read_text())

    def test_nothing_remembers_where_it_was_built(self):
        for name in set().union(*self.files.values()):
            path = self.root / name
            if path.is_symlink() or not is_elf(path):
                continue
            dynamic = output_of("readelf", "-d", path)
            self.assertNotIn("RUNPATH", dynamic, name)
            self.assertNotIn("RPATH", dynamic, name)

    def test_dependencies_are_those_of_the_libraries(self):
        depends = self.control("swarmanoid", "Depends")
        for library in ("libfastrtps", "libode", "libbox2d", "liboctomap"):
            self.assertIn(library, depends)
        self.assertIn(f"swarmanoid (= {self.control('swarmanoid', 'Version')})", self.control("swarmanoid-dev", "Depends"))

    @unittest.skipUnless(HAS_PYTHON, "the module of Python was not built")
    def test_python_finds_the_module_and_its_types(self):
        folder = "usr/lib/python3/dist-packages/swarmanoid/"
        files = {name.removeprefix(folder) for name in self.files["python3-swarmanoid"] if name.startswith(folder)}
        self.assertEqual({name for name in files if not name.startswith("_module.cpython-")},
                         {path.name for path in (SOURCE / "python" / "swarmanoid").iterdir() if path.is_file()})
        self.assertLessEqual({"_module.pyi", "py.typed"}, files)
        self.assertEqual({name.split("/")[1] for name in self.files["python3-swarmanoid"]}, {"lib", "share"})
        depends = self.control("python3-swarmanoid", "Depends")
        self.assertIn(f"swarmanoid (= {self.control('swarmanoid', 'Version')})", depends)
        for other in ("python3 (<< 3.", "python3-numpy", "libc6"):
            self.assertIn(other, depends)
        for script in ("postinst", "prerm"):
            self.assertTrue(os.access(self.folder / "control" / "python3-swarmanoid" / script, os.X_OK))

    def test_there_is_a_manual_page_for_each_command(self):
        said = output_of(BUILD / "bin" / "swarmanoid", "--help")
        commands = re.findall(r"^  ([a-z]+)  +[A-Z]", said, re.MULTILINE)
        self.assertGreater(len(commands), 6)
        for name in ["swarmanoid", "swarmanoid_robot"] + [f"swarmanoid-{command}" for command in commands]:
            self.assertIn(f"usr/share/man/man1/{name}.1.gz", self.files["swarmanoid"])
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
        self.assertIn("usr/share/swarmanoid/experiment.xsd", self.files["swarmanoid"])
        self.assertIn("usr/share/doc/swarmanoid/docs/tutorial.md", self.files["swarmanoid-doc"])

    def test_a_newcomer_gets_to_a_controller_of_their_own(self):
        environment = {**os.environ, "PATH": f"{self.usr / 'bin'}:{os.environ['PATH']}", "SWARMANOID_PREFIX": str(self.usr),
                       "LD_LIBRARY_PATH": str(self.usr / "lib"), "PKG_CONFIG_PATH": str(self.usr / "lib" / "pkgconfig"),
                       "SWARMANOID_SHARED_FOLDER": f"/dev/shm/swarmanoid-test-{os.getpid()}"}
        done = subprocess.run([SOURCE / "tests" / "packaging" / "smoke.sh", SOURCE / "README.md"], env=environment, capture_output=True,
                              text=True, check=False)
        shutil.rmtree(environment["SWARMANOID_SHARED_FOLDER"], ignore_errors=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
