"""What swarms do: the same diffusion in all engines, by our rule and by that of ARGoS3's examples; and a pushed prey."""
import math

from experiment import block, controller, footbot, mean, prey, probe
from report import Row, scene
from scenes_kinematics2d import unwrapped

ENGINES = ("dummy_engine", "dynamics2d", "dynamics3d")


def diffusion(lab, rule, engine, robots, seconds, seed, delta=0.1):
    """Mean speed (m/s) and mean size of the yaw rate (rad/s) of robots at one per m²."""
    side = math.sqrt(robots)
    who = controller(rule, "c", {"footbot_wheels": {}}, {"footbot_proximity": {}}, {"velocity": 0.05, "delta": delta})
    walls = "".join(block(f"w{i}", f"{x},{y},0.25", size) for i, (x, y, size) in enumerate((
        (0, side / 2, f"0.1,{side},0.5"), (side, side / 2, f"0.1,{side},0.5"), (side / 2, 0, f"{side},0.1,0.5"), (side / 2, side, f"{side},0.1,0.5"))))
    arena = walls + f'<distribute quantity="{robots}"><footbot id="fb" controller="c"/></distribute>'
    result = lab.run(arena, who, engine, 10 * seconds, size=f"{side},{side},1", seed=seed, entities="footbot")
    speeds, turns = [], []
    for i in range(robots):
        track = result.track(f"fb_{i}")[50:]
        angles = unwrapped([p[5] for p in track])
        speeds += [math.dist(a[:2], b[:2]) / 0.1 for a, b in zip(track, track[1:])]
        turns += [abs(b - a) / 0.1 for a, b in zip(angles, angles[1:])]
    result.clear()
    return mean(speeds), mean(turns)


@scene("Swarms", quick=False)
def diffusions(lab):
    for rule, delta, engines in (("argos3_diffusion", 0.07, ENGINES[:2]), ("argos3_diffusion", 0.1, ENGINES), ("footbot_diffusion", 0.1, ENGINES)):
        for engine in engines:
            found = [diffusion(lab, rule, engine, 100, 100, seed, delta) for seed in (1, 2)]
            speed, turn = mean([s for s, _ in found]), mean([t for _, t in found])
            yield Row(f"{engine}: {rule}, delta {delta}, mean speed", "v - |ω| b / 2", "nothing holds",
                      0.05 - turn * 0.14 / 2, speed, 0.0005, f"1 %, mean |ω| {turn:.4f} rad/s", "m/s")


# Of the angle between the way and the middles of two discs, radii L in all: docs/engines.md.
def way_until_45(offset, reach, slower):
    return slower * reach * math.log(math.tan(math.pi / 8) / math.tan(math.asin(offset / reach) / 2))


@scene("Swarms")
def pushed_prey(lab):
    reach = 0.085036758 + 0.1
    for engine, friction, offset in (("dynamics2d", 0, 0.01), ("dynamics2d", 0.7, 0.01), ("dynamics2d", 0.7, 0.002),
                                     ("dynamics3d", 0, 0.01), ("dynamics3d", 0.5, 0.01), ("dynamics3d", 0.5, 0.002)):
        who = probe("c", [(0, 1000, "footbot_wheels", -0.05, -0.05)])
        arena = footbot("fb", 2.0, 5.0, 180, "c") + prey("p", 2.0002 + math.sqrt(reach * reach - offset * offset), 5.0 + offset, radius=0.1, height=0.1,
                                                         ground_friction=0.5)
        result = lab.run(arena, who, engine, 300, friction=friction)
        aside = next((q[0] - 2 for p, q in zip(result.track("p"), result.track("fb")) if abs(p[1] - q[1]) > p[0] - q[0]), math.inf)
        expected = way_until_45(offset, reach, 1 if friction == 0 else 1 + 4 / 9)
        yield Row(f"{engine}: prey pushed {1000 * offset:.0f} mm off its middle, friction {friction}, way to 45°", "L ln(…)" if friction == 0 else "(1 + 4/9) L ln(…)",
                  "docs/engines.md#a-prey-that-is-pushed-off-its-middle", expected, aside, (0.02 if engine == "dynamics2d" else 0.06) * expected,
                  "2 %" if engine == "dynamics2d" else "6 %, see above", "m")
    for engine, form, way in (("dummy_engine", "v t / 2: equal weights", 6 / 2 + 0.005), ("dynamics2d", "v t: carried along by a flat front", 6)):
        who = probe("c", [(0, 1000, "footbot_wheels", 0.1, 0.1)])
        arena = footbot("fb", 2.0, 5.0, 0, "c") + prey("p", 2.2, 5.01, radius=0.1, height=0.1)
        track = lab.run(arena, who, engine, 600, size="20,10,2").track("p")
        yield Row(f"{engine}: prey pushed 10 mm off its middle by a gripper, way in 60 s", form, "docs/engines.md", way, track[-1][0] - 2.2, 0.02, "start and one tick", "m")
