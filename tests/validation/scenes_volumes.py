"""Robots and preys that change their engine at the border of its volume, x = 5 m."""
import itertools
import math

from experiment import footbot, prey, probe
from report import Row, scene

WEST, EAST = "0, 0, 5, 10", "5, 0, 10, 10"
ENGINES = ("dummy_engine", "dynamics2d", "dynamics3d")
RADIUS = 0.085036758  # m, of a footbot
SPEED, TICK = 0.2, 0.1  # m/s, s
PAGE = "docs/engines.md"


def between(west, east):
    return [(west, WEST), (east, EAST)]


@scene("Volumes")
def volumes_continuity(lab):
    """A robot drives across the border of each pair of engines."""
    ways = []
    for west, east in itertools.permutations(ENGINES, 2):
        who = probe("c", [(0, 100, "footbot_wheels", SPEED, SPEED)])
        poses = lab.run(footbot("fb", 4.0, 5.0, 20, "c"), who, ticks=100, volumes=between(west, east)).track("fb")[20:]
        ways += [math.dist(a[:3], b[:3]) for a, b in zip(poses, poses[1:])]
    yield Row("volumes: way in a tick at a border, 6 pairs", "v t", PAGE, SPEED * TICK, max(ways, key=lambda way: abs(way - SPEED * TICK)), 2e-4, "1 %", "m")


@scene("Volumes")
def volumes_momentum(lab):
    """A robot gives the prey its speed, and stops before the border."""
    friction, losses = 0.002, []
    for west, east in itertools.permutations(("dynamics2d", "dynamics3d")):
        who = probe("c", [(0, 20, "footbot_wheels", 0.3, 0.3), (20, 200, "footbot_wheels", 0.0, 0.0)])
        arena = footbot("fb", 3.8, 5.0, 0, "c") + prey("prey", 4.1, 5.0, radius=0.1, height=0.1, mass=0.5, ground_friction=friction, restitution=0)
        xs = [pose[0] for pose in lab.run(arena, who, ticks=200, volumes=between(west, east)).track("prey")]
        crossing = next(k for k, x in enumerate(xs) if x >= 5)
        # The speeds of two ticks before and two after differ by friction in the three ticks between their middles.
        before, after = (xs[crossing] - xs[crossing - 2]) / (2 * TICK), (xs[crossing + 3] - xs[crossing + 1]) / (2 * TICK)
        losses.append(before - after)
    expected = friction * 9.81 * 3 * TICK
    yield Row("volumes: loss of speed of a sliding prey at a border", "µ g t", PAGE, expected, max(losses, key=lambda loss: abs(loss - expected)), 0.002,
              "1 %", "m/s")


@scene("Volumes")
def volumes_solid_border(lab):
    """Bodies that meet at a border of two engines of a kind, and within one: a robot that stands, one that drives back, a prey."""
    who = probe("c", [(0, 60, "footbot_wheels", 0.15, 0.15)]) + probe("still", [(0, 60, "footbot_wheels", 0.0, 0.0)])
    others = (footbot("other", 5.1, 5.0, 0, "still"), footbot("other", 5.3, 5.0, 180, "c"),
              prey("other", 5.1, 5.0, radius=0.05, height=0.1, mass=0.2))
    differences = []
    for engine in ENGINES:
        for other in others:
            arena = footbot("driver", 4.5, 5.0, 0, "c") + other
            one, two = (lab.run(arena, who, ticks=60, volumes=engines) for engines in ([(engine, "0, 0, 10, 10")], between(engine, engine)))
            differences += [math.dist(one.track(body)[-1][:2], two.track(body)[-1][:2]) for body in ("driver", "other")]
    yield Row("volumes: bodies that meet at a border, 9 pairs", "as in one engine", PAGE, 0, max(differences), 0.03, "order of contacts; `dynamics3d`: ODE lets a braked robot creep at the border", "m")


@scene("Volumes")
def volumes_head_on(lab):
    """Two robots of different engines drive at each other; in ARGoS3 they change sides."""
    overlaps = []
    for west, east in itertools.permutations(ENGINES, 2):
        who = probe("c", [(0, 60, "footbot_wheels", 0.15, 0.15)])
        result = lab.run(footbot("a", 4.5, 5.0, 0, "c") + footbot("b", 5.5, 5.0, 180, "c"), who, ticks=60, volumes=between(west, east))
        overlaps.append(2 * RADIUS - min(math.dist(a[:2], b[:2]) for a, b in zip(result.track("a"), result.track("b"))))
    yield Row("volumes: overlap of footbots head-on, 6 pairs", "0", PAGE, 0, max(0.0, *overlaps), 0.002, "soft contacts", "m")
