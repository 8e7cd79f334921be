"""The devices that the others do not need: further cameras, light from the air, microphones, joints, shown directions."""
import math

from experiment import block, deviation, element, footbot, probe
from report import ROUNDING, Row, scene
from scenes_devices import ENGINE, GEOMETRY, GREEN, GROUP, RED, angles, lit, ring
from scenes_kinematics2d import RADIUS

BEACON = 0.174  # m above the floor
HOVER = (0, 10, "eyebot_propellers", 0, 0, 0, 0)
HOVERS = "hovering, sinking"


def eyebot(who, heading=0):
    return element("eyebot", {"id": "e", "position": "5,5,2", "orientation": f"0,0,{heading}", "controller": who})


@scene(GROUP)
def pie_camera(lab):
    heading, colours = 25, {"red": RED, "green": GREEN}
    arena, who = footbot("w", 5.0, 5.0, heading, "w"), probe("w", sensors={"pie_camera": {"aperture": 85}})
    expected = {}
    for k in range(12):
        colour = ("red", "green")[k % 2]
        distance, angle = 0.35 + 0.05 * k, 0.2 + 2.4 * k
        robot, controller = lit(f"b{k}", 5 + distance * math.cos(angle), 5 + distance * math.sin(angle), colours[colour])
        arena, who = arena + robot, who + controller
        sector = int(math.degrees(angle - math.radians(heading)) % 360 // 30)
        name = f"{colour} {sector} distance"
        expected[name] = min(expected.get(name, math.inf), distance)
    now = lab.run(arena, who, ENGINE, 3).readings("w", "pie_camera")[-1]
    worst = max((abs(now.get(name, math.inf) - distance) for name, distance in expected.items()), default=math.inf)
    yield Row("pie camera: nearest beacon of each sector and colour", "√(Δx² + Δy²)", GEOMETRY, 0, worst, ROUNDING, "rounding", "m")
    yield Row("pie camera: sectors and colours that see something", "sectors of 30°, the first from the front on", "docs/devices.md", len(expected), sum(name.endswith(" distance") for name in now), 0, "counts")


@scene(GROUP)
def cameras_of_others(lab):
    robot, lamp = lit("b", 5.6, 5.4, GREEN)
    outside, other = lit("o", 6.2, 5.0, RED)
    result = lab.run(eyebot("e", 10) + robot + outside, probe("e", [HOVER], sensors={"eyebot_camera": {}}) + lamp + other, "dynamics3d", 5, size="10,10,5")
    now = result.readings("e", "eyebot_camera")[-1]
    yield Row("eyebot camera: distance of a beacon along the floor", "√(Δx² + Δy²)", GEOMETRY, math.hypot(0.6, 0.4), now["blob 0 distance"], 1e-3, HOVERS, "m")
    yield Row("eyebot camera: bearing", "atan2(Δy, Δx) - heading", GEOMETRY, math.atan2(0.4, 0.6) - math.radians(10), now["blob 0 angle"], 1e-3, HOVERS, "rad")
    yield Row("eyebot camera: beacons in view, one 33° off its axis", "aperture 30°", "ARGoS 2", 1, sum("colour" in name for name in now), 0, "counts")
    robot, lamp = lit("b", 6.0, 5.2, GREEN)
    handbot = element("handbot", {"id": "h", "position": "5,5,0", "controller": "h"})
    now = lab.run(handbot + robot, probe("h", sensors={"handbot_camera": {}}) + lamp, ENGINE, 3).readings("h", "handbot_camera")[-1]
    way = (6.0 - 5.09, 0.2, BEACON - 0.1)
    yield Row("handbot camera: distance of a beacon", "√(Δx² + Δy² + Δz²)", GEOMETRY, math.hypot(*way), now["blob 0 distance"], ROUNDING, "rounding", "m")
    yield Row("handbot camera: bearing", "atan2(Δy, Δx)", GEOMETRY, math.atan2(way[1], way[0]), now["blob 0 angle"], ROUNDING, "rounding", "rad")
    yield Row("handbot camera: elevation", "atan2(Δz, √(Δx² + Δy²))", GEOMETRY, math.atan2(way[2], math.hypot(*way[:2])), now["blob 0 elevation"], ROUNDING, "rounding", "rad")


@scene(GROUP)
def device_faults(lab):
    ticks, chance, factor, late = 400 if lab.quick else 4000, 0.3, 0.6, 5
    drives = probe("w", [(0, ticks, "footbot_wheels", 0.1, 0.1)], sensors={"positioning": {}})
    result = lab.run(footbot("w", 1.0, 5.0, 0, "w"), drives, ENGINE, ticks, size="40,10,4", faults=[
        {"device": "positioning", "kind": "drop", "value": chance, "from": 1}, {"device": "footbot_wheels", "kind": "scale", "value": factor}])
    way = result.track("w")[-1][0] - 1.0
    yield Row("faults: way of wheels with 0.6 of their speed", "0.6 v t", "docs/faults.md", factor * 0.1 * ticks * 0.1, way, 1e-11, "rounding of a sum", "m")
    read = [now["x"] for now in result.readings("w", "positioning")]
    lost = sum(now == before for before, now in zip(read, read[1:])) / (len(read) - 1)
    yield Row("faults: share of dropped readings", "p", "docs/faults.md", chance, lost, 4 * math.sqrt(chance * (1 - chance) / (len(read) - 1)), "4 standard deviations")
    result = lab.run(footbot("w", 1.0, 5.0, 0, "w"), drives, ENGINE, 100, size="20,10,4", faults=[{"device": "positioning", "kind": "delay", "value": late, "from": 20}])
    read, track = [now["x"] for now in result.readings("w", "positioning")], [place[0] for place in result.track("w")]
    worst = max(abs(read[tick] - track[tick - late]) for tick in range(20 + late, len(read)))
    yield Row("faults: readings that come 5 ticks late", "x(t - 5)", "docs/faults.md", 0, worst, ROUNDING, "rounding", "m")


@scene(GROUP)
def floor_field(lab):
    """One deposit of 5 in the middle of a cell, read 8 cells (the deviation) and more away."""
    cell, diffusion, rate, ticks = 0.05, 2.5e-3, 0.02, 322
    field = element("floor_field", {"id": "trail", "cell": cell, "evaporation": rate, "diffusion": diffusion})
    distances = (0, 0.2, 0.4, 0.8)
    sensor = {"floor_field": {"points": "; ".join(f"{distance}, 0" for distance in distances)}}
    now = lab.run(field + footbot("w", 5.025, 5.025, 30, "w"), probe("w", [(0, 0, "floor_field", 50), (1, 1, "floor_field", 0)], sensors=sensor), ENGINE, ticks).readings("w", "floor_field")[-1]
    time = (ticks - 2) * 0.1  # the deposit is in the field of tick 2, after a step; the last readings are of one tick before the end
    spread = 4 * diffusion * time
    for k, distance in enumerate(distances):
        expected = 5 / (math.pi * spread) * math.exp(-distance ** 2 / spread - rate * time)
        yield Row(f"floor field: value {distance} m from one deposit after {time:.0f} s", "M / (4 π D t) exp(-r² / (4 D t) - λ t)", "heat equation", expected, now[f"value {k}"],
                  0.006 * 5 / (math.pi * spread), "grid of 8 cells in a deviation", "1/m²")
    expected = -2 * 0.4 / spread * 5 / (math.pi * spread) * math.exp(-0.4 ** 2 / spread - rate * time)
    yield Row("floor field: gradient 0.4 m from one deposit, in the robot's frame", "∂/∂r of the value", "heat equation", expected, now["gradient x 2"], 0.02 * abs(expected), "grid", "1/m³")


@scene(GROUP)
def batteries(lab):
    """Robots that drive, shine, send and receive; one on a station, and two that share another one."""
    ticks, speed = 201, 0.1
    battery = {"implementation": "energy_battery", "capacity": 1000, "start": 0.5, "idle": 2, "wheels": 30, "led": 0.5, "sent": 0.01, "received": 0.003}
    drives = probe("w", [(0, ticks, "footbot_wheels", speed, speed)], sensors={"battery": battery})
    shines = probe("l", [(0, 0, "footbot_leds", 0xff0000)], sensors={"battery": battery})
    talks = probe("t", [(0, ticks, "range_and_bearing", 1, 2, 3)], sensors={"battery": battery, "range_and_bearing": {}})
    stands = probe("s", [], sensors={"battery": battery})
    arena = (footbot("w", 1.0, 1.0, 0, "w") + footbot("l", 1.0, 3.0, 0, "l") + footbot("t1", 1.0, 7.0, 0, "t") + footbot("t2", 2.0, 7.0, 0, "t") +
             footbot("s", 6.0, 6.0, 0, "s") + footbot("p", 9.0, 6.0, 0, "s") + footbot("q", 9.0, 6.3, 0, "s") +
             element("charging_station", {"id": "one", "position": "6,6,0", "radius": 0.3, "charging_power": 20}) +
             element("charging_station", {"id": "two", "position": "9,6.15,0", "size": "0.6,0.6", "charging_power": 20, "charging_limit": 30}))
    result = lab.run(arena, drives + shines + talks + stands, ENGINE, ticks)
    time = 200 * 0.1
    for robot, formula, power in (("w", "E - (P + k v) t", -2 - 30 * speed), ("l", "E - (P + 12 L) t", -2 - 12 * 0.5), ("s", "E + (C - P) t", 20 - 2),
                                  ("p", "E + (C / 2 - P) t", 15 - 2)):
        yield Row(f"energy battery: charge after {time:.0f} s, {dict(w='driving', l='12 LEDs lit', s='on a station', p='two on a station with a limit')[robot]}", formula, "docs/batteries.md",
                  (500 + power * time) / 1000, result.readings(robot, "battery")[200]["charge"], 1e-11, "rounding of a sum")
    received = 10 * 0.003 * 199  # the first message comes a tick after it is sent
    yield Row("energy battery: charge after 20 s, messages of 10 bytes sent and received", "E - P t - s n - r (n - 1)", "docs/batteries.md", (500 - 2 * time - 10 * 0.01 * 200 - received) / 1000,
              result.readings("t1", "battery")[200]["charge"], 1e-11, "rounding of a sum")


@scene(GROUP)
def shared_radio(lab):
    """20 robots send in each tick, in one of its slots; a packet gets through if no other one is in its slot."""
    senders, ticks = 20, 501
    arena = footbot("r", 5.0, 9.0, 0, "r")
    for k in range(senders):
        arena += footbot(f"s{k}", 0.3 + 0.45 * k, 1.0, 0, "s")
    for slots in (10, 20, 60):
        radio = {"implementation": "shared_radio", "range": 100, "capture": 1000, "slots": slots}
        who = probe("r", sensors={"radio": radio}) + probe("s", [(0, ticks, "radio", 1)])
        result = lab.run(arena, who, ENGINE, ticks + 1)
        heard = sum(1 if isinstance(value, (int, float)) else len(value) for now in result.readings("r", "radio") for name, value in now.items() if name.endswith(" length"))
        through, packets = (1 - 1 / slots) ** (senders - 1), senders * ticks
        yield Row(f"shared radio: packets of {senders} senders heard in one of {slots} slots", "N/m (1 - 1/m)^(N - 1)", "slotted ALOHA (Roberts 1975)", senders / slots * through,
                  heard / ticks / slots, 4 * math.sqrt(through * (1 - through) / packets) * senders / slots, "4 standard deviations")


@scene(GROUP)
def signals(lab):
    """One sender amid receivers on a circle: path loss, and shadowing that is drawn once for each link."""
    count, distance, sigma = (60 if lab.quick else 400), 20.0, 6
    sender = footbot("s", 30.0, 30.0, 0, "s")
    arena = sender + "".join(footbot(f"r{k}", 30 + distance * math.cos(math.tau * k / count), 30 + distance * math.sin(math.tau * k / count), 0, "r") for k in range(count))
    for shadowing in (0, sigma):
        radio = {"implementation": "shared_radio", "range": 2000, "path_loss": 3, "shadowing": shadowing}
        result = lab.run(arena, probe("r", sensors={"radio": radio}) + probe("s", [(0, 2, "radio", 1)]), ENGINE, 3, size="60,60,2")
        off = [value + 30 * math.log10(distance) for k in range(count) for name, value in result.readings(f"r{k}", "radio")[-1].items() if name.endswith("signal")]
        if shadowing == 0:
            yield Row("shared radio: signal 20 m away, path loss 3", "-10 n lg(d / 1 m)", "log-distance path loss", -30 * math.log10(distance), off[0] - 30 * math.log10(distance), ROUNDING * 100, "rounding", "dB")
        else:
            yield Row("shared radio: deviation of the signals of shadowed links", "σ", "normal", sigma, deviation(off), 4 * sigma / math.sqrt(2 * count), "4 s.e.", "dB")
    arena = footbot("near", 6.0, 5.0, 0, "s") + footbot("far", 3.0, 5.0, 0, "s") + footbot("r", 5.0, 5.0, 0, "r")
    for capture, expected in ((6.02, 1), (6.03, 0)):
        who = probe("r", sensors={"radio": {"implementation": "shared_radio", "range": 100, "capture": capture}}) + probe("s", [(0, 20, "radio", 1)])
        heard = len(lab.run(arena, who, ENGINE, 21).readings("r", "radio")[-1]) > 0
        yield Row(f"shared radio: packets heard of a sender twice as near as another one, {capture} dB needed", "1 if 20 lg 2 is enough", "power ratio", expected, float(heard), 0, "counts")


@scene(GROUP)
def eyebot_light(lab):
    turn = math.radians(20)
    bulb = element("light_bulb", {"id": "l", "position": "6,5.5,2.5", "intensity": 0.8})
    now = lab.run(eyebot("c", 20) + bulb, probe("c", [HOVER], sensors={"eyebot_light": {"implementation": "argos3_eyebot_light"}}), "dynamics3d", 2, size="10,10,5").readings("e", "eyebot_light")[0]
    strength = math.exp(-2 * math.sqrt(1 + 0.25 + 0.25) / 0.8)
    off = [abs(math.remainder(angle + turn - math.atan2(0.5, 1), math.tau)) for angle in angles()]
    worst = max(abs(reading - strength * max(0, 1 - a / (math.pi / 2))) for reading, a in zip(ring(now), off))
    yield Row("light of an eyebot as in ARGoS3: 24 readings", "exp(-2 d / I) max(0, 1 - |off| / 90°)", "ARGoS3 eyebot_light_rotzonly_sensor.cpp@de40bf19", 0, worst, 1e-4, "hovering")


@scene(GROUP)
def other_microphones(lab):
    arena = footbot("fb", 5.0, 5.0, 30, "c") + block("w", "6,5,0.5", "0.1,1,1")
    arena += element("sound_source", {"id": "a", "position": "7,5,0.1", "intensity": 2}) + element("sound_source", {"id": "b", "position": "5,8,0.1", "intensity": 1})
    heard = {}
    for kind in ("shadowed_microphone", "capsule_microphone"):
        heard[kind] = lab.run(arena, probe("c", sensors={"microphone": {"implementation": kind}}), ENGINE, 2).readings("fb", "microphone")[0]
    shadowed = heard["shadowed_microphone"]
    louder = sorted((shadowed[f"sound {i} loudness"] for i in range(2)), reverse=True)
    yield Row("microphone with shadows: source in the open, 3 m", "I / d", "spherical wave", 1 / 3, louder[0], ROUNDING, "rounding")
    yield Row("microphone with shadows: source behind a wall, 2 m", "0.25 I / d", "docs/devices.md", 0.25, louder[1], ROUNDING, "rounding")
    yield Row("microphone of one capsule: loudness of both", "√(p₁² + p₂²)", "incoherent", math.hypot(1, 1 / 3), heard["capsule_microphone"]["loudness"], ROUNDING, "rounding")
    yield Row("microphone of one capsule: directions", "none", "docs/devices.md", 0, sum("bearing" in name for name in heard["capsule_microphone"]), 0, "counts")


@scene(GROUP)
def joints(lab):
    speeds = (0.3, 0.5, 0.7, 0.9)
    who = probe("c", [(0, 9, "handbot_head", 0.2), (0, 9, "handbot_arms", *speeds)], sensors={"handbot_joints": {}})
    handbot = element("handbot", {"id": "h", "position": "5,5,0", "controller": "c"})
    now = lab.run(handbot, who, ENGINE, 12).readings("h", "handbot_joints")[10]
    errors = [now["head"] - 0.2] + [now[name] - speed for name, speed in zip(("left arm", "right arm", "left wrist", "right wrist"), speeds)]
    yield Row("handbot joints: 5 angles after 1 s", "ω t", GEOMETRY, 0, max(map(abs, errors)), ROUNDING, "rounding", "rad")
    who = probe("c", [(0, 100, "handbot_arms", 3, 3, 3, 3)], sensors={"handbot_joints": {}})
    now = lab.run(handbot, who, ENGINE, 30).readings("h", "handbot_joints")[-1]
    limits = (math.pi / 3, math.pi / 3, math.pi / 2, math.pi / 2)
    worst = max(abs(now[name] - limit) for name, limit in zip(("left arm", "right arm", "left wrist", "right wrist"), limits))
    yield Row("handbot joints: arms and wrists at their stops", "60° and 90°", "ARGoS 2", 0, worst, 5e-6, "stops are rounded", "rad")


@scene(GROUP)
def shown_direction(lab):
    # The LEDs at 45° and 75° are within half of 60° of it: they are one blob, half way between them.
    watcher = probe("w", sensors={"footbot_omnidirectional_camera": {"aperture": 85}})
    shower = probe("s", [(0, 10, "footbot_preferential_direction", RED, math.radians(60))], actuators={"footbot_preferential_direction": {"implementation": "led_ring_preferential_direction"}})
    now = lab.run(footbot("w", 5.0, 5.0, 0, "w") + footbot("s", 6.0, 5.5, 90, "s"), watcher + shower, ENGINE, 3).readings("w", "footbot_omnidirectional_camera")[-1]
    shown, out = math.radians(60 + 90), (RADIUS + 0.005) * math.cos(math.radians(15))
    place = (1 + out * math.cos(shown), 0.5 + out * math.sin(shown))
    yield Row("preferential direction: distance of its blob", "middle of the LEDs within 30° of it", GEOMETRY, math.hypot(*place), now["blob 0 distance"], ROUNDING, "rounding", "m")
    yield Row("preferential direction: bearing of its blob", "atan2(Δy, Δx)", GEOMETRY, math.atan2(place[1], place[0]), now["blob 0 angle"], ROUNDING, "rounding", "rad")
