"""What benchmarks of whole runs have in common: their swarm, and what a run says at its end."""
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# The last line of a run: ticks, entities, hash, seconds.
FINISHED = re.compile(r"^finished: (\d+) ticks, (\d+) entities, hash ([0-9a-f]{16}), ([0-9.e+-]+) s, ", re.MULTILINE)


def diffusion(robots):
    """The text of configs/diffusion_10.xml with another number of robots at the same density, without visualisations."""
    with open(os.path.join(ROOT, "configs", "diffusion_10.xml"), encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"<visualisations>.*</visualisations>", "", text, flags=re.DOTALL)
    text = text.replace("3.16228", f"{robots ** 0.5:.6g}").replace("1.58114", f"{robots ** 0.5 / 2:.6g}")
    # As docs/experiment_files.md advises for many robots.
    order = ' order="place"' if robots >= 10000 else ""
    return text.replace('quantity="10"', f'quantity="{robots}"{order}')


def diffusion_of_argos3(robots, ticks, examples):
    """The like for ARGoS3, with the controller of its examples, which were built in the folder `examples`."""
    side = robots ** 0.5
    walls = "".join(
        f'<box id="{name}" size="{sx:.6g},{sy:.6g},0.5" movable="false"><body position="{x:.6g},{y:.6g},0" orientation="0,0,0"/></box>'
        for name, x, y, sx, sy in (("west", -side / 2, 0, 0.1, side), ("east", side / 2, 0, 0.1, side),
                                   ("south", 0, -side / 2, side, 0.1), ("north", 0, side / 2, side, 0.1)))
    reach = side / 2 - 0.2
    return f"""<?xml version="1.0" ?>
<argos-configuration>
  <framework><system threads="0"/><experiment length="{ticks / 10:.6g}" ticks_per_second="10" random_seed="7"/></framework>
  <controllers>
    <footbot_diffusion_controller id="d" library="{examples}/controllers/footbot_diffusion/libfootbot_diffusion">
      <actuators><differential_steering implementation="default"/></actuators>
      <sensors><footbot_proximity implementation="default"/></sensors>
      <params alpha="7.5" delta="0.1" velocity="5"/>
    </footbot_diffusion_controller>
  </controllers>
  <arena size="{side + 1:.6g},{side + 1:.6g},1" center="0,0,0.5">{walls}
    <distribute>
      <position method="uniform" min="{-reach:.6g},{-reach:.6g},0" max="{reach:.6g},{reach:.6g},0"/>
      <orientation method="uniform" min="0,0,0" max="360,0,0"/>
      <entity quantity="{robots}" max_trials="100"><foot-bot id="fb"><controller config="d"/></foot-bot></entity>
    </distribute>
  </arena>
  <physics_engines><dynamics2d id="dyn2d"/></physics_engines>
  <media/>
</argos-configuration>
"""
