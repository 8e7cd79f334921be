"""The Common Interface and the robot program stand without the simulator: they compile where its folders are missing, and
load none of its libraries."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["SWARMANOID_BUILD"])
SOURCE = pathlib.Path(os.environ["SWARMANOID_SOURCE"])
FOLDERS = ("common/math", "common/configuration", "common/plugins", "common/logging", "common/control_interface", "real_robot",
           "user/behavior_toolkit", "user/controllers")
SIMULATOR = ("space", "bus", "physics_engine", "controller_host_role", "render", "space_server_role", "experiment")


def libraries_of(path):
    """Without the numbers of their versions."""
    output = subprocess.run(["ldd", path], capture_output=True, text=True, check=True).stdout
    return [re.sub(r"\.so\..*$", ".so", line.split()[0]) for line in output.splitlines()]


class WithoutSimulator(unittest.TestCase):
    def test_all_headers_and_a_controller_compile_where_the_simulator_is_missing(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary)
            for name in FOLDERS:
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                (folder / name).symlink_to(SOURCE / name)
            headers = [header.relative_to(SOURCE) for name in ("common/control_interface", "user/behavior_toolkit")
                       for header in sorted((SOURCE / name).rglob("*.h"))]
            headers.append(pathlib.Path("real_robot/driver.h"))
            everything = folder / "everything.cpp"
            everything.write_text("".join(f'#include "{header}"\n' for header in headers) +
                                  '#include "user/controllers/footbot_diffusion/footbot_diffusion.cpp"\n')
            command = [os.environ["CXX"], "-std=c++20", "-fsyntax-only", "-DEIGEN_DONT_VECTORIZE", f"-I{folder}",
                       f"-I{folder}/common/control_interface", f"-I{folder}/user/behavior_toolkit", "-isystem",
                       "/usr/include/eigen3", str(everything)]
            result = subprocess.run(command, capture_output=True, text=True, timeout=120)
            self.assertEqual(result.returncode, 0, result.stderr)

    def test_no_library_of_the_simulator_is_loaded(self):
        unwanted = {f"libswarmanoid_{name}.so" for name in SIMULATOR}
        libraries = BUILD / "lib"
        for path in (BUILD / "bin" / "swarmanoid_robot", libraries / "libswarmanoid_control_interface.so",
                     libraries / "libswarmanoid_real_robot.so", libraries / "swarmanoid" / "libros2_drivers.so",
                     libraries / "swarmanoid" / "libfootbot_diffusion.so", libraries / "swarmanoid" / "libprey_retrieval.so"):
            with self.subTest(path.name):
                self.assertEqual(unwanted & set(libraries_of(path)), set())

    def test_only_the_drivers_load_dds(self):
        for path in (BUILD / "bin" / "swarmanoid_robot", BUILD / "lib" / "libswarmanoid_real_robot.so"):
            self.assertEqual([name for name in libraries_of(path) if "fastrtps" in name], [])
