"""role_libraries.py PROGRAM...: the program of a role loads the libraries of its own role, and of no other. The command, which is the
first of the programs, starts without DDS: it loads the library launcher_bus when it needs that, and other sub-commands than `run` from commands.
No program starts with ODE or Box2D.

What a process must know of the others' engines, devices and renderers to read an experiment is in common/plugin_descriptions.
"""
import os
import re
import subprocess
import sys

from tracked import report

# Libraries of ours (libswarmanoid_<name>.so) that every role may stand on, and those of one role.
SHARED = {"plugin_descriptions", "bus", "common", "control_interface", "experiment", "reproducible_math", "run", "space", "version"}
OF_ROLE = {
    "space_server": {"space_server_node", "space_server_role"},
    "engine_worker": {"engines", "physics_engine"},
    "controller_host": {"controller_host_role"},
    "visualiser": {"render"},
}
# The library of engines of rigid bodies is loaded when one is made, and so are renderers that need graphics or films. Assimp is loaded for
# mesh files.
SOLVERS = re.compile(r"lib(ode|box2d|swarmanoid_rigid_bodies)")
LATE = re.compile(r"lib(fastrtps|fastdds|fastcdr|crypto|ssl|sqlite3|nlopt|swarmanoid_(bus|launcher_bus|space_server_node|commands|studies))$")
GRAPHICS = re.compile(r"lib(GL|EGL|OpenGL|epoxy|glfw|Ogre|imgui|SDL|X11|avcodec|avformat|avutil|swscale)|libassimp")


def loaded(program):
    """The libraries that the loader finds for the program, with all that those need, without versions."""
    listing = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    for line in listing.splitlines():
        if "not found" in line:
            raise RuntimeError(f"{program}: {line.strip()}")
    return {os.path.basename(line.split()[0]).split(".so")[0] for line in listing.splitlines() if ".so" in line}


def mistakes_of_command(program):
    for name in sorted(name for name in loaded(program) if LATE.match(name) or SOLVERS.match(name)):
        yield f"{os.path.basename(program)} loads {name} at its start"


def mistakes_of(program):
    role = os.path.basename(program)
    libraries = loaded(program)
    ours = {name.removeprefix("libswarmanoid_") for name in libraries if name.startswith("libswarmanoid_")}
    for name in sorted(ours - SHARED - OF_ROLE[role]):
        yield f"{role} loads libswarmanoid_{name}.so, which is not of its role"
    for name in sorted(OF_ROLE[role] - ours):
        yield f"{role} does not load libswarmanoid_{name}.so, its role"
    for name in sorted(name for name in libraries if GRAPHICS.match(name) or SOLVERS.match(name)):
        yield f"{role} loads {name} at its start"


def main():
    command, *programs = sys.argv[1:]
    if os.path.basename(command) != "swarmanoid" or {os.path.basename(program) for program in programs} != set(OF_ROLE):
        report([f"give the programs swarmanoid, {', '.join(OF_ROLE)}"])
    report([*mistakes_of_command(command), *(mistake for program in programs for mistake in mistakes_of(program))])


main()
