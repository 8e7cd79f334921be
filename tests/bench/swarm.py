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
