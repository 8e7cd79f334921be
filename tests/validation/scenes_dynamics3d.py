"""The 3D rigid-body engine against mechanics of rigid bodies under gravity."""
import math

from experiment import block, element, footbot, prey, probe, slope
from report import PROMISES, Row, scene
from scenes_dynamics2d import COLLISION, COULOMB, G, NEWTON, launched, speeds, stopping
from scenes_kinematics2d import SOURCE, arc, drive, unwrapped

GROUP = "3D rigid-body engine"


@scene(GROUP)
def dynamics3d_drive(lab):
    poses = drive(lab, 0.1, 0.1, "dynamics3d")
    yield Row("dynamics3d: straight, speed from the second second on", "v", SOURCE, 0.1, (poses[-1][0] - poses[10][0]) / 9, 1e-4, "promised", "m/s")
    poses = drive(lab, 0.05, 0.1, "dynamics3d")
    angles = unwrapped([p[5] for p in poses])
    rate = arc(0.05, 0.1, 1)[2]
    yield Row("dynamics3d: yaw rate of an arc", "(r - l) / b", SOURCE, rate, (angles[-1] - angles[10]) / 9, 0.02 * rate,
              "2 %, slip in turns", "rad/s")


@scene(GROUP)
def dynamics3d_fall(lab):
    steps, errors = [], []
    for step in (20, 10, 5, 2.5, 1.25):
        track = lab.run(block("b", "5,5,8", "0.2,0.2,0.2", movable="true", mass=1), "", "dynamics3d", 10, size="10,10,10", step_ms=step).track("b")
        steps.append(step / 1000)
        errors.append(abs(8 - track[-1][2] - G / 2))
        if step == 5:
            yield Row("dynamics3d: free fall of 1 s", "g t² / 2", NEWTON, G / 2, 8 - track[-1][2], 1.001 * G * 0.005 / 2, "g h t / 2, h = 5 ms", "m")
    order = slope([math.log(h) for h in steps], [math.log(e) for e in errors])
    yield Row("dynamics3d: order of convergence, free fall", "1, symplectic Euler", "Hairer", 1, order, 0.05,
              "fit, 20 … 1.25 ms")
    yield {"name": "convergence3d", "caption": "Error of a free fall of 1 s over the step, dynamics3d", "x": "step (s)", "y": "error (m)", "log": True,
           "series": [("measured", steps, errors)], "curves": [("g h t / 2", steps, [G * h / 2 for h in steps])]}


@scene(GROUP)
def dynamics3d_bounce(lab):
    track = lab.run(block("b", "5,5,2.1", "0.2,0.2,0.2", movable="true", mass=1), "", "dynamics3d", 200, 10, size="10,10,10").track("b")
    z = [p[2] - 0.1 for p in track]
    yield Row("dynamics3d: cube dropped from 2 m, e = 0, highest afterwards", "0", "restitution", 0, max(z[z.index(min(z)):]), 1e-3, "1 mm", "m")
    track = lab.run(block("b", "5,5,2.1", "0.2,0.2,0.2", movable="true", mass=1, restitution=0.8), "", "dynamics3d", 400, 10, size="10,10,10").track("b")
    z = [p[2] - 0.1 for p in track]
    peaks = [b for a, b, c in zip(z, z[1:], z[2:]) if a < b >= c]
    for n, peak in enumerate(peaks[:3], 1):
        yield Row(f"dynamics3d: cube dropped from 2 m, e = 0.8, height of bounce {n}", "e²ⁿ h", "restitution", 2 * 0.64 ** n, peak, 0.025 * n * 0.8 ** n,
                  "2.5 cm · n eⁿ", "m")
    yield {"name": "bounce", "caption": "A cube dropped from 2 m, e = 0.8, dynamics3d", "x": "time (s)", "y": "height (m)",
           "series": [("engine", [0.01 * i for i in range(len(z))], z)], "lines": [(f"e^{2 * n} h", 2 * 0.64 ** n) for n in (1, 2, 3)], "thin": True}


@scene(GROUP)
def dynamics3d_friction(lab):
    for mu in (0.05, 0.1):
        track = launched(lab, "dynamics3d", hold=60, prey={"ground_friction": mu, "mass": 1}).track("p")
        v, way = stopping(track, 65)
        yield Row(f"dynamics3d: sliding prey, friction {mu}, way to rest", "v² / (2 µ g)", COULOMB, v * v / (2 * mu * G), way, 0.0075 * v,
                  "7.5 ms · v", "m")


def incline(lab, degrees, arena, ticks=10, **more):
    return lab.run(arena, "", "dynamics3d", ticks, size="20,20,20", orientation=f"0,{degrees},0", position="10,10,10", **more)


def on_incline(degrees, x, z):
    a = math.radians(degrees)
    return f"{10 + x * math.cos(a) + z * math.sin(a)!r},10,{10 - x * math.sin(a) + z * math.cos(a)!r}"


def along(track, degrees):
    a = math.radians(degrees)
    return [(p[0] - 10) * math.cos(a) - (p[2] - 10) * math.sin(a) for p in track]


@scene(GROUP)
def dynamics3d_incline(lab):
    for degrees, mu in ((30, 0.3), (20, 0.4)):
        arena = block("b", on_incline(degrees, 0, 0.05), "0.4,0.4,0.1", orientation=f"0,{degrees},0", movable="true", mass=2)
        way = along(incline(lab, degrees, arena, friction=mu).track("b"), degrees)
        a = G * (math.sin(math.radians(degrees)) - mu * math.cos(math.radians(degrees)))
        expected = max(0, a / 2)
        yield Row(f"dynamics3d: block on a slope of {degrees}°, µ = {mu}, way in 1 s", "t² g (sin α - µ cos α) / 2, or 0", COULOMB, expected, way[-1] - way[0],
                  max(1e-3, 0.01 * expected), "1 %; at rest 1 mm", "m")
    a = math.radians(10)
    cylinder = prey("p", 0, 0, radius=0.1, height=0.2, mass=1).replace('position="0,0,0"', f'position="{10 + 0.1 * math.sin(a)!r},10.1,{10 + 0.1 * math.cos(a)!r}" orientation="90,0,0"')
    way = along(incline(lab, 10, cylinder, friction=0.8).track("p"), 10)
    yield Row("dynamics3d: cylinder that rolls down 10°, way in 1 s", "t² g sin α / 3", "solid cylinder, I = m r² / 2", G * math.sin(a) / 3, way[-1] - way[0],
              0.01 * G * math.sin(a) / 3, "1 %", "m")


@scene(GROUP)
def dynamics3d_pendulum(lab):
    a = math.radians(5)
    who = probe("c", [(0, 0, "handbot_rope", 0)], sensors={"handbot_joints": {}})
    robot = element("handbot", {"id": "h", "position": "5,5,0.5", "controller": "c"})
    result = lab.run(robot, who, "dynamics3d", 1500, 10, size="10,10,3", ceiling="true", gravity=f"0,{G * math.sin(a)!r},{-G * math.cos(a)!r}")
    rope = result.readings("h", "handbot_joints")[-1]["rope length"]
    y = [p[1] for p in result.track("h")]
    middle = (max(y) + min(y)) / 2
    crossings = [i + (middle - p) / (q - p) for i, (p, q) in enumerate(zip(y, y[1:])) if p < middle <= q]
    period = 0.01 * (crossings[-1] - crossings[0]) / (len(crossings) - 1)
    yield Row("dynamics3d: handbot on its rope, period", "2π √(l / g) (1 + α² / 16)", "pendulum, α = 5°", 2 * math.pi * math.sqrt((rope + 0.09) / G) * (1 + a * a / 16),
              period, 0.01 * period, "1 %, no point, fans damp", "s")


@scene(GROUP)
def dynamics3d_winch(lab):
    who = probe("c", [(0, 0, "handbot_rope", 0), (1, 100, "handbot_rope", -0.1)], sensors={"handbot_joints": {}})
    robot = element("handbot", {"id": "h", "position": "5,5,0", "controller": "c"})
    z = [p[2] for p in lab.run(robot, who, "dynamics3d", 60, size="10,10,3", ceiling="true").track("h")]
    yield Row("dynamics3d: handbot pulled up by its winch at 0.1 m/s, speed", "v", "rope", 0.1, (z[-1] - z[20]) / ((len(z) - 21) * 0.1), 1e-3, "1 %", "m/s")


def tower(links, joint, origin, axis, kind, more=""):
    """A heavy tower with one more link on a joint, as a URDF file."""
    heavy = '<inertial><mass value="500"/><inertia ixx="50" iyy="50" izz="50"/></inertial><collision><geometry><box size="0.4 0.4 1"/></geometry></collision>'
    return f'''<robot name="tower"><link name="tower">{heavy}</link><link name="moved">{links}</link><joint name="{joint}" type="{kind}">
<parent link="tower"/><child link="moved"/><origin xyz="{origin}"/><axis xyz="{axis}"/>{more}</joint></robot>'''


BAR = f'<inertial><origin xyz="0 0 -0.25"/><mass value="0.4"/><inertia ixx="{0.4 * 0.25 / 12!r}" iyy="{0.4 * 0.25 / 12!r}" izz="{0.4 * 0.25 / 12!r}"/></inertial>'
STANDING = element("jointed", {"id": "j", "position": "5,5,0", "controller": "c"})


@scene(GROUP)
def dynamics3d_joints(lab):
    who = probe("c", sensors={"joints": {}})
    a = math.radians(5)
    urdf = tower(BAR, "swing", "0 0.3 0.3", "1 0 0", "continuous")
    angles = [now["swing position"] for now in lab.run(STANDING, who, "dynamics3d", 1000, 10, kinds={"jointed": urdf},
                                                       gravity=f"0,{G * math.sin(a)!r},{-G * math.cos(a)!r}").readings("j", "joints")]
    middle = (max(angles) + min(angles)) / 2
    crossings = [i + (middle - p) / (q - p) for i, (p, q) in enumerate(zip(angles, angles[1:])) if p < middle <= q]
    period = 0.01 * (crossings[-1] - crossings[0]) / (len(crossings) - 1)
    yield Row("dynamics3d: bar on a free joint, period", "2π √(2 l / (3 g)) (1 + α² / 16)", "pendulum, α = 5°, l = 0.5 m",
              2 * math.pi * math.sqrt(1 / (3 * G)) * (1 + a * a / 16), period, 0.005 * period, "0.5 %", "s")
    yield Row("dynamics3d: bar on a free joint, swing after 10 s", "2 α", "energy", 2 * a, max(angles[-200:]) - min(angles[-200:]), 0.05 * a, "2.5 %", "rad")

    level = tower(BAR, "swing", "0 0.3 0.3", "1 0 0", "revolute", '<limit lower="-2" upper="2" effort="2" velocity="1.5"/>')
    who = probe("c", [(0, 100, "joints", math.pi / 2)], sensors={"joints": {}}, actuators={"joints": {}})
    now = lab.run(STANDING, who, "dynamics3d", 60, kinds={"jointed": level}).readings("j", "joints")
    yield Row("dynamics3d: motor that turns a bar, speed", "v", "limit of the joint", 1.5, now[6]["swing velocity"], 0.015, "1 %", "rad/s")
    yield Row("dynamics3d: motor that holds a level bar, effort", "m g l / 2", NEWTON, 0.4 * G * 0.25, now[-1]["swing effort"], 0.01 * 0.4 * G * 0.25, "1 %", "N m")

    plate = '<inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01"/></inertial><collision><geometry><box size="0.3 0.3 0.02"/></geometry></collision>'
    lift = tower(plate, "lift", "0 0 0.52", "0 0 1", "prismatic", '<limit lower="0" upper="0.5" effort="40" velocity="0.25"/>')
    who = probe("c", [(0, 100, "joints", 0.4)], sensors={"joints": {}}, actuators={"joints": {}})
    load = block("b", "5,5,1.081", "0.1,0.1,0.1", movable="true", mass=1)
    result = lab.run(STANDING + load, who, "dynamics3d", 40, kinds={"jointed": lift})
    yield Row("dynamics3d: load on a slider, lifted by", "x", "position of the joint", 0.4, result.track("b")[-1][2] - 1.08, 0.004, "1 %", "m")
    yield Row("dynamics3d: slider under the load, effort", "m g", NEWTON, 3 * G, result.readings("j", "joints")[-1]["lift effort"], 0.03 * G, "1 %", "N")


@scene(GROUP)
def dynamics3d_stack(lab):
    cubes, seconds = (10, 10) if lab.quick else (20, 60)
    arena = "".join(block(f"b{i}", f"5,5,{0.1 + 0.2 * i!r}", "0.2,0.2,0.2", movable="true") for i in range(cubes))
    result = lab.run(arena, "", "dynamics3d", 10 * seconds, size="10,10,10", every=10 * seconds)
    off = max(math.hypot(p[0] - 5, p[1] - 5) for p in (result.track(f"b{i}")[-1] for i in range(cubes)))
    yield Row("dynamics3d: a pile of cubes stands, furthest off", "0", "statics", 0, off, 0.005, "promised", "m")


@scene(GROUP)
def dynamics3d_headon(lab):
    who = probe("c", [(0, 1000, "footbot_wheels", 0.1, 0.1)])
    for order in (("a", "b"), ("b", "a")):
        places = {"a": (4.85, 0), "b": (5.15, 180)}
        arena = "".join(footbot(name, places[name][0], 5.0, places[name][1], "c") for name in order)
        result = lab.run(arena, who, "dynamics3d", 150)
        middle = [(p[0] + q[0]) / 2 for p, q in zip(result.track("a"), result.track("b"))]
        yield Row(f"dynamics3d: equal footbots head-on, {order[0]} listed first, drift", "0", "symmetry", 0, (middle[-1] - middle[50]) / 10, 5e-4,
                  "promised", "m/s")


@scene(GROUP)
def dynamics3d_motor(lab):
    # The controller's actuator limits speeds to 0.3 m/s: what speeds the robot up is the torque, T (1 - ω / ω₀) at the rim.
    who = probe("c", [(0, 200, "footbot_wheels", 2, 2)], actuators={"footbot_wheels": {"max_speed": 2}})
    x = [p[0] - 1 for p in lab.run(footbot("fb", 1.0, 5.0, 0, "c"), who, "dynamics3d", 100, 10, size="10,10,2").track("fb")]
    v0, force, mass = 0.6, 2 * 0.73 * 1.6 * G / 2, 3.2
    tau = mass * v0 / force
    yield Row("dynamics3d: footbot commanded to 2 m/s, way in 1 s", "v₀ (t - τ (1 - e^(-t/τ))), τ = m v₀ / F", "docs/engines.md", v0 * (1 - tau * (1 - math.exp(-1 / tau))), x[-1],
              0.006, "promised", "m")
    yield {"name": "motor", "part": PROMISES, "caption": "A footbot of dynamics3d that is commanded to 2 m/s", "x": "time (s)", "y": "way (m)", "thin": True,
           "series": [("engine", [0.01 * i for i in range(len(x))], x)],
           "curves": [("closed form", [0.01 * i for i in range(len(x))], [v0 * (0.01 * i - tau * (1 - math.exp(-0.01 * i / tau))) for i in range(len(x))])]}


@scene(GROUP)
def dynamics3d_collision(lab):
    momenta = []
    for mass, restitution in ((1, 1), (3, 1), (1, 0.5), (3, 0)):
        other = prey("q", 4.0, 5.0, radius=0.1, height=0.1, mass=mass, ground_friction=0, friction=0, restitution=restitution)
        result = launched(lab, "dynamics3d", hold=60, ticks=900, more=other, prey={"mass": 1, "ground_friction": 0, "friction": 0})
        p, q = speeds(result.track("p")), speeds(result.track("q"))
        before, after, hit = p[120], p[-1], q[-1]
        expected = before * (1 + restitution) / (1 + mass)
        yield Row(f"dynamics3d: collision, M/m = {mass}, e = {restitution}, speed", "v (1 + e) / (1 + M/m)", COLLISION, expected, hit,
                  0.03 / (1 + mass) + 0.001 * before, "overlaps", "m/s")
        momenta.append(Row(f"dynamics3d: collision, M/m = {mass}, e = {restitution}, momentum", "m v + M V", COLLISION, before, after + mass * hit, 1e-3 * before,
                           "0.1 %", "kg m/s"))
    yield from momenta


@scene(GROUP)
def dynamics3d_tipping(lab):
    for degrees, expected in ((24, 0), (29, 1)):
        arena = block("b", on_incline(degrees, 0, 0.2), "0.2,0.2,0.4", orientation=f"0,{degrees},0", movable="true", mass=2)
        beta = incline(lab, degrees, arena, 20, friction=2).track("b")[-1][4]
        yield Row(f"dynamics3d: tall block on {degrees}°, tips", "from atan(1/2) = 26.6° on", "statics", expected, float(abs(beta - degrees) > 20), 0, "yes or no")


@scene(GROUP)
def dynamics3d_eyebot(lab):
    who = probe("c", [(0, 99, "eyebot_propellers", 0, 0, 0, 0), (100, 200, "eyebot_propellers", 0.3, 0, 0, 0.5)])
    track = lab.run(element("eyebot", {"id": "e", "position": "3,5,1", "controller": "c"}), who, "dynamics3d", 200).track("e")
    yield Row("dynamics3d: eyebot hovers 10 s, furthest off", "0", "thrust of its weight", 0, max(math.dist(p[:3], (3, 5, 1)) for p in track[:100]), 1e-4, "promised", "m")
    angles = unwrapped([p[5] for p in track])
    yield Row("dynamics3d: eyebot's yaw rate", "as commanded", "docs/engines.md", 0.5, (angles[-1] - angles[150]) / ((len(angles) - 151) * 0.1), 1e-3, "0.2 %", "rad/s")


@scene(GROUP)
def dynamics3d_sensors(lab):
    who = probe("c", [(0, 0, "footbot_gripper", 1), (1, 100, "footbot_gripper", 1), (5, 100, "footbot_wheels", -0.05, -0.05)],
                sensors={"footbot_accelerometer": {}, "footbot_turret_torque": {}, "footbot_encoders": {}})
    arena = footbot("fb", 5.0, 5.0, 0, "c") + prey("p", 5.187, 5.0, radius=0.1, height=0.15, mass=1, ground_friction=0.3)
    result = lab.run(arena, who, "dynamics3d", 60)
    up = result.readings("fb", "footbot_accelerometer")[3]["up"]
    yield Row("dynamics3d: accelerometer at rest", "g", "definition", G, up, 0.01, "0.1 %", "m/s²")
    pulls = [now["forward traction"] for now in result.readings("fb", "footbot_turret_torque")[30:]]
    yield Row("dynamics3d: traction sensor while a prey of 1 kg is dragged", "µ m g / 25 N", COULOMB, 0.3 * G / 25, sum(pulls) / len(pulls), 0.05 * 0.3 * G / 25, "5 %, see above")
    x = [p[0] for p in result.track("fb")]
    rolled = [now["left"] * 0.029112741 * 0.1 for now in result.readings("fb", "footbot_encoders")]
    yield Row("dynamics3d: encoders against the way, 3 s", "Σ r ω t", SOURCE, x[55] - x[25], sum(rolled[26:56]), 0.01 * abs(x[55] - x[25]), "1 %, slip", "m")
