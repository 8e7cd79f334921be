"""Sensors and actuators against geometry, their stated formulas, and the statistics of their noise."""
import math

from experiment import block, deviation, element, footbot, mean, prey, probe
from report import VALIDATION, ROUNDING, Row, scene
from scenes_kinematics2d import RADIUS, SOURCE, unwrapped

GROUP = "Devices"
ENGINE = "dummy_engine"
A3 = "ARGoS3"
GEOMETRY = "geometry"
RED, GREEN = 0xff0000, 0x00ff00


def ring(now):
    return [now[str(i)] for i in range(24)]


def angles(count=24):
    return [math.radians(7.5 + 15 * i) for i in range(count)]


def proximity_of(distance):
    return 1 if distance < 0.009889556 else 0.0100527 / (distance + 0.000163144)


@scene(GROUP)
def proximity(lab):
    who = probe("c", sensors={"footbot_proximity": {}})
    places = [0.0, 0.005, 0.01, 0.02, 0.05, 0.08, 0.099]
    arena = "".join(footbot(f"fb_{i}", 2.0, 1.0 + i, 30, "c") + block(f"w{i}", f"{2 + RADIUS + gap + 0.11!r},{1.0 + i},0.25", "0.2,0.9,0.5")
                    for i, gap in enumerate(places))
    result = lab.run(arena, who, ENGINE, 2)
    worst, drawn = 0, []
    for i, gap in enumerate(places):
        for angle, reading in zip(angles(), ring(result.readings(f"fb_{i}", "footbot_proximity")[0])):
            cosine = math.cos(angle + math.pi / 6)
            distance = (RADIUS + gap + 0.01) / cosine - RADIUS if cosine > 0 else 1
            side = (RADIUS + max(distance, 0)) * abs(math.sin(angle + math.pi / 6))
            expected = proximity_of(distance) if distance <= 0.1 and side < 0.45 else 0
            worst = max(worst, abs(reading - expected))
            if reading > 0:
                drawn.append((distance, reading))
    yield Row("proximity beside a wall: 7 · 24 readings", "0.0100527 / (d + 0.000163144)", f"{A3} footbot_proximity_default_sensor.cpp@dfa7d4b0", 0, worst, ROUNDING, "rounding")
    grid = [0.001 * i for i in range(1, 100)]
    yield {"name": "proximity", "caption": "Readings of footbot_proximity beside a wall", "part": VALIDATION, "x": "distance (m)", "y": "reading",
           "series": [("readings", *zip(*sorted(drawn)))], "curves": [("ARGoS3's formula", grid, [proximity_of(d) for d in grid])]}
    arena = footbot("a", 2.0, 2.0, 0, "c") + prey("p", 2.0 + RADIUS + 0.08 + 0.05, 2.0, radius=0.08, height=0.15)
    readings = ring(lab.run(arena, who, ENGINE, 2).readings("a", "footbot_proximity")[0])
    b = (RADIUS + 0.13) * math.cos(math.radians(7.5))
    distance = b - math.sqrt(b * b - (RADIUS + 0.13) ** 2 + 0.08 ** 2) - RADIUS
    yield Row("proximity before a cylinder, the ray at 7.5°", "ray and circle", GEOMETRY, proximity_of(distance), readings[0], ROUNDING, "rounding")


@scene(GROUP)
def light(lab):
    worst = {"generic_footbot_light": 0, "argos3_footbot_light": 0}
    for implementation in worst:
        who = probe("c", sensors={"footbot_light": {"implementation": implementation}})
        for x, intensity in ((4.0, 0.3), (5.5, 1.0), (3.0, 0.1)):
            arena = footbot("fb", 2.0, 2.0, 20, "c") + element("light_bulb", {"id": "l", "position": f"{x},3,0.5", "intensity": intensity})
            readings = ring(lab.run(arena, who, ENGINE, 2).readings("fb", "footbot_light")[0])
            height = 0.5 - (0.06 if implementation.startswith("generic") else 0)
            distance = math.sqrt((x - 2) ** 2 + 1 + height ** 2)
            towards = math.atan2(1, x - 2) - math.radians(20)
            if implementation.startswith("generic"):
                strength = (intensity / distance) ** 2
            else:
                strength = math.exp(-2 * distance / intensity) if distance <= 2.5 * intensity else 0
            for angle, reading in zip(angles(), readings):
                off = abs(math.remainder(angle - towards, math.tau))
                worst[implementation] = max(worst[implementation], abs(reading - min(1, strength * max(0, 1 - off / (math.pi / 2)))))
    yield Row("light: 3 · 24 readings", "(I / d)² max(0, 1 - |off| / 90°)", "inverse square", 0, worst["generic_footbot_light"], ROUNDING, "rounding")
    yield Row("light as in ARGoS3: 3 · 24 readings", "exp(-2 d / I) max(0, 1 - |off| / 90°)", f"{A3} footbot_light_rotzonly_sensor.cpp@de40bf19", 0,
              worst["argos3_footbot_light"], ROUNDING, "rounding")


@scene(GROUP)
def ground(lab):
    who = probe("c", sensors={"footbot_ground": {}, "footbot_motor_ground": {}})
    patch = element("ground_patch", {"id": "g", "position": "2.5,2,0", "size": "1,1", "colour": "60, 120, 200"})
    result = lab.run(footbot("fb", 2.0, 2.0, 10, "c") + patch, who, ENGINE, 2)
    grey = (0.299 * 60 + 0.587 * 120 + 0.114 * 200) / 255
    places = ((0.08, 0), (0.042, 0.065), (0, 0.08), (-0.042, 0.065), (-0.08, 0), (-0.042, -0.065), (0, -0.08), (0.042, -0.065))
    turn = math.radians(10)
    now = result.readings("fb", "footbot_ground")[0]
    worst = max(abs(now[str(i)] - (grey if x * math.cos(turn) - y * math.sin(turn) > 0 else 1)) for i, (x, y) in enumerate(places))
    yield Row("ground: 8 sensors at the edge of a patch", "0.299 R + 0.587 G + 0.114 B; places", f"ITU-R BT.601; {A3} footbot_entity.cpp@c6aa94d6", 0, worst, ROUNDING, "rounding")


def lit(name, x, y, colour, heading=0, z=0):
    return footbot(name, x, y, heading, name, z), probe(name, [(0, 10, "footbot_beacon", colour)])


@scene(GROUP)
def cameras(lab):
    watcher = probe("w", sensors={"footbot_omnidirectional_camera": {"aperture": 85}})
    arena, who = footbot("w", 5.0, 5.0, 25, "w"), watcher
    places = [(5 + 0.15 * (k + 2) * math.cos(1.0 * k), 5 + 0.15 * (k + 2) * math.sin(1.0 * k)) for k in range(6)]
    for k, (x, y) in enumerate(places):
        robot, controller = lit(f"b{k}", x, y, 0x100000 * (k + 1) + 0xff)
        arena, who = arena + robot, who + controller
    now = lab.run(arena, who, ENGINE, 5).readings("w", "footbot_omnidirectional_camera")[-1]
    found = {int(now[f"blob {i}"+" colour"]): (now[f"blob {i} distance"], now[f"blob {i} angle"]) for i in range(sum("colour" in name for name in now))}
    worst_distance = worst_angle = 0
    for k, (x, y) in enumerate(places):
        distance, angle = found.get(0x100000 * (k + 1) + 0xff, (math.inf, math.inf))
        worst_distance = max(worst_distance, abs(distance - math.hypot(x - 5, y - 5)))
        worst_angle = max(worst_angle, abs(math.remainder(angle - math.atan2(y - 5, x - 5) + math.radians(25), math.tau)))
    yield Row("omnidirectional camera: distances of 6 beacons", "√(Δx² + Δy²)", GEOMETRY, 0, worst_distance, ROUNDING, "rounding", "m")
    yield Row("omnidirectional camera: bearings of 6 beacons", "atan2(Δy, Δx) - heading", GEOMETRY, 0, worst_angle, ROUNDING, "rounding", "rad")


@scene(GROUP)
def led_visibility(lab):
    gaps = [0.001 * i for i in range(550, 570)]
    arena, who = "", probe("w", sensors={"footbot_omnidirectional_camera": {}})
    who += probe("l", [(0, 10, "footbot_leds", RED)])
    for i, gap in enumerate(gaps):
        # All LEDs of one colour are one blob at their middle, above the axis.
        arena += footbot(f"w{i}", 1.0, 1.0 + 2 * i, 0, "w") + footbot(f"l{i}", 1.0 + gap, 1.0 + 2 * i, 180, "l")
    result = lab.run(arena, who, ENGINE, 5, size="10,50,2")
    seen = [gap for i, gap in enumerate(gaps) if result.readings(f"w{i}", "footbot_omnidirectional_camera")[-1]]
    yield Row("omnidirectional camera: furthest LEDs in view", "(0.2887 - 0.085) tan 70°", f"{A3} footbot_entity.cpp@c6aa94d6", 0.2037 * math.tan(math.radians(70)), max(seen, default=0), 0.001, "steps of 1 mm", "m")


@scene(GROUP)
def pixels(lab):
    count, step = (40, 0.05) if lab.quick else (400, 0.005)
    who = probe("w", sensors={"footbot_omnidirectional_camera": {"implementation": "pixel_noise_footbot_omnidirectional_camera", "aperture": 85}}) + probe("l", [(0, 10, "footbot_beacon", RED)])
    arena = "".join(footbot(f"w{i}", 1.0 + 3 * (i % 20), 1.0 + 3 * (i // 20), 0, "w") + footbot(f"l{i}", 1.25 + 3 * (i % 20), 1.0 + 3 * (i // 20) + step * i / count * 2, 0, "l") for i in range(count))
    result = lab.run(arena, who, ENGINE, 3, size="80,80,2")
    worst = 0
    for i in range(count):
        now = result.readings(f"w{i}", "footbot_omnidirectional_camera")[-1]
        y = step * i / count * 2
        true = math.hypot(0.25, y)
        # From the distance to the angle off the axis, whose 85 degrees are 240 pixels.
        eye = 0.2887 - 0.174249733
        radius = [math.atan2(d, eye) / math.radians(85) * 240 for d in (true, now["blob 0 distance"])]
        directions = (math.atan2(y, 0.25), now["blob 0 angle"])
        worst = max(worst, *(abs(radius[0] * f(directions[0]) - radius[1] * f(directions[1])) for f in (math.cos, math.sin)))
    yield Row("camera with pixels: furthest off without noise", "at most half a pixel", "rounding", 0.25, worst, 0.25 + 1e-6, "between 0 and 0.5", "pixels")


@scene(GROUP)
def range_and_bearing(lab):
    sender = probe("s", [(0, 1000, "range_and_bearing", 7)])
    hearer = probe("h", sensors={"range_and_bearing": {}})
    arena = footbot("h", 5.0, 5.0, 40, "h") + footbot("s", 6.2, 4.1, 0, "s") + footbot("hidden", 5.0, 7.0, 0, "s") + footbot("between", 5.0, 6.0)
    arena += footbot("far", 5.0, 1.999, 0, "s")
    result = lab.run(arena, sender + hearer, ENGINE, 5)
    now = result.readings("h", "range_and_bearing")[-1]
    yield Row("range and bearing: range", "distance of antennas", GEOMETRY, 1.5, now["packet 0 range"], ROUNDING, "rounding", "m")
    yield Row("range and bearing: bearing", "atan2(Δy, Δx) - heading", GEOMETRY, math.atan2(-0.9, 1.2) - math.radians(40), now["packet 0 bearing"], ROUNDING, "rounding", "rad")
    yield Row("range and bearing: packets, one sender hidden, one at 3.001 m", "line of sight, 3 m", f"{A3} footbot_entity.cpp@c6aa94d6", 1, sum("range" in name for name in now), 0, "counts")
    eye = element("eyebot", {"id": "h", "position": "5,5,2", "controller": "h"})
    now = lab.run(eye + footbot("s", 6.0, 5.0, 0, "s"), sender + hearer, "dynamics3d", 3, size="10,10,5").readings("h", "range_and_bearing")[-1]
    yield Row("range and bearing: eyebot 2 m above a footbot, range", "√(Δx² + Δz²)", GEOMETRY, math.sqrt(5), now["packet 0 range"], 1e-3, "sinking", "m")
    ticks, p = (400, 0.3) if lab.quick else (5000, 0.3)
    hearer = probe("h", sensors={"range_and_bearing": {"loss_probability": p, "range_noise_kind": "gaussian", "range_noise_deviation": 0.05}})
    found = lab.run(footbot("h", 5.0, 5.0, 0, "h") + footbot("s", 6.0, 5.0, 0, "s"), sender + hearer, ENGINE, ticks, every=ticks).readings("h", "range_and_bearing")
    ranges = [now["packet 0 range"] for now in found if "packet 0 range" in now]
    asked = ticks - 1
    yield Row("range and bearing: share of lost packets", "p", "Bernoulli", p, 1 - len(ranges) / asked, 4 * math.sqrt(p * (1 - p) / asked) + 1 / asked, "4 s.e., one packet")
    yield Row("range and bearing: deviation of the range", "σ", "normal", 0.05, deviation(ranges), 4 * 0.05 / math.sqrt(2 * len(ranges)), "4 s.e.", "m")


@scene(GROUP)
def microphone(lab):
    who = probe("c", sensors={"microphone": {}})
    arena = footbot("fb", 5.0, 5.0, 30, "c") + element("sound_source", {"id": "a", "position": "7,5,1.1", "intensity": 2}) + element("sound_source", {"id": "b", "position": "5,8,0.1", "intensity": 1})
    now = lab.run(arena, who, ENGINE, 2).readings("fb", "microphone")[0]
    loud = 2 / math.sqrt(5)
    first = 0 if abs(now["sound 0 loudness"] - loud) < 0.1 else 1
    yield Row("microphone: pressure at 2.24 m, I = 2", "I / d", "spherical wave", loud, now[f"sound {first} loudness"], ROUNDING, "rounding")
    yield Row("microphone: bearing", "atan2(Δy, Δx) - heading", GEOMETRY, -math.radians(30), now[f"sound {first} bearing"], ROUNDING, "rounding", "rad")
    yield Row("microphone: loudness of both sources", "√(p₁² + p₂²)", "incoherent", math.hypot(loud, 1 / 3), now["loudness"], ROUNDING, "rounding")


@scene(GROUP)
def motion_sensors(lab):
    who = probe("c", [(0, 200, "footbot_wheels", 0.05, 0.1)], sensors={"gyroscope": {}, "battery": {}, "footbot_encoders": {}, "positioning": {}})
    result = lab.run(footbot("fb", 5.0, 5.0, 0, "c"), who, ENGINE, 101)
    rate = 0.05 / 0.14
    yield Row("gyroscope: yaw rate on an arc", "(r - l) / b", SOURCE, rate, result.readings("fb", "gyroscope")[50]["yaw"], ROUNDING, "rounding", "rad/s")
    yield Row("battery: charge after 10 s on an arc", "1 - 10⁻⁴ t - 10⁻³ d - 10⁻³ α", f"{A3} battery_equipped_entity.cpp@c6aa94d6", 1 - 1e-3 - 0.75e-3 - rate * 10e-3,
              result.readings("fb", "battery")[100]["charge"], 1e-6, "chords")
    x = y = heading = 0
    for now in result.readings("fb", "footbot_encoders")[1:101]:
        left, right = now["left"] * 0.029112741, now["right"] * 0.029112741
        turn = (right - left) / 0.14 * 0.1
        step = (left + right) / 2 * 0.1 * (math.sin(turn / 2) / (turn / 2))
        x, y, heading = x + step * math.cos(heading + turn / 2), y + step * math.sin(heading + turn / 2), heading + turn
    pose = result.readings("fb", "positioning")[100]
    yield Row("odometry of encoders against positioning, 10 s of an arc", "Σ of arcs", SOURCE, 0, math.hypot(pose["x"] - 5 - x, pose["y"] - 5 - y), ROUNDING, "rounding", "m")


@scene(GROUP)
def noise(lab):
    ticks = 2000 if lab.quick else 20000
    gauss = math.exp(-2) / math.sqrt(2 * math.pi)  # φ(2)
    inside = math.erf(2 / math.sqrt(2))
    tail = (1 - inside) / 2
    kinds = (("uniform", {"range": 0.1}, 0.1 / math.sqrt(3), "r / √3"),
             ("gaussian", {"deviation": 0.05}, 0.05, "σ"),
             ("gaussian", {"deviation": 0.05, "range": 0.1}, 0.05 * math.sqrt(1 - 2 * tail - 4 * gauss + 8 * tail), "σ √(1 - 2Q - 2bφ + 2b²Q), b = 2"),
             ("truncated_gaussian", {"deviation": 0.05, "range": 0.1}, 0.05 * math.sqrt(1 - 4 * gauss / inside), "σ √(1 - 2bφ / (1 - 2Q)), b = 2"))
    for kind, numbers, expected, form in kinds:
        who = probe("c", sensors={"positioning": {"position_noise_kind": kind, **{f"position_noise_{name}": value for name, value in numbers.items()}}})
        found = lab.run(footbot("fb", 5.0, 5.0, 0, "c"), who, ENGINE, ticks, every=ticks).readings("fb", "positioning")
        errors = [now["x"] - 5 for now in found]
        yield Row(f"positioning: deviation of {kind} noise{' within ±2σ' if len(numbers) == 2 else ''}", form, "moments", expected, deviation(errors), 4 * expected / math.sqrt(2 * ticks), "4 s.e.", "m")
        yield Row(f"positioning: mean of {kind} noise{' within ±2σ' if len(numbers) == 2 else ''}", "0", "moments", 0, mean(errors), 4 * expected / math.sqrt(ticks), "4 s.e.", "m")


@scene(GROUP)
def radio(lab):
    sender = probe("s", [(0, 100, "radio", 10)])
    slow = probe("slow", [(0, 100, "radio", 10)], actuators={"radio": {"bandwidth": 50}})
    hearer = probe("h", sensors={"radio": {}})
    late = probe("late", sensors={"radio": {"latency": 0.5}})
    arena = footbot("near", 1.0, 1.0, 0, "h") + footbot("s", 10.999, 1.0, 0, "s") + footbot("far", 21.001, 1.0, 0, "h")
    result = lab.run(arena, sender + hearer, ENGINE, 100, size="40,40,2", every=100)
    arrived = lambda result, robot: [sum(value if isinstance(value, (int, float)) else sum(value) for name, value in now.items() if name.endswith(" length")) for now in result.readings(robot, "radio")]
    yield Row("radio: packets in 100 ticks at 9.999 m", "range 10 m, one tick later", "docs/devices.md", 99, sum(bytes_ > 0 for bytes_ in arrived(result, "near")), 0, "counts")
    yield Row("radio: packets in 100 ticks at 10.002 m", "range 10 m", "docs/devices.md", 0, sum(bytes_ > 0 for bytes_ in arrived(result, "far")), 0, "counts")
    result = lab.run(footbot("h", 1.0, 1.0, 0, "h") + footbot("s", 2.0, 1.0, 0, "slow"), slow + hearer, ENGINE, 101, every=100)
    yield Row("radio: bytes in 10 s through 50 bytes/s", "30 + 50 t", "docs/devices.md", 530, sum(arrived(result, "h")), 20, "whole packets, first tick", "bytes")
    result = lab.run(footbot("h", 1.0, 1.0, 0, "late") + footbot("s", 2.0, 1.0, 0, "s"), sender + late, ENGINE, 50, every=50)
    yield Row("radio: first packet with a latency of 0.5 s", "one tick and the latency", "docs/devices.md", 6, next(i for i, n in enumerate(arrived(result, "h")) if n), 0, "ticks", "ticks")
    ticks, p = (100, 0.2) if lab.quick else (100, 0.2)
    lossy = probe("lossy", sensors={"radio": {"loss_probability": p}})
    arena = footbot("s", 5.0, 5.0, 0, "s") + "".join(footbot(f"h{i}", 3.0 + 0.4 * (i % 10), 1.0 + 0.4 * (i // 10), 0, "lossy") for i in range(50))
    result = lab.run(arena, sender + lossy, ENGINE, ticks, every=ticks)
    got = sum(sum(n > 0 for n in arrived(result, f"h{i}")) for i in range(50))
    asked = 50 * (ticks - 1)
    yield Row("radio: share of lost packets, 50 receivers", "p, independently", "Bernoulli", p, 1 - got / asked, 4 * math.sqrt(p * (1 - p) / asked), "4 s.e.")


@scene(GROUP)
def gripper(lab):
    gaps = [0.001 * i for i in range(0, 40)]
    who = probe("c", [(0, 10, "footbot_gripper", 1)], sensors={"footbot_gripper": {}})
    for engine in (ENGINE, "dynamics2d", "dynamics3d"):
        front = 0.1  # of the gripper
        arena = "".join(footbot(f"fb_{i}", 1.0, 1.0 + i, 0, "c") + prey(f"p{i}", 1.0 + front + gap + 0.1 + 0.0005, 1.0 + i, radius=0.1, height=0.15) for i, gap in enumerate(gaps))
        result = lab.run(arena, who, engine, 4, size="10,50,2")
        held = [gap + 0.0005 for i, gap in enumerate(gaps) if result.readings(f"fb_{i}", "footbot_gripper")[-1]["gripping"]]
        yield Row(f"gripper: reach in {engine}", "assumption", "docs/engines.md", 0.02, max(held, default=0), 0.001, "steps of 1 mm", "m")


@scene(GROUP)
def scanner(lab):
    who = probe("c", sensors={"footbot_distance_scanner": {"rotation_speed": 1}})
    arena = footbot("fb", 5.0, 5.0, 0, "c") + block("n", "5,5.9,0.5", "4,0.2,1") + block("s", "5,4.1,0.5", "4,0.2,1") + block("e", "5.3,5,0.5", "0.2,4,1")
    worst, count = 0, 0
    for now in lab.run(arena, who, ENGINE, 60).readings("fb", "footbot_distance_scanner"):
        for i in range(24):
            if f"reading {i} angle" not in now:
                continue
            angle, distance = now[f"reading {i} angle"], now[f"reading {i} distance"]
            hits = [side / f for side, f in ((0.2, math.cos(angle)), (0.8, math.sin(angle)), (0.8, -math.sin(angle))) if f > 1e-9]
            if hits and distance not in (0, 0.26, 1.42):
                worst, count = max(worst, abs(distance - (min(hits) - RADIUS))), count + 1
    yield Row(f"distance scanner between three walls: {count} readings", "ray and plane", GEOMETRY, 0, worst, ROUNDING, "rounding", "m")


@scene(GROUP)
def eyes(lab):
    pilot = probe("e", [(0, 10, "eyebot_laser", 0.5, 0.3), (0, 10, "eyebot_propellers", 0, 0, 0, 0)], sensors={"eyebot_altitude": {}})
    watcher = probe("w", sensors={"footbot_omnidirectional_camera": {"aperture": 85}})
    arena = element("eyebot", {"id": "e", "position": "5,5,2", "controller": "e"}) + footbot("w", 6.0, 5.0, 0, "w")
    result = lab.run(arena, pilot + watcher, "dynamics3d", 5, size="10,10,5")
    x, y = 5 + 2 * math.tan(0.3) * math.cos(0.5), 5 + 2 * math.tan(0.3) * math.sin(0.5)
    now = result.readings("w", "footbot_omnidirectional_camera")[-1]
    yield Row("laser: distance of its spot from a footbot", "P = o + h tan(tilt) (cos pan, sin pan)", GEOMETRY, math.hypot(x - 6, y - 5), now["blob 0 distance"], 1e-4, "hovering", "m")
    yield Row("altitude of an eyebot", "h", GEOMETRY, 2, result.readings("e", "eyebot_altitude")[-1]["altitude"], 1e-4, "hovering", "m")


@scene(GROUP)
def near(lab):
    who = probe("c", sensors={"contact": {}, "tag_reader": {}})
    arena = footbot("fb", 5.0, 5.0, 20, "c") + prey("p", 5 + (RADIUS + 0.0511) * math.cos(1), 5 + (RADIUS + 0.0511) * math.sin(1), radius=0.05, height=0.1)
    arena += prey("q", 5.149, 5.0, radius=0.03, height=0.1) + prey("r", 4.849, 5.0, radius=0.03, height=0.1)
    result = lab.run(arena, who, ENGINE, 1)
    now = result.readings("fb", "contact")[0]
    yield Row("contact: direction of a prey 1.1 mm away", "angle of the centre - heading", GEOMETRY, 1 - math.radians(20), now.get("contact 0", math.nan), ROUNDING, "rounding", "rad")
    tags = result.readings("fb", "tag_reader")[0]
    yield Row("tag reader: tags at 0.149, 0.151 and 0.136 m", "range 0.15 m", "docs/devices.md", 2, len(set(tags) - {"tag fb"}), 0, "counts")


@scene(GROUP)
def directional_leds(lab):
    # A robot on each degree of a circle around one whose LED 0, 15° left of its front, is lit.
    limit, distance = 40, 1.0
    lamp = probe("l", [(0, 10, "directional_leds", RED, 0)], actuators={"directional_leds": {"observable_angle": limit}})
    watcher = probe("w", sensors={"footbot_omnidirectional_camera": {"aperture": 85}})
    turns = range(0, 90, 2 if lab.quick else 1)
    arena = "".join(footbot(f"l{a}", 2.0, 2.0 + 4 * i, -15.0 + a, "l") + footbot(f"w{a}", 2.0 + distance, 2.0 + 4 * i, 0, "w") for i, a in enumerate(turns))
    result = lab.run(arena, lamp + watcher, ENGINE, 3, size=f"6,{4 * len(turns) + 4},2")
    wrong = 0
    for a in turns:
        turn = math.radians(a)
        led = [(RADIUS + 0.005) * math.cos(turn), (RADIUS + 0.005) * math.sin(turn), 0.085]
        way = [distance - led[0], -led[1], 0.2887 - led[2]]
        off = math.acos((way[0] * math.cos(turn) + way[1] * math.sin(turn)) / math.hypot(*way))
        wrong += bool(result.readings(f"w{a}", "footbot_omnidirectional_camera")[-1]) != (off <= math.radians(limit))
    yield Row("directional LEDs: directions with a wrong view", "angle to the axis ≤ observable angle", f"{A3} directional_led_detector", 0, wrong, 0, "counts")


@scene(GROUP)
def depth_camera(lab):
    # The middle of an image of odd size looks along the axis.
    worst = 0
    for tilt, pan in ((0, 0), (-20, 0), (-35, 10), (0, 25)):
        who = probe("c", sensors={"depth_camera": {"width": 15, "height": 11, "tilt": tilt, "pan": pan, "position": "0.1,0,0.4"}})
        result = lab.run(footbot("fb", 5.0, 5.0, 0, "c") + block("w", "7.1,5,1", "0.2,9,2"), who, ENGINE, 1)
        ahead = math.cos(math.radians(tilt)) * math.cos(math.radians(pan))
        wall, floor = 1.9 / ahead, 0.4 / math.sin(math.radians(-tilt)) if tilt < 0 else math.inf
        worst = max(worst, abs(result.readings("fb", "depth_camera")[0]["depth in the middle"] - min(wall, floor)))
    yield Row("depth camera: 4 depths of wall and floor along the axis", "ray and plane", GEOMETRY, 0, worst, ROUNDING, "rounding", "m")
    who = probe("c", sensors={"depth_camera": {"width": 101, "height": 1, "position": "0.1,0,0.2"}})
    result = lab.run(footbot("fb", 5.0, 5.0, 0, "c") + prey("p", 7.0, 5.0, radius=0.3, height=0.5), who, ENGINE, 1)
    yield Row("depth camera: nearest of a cylinder", "d - r", GEOMETRY, 1.6, result.readings("fb", "depth_camera")[0]["nearest"], ROUNDING, "rounding", "m")
    who = probe("c", sensors={"depth_camera": {"width": 1, "height": 1, "position": "0.1,0,0.2", "depth_noise_kind": "gaussian", "depth_noise_deviation": 0.02}})
    ticks = 2000 if lab.quick else 20000
    depths = [now["depth in the middle"] for now in lab.run(footbot("fb", 5.0, 5.0, 0, "c") + block("w", "7.1,5,1", "0.2,9,2"), who, ENGINE, ticks, every=ticks).readings("fb", "depth_camera")]
    yield Row("depth camera: deviation of the depth", "σ", "normal", 0.02, deviation(depths), 4 * 0.02 / math.sqrt(2 * ticks), "4 s.e.", "m")


@scene(GROUP)
def range_scanner(lab):
    # Robots with one beam each, in many directions: to a wall, to a cylinder, and to the floor from the lower of two layers.
    def distances(bodies, pans, parameters):
        who = "".join(probe(f"c{i}", sensors={"range_scanner": {"beams": 1, "pan": pan, **parameters}}) for i, pan in enumerate(pans))
        result = lab.run("".join(footbot(f"fb{i}", 5.0, 4.0 + 8 * i, 0, f"c{i}") + bodies(4.0 + 8 * i) for i in range(len(pans))), who, ENGINE, 1,
                         size=f"10,{8 * len(pans)},3")
        return [result.readings(f"fb{i}", "range_scanner")[0]["nearest"] for i in range(len(pans))]

    pans = list(range(-60, 61, 15))
    found = distances(lambda y: block(f"w{y}", f"7.1,{y},1", "0.2,7,2"), pans, {"position": "0.1,0,0.2", "range": 5})
    worst = max(abs(distance - 1.9 / math.cos(math.radians(pan))) for pan, distance in zip(pans, found))
    yield Row("range scanner: 9 beams to a wall", "d / cos α", GEOMETRY, 0, worst, ROUNDING, "rounding", "m")
    pans = [-14.4, -10, -5, 0, 5, 10, 14.4]
    found = distances(lambda y: prey(f"p{y}", 7.0, y, radius=0.5, height=1), pans, {"range": 3})
    worst = max(abs(distance - 2 * math.cos(math.radians(pan)) + math.sqrt(0.25 - 4 * math.sin(math.radians(pan)) ** 2)) for pan, distance in zip(pans, found))
    yield Row("range scanner: 7 beams to a cylinder", "ray and circle", GEOMETRY, 0, worst, ROUNDING, "rounding", "m")
    pans = [-170, -30, 0, 100]
    found = distances(lambda y: "", pans, {"layers": 2, "vertical_field_of_view": 30, "position": "0,0,0.3", "range": 3})
    yield Row("range scanner: 4 beams of a lower layer to the floor", "h / sin ε", GEOMETRY, 0, max(abs(distance - 0.3 / math.sin(math.radians(15))) for distance in found),
              ROUNDING, "rounding", "m")
    who = probe("c", sensors={"range_scanner": {"beams": 1, "noise_kind": "gaussian", "noise_deviation": 0.02}})
    ticks = 2000 if lab.quick else 20000
    found = [now["nearest"] for now in lab.run(footbot("fb", 5.0, 5.0, 0, "c") + block("w", "7.1,5,1", "0.2,9,2"), who, ENGINE, ticks, every=ticks).readings("fb", "range_scanner")]
    yield Row("range scanner: deviation of the distance", "σ", "normal", 0.02, deviation(found), 4 * 0.02 / math.sqrt(2 * ticks), "4 s.e.", "m")


@scene(GROUP)
def hands(lab):
    # A plate across the claws of both hands, at rest: the six sensors that look ahead are on the palms.
    plate = 0.012
    shoulder = 0.06
    palm = shoulder + 0.138
    who = probe("c", sensors={"handbot_proximity": {"range": 0.1}})
    result = lab.run(element("handbot", {"id": "h", "position": "5,5,0", "controller": "c"}) + block("w", f"{5 + palm + 0.058 + plate + 0.05!r},5,0.5", "0.1,2,1"), who, ENGINE, 1)
    now = result.readings("h", "handbot_proximity")[0]
    expected = 1 - (0.058 + plate) / 0.1
    worst = max(abs(now[f"{side} {i}"] - expected) for side in ("left", "right") for i in range(3, 9))
    yield Row("handbot proximity: a wall before the palms, 12 readings", "1 - d / range", GEOMETRY, 0, worst, ROUNDING, "rounding")


@scene(GROUP)
def more_eyes(lab):
    eyebot = lambda who, heading=0: element("eyebot", {"id": "e", "position": "5,5,2", "orientation": f"0,0,{heading}", "controller": who})
    hover = (0, 10, "eyebot_propellers", 0, 0, 0, 0)
    pilot = probe("e", [hover, (0, 10, "eyebot_laser", 0.5, 0.4)], sensors={"eyebot_pan_tilt_camera": {"range": 3}})
    robot, lamp = lit("b", 5.9, 5.5, GREEN)
    result = lab.run(eyebot("e", 10) + robot, pilot + lamp, "dynamics3d", 5, size="10,10,5")
    now = result.readings("e", "eyebot_pan_tilt_camera")[-1]
    blob = next(i for i in range(9) if int(now[f"blob {i} colour"]) == GREEN)
    way = (0.9, 0.5, 0.174249733 - 2)
    bearing = math.atan2(way[1], way[0]) - math.radians(10)
    height = "hovering, sinking"
    yield Row("camera that turns: distance of a beacon", "√(Δx² + Δy² + Δz²)", GEOMETRY, math.hypot(*way), now[f"blob {blob} distance"], 1e-3, height, "m")
    yield Row("camera that turns: bearing", "atan2(Δy, Δx) - heading", GEOMETRY, bearing, now[f"blob {blob} angle"], 1e-3, height, "rad")
    yield Row("camera that turns: elevation", "atan2(Δz, √(Δx² + Δy²))", GEOMETRY, math.atan2(way[2], math.hypot(way[0], way[1])), now[f"blob {blob} elevation"], 1e-3, height, "rad")

    who = probe("c", [hover], sensors={"proximity": {}, "eyebot_distance_scanner": {}})
    result = lab.run(eyebot("c") + block("w", "7.05,5,2", "0.1,9,3"), who, "dynamics3d", 2, size="10,10,5", arena_walls="false")
    now = result.readings("e", "proximity")[0]
    worst = 0
    for i, angle in enumerate(angles()):
        distance = (2 - 0.255 * math.cos(angle)) / math.cos(angle) if math.cos(angle) > 1e-9 else math.inf
        beside = abs(math.sin(angle)) * (0.255 + distance) if distance < 9 else math.inf
        worst = max(worst, abs(now[str(i)] - (1 - distance / 3 if distance < 3 and beside < 4.5 else 0)))
    yield Row("proximity of an eyebot beside a wall: 24 readings", "1 - d / 3 m", GEOMETRY, 0, worst, 1e-4, "hovering")
    now = result.readings("e", "eyebot_distance_scanner")[0]
    worst = 0
    for i in range(32):
        angle, distance = now[f"reading {i} angle"], now[f"reading {i} distance"]
        hit = 2 / math.cos(angle) if math.cos(angle) > 1e-9 else math.inf
        worst = max(worst, abs(distance - (hit if abs(hit * math.sin(angle)) < 4.5 else 15)))
    yield Row("eyebot distance scanner beside a wall: 32 readings", "ray and plane, 15 m", GEOMETRY, 0, worst, 1e-4, "hovering", "m")


@scene(GROUP)
def turret(lab):
    who = probe("c", [(0, 20, "footbot_turret", 0.7)], sensors={"footbot_turret_encoder": {}, "footbot_gripper": {}})
    now = lab.run(footbot("fb", 5.0, 5.0, 0, "c"), who, ENGINE, 21).readings("fb", "footbot_turret_encoder")
    yield Row("turret encoder: angle after 2 s at 0.7 rad/s", "ω t", GEOMETRY, 1.4, now[20]["angle"], ROUNDING, "rounding", "rad")


@scene(GROUP)
def floor(lab):
    who = probe("c", sensors={"footbot_base_ground": {}, "footbot_motor_ground": {}})
    patch = element("ground_patch", {"id": "g", "position": "2.5,2,0", "size": "1,1", "colour": "60, 120, 200"})
    result = lab.run(footbot("fb", 2.0, 2.0, 10, "c") + patch, who, ENGINE, 2)
    turn, grey = math.radians(10), (0.299 * 60 + 0.587 * 120 + 0.114 * 200) / 255
    base = ((0.08, 0), (0.042, 0.065), (0, 0.08), (-0.042, 0.065), (-0.08, 0), (-0.042, -0.065), (0, -0.08), (0.042, -0.065))
    motor = ((0.063, 0.0116), (-0.063, 0.0116), (-0.063, -0.0116), (0.063, -0.0116))
    ahead = lambda place: place[0] * math.cos(turn) - place[1] * math.sin(turn) > 0
    now = result.readings("fb", "footbot_base_ground")[0]
    yield Row("base ground: wrong sensors of 8 at the edge of a grey patch", "1 from a brightness of 0.5 on, else 0", f"{A3} footbot_base_ground_rotzonly_sensor.cpp@27e16d78", 0,
              sum(now[str(i)] != (float(grey >= 0.5) if ahead(place) else 1) for i, place in enumerate(base)), 0, "counts")
    now = result.readings("fb", "footbot_motor_ground")[0]
    yield Row("motor ground: 4 sensors at the edge of a patch", "0.299 R + 0.587 G + 0.114 B; places", f"ITU-R BT.601; {A3} footbot_entity.cpp@c6aa94d6", 0,
              max(abs(now[str(i)] - (grey if ahead(place) else 1)) for i, place in enumerate(motor)), ROUNDING, "rounding")
