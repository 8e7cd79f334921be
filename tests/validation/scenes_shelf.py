"""Robots of the shelf against their published tables: fastest speed, the distance between the wheels, the ranges of sensors."""
import math

from experiment import block, element, probe
from report import ROUNDING, Row, scene
from scenes_planes import HALF, furthest

GROUP = "Robots of the shelf"
ENGINE = "dummy_engine"
# Kind: name, library, fastest speed (m/s), its source, axle (m), where the front sensor is (m), its range (m), the source of these.
ROBOTS = {
    "thymio_ii": ("Thymio II", "thymio_ii", 0.2, "Webots' guide, Thymio II", 0.0935, 0.08, 0.12, "ros-thymio base.urdf.xacro@374ff87c"),
    "turtlebot4": ("TurtleBot 4", "turtlebot4", 0.306, "create3_docs safety.md@06486d0a", 0.233, 0.154, 0.2, "create3_sim irobot_create_description"),
    "epuck2": ("e-puck2", "epuck", 0.154, "Webots' guide, e-puck2", 0.052, None, None, "Webots' guide, e-puck"),
    "khepera_iv": ("Khepera IV", "khepera_iv", None, None, 0.1054, 0.0704, 0.12, "ARGoS3 kheperaiv_measures.cpp@56357d6e"),
}


def robot(kind, name, x, y, who="c"):
    return element(kind, {"id": name, "position": f"{x!r},{y!r},0", "controller": who})


def wall(name, x, y):
    """Its near face is at x."""
    return block(name, f"{x + 0.1!r},{y!r},0.25", "0.2,0.6,0.5")


@scene(GROUP)
def wheels(lab):
    for kind, (name, library, fastest, source, axle, *_, places) in ROBOTS.items():
        kinds = {kind: library}
        if fastest:
            track = lab.run(robot(kind, "r", 1.0, 5.0), probe("c", [(0, 100, "wheels", 5, 5)]), ENGINE, 41, kinds=kinds).track("r")
            way = (track[-1][0] - track[-21][0]) / 2
            yield Row(f"{name}: fastest speed", "wheels commanded to 5 m/s", source, fastest, way, 1e-3, "published digits", "m/s")
        track = lab.run(robot(kind, "r", 5.0, 5.0), probe("c", [(0, 100, "wheels", -0.02, 0.02)]), ENGINE, 21, kinds=kinds).track("r")
        turned = math.radians(track[-1][5] - track[-11][5])
        yield Row(f"{name}: turn in 1 s, wheels at ±0.02 m/s", "2 v t / axle", places, 0.04 / axle, turned, ROUNDING, "rounding", "rad")


@scene(GROUP)
def ranges(lab):
    steps = [1e-4 * k + HALF for k in range(-10, 10)]

    def furthest_of(kind, library, sensor, parameters, limit, sees):
        return furthest(lab, [limit + step for step in steps], lambda i, gap: robot(kind, f"r{i}", 2.0, 3.0 * i + 2) + wall(f"b{i}", 2 + gap, 3.0 * i + 2),
                        probe("c", sensors={sensor: parameters}), "r", sensor, sees, kinds={kind: library})

    for kind, (name, library, _, _, _, place, reach, source) in ROBOTS.items():
        if reach:
            found = furthest_of(kind, library, "proximity", {}, place + reach, lambda now: max(now.values()) > 0)
            yield Row(f"{name}: furthest wall that a front sensor sees", "place + range", source, place + reach, found, HALF, "steps of 0.1 mm", "m")
    scanners = (("turtlebot4", "TurtleBot 4: furthest wall of its scanner", -0.04, 12, {"beams": 1, "range": 12, "nearest": 0.15, "position": "-0.04, 0, 0.193"}, "turtlebot4-user-manual features.md@0c075942"),
                ("epuck2", "e-puck2: furthest wall of its time-of-flight sensor", 0.034, 2, {"beams": 1, "range": 2, "position": "0.034, -0.0018, 0.033"}, "Webots' guide, e-puck2"))
    for kind, name, place, reach, parameters, source in scanners:
        found = furthest_of(kind, ROBOTS[kind][1], "range_scanner", parameters, place + reach, lambda now: math.isfinite(now.get("nearest", math.inf)))
        yield Row(name, "place + range", source, place + reach, found, HALF, "steps of 0.1 mm", "m")
    drawn = furthest_of("crazyflie", "crazyflie", "proximity", {}, 0.02 + 4, lambda now: now["0"] > 0)
    yield Row("Crazyflie: furthest wall of its front rangefinder", "place + range", "Bitcraze, Multi-ranger deck", 4.02, drawn, HALF, "steps of 0.1 mm", "m")
