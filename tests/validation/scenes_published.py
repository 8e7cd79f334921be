"""Swarms and walks beside published numbers: Byers 2001, Kareiva and Shigesada 1983, Gauci et al. 2014."""
import math

from experiment import controller, mean
from report import VALIDATION, Row, scene
from scenes_kinematics2d import RADIUS

# Byers 2001, table 1: standard deviation of turns (degrees), mean step, distance after 1000 steps (both in the unit of the animal).
ANIMALS = (("nematode Steinernema carpocapsae", 19.66, 0.03515, 5.76), ("weevil Hylobius abietis", 23.99, 8.72, 1171), ("ant Tapinoma nigerrimum", 33.7, 2.68, 256),
           ("parasitoid Pnigalio soemius", 41.43, 0.2, 15.59), ("beetle Pterostichus melanarius", 44.68, 1.28, 92.62), ("ant Serrastruma lujae", 46.98, 1.5, 103),
           ("butterfly Pieris rapae", 48.06, 2.56, 172.44), ("beetle Eleodes extricata", 53.75, 4, 242), ("butterfly Euphydryas editha", 56.02, 7.16, 415.5))
STEP, COUNTS = 0.01, (50, 200, 500, 1000)  # m; steps


def walk(lab, deviation, seed):
    """Squared distances, in steps, from where each robot began, by number of steps. Ticks alternate between a step and a turn."""
    columns = 32
    who = controller("footbot_random_walk", "c", {"footbot_wheels": {}}, {}, {"step": STEP, "deviation": deviation})
    side = 20.0 * columns
    arena = (f'<distribute quantity="{columns * columns}"><position method="grid" centre="{side / 2},{side / 2},0" spacing="20,20,0" layout="{columns},{columns},1"/>'
             '<orientation method="uniform"/><footbot id="fb" controller="c"/></distribute>')
    result = lab.run(arena, who, "dummy_engine", 2000, tick_ms=1000, size=f"{side},{side},1", seed=seed, every=100)
    squares = {count: [(poses[2 * count][0] - poses[0][0]) ** 2 + (poses[2 * count][1] - poses[0][1]) ** 2 for poses in result.poses.values()] for count in COUNTS}
    result.clear()
    return {count: [square / STEP ** 2 for square in found] for count, found in squares.items()}


def square_of(count, cosine):
    """Mean squared distance of a correlated random walk of unit steps (Kareiva and Shigesada 1983, equation 1)."""
    return count + 2 * cosine / (1 - cosine) * (count - (1 - cosine ** count) / (1 - cosine))


def standard_error(values):
    middle = mean(values)
    return math.sqrt(math.fsum((v - middle) ** 2 for v in values) / (len(values) - 1) / len(values))


@scene("Random walks")
def byers(lab):
    shown = []
    for k, (animal, deviation, step, distance) in enumerate(ANIMALS):
        expected = distance / step
        found = [math.sqrt(square) for square in walk(lab, deviation, 10 + k)[1000]]
        shown.append((deviation, mean(found), expected))
        rounded = 0.5 * 10.0 ** -len(str(distance).partition(".")[2]) / step
        yield Row(f"{animal}, turns ±{deviation}°: distance after 1000 steps", "table 1", "Byers 2001", expected, mean(found),
                  4 * standard_error(found) + rounded, "4 s.e., rounded", "steps")
    deviations, measured, published = zip(*sorted(shown))
    yield {"name": "byers", "part": VALIDATION, "caption": "Distance after 1000 steps with random turns", "x": "standard deviation of turns (°)", "y": "distance (steps)",
           "series": [("footbots", deviations, measured), ("Byers 2001, table 1", deviations, published)]}


@scene("Random walks")
def kareiva(lab):
    for k, deviation in enumerate((15, 30, 45, 60, 90)):
        cosine = math.exp(-math.radians(deviation) ** 2 / 2)  # mean cosine of normal turns
        for count, squares in walk(lab, deviation, 30 + k).items():
            yield Row(f"turns ±{deviation}°: mean squared distance after {count} steps", "n + 2 c / (1 - c) (n - (1 - cⁿ) / (1 - c))", "Kareiva and Shigesada 1983",
                      square_of(count, cosine), mean(squares), 4 * standard_error(squares), "4 s.e.", "steps²")


def largest_cluster(places, reach):
    """Returns the share of robots in the largest cluster. Robots that are nearer to each other than `reach` (m) are in one cluster."""
    left, largest = set(range(len(places))), 0
    while left:
        cluster = [left.pop()]
        for robot in cluster:
            near = {other for other in left if math.dist(places[robot], places[other]) < reach}
            left -= near
            cluster += near
        largest = max(largest, len(cluster))
    return largest / len(places)


@scene("Swarms", quick=False)
def gauci(lab):
    # Their e-pucks with lengths times 2.3 and times doubled: configs/aggregation.xml. 40 robots, one body further than touching counts as apart.
    robots, trials, ticks = 40, 5, 9000
    who = controller("footbot_aggregation", "c", {"footbot_wheels": {}, "footbot_beacon": {}}, {"footbot_omnidirectional_camera": {"aperture": 89.9, "range": 100}},
                     {"free": "-0.0983, -0.1508", "seen": "0.1757, -0.1757"})
    half = math.sqrt(robots * math.pi * RADIUS ** 2 / 0.02) / 2
    arena = (f'<distribute quantity="{robots}"><position method="uniform" min="{6 - half},{6 - half},0" max="{6 + half},{6 + half},0"/><orientation method="uniform"/>'
             '<footbot id="fb" controller="c"/></distribute>')
    shares = []
    for seed in range(1, trials + 1):
        result = lab.run(arena, who, "dynamics2d", ticks, tick_ms=200, size="12,12,1", seed=seed, every=ticks)
        places = [track[max(track)][:2] for track in result.poses.values()]
        result.clear()
        shares.append(largest_cluster(places, 2 * RADIUS + 0.02))
    yield Row("40 robots without memory, share of the largest cluster after 30 min", "98.6 % of 40 e-pucks, mean of 30 trials", "Gauci et al. 2014", 0.986, mean(shares),
              1 / robots, "one robot")
