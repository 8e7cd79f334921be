"""Who may include whom (docs/architecture.md): folders include downwards only, roles never see each other, and only
common/bus/dds sees Fast DDS."""
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
    ["common/logging", "common/serialisation", "common/activity"],
    ["common/program"],
    ["common/control_interface"],
    ["common/mesh"],
    ["common/experiment"],
    ["common/plugin_descriptions"],
    ["common/run"],
    ["common/messages"],
    ["common/space"],
    ["common/checkpoint"],
    ["common/journal"],
    ["common/bus"],
]
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
    without_bus = [folder for folder in below if folder != "common/bus"]
    for role in ROLES:
        rules[role] = without_bus + [role]
    # The terrains are of the library of the experiment: <distribute> places on them.
    experiment = rules["common/experiment"]
    rules["common/space/terrain"] = experiment + ["common/space/terrain"]
    rules["common/experiment"] = experiment + ["common/space/terrain"]
    # The API of ARGoS3 over ours; its files are read by the launcher.
    rules["argos3"] = rules["space_server"] + ["argos3", "argos3/converter"]
    rules["argos3/converter"] = below[: below.index("common/experiment") + 1] + ["argos3/converter"]
    rules["argos3/program"] = rules["argos3"] + ["simulation", "launcher", "argos3/program"]
    # The simulator of one process registers all roles.
    rules["simulation"] = without_bus + ROLES + ["simulation"]
    rules["launcher"] = below + ROLES + ["simulation", "argos3/converter", "launcher"]
    # The module wraps the runner for one process, as a program of a user does, and looks on at runs as a visualiser does.
    rules["python"] = below + ["controller_host", "space_server", "visualiser", "simulation", "launcher", "studies", "python"]
    # A layer on what programs of users have: no role.
    rules["studies"] = below + ["simulation", "launcher", "studies"]
    rules["real_robot"] = INTERFACE + ["common/logging", "common/program", "real_robot"]
    # One folder knows which release of Fast DDS there is; the bus and the ROS 2 drivers see Fast DDS by it.
    rules["common/bus/dds"] = ["common/bus/dds"]
    rules["common/bus"] = rules["common/bus"] + ["common/bus/dds"]
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
    for folder in rules:
        if "common/space" in rules[folder]:
            rules[folder] = rules[folder] + ["common/space/terrain"]
    return rules


def folder_of(path, rules):
    matching = [folder for folder in rules if path.startswith(folder + "/")]
    return max(matching, key=len, default=None)


def includes(path):
    with open(path, encoding="utf-8") as source:
        for number, line in enumerate(source, 1):
            found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if found:
                yield number, found.group(1) == '"', found.group(2)


def main():
    rules = allowed()
    mistakes = []
    for path in tracked("*.h", "*.hpp", "*.cpp"):
        folder = folder_of(path, rules)
        if folder is None:
            continue
        may_include = rules[folder]
        if folder in ROLES and (os.path.basename(path) == "main.cpp" or "/cluster/" in path):
            may_include = may_include + ["common/bus"]  # the program around the role
        if path == "launcher/main.cpp":
            may_include = may_include + ["studies"]  # whose verbs it has, too
        for number, quoted, included in includes(path):
            if DDS_HEADER.search(included) and folder != DDS_FOLDER:
                mistakes.append(f"{path}:{number}: only {DDS_FOLDER} may include headers of Fast DDS, not {folder} ({included})")
            owner = HIDDEN.get(included.split("/")[0])
            if owner is not None and (folder != owner or path.endswith(".h")):
                mistakes.append(f"{path}:{number}: only a .cpp of {owner} may include {included}")
            target = folder_of(included, rules) if quoted else None
            if target is not None and target not in may_include:
                mistakes.append(f"{path}:{number}: {folder} must not include {included}; it may include: "
                                + ", ".join(may_include))
    report(mistakes)


main()
