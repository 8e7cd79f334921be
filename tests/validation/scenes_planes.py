"""What the two engines of the plane share: friction of walls, bodies put into each other, mirrors, regions, a robot alone."""
import math

from experiment import block, element, footbot, prey, probe
from report import ROUNDING, Row, scene
from scenes_kinematics2d import RADIUS, deepest_overlap

ROBOTS = 0.49  # friction of robots in both engines
ALLOWED = 0.004 * RADIUS + 1e-9
HALF = 5e-5  # m, of a step between two places
OVERLAP = "docs/engines.md"


def sliding(lab, engine, contact=None, **parameters):
    """Speed along a wall of a footbot that is commanded to 0.1 m/s at 45° to it; `contact`: friction of the contact."""
    own = {} if contact is None else {"friction": repr(contact * contact / ROBOTS)}
    who = probe("c", [(0, 200, "footbot_wheels", 0.1, 0.1)])
    track = lab.run(footbot("fb", 5 - RADIUS, 3.0, 45, "c") + block("w", "5.1,5,0.25", "0.2,9,0.5", **own), who, engine, 100, **parameters).track("fb")
    return (track[100][1] - track[20][1]) / 8


def walls(lab, engine, prefix, tolerance, why):
    for contact in (0, 0.07, 0.3):
        yield Row(f"{prefix}: slides along a wall at 45°, friction {contact}, speed", "v (cos 45° - µ sin 45°)", "Coulomb, limited force",
                  0.1 * math.sqrt(0.5) * (1 - contact), sliding(lab, engine, contact), tolerance, why, "m/s")


@scene("Kinematic engine")
def kinematic_walls(lab):
    yield from walls(lab, "dummy_engine", "kinematic", ROUNDING, "rounding")


@scene("2D rigid-body engine")
def dynamics2d_walls(lab):
    yield from walls(lab, "dynamics2d", "dynamics2d", 1e-5, "it turns a little")


@scene("Contacts")
def argos3_wall(lab):
    # ARGoS3 at 421bd763 with dynamics2d, foot-bot at 45° to a box, 0.1 m/s: y of 0.267 m after 4 s and 0.530 m after 8 s.
    yield Row("dynamics2d: slides along a wall at 45°, 0.1 m/s", "0.530 m - 0.267 m in 4 s, measured; friction 0.7 · 0.1",
              "ARGoS3 dynamics2d_box_model.cpp@0e5218f7", 0.263 / 4, sliding(lab, "dynamics2d"), 0.001 / 4, "rounded to 1 mm", "m/s")


def overlap(poses):
    return max(deepest_overlap(now) for now in poses)


def put_together(lab, engine):
    """Pairs of 60 that are apart 6 s after one was put 2 cm from the other; both drive blindly."""
    who = probe("c", [(0, 100, "footbot_wheels", 0.05, 0.03)]) + probe("d", [(0, 100, "footbot_wheels", 0.04, 0.06)])
    arena, moves = "", []
    for k in range(60):
        x, y = 2.0 + 2 * (k % 10), 2.0 + 2 * (k // 10)
        arena += footbot(f"a{k}", x, y, 47.0 * k, "c") + footbot(f"b{k}", x, y + 1, 0, "d")
        moves.append((1, f"b{k}", x + 0.02 * math.cos(6.0 * k), y + 0.02 * math.sin(6.0 * k), 31 * k))
    result = lab.run(arena, who, engine, 62, size="24,16,1", every=62, moves=moves)
    return sum(deepest_overlap([result.track(f"a{k}")[-1], result.track(f"b{k}")[-1]]) < 1e-3 for k in range(60))


@scene("Contacts")
def pairs_put_together(lab):
    for engine in ("dummy_engine", "dynamics2d"):
        yield Row(f"{engine}: pairs apart of 60 that were put 2 cm from each other, after 6 s", "all part", OVERLAP, 60, put_together(lab, engine), 0, "counts")


def mirror_depth(lab, engine, left, right):
    """Deepest overlap of a footbot with room and the mirror of one that drives into it from another engine."""
    who = probe("c", [(0, 100, "footbot_wheels", left, right)])
    arena = footbot("m", 2.0, 5.0, 0, "c") + footbot("b", 3.0, 5.0, 90)
    result = lab.run(arena, who, ticks=40, size="20,10,1", engines={"m": ("dummy_engine", {}, ["m"]), "e": (engine, {}, None)})
    return overlap(zip(result.track("m"), result.track("b")))


@scene("Contacts")
def mirrors(lab):
    for engine, tolerance, why in (("dummy_engine", ALLOWED, "promised"), ("dynamics2d", 0.001, "1 mm")):
        for name, left, right in (("straight on at 1 m/s", 1, 1), ("on a curve at 0.3 m/s", 0.29, 0.31)):
            yield Row(f"{engine}: a mirror drives {name} into a robot with room, deepest overlap", "none", OVERLAP, 0, mirror_depth(lab, engine, left, right),
                      tolerance, why, "m")


@scene("Contacts")
def regions(lab):
    who = probe("c", [(0, 200, "footbot_wheels", 0.3, 0.28)])
    crowd = ('<distribute quantity="64"><position method="grid" centre="5,5,0" spacing="0.4,0.4,0" layout="8,8,1"/><orientation method="uniform"/>'
             '<footbot id="fb" controller="c"/></distribute>')
    for engine in ("dummy_engine", "dynamics2d"):
        one, three = (lab.run(crowd, who, engine, 100, processes=split > 1, split=split, every=10, wall_friction=0.01) for split in (1, 3))
        worst = max(abs(p - q) for robot in one.poses for a, b in zip(one.track(robot), three.track(robot)) for p, q in zip(a, b))
        yield Row(f"{engine}: a crowd in three regions of a cluster, furthest from one process", "the same bits", "docs/determinism.md", 0, worst, 0, "counts", "m")


@scene("Devices")
def alone(lab):
    # Nothing is in range: sensors of the surroundings read what they read of nothing.
    sensors = {name: {} for name in ("footbot_proximity", "footbot_light", "footbot_omnidirectional_camera", "range_and_bearing", "contact", "tag_reader", "radio",
                                     "microphone", "pie_camera")}
    for engine in ("dummy_engine", "dynamics2d", "dynamics3d"):
        result = lab.run(footbot("fb", 5.0, 5.0, 30, "c"), probe("c", [(0, 20, "footbot_wheels", 0.05, 0.1)], sensors=sensors), engine, 20)
        values = [value for sensor in sensors for now in result.readings("fb", sensor) for value in now.values()]
        yield Row(f"{engine}: a robot alone, readings of 9 sensors other than 0", "nothing is near", "geometry", 0, sum(value != 0 for value in values), 0, "counts")


def furthest(lab, places, arena, who, robot, sensor, sees, **more):
    """The last of the places at which a robot's sensor sees something."""
    result = lab.run("".join(arena(i, place) for i, place in enumerate(places)), who, "dummy_engine", 3, size=f"40,{6 * len(places) + 6},3", **more)
    return max((place for i, place in enumerate(places) if any(sees(now) for now in result.readings(f"{robot}{i}", sensor)[-1:])), default=0) + HALF


@scene("Devices")
def borders(lab):
    steps = [1e-4 * k + HALF for k in range(-10, 10)]
    who = probe("w", sensors={"footbot_proximity": {}})
    limit = (RADIUS + 0.1) * math.cos(math.radians(7.5)) - RADIUS
    found = furthest(lab, [limit + step for step in steps], lambda i, gap: footbot(f"w{i}", 2.0, 3.0 * i + 2, 0, "w") + block(
        f"b{i}", f"{2 + RADIUS + gap + 0.1!r},{3.0 * i + 2},0.25", "0.2,0.6,0.5"), who, "w", "footbot_proximity", lambda now: now["0"] > 0)
    yield Row("proximity: furthest wall that is seen", "(r + 0.1 m) cos 7.5° - r", "geometry", limit, found, HALF, "steps of 0.1 mm", "m")

    sender = probe("s", [(0, 10, "range_and_bearing", 7)])
    who = sender + probe("w", sensors={"range_and_bearing": {}})
    found = furthest(lab, [3 + step for step in steps], lambda i, gap: footbot(f"w{i}", 2.0, 6.0 * i + 2, 0, "w") + footbot(f"s{i}", 2 + gap, 6.0 * i + 2, 0, "s"),
                     who, "w", "range_and_bearing", lambda now: any("range" in name for name in now))
    yield Row("range and bearing: furthest sender that is heard", "3 m", "docs/devices.md", 3, found, HALF, "steps of 0.1 mm", "m")

    # A robot half way hides the sender until it is its radius beside the line.
    found = furthest(lab, [RADIUS + step for step in steps], lambda i, gap: footbot(f"w{i}", 2.0, 6.0 * i + 2, 0, "w") + footbot(f"s{i}", 4.0, 6.0 * i + 2, 0, "s")
                     + footbot(f"o{i}", 3.0, 6.0 * i + 2 + gap, 90), who, "w", "range_and_bearing", lambda now: not any("range" in name for name in now))
    yield Row("range and bearing: furthest a hiding robot is beside the line", "its radius", "geometry", RADIUS, found, HALF, "steps of 0.1 mm", "m")

    who = probe("w", sensors={"contact": {"reach": 0.01}})
    found = furthest(lab, [0.01 + step for step in steps], lambda i, gap: footbot(f"w{i}", 2.0, 3.0 * i + 2, 180, "w") + prey(
        f"p{i}", 2 + RADIUS + gap + 0.05, 3.0 * i + 2, radius=0.05, height=0.1), who, "w", "contact", lambda now: any(name.startswith("contact") for name in now))
    yield Row("contact: furthest prey that is felt", "reach", "docs/devices.md", 0.01, found, HALF, "steps of 0.1 mm", "m")
