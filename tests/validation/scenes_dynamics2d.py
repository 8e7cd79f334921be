"""The 2D rigid-body engine against mechanics of rigid bodies on a plane."""
import math

from experiment import block, footbot, prey, probe, slope
from report import Row, scene
from scenes_kinematics2d import SOURCE, arc, drive, unwrapped

GROUP = "2D rigid-body engine"
G = 9.81
COULOMB = "Coulomb"
NEWTON = "Newton"
COLLISION = "collision"


def launched(lab, engine, hold=40, ticks=300, more="", **parameters):
    """A footbot pushes the prey 'p' of 0.1 m along x for `hold` ticks of 10 ms, then stops."""
    who = probe("c", [(0, hold, "footbot_wheels", 0.3, 0.3), (hold + 1, ticks, "footbot_wheels", 0, 0)])
    first = parameters.pop("prey", {})
    arena = footbot("fb", 2.0, 5.0, 0, "c") + prey("p", 2.2051, 5.0, radius=0.1, height=0.1, **first) + more
    return lab.run(arena, who, engine, ticks, 10, **parameters)


def speeds(track, dt=0.01):
    return [(b[0] - a[0]) / dt for a, b in zip(track, track[1:])]


def stopping(track, after, dt=0.01):
    """Speed at tick `after`, and the way from there to the end."""
    return (track[after][0] - track[after - 1][0]) / dt, track[-1][0] - track[after][0]


@scene(GROUP)
def dynamics2d_drive(lab):
    poses = drive(lab, 0.1, 0.1, "dynamics2d")
    yield Row("dynamics2d: straight, speed from the second second on", "v", SOURCE, 0.1, (poses[-1][0] - poses[10][0]) / 9, 5e-7, "single precision", "m/s")
    poses = drive(lab, 0.05, 0.1, "dynamics2d")
    angles = unwrapped([p[5] for p in poses])
    rate = arc(0.05, 0.1, 1)[2]
    yield Row("dynamics2d: yaw rate of an arc", "(r - l) / b", SOURCE, rate, (angles[-1] - angles[10]) / 9, 1e-5 * rate, "single precision", "rad/s")
    centre_radius = 0.075 / rate
    cx, cy = 3, 5 + centre_radius
    radii = [math.hypot(p[0] - cx, p[1] - cy) for p in poses[10:]]
    yield Row("dynamics2d: radius of the arc", "v / ω", SOURCE, centre_radius, sum(radii) / len(radii), 1e-5,
              "single precision", "m")


@scene(GROUP)
def dynamics2d_acceleration(lab):
    for name, form, expected, parameters in (
            ("motors of 1 N", "F / m", 1 / 1.6, {"drive_force": 1}),
            ("wheels of friction 0.05", "µ g", 0.05 * G, {"wheel_friction": 0.05})):
        who = probe("c", [(0, 100, "footbot_wheels", 0.3, 0.3)])
        track = lab.run(footbot("fb", 2.0, 5.0, 0, "c"), who, "dynamics2d", 40, 10, **parameters).track("fb")
        v = speeds(track)
        yield Row(f"dynamics2d: acceleration with {name}", form, NEWTON, expected, (v[35] - v[5]) / 0.3, 1e-5 * expected, "single precision", "m/s²")


@scene(GROUP)
def dynamics2d_friction(lab):
    for mu in (0.05, 0.1):
        track = launched(lab, "dynamics2d", prey={"ground_friction": mu}).track("p")
        v, way = stopping(track, 45)
        yield Row(f"dynamics2d: sliding prey, friction {mu}, way to rest", "v² / (2 µ g)", COULOMB, v * v / (2 * mu * G), way, v * 0.0075,
                  "7.5 ms · v", "m")
    for name, part, expected in (("lighter", 0.9, 0.1), ("heavier", 1.1, 0.0)):
        mass = part * 0.8 * 1.6 / 0.5  # wheel friction times weight of the robot over ground friction
        who = probe("c", [(0, 100, "footbot_wheels", 0.1, 0.1)])
        arena = footbot("fb", 2.0, 5.0, 0, "c") + prey("p", 2.2051, 5.0, radius=0.1, height=0.1, mass=mass)
        track = lab.run(arena, who, "dynamics2d").track("p")
        yield Row(f"dynamics2d: a prey 10 % {name} than wheels can push, speed", "v if µ_prey m g < µ_wheel M g, else 0", COULOMB, expected,
                  (track[-1][0] - track[50][0]) / ((len(track) - 51) * 0.1), 5e-6, "single precision", "m/s")


@scene(GROUP)
def dynamics2d_collision(lab):
    momenta = []
    for mass, restitution in ((1, 1), (3, 1), (1, 0.5), (3, 0)):
        other = prey("q", 4.0, 5.0, radius=0.1, height=0.1, mass=mass, ground_friction=0, restitution=restitution)
        result = launched(lab, "dynamics2d", ticks=700, more=other, prey={"mass": 1, "ground_friction": 0})
        p, q = speeds(result.track("p")), speeds(result.track("q"))
        before, after, hit = p[100], p[-1], q[-1]
        expected = before * (1 + restitution) / (1 + mass)
        yield Row(f"dynamics2d: collision, M/m = {mass}, e = {restitution}, speed", "v (1 + e) / (1 + M/m)", COLLISION, expected, hit,
                  1e-6, "single precision", "m/s")
        momenta.append(Row(f"dynamics2d: collision, M/m = {mass}, e = {restitution}, momentum", "m v + M V", COLLISION, before, after + mass * hit, 1e-6,
                           "single precision", "kg m/s"))
    yield from momenta


@scene(GROUP)
def dynamics2d_convergence(lab):
    steps, errors = [], []
    for substeps in (1, 2, 4, 8, 16):
        who = probe("c", [(0, 100, "footbot_wheels", 0.3, 0.3)])
        track = lab.run(footbot("fb", 2.0, 5.0, 0, "c"), who, "dynamics2d", 4, 100, substeps=substeps, drive_force=1).track("fb")
        steps.append(0.1 / substeps)
        errors.append(abs(track[-1][0] - 2 - 0.5 * 1 / 1.6 * 0.4 ** 2))
    order = slope([math.log(h) for h in steps], [math.log(e) for e in errors])
    yield Row("dynamics2d: order of convergence, accelerated footbot", "1, symplectic Euler", "Hairer", 1,
              order, 1e-6, "single precision, 100 … 6.25 ms")
    yield {"name": "convergence2d", "caption": "Error of the way after 0.4 s over the step, dynamics2d", "x": "step (s)", "y": "error (m)", "log": True,
           "series": [("measured", steps, errors)], "curves": [("a h t / 2", steps, [0.5 / 1.6 * h * 0.4 for h in steps])]}


@scene(GROUP)
def dynamics2d_groups(lab):
    """Robots that push each other in a pen: any number of threads, and robots far away, change no bit."""
    promise = "docs/engines.md#contact-groups"
    ticks = 60 if lab.quick else 300

    def run(more="", who="", **parameters):
        walls = "".join(block(f"wall{k}", f"{x},{y},0.1", size, movable="false") for k, (x, y, size) in enumerate((
            (2, 1, "2.2,0.1,0.2"), (2, 3, "2.2,0.1,0.2"), (1, 2, "0.1,2.2,0.2"), (3, 2, "0.1,2.2,0.2"))))
        robots = "".join(footbot(f"fb{k}", 1.3 + 0.24 * (k % 6), 1.3 + 0.24 * (k // 6), 67.0 * k, f"c{k % 3}") for k in range(36))
        drives = "".join(probe(f"c{k}", [(0, ticks, "footbot_wheels", 0.02 + 0.03 * k, 0.08 - 0.02 * k)]) for k in range(3))
        result = lab.run(walls + robots + more, drives + who, "dynamics2d", ticks, **parameters)
        return [result.track(f"fb{k}") for k in range(36)]

    def differences(a, b):
        return sum(p != q for one, other in zip(a, b) for p, q in zip(one, other))
    alone = run(threads=1)
    for threads in (2, 3):
        yield Row(f"dynamics2d: poses of a pen that {threads} threads change", "0", promise, 0, differences(alone, run(threads=threads)), 0, "counts")
    others = "".join(footbot(f"far{k}", 7 + 0.2 * (k % 4), 7 + 0.2 * (k // 4), 50.0 * k, "away") for k in range(16))
    away = probe("away", [(0, ticks, "footbot_wheels", 0.1, 0.07)])
    yield Row("dynamics2d: poses of a pen that robots 4 m away change", "0", promise, 0, differences(alone, run(others, away, threads=1)), 0, "counts")
