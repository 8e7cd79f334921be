"""Experiments that the validation writes as a user would, runs by the command, and reads: poses of `text_render`, and what
the controller `validation_probe` writes of its sensors."""
import csv
import itertools
import math
import os
import pathlib
import shutil
import subprocess

IMPLEMENTATIONS = {
    "footbot_wheels": "dummy_footbot_wheels", "footbot_gripper": "dummy_footbot_gripper", "footbot_turret": "dummy_footbot_turret",
    "eyebot_propellers": "dummy_eyebot_propellers", "handbot_rope": "dummy_handbot_rope", "handbot_head": "dummy_handbot_head", "handbot_arms": "dummy_handbot_arms", "footbot_encoders": "engine_footbot_encoders",
    "footbot_accelerometer": "engine_footbot_accelerometer", "footbot_turret_torque": "engine_footbot_turret_torque"}


def element(tag, attributes, content=""):
    words = "".join(f' {name}="{value}"' for name, value in attributes.items())
    return f"<{tag}{words}>{content}</{tag}>\n"


def devices(group, wanted):
    entries = ""
    for label, parameters in wanted.items():
        implementation = IMPLEMENTATIONS.get(label, f"generic_{label}")
        if group == "sensors" and label == "footbot_gripper":
            implementation = "generic_footbot_gripper"
        entries += element(label, {"implementation": implementation, **parameters})
    return element(group, {}, entries)


def controller(label, name, actuators, sensors, parameters):
    """A controller of any label; actuators and sensors are dictionaries of parameters by label."""
    return element(label, {"id": name, "library": label},
                   devices("actuators", actuators) + devices("sensors", sensors) + element("parameters", parameters))


def probe(name, commands=(), sensors=None, actuators=None, draws=0):
    """The controller that does `commands`, tuples of first tick, last tick, actuator and values, and writes its sensors."""
    wanted = {device: {} for _, _, device, *_ in commands}
    text = "; ".join(" ".join(str(word) for word in command) for command in commands)
    more = {"commands": text, "sensors": " ".join(sensors or {}), "draws": draws}
    return controller("validation_probe", name, {**wanted, **(actuators or {})}, sensors or {}, more)


class Result:
    """What a run left: poses by entity and tick, and readings by robot."""

    def __init__(self, folder):
        self.folder = folder
        self.poses = {}
        with open(folder / "run" / "poses.csv", encoding="utf-8") as table:
            for row in csv.DictReader(table):
                numbers = [float(row[column]) for column in ("X", "Y", "Z", "Alpha", "Beta", "Gamma")]
                self.poses.setdefault(row["Entity id"], {})[int(row["clock"])] = numbers

    def track(self, entity):
        """x, y, z in m and the three angles in degrees, one entry a table."""
        return list(self.poses[entity].values())

    def readings(self, robot, sensor):
        """One dictionary of values by name for each tick; a name that comes again in a tick has a list."""
        ticks = {}
        with open(self.folder / f"{robot}.csv", encoding="utf-8") as table:
            for tick, device, name, value in csv.reader(table):
                now = ticks.setdefault(int(tick), {})
                if device == sensor:
                    now.setdefault(name, []).append(float(value))
        return [{name: values[0] if len(values) == 1 else values for name, values in now.items()} for now in ticks.values()]


class Lab:
    """Runs experiments in folders of its own; `quick` asks for fewer samples."""

    def __init__(self, program, libraries, folder, quick):
        self.program = program
        self.libraries = libraries
        self.folder = pathlib.Path(folder)
        self.quick = quick
        self.numbers = itertools.count()

    def run(self, arena, controllers="", engine="dynamics3d", ticks=100, tick_ms=100, size="10,10,4", seed=1, every=1,
            entities="", engines=None, volumes=(), moves=(), faults=(), kinds=None, processes=False, **parameters):
        """Runs a scene in one engine with these parameters, or in `engines`: tag, parameters and entities (none: all) by id.
        `volumes`: engines instead, as pairs of a tag and the volume in which it moves entities. `moves`: tick, entity, x, y
        and heading of what is put elsewhere, into others too. `faults`: attributes of each. `kinds`: by their tags, the libraries
        or the texts of URDF files. `processes`: as a cluster."""
        engines = engines or {f"engine_{k}": (tag, {}, None) for k, (tag, _) in enumerate(volumes)} or {"engine": (engine, parameters, None)}
        places = {f"engine_{k}": {"volume": volume} for k, (_, volume) in enumerate(volumes)}
        folder = self.folder / f"run_{next(self.numbers)}"
        folder.mkdir(parents=True)
        shown = {"id": "poses", "file": "poses.csv", "format": "csv", "precision": 15, "every": every}
        if entities:
            shown["entities"] = entities
        text = element("framework", {}, "".join(element(tag, {}, value) for tag, value in (
            ("clocktick", tick_ms), ("maxclock", ticks), ("seed", seed), ("controller_path", self.libraries), ("plugin_path", self.libraries))))
        for tag, kind in (kinds or {}).items():
            if kind.startswith("<"):
                (folder / f"{tag}.urdf").write_text(kind, encoding="utf-8")
        if kinds:
            text += element("entity_kinds", {}, "".join(
                element(tag, {"urdf": f"{tag}.urdf"} if kind.startswith("<") else {"library": kind}) for tag, kind in kinds.items()))
        text += element("controllers", {}, controllers) + element("arena", {"size": size, "optimization": "2D"}, arena)
        text += element("engines", {}, "".join(element(tag, {"id": name, **more}) for name, (tag, more, _) in engines.items()))
        text += element("arena_physics", {}, "".join(
            element("engine", {"id": name, **places.get(name, {})}, "<all/>" if listed is None else "".join(f'<entity id="{one}"/>' for one in listed))
            for name, (_, _, listed) in engines.items()))
        if moves:
            text += element("experiment_functions", {}, element("validation_placement", {"id": "placement", "library": "validation_placement"}, element(
                "moves", {}, "; ".join(" ".join(str(word) for word in move) for move in moves))))
        text += element("visualisations", {}, element("text_render", shown))
        text += element("faults", {}, "".join(element("fault", {"id": f"fault_{k}", **fault}) for k, fault in enumerate(faults)))
        (folder / "experiment.xml").write_text(element("ahss-config", {}, text), encoding="utf-8")
        done = subprocess.run([self.program, "run", "experiment.xml", "--quiet", "--output", "run", *([] if processes else ["--single-process"])], cwd=folder,
                              capture_output=True, text=True, env={**os.environ, "SWARMANOID_SHARED_FOLDER": str(self.folder / "shared")})
        if done.returncode != 0:
            raise RuntimeError(f"{folder}/experiment.xml: {done.stderr or done.stdout}")
        result = Result(folder)
        result.clear = lambda: shutil.rmtree(folder)
        return result


def footbot(name, x, y, heading=0, who=None, z=0):
    return element("footbot", {"id": name, "position": f"{x!r},{y!r},{z!r}", "orientation": f"0,0,{heading!r}",
                               **({"controller": who} if who else {})})


def prey(name, x, y, z=0, **more):
    return element("cylindric_prey", {"id": name, "position": f"{x!r},{y!r},{z!r}", **more})


def block(name, position, size, **more):
    return element("block", {"id": name, "position": position, "size": size, **more})


def mean(values):
    return math.fsum(values) / len(values)


def deviation(values):
    middle = mean(values)
    return math.sqrt(math.fsum((v - middle) ** 2 for v in values) / (len(values) - 1))


def slope(xs, ys):
    """Of the line of least squares."""
    x0, y0 = mean(xs), mean(ys)
    return math.fsum((x - x0) * (y - y0) for x, y in zip(xs, ys)) / math.fsum((x - x0) ** 2 for x in xs)
