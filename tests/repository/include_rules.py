"""Which folders may include which (docs/architecture.md): folders include downwards only and never in a circle, roles
never include each other, and only common/bus/dds includes Fast DDS."""
import collections
import graphlib
import os
import re

from tracked import report, tracked

# From the bottom to the top; a folder may include itself and those in the lines before its own.
COMMON = [
    ["common/version"],
    ["common/math"],
    ["common/threads"],
    ["common/configuration"],
    ["common/plugins"],
    ["common/errors", "common/memory"],
    ["common/logging", "common/serialisation", "common/activity"],
    ["common/limits"],
    ["common/program"],
    ["common/control_interface"],
    ["common/mesh"],
    ["common/experiment"],
    ["common/space/terrain"],
    ["common/experiment/placement"],
    ["common/plugin_descriptions"],
    ["common/run/access"],
    ["common/run"],
    ["idl"],  # headers that the build makes
    ["common/messages"],
    ["common/space"],
    ["common/checkpoint"],
    ["common/journal"],
]
BUS = ["common/bus", "common/bus/security", "common/bus/topics", "common/bus/membership"]
ROLES = ["space_server", "engine_worker", "controller_host", "visualiser"]
# The Common Interface and what it stands on: all that builds without the simulator.
INTERFACE = ["common/math", "common/configuration", "common/plugins", "common/control_interface"]
DDS_HEADER = re.compile(r"^(fastdds|fastrtps|fastcdr)/")
DDS_FOLDER = "common/bus/dds"
# Libraries that only the named folder includes, so that users need not have them.
HIDDEN = {"spdlog": "common/logging"}


def allowed():
    """Folder to the folders that it may include, itself too."""
    rules = {}
    below = []
    for level in COMMON:
        for folder in level:
            rules[folder] = below + [folder]
        below = below + level
    for k, room in enumerate(BUS):
        rules[room] = below + BUS[: k + 1] + [DDS_FOLDER]
    # One folder knows which release of Fast DDS there is; the bus and the ROS 2 drivers see Fast DDS by it.
    rules[DDS_FOLDER] = [DDS_FOLDER]
    for role in ROLES:
        rules[role] = below + [role]
        # The process around a role joins the bus.
        rules[role + "/cluster"] = rules[role] + BUS + [role + "/cluster"]
        rules[role + "/main.cpp"] = rules[role + "/cluster"]
    # Plug-ins that run the scripts of users' controllers.
    rules["controller_host/scripts/declaration"] = INTERFACE + ["controller_host/scripts/declaration"]
    for language in ("controller_host/scripts/lua", "controller_host/scripts/python"):
        rules[language] = rules["controller_host/scripts/declaration"] + ["common/serialisation", language]
    # The API of ARGoS3 over ours; its files are read by the launcher.
    rules["argos3"] = rules["space_server"] + ["controller_host/scripts/lua", "argos3", "argos3/converter"]
    rules["argos3/converter"] = below[: below.index("common/experiment") + 1] + ["argos3/converter"]
    rules["argos3/program"] = rules["argos3"] + ["simulation", "launcher", "argos3/program"]
    # The simulator of one process registers all roles.
    rules["simulation"] = below + ROLES + ["simulation"]
    # The launcher starts without DDS. It loads the library of launcher/bus, which takes part in runs.
    rules["launcher"] = below + ROLES + ["simulation", "argos3/converter", "launcher"]
    rules["launcher/bus"] = rules["launcher"] + BUS + ["space_server/cluster", "launcher/bus"]
    # The program has the sub-commands of studies too.
    rules["launcher/main.cpp"] = rules["launcher"] + ["studies"]
    # The module wraps the runner for one process, as a program of a user does, and looks on at runs as a visualiser does.
    rules["python"] = (below + BUS + ["controller_host", "space_server", "visualiser", "visualiser/cluster", "simulation", "launcher"]
                       + ["studies", "python"])
    # A layer on what programs of users have: no role.
    rules["studies"] = below + ["simulation", "launcher", "studies"]
    rules["real_robot"] = INTERFACE + ["common/logging", "common/program", "real_robot"]
    # A folder of drivers sees what drivers are made from, and no other drivers.
    rules["real_robot/drivers/ros2"] = rules["real_robot"] + ["common/bus/dds", "real_robot/drivers/ros2"]
    # A controller of simulated robots, which sees what controllers see and speaks to ROS 2 as the drivers do.
    rules["real_robot/ros2_controller"] = rules["real_robot/drivers/ros2"] + ["real_robot/ros2_controller"]
    # It speaks to ROS 2 as the drivers do.
    rules["visualiser/ros2"] = rules["visualiser"] + ["visualiser/ros2"] + rules["real_robot/drivers/ros2"]
    rules["user"] = INTERFACE + ["user"]
    # Experiment functions run at the space server and see all of it.
    rules["user/functions"] = rules["space_server"] + ["user/functions"]
    # Kinds of robots and objects are rows of a table of the experiment.
    rules["user/entities"] = below[: below.index("common/experiment") + 1] + ["user/entities"]
    return rules


def folder_of(path, rules):
    matching = [folder for folder in rules if path == folder or path.startswith(folder + "/")]
    return max(matching, key=len, default=None)


def room_of(path):
    """The folder of a file. A file that puts the parts of a program or of a role together stands above its folder."""
    name = os.path.basename(path)
    return path if name == "main.cpp" or name.startswith("register_") else os.path.dirname(path)


def circle(edges):
    """The includes of a circle of folders, if there is one."""
    try:
        graphlib.TopologicalSorter({room: set(targets) for room, targets in edges.items()}).prepare()
    except graphlib.CycleError as error:
        rooms = error.args[1][::-1]
        return ["folders include each other in a circle; move what both need to one below them:\n  "
                + "\n  ".join(edges[room][target] for room, target in zip(rooms, rooms[1:]))]
    return []


def includes(path):
    with open(path, encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if found:
                yield number, found.group(1) == '"', found.group(2)


def main():
    rules = allowed()
    mistakes = []
    edges = collections.defaultdict(dict)  # folder to the folders that it includes, with an example
    for path in tracked("*.h", "*.hpp", "*.cpp"):
        folder = folder_of(path, rules)
        if folder is None:
            continue
        may_include = rules[folder]
        for number, quoted, included in includes(path):
            if DDS_HEADER.search(included) and folder != DDS_FOLDER:
                mistakes.append(f"{path}:{number}: only {DDS_FOLDER} may include headers of Fast DDS, not {folder} ({included})")
            owner = HIDDEN.get(included.split("/")[0])
            if owner is not None and (folder != owner or path.endswith(".h")):
                mistakes.append(f"{path}:{number}: only a .cpp of {owner} may include {included}")
            target = folder_of(included, rules) if quoted else None
            if target is not None and room_of(included) != room_of(path):
                edges[room_of(path)].setdefault(room_of(included), f"{path}:{number} includes {included}")
            if target is not None and target not in may_include:
                mistakes.append(f"{path}:{number}: {folder} must not include {included}; it may include: "
                                + ", ".join(may_include))
    report(mistakes + circle(edges))


main()
