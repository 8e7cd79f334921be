"""The 2D rigid-body engine against mechanics of rigid bodies on a plane."""
import math

from experiment import footbot, prey, probe, slope
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
    yield Row("dynamics2d: straight, speed from the second second on", "v", SOURCE, 0.1, (poses[-1][0] - poses[10][0]) / 9, 1e-6, "single precision", "m/s")
    poses = drive(lab, 0.05, 0.1, "dynamics2d")
    angles = unwrapped([p[5] for p in poses])
    rate = arc(0.05, 0.1, 1)[2]
    yield Row("dynamics2d: yaw rate of an arc", "(r - l) / b", SOURCE, rate, (angles[-1] - angles[10]) / 9, 1e-4 * rate, "single precision", "rad/s")
    centre_radius = 0.075 / rate
    cx, cy = 3, 5 + centre_radius
    radii = [math.hypot(p[0] - cx, p[1] - cy) for p in poses[10:]]
    yield Row("dynamics2d: radius of the arc", "v / ω", SOURCE, centre_radius, sum(radii) / len(radii), 1e-3,
              "slip at the start", "m")


@scene(GROUP)
def dynamics2d_acceleration(lab):
    for name, form, expected, parameters in (
            ("motors of 1 N", "F / m", 1 / 1.6, {"drive_force": 1}),
            ("wheels of friction 0.05", "µ g", 0.05 * G, {"wheel_friction": 0.05})):
        who = probe("c", [(0, 100, "footbot_wheels", 0.3, 0.3)])
        track = lab.run(footbot("fb", 2.0, 5.0, 0, "c"), who, "dynamics2d", 40, 10, **parameters).track("fb")
        v = speeds(track)
        yield Row(f"dynamics2d: acceleration with {name}", form, NEWTON, expected, (v[35] - v[5]) / 0.3, 0.001 * expected, "single precision", "m/s²")


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
                  (track[-1][0] - track[50][0]) / ((len(track) - 51) * 0.1), 1e-4, "0.1 %", "m/s")


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
                  0.002 * before, "single precision", "m/s")
        momenta.append(Row(f"dynamics2d: collision, M/m = {mass}, e = {restitution}, momentum", "m v + M V", COLLISION, before, after + mass * hit, 1e-4 * before,
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
              order, 0.05, "fit, 100 … 6.25 ms")
    yield {"name": "convergence2d", "caption": "Error of the way after 0.4 s over the step, dynamics2d", "x": "step (s)", "y": "error (m)", "log": True,
           "series": [("measured", steps, errors)], "curves": [("a h t / 2", steps, [0.5 / 1.6 * h * 0.4 for h in steps])]}
