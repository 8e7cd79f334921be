"""Flying robots and wind: the Crazyflie by its published rotors and drag, the drift in engines of the plane, and the statistics of gusts."""
import math

from experiment import deviation, element, mean, probe
from report import ROUNDING, Row, scene

GROUP = "Flight"
RANDOM, LEVEL = "MIL-F-8785C, 3.7.3.4", "dynamics3d"
FORSTER = "Förster 2015"
KINDS = {"crazyflie": "crazyflie"}
HOVER = (0, 10000, "eyebot_propellers", 0, 0, 0, 0)
MASS, GRAVITY, HEIGHT = 0.027, 9.81, 0.029
PLACE, MOST_ACROSS = 3, 3.5  # of the autopilot in user/entities/crazyflie: rad/s, m/s²


def crazyflie(name, x, y, z):
    return element("crazyflie", {"id": name, "position": f"{x!r},{y!r},{z!r}", "controller": "c"})


def wind(velocity, **more):
    return element("wind", {"velocity": velocity, **more})


def rotor_speed(thrust):
    """rad/s for a thrust in N, by the thrust and the speed of a command."""
    p0, p1, p2, w0, w1 = 5.484560e-4, 1.032633e-6, 2.130295e-11, 380.8359, 0.04076521
    return w0 + w1 * (-p1 + math.sqrt(p1 * p1 + 4 * p2 * (thrust - p0))) / (2 * p2)


def steady(across):
    """Air speed and tilt at which the drag balances an acceleration across: drag -W K u along the axes of the robot, W the sum of four rotors."""
    k, kz, up = 9.1785e-7, 10.311e-7, 0
    for _ in range(50):
        tilt = math.atan2(across, GRAVITY + up)
        rotors = 4 * rotor_speed(MASS * math.hypot(across, GRAVITY + up) / 4)
        speed = MASS * across / (rotors * (k * math.cos(tilt) ** 2 + kz * math.sin(tilt) ** 2))
        up = -rotors * speed * (k - kz) * math.sin(tilt) * math.cos(tilt) / MASS
    return speed, tilt


def across_in(speed):
    low, high = 0, 10
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if steady(middle)[0] < speed else (low, middle)
    return low


@scene(GROUP)
def crazyflies_in_wind(lab):
    """The place loop has no integral, so a robot stands where its spring balances the drag of its rotors at the speed for its weight."""
    for speed in (1, 3):
        track = lab.run(crazyflie("c", 5.0, 5.0, 2.0) + wind(f"{speed}, 0, 0"), probe("c", [HOVER]), LEVEL, 120, kinds=KINDS).track("c")
        # The centre of mass is at half the height of the robot, which leans.
        off = track[-1][0] - 5 + HEIGHT / 2 * math.sin(math.radians(track[-1][4]))
        yield Row(f"Crazyflie that hovers in a wind of {speed} m/s: distance from its place", "k W v / (m ω²), W for a thrust of m g", FORSTER, across_in(speed) / PLACE ** 2, off,
                  1e-6, "steady state", "m")
    expected = 25 - steady(MOST_ACROSS)[0]
    track = lab.run(crazyflie("c", 5.0, 5.0, 20.0) + wind("25, 0, 0"), probe("c", [HOVER]), LEVEL, 600, size="1000,10,40", kinds=KINDS, arena_walls="false").track("c")
    yield Row("Crazyflie in a storm of 25 m/s: drift at its largest tilt", "v - m a / (k W)", FORSTER, expected, (track[-1][0] - track[-2][0]) / 0.1, 1e-4, "steady state", "m/s")
    track = lab.run(crazyflie("c", 5.0, 5.0, 2.0), probe("c", [HOVER]), LEVEL, 100, kinds=KINDS).track("c")
    yield Row("Crazyflie that hovers in calm air: way in 10 s", "thrust m g", "geometry", 0, math.dist(track[-1][:3], (5, 5, 2)), 1e-6, "rounding of a sum", "m")


@scene(GROUP)
def drift_in_planes(lab):
    for engine, tolerance in (("dummy_engine", ROUNDING), ("dynamics2d", 1e-3)):
        track = lab.run(crazyflie("c", 2.0, 2.0, 0.0) + wind("0.3, 0.2, 0"), probe("c", [HOVER]), engine, 101, kinds=KINDS).track("c")
        way = math.dist(track[-1][:2], track[20][:2])
        expected = math.hypot(0.3, 0.2) * 0.1 * (len(track) - 21)
        yield Row(f"{engine}: drift with the wind", "v t", "docs/flying.md", expected, way, tolerance if engine == "dummy_engine" else tolerance * expected,
                  "rounding" if engine == "dummy_engine" else "single precision", "m")


@scene(GROUP)
def gusts(lab):
    """Robots that are far from each other drift for a tick in independent gusts; pairs of them are half a length apart."""
    pairs, scale = (200 if lab.quick else 1000), 10
    base = 0.177 + 0.000823 * 20
    sigma, length = 0.1 * scale / base ** 0.4, 20 * 0.3048 / base ** 1.2
    arena = wind("1, 0, 0", gusts=scale, height=6.096)
    for k in range(pairs):
        arena += crazyflie(f"a{k}", 10 + 200.0 * k, 5.0, 0.0) + crazyflie(f"b{k}", 10 + 200 * k + length / 2, 5.0, 0.0)
    result = lab.run(arena, probe("c", [HOVER]), "dummy_engine", 3, size=f"{200 * pairs + 100},10,3", kinds=KINDS)
    drift = {name: [(track[-1][axis] - track[-2][axis]) / 0.1 for axis in (0, 1)] for name, track in ((name, result.track(name)) for k in range(pairs) for name in (f"a{k}", f"b{k}"))}
    for axis, word, correlation in ((0, "along the wind", math.exp(-0.5)), (1, "across the wind", 0.75 * math.exp(-0.5))):
        first, second = ([drift[f"{name}{k}"][axis] - (1 - axis) for k in range(pairs)] for name in "ab")
        yield Row(f"gusts {word}: deviation at 6.1 m, wind of 10 m/s", "0.1 W / (0.177 + 0.000823 h)^0.4, h in feet", RANDOM, sigma, deviation(first), 4 * sigma / math.sqrt(2 * pairs), "4 s.e.", "m/s")
        form = "exp(-r / L)" if axis == 0 else "(1 - r / 2 L) exp(-r / L)"
        measured = mean([a * b for a, b in zip(first, second)]) / sigma ** 2
        yield Row(f"gusts {word}: correlation half a length further on", form, RANDOM, correlation, measured, 4 * math.sqrt((1 + correlation ** 2) / pairs), "4 s.e.")
