"""The kinematic engine against kinematics."""
import math

from experiment import block, deviation, footbot, mean, probe
from report import PROMISES, ROUNDING, Row, scene

BASE = 0.14  # m between the wheels
SOURCE = "unicycle"
RADIUS = 0.085036758


def drive(lab, left, right, engine, ticks=100, **more):
    who = probe("c", [(0, ticks, "footbot_wheels", left, right)])
    return lab.run(footbot("fb", 3.0, 5.0, 0, "c"), who, engine, ticks, **more).track("fb")


def unwrapped(degrees):
    turned = [math.radians(degrees[0])]
    for angle in degrees[1:]:
        turned.append(turned[-1] + math.remainder(math.radians(angle) - turned[-1], math.tau))
    return turned


def arc(left, right, seconds):
    speed, rate = (left + right) / 2, (right - left) / BASE
    return speed / rate * math.sin(rate * seconds), speed / rate * (1 - math.cos(rate * seconds)), rate * seconds


@scene("Kinematic engine")
def kinematic_drive(lab):
    x = drive(lab, 0.1, 0.1, "dummy_engine")[-1][0] - 3
    yield Row("kinematic: straight, 10 s at 0.1 m/s", "v t", SOURCE, 1, x, ROUNDING, "rounding", "m")
    poses = drive(lab, 0.05, 0.1, "dummy_engine")
    x, y, angle = arc(0.05, 0.1, 10)
    yield Row("kinematic: end of an arc, 10 s", "(v/ω) (sin ωt, 1 - cos ωt), ω = (r - l) / 0.14 m", SOURCE, 0,
              math.hypot(poses[-1][0] - 3 - x, poses[-1][1] - 5 - y), ROUNDING, "rounding", "m")
    yield Row("kinematic: angle of the arc", "ω t", SOURCE, angle, unwrapped([p[5] for p in poses])[-1], ROUNDING, "rounding", "rad")


@scene("Kinematic engine")
def kinematic_wheel_noise(lab):
    robots, ticks, sigma = (20, 200, 0.01) if lab.quick else (50, 1000, 0.01)
    who = probe("c", [(0, ticks, "footbot_wheels", 0.02, 0.02)],
                actuators={"footbot_wheels": {"noise_kind": "gaussian", "noise_deviation": sigma}})
    arena = "".join(footbot(f"fb_{i}", 4.0 * (i % 10) + 2, 4.0 * (i // 10) + 4, 0, "c") for i in range(robots))
    result = lab.run(arena, who, "dummy_engine", ticks, size="50,30,1")
    rates, speeds = [], []
    for i in range(robots):
        poses = result.track(f"fb_{i}")
        angles = unwrapped([p[5] for p in poses])
        turns = [b - a for a, b in zip(angles, angles[1:])]
        rates += [turn / 0.1 for turn in turns]
        # The chord of an arc is shorter than the arc.
        speeds += [math.dist(a[:2], b[:2]) / 0.1 * (turn / 2) / math.sin(turn / 2)
                   for a, b, turn in zip(poses, poses[1:], turns) if turn]
    n = len(rates)
    yield Row("kinematic: wheel noise, deviation of the yaw rate", "√2 σ / b", "independent wheels", math.sqrt(2) * sigma / BASE,
              deviation(rates), 4 * math.sqrt(2) * sigma / BASE / math.sqrt(2 * n), "4 s.e.", "rad/s")
    yield Row("kinematic: wheel noise, deviation of the speed", "σ / √2", "independent wheels", sigma / math.sqrt(2),
              deviation(speeds), 4 * sigma / math.sqrt(2) / math.sqrt(2 * n), "4 s.e.", "m/s")
    yield Row("kinematic: wheel noise, mean speed", "v", "noise of mean 0", 0.02, mean(speeds), 4 * sigma / math.sqrt(2 * n), "4 s.e.",
              "m/s")


@scene("Kinematic engine")
def kinematic_symmetry(lab):
    who = probe("c", [(0, 400, "footbot_wheels", 0.1, 0.1)])
    result = lab.run(footbot("a", 4.0, 5.0, 0, "c") + footbot("b", 6.0, 5.0, 180, "c"), who, "dummy_engine", 400)
    a, b = result.track("a"), result.track("b")
    worst = max(abs(p[0] + q[0] - 10) for p, q in zip(a, b))
    yield Row("kinematic: head-on, asymmetry in 40 s", "x₁ + x₂ stays", "symmetry", 0, worst, ROUNDING, "rounding", "m")
    gap = min(q[0] - p[0] for p, q in zip(a, b))
    yield Row("kinematic: head-on, nearest approach", "two grippers of 0.1 m in front", "docs/engines.md", 0.2, gap,
              0.004 * RADIUS, "promised", "m")


def deepest_overlap(poses):
    """Of bodies' circles, and of front corners of grippers in circles of others, m."""
    cells = {}
    for i, (x, y, *_) in enumerate(poses):
        cells.setdefault((int(x // 0.2), int(y // 0.2)), []).append(i)
    worst = 0
    for i, pose in enumerate(poses):
        x, y, heading = pose[0], pose[1], math.radians(pose[5])
        ahead, side = math.cos(heading), math.sin(heading)
        corners = [(x + 0.1 * ahead - s * side, y + 0.1 * side + s * ahead) for s in (-0.015, 0.015)]
        for j in (j for dx in (-1, 0, 1) for dy in (-1, 0, 1) for j in cells.get((int(x // 0.2) + dx, int(y // 0.2) + dy), ())):
            if j != i:
                other = poses[j][:2]
                worst = max(worst, 2 * RADIUS - math.dist((x, y), other), *(RADIUS - math.dist(corner, other) for corner in corners))
    return worst


@scene("Kinematic engine")
def kinematic_crowd(lab):
    densities = (10, 20) if lab.quick else (2, 5, 10, 15, 20, 22)
    worst = []
    for density in densities:
        row = 7 if lab.quick else 12
        count, spacing = row * row, 1 / math.sqrt(density)
        side = row * spacing + 0.1
        who = probe("c", [(0, 300, "footbot_wheels", 0.1, 0.09)])
        walls = "".join(block(f"w{i}", f"{x},{y},0.25", size) for i, (x, y, size) in enumerate((
            (0, side / 2, f"0.1,{side},0.5"), (side, side / 2, f"0.1,{side},0.5"), (side / 2, 0, f"{side},0.1,0.5"),
            (side / 2, side, f"{side},0.1,0.5"))))
        crowd = (f'<distribute quantity="{count}"><position method="grid" spacing="{spacing},{spacing},0" layout="{row},{row},1"/>'
                 '<footbot id="fb" controller="c"/></distribute>')
        result = lab.run(walls + crowd, who, "dummy_engine", 100 if lab.quick else 300, size=f"{side},{side},1", entities="footbot")
        ticks = sorted(result.poses["fb_0"])
        worst.append(max(deepest_overlap([result.poses[f"fb_{i}"][tick] for i in range(count)]) for tick in ticks[:: 5 if lab.quick else 3]))
        result.clear()
    for density, depth in zip(densities, worst):
        yield Row(f"kinematic: blind crowd, {density} per m², deepest overlap", "at most 0.4 % of the radius", "docs/engines.md", 0, depth,
                  0.004 * RADIUS + 1e-9, "promised", "m")
    yield {"name": "crowd", "part": PROMISES, "caption": "Deepest overlap in crowds of the kinematic engine", "x": "footbots per m²", "y": "deepest overlap (mm)",
           "series": [("measured", densities, [1000 * d for d in worst])], "lines": [("promised", 0.004 * RADIUS * 1000)]}
