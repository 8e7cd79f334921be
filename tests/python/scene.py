"""A scene of footbots that Python steers, for the tests of this folder."""

from world.case import controller, devices, experiment

SENSORS = devices(["generic_footbot_proximity", "generic_footbot_omnidirectional_camera"]) + (
    '<footbot_distance_scanner implementation="generic_footbot_distance_scanner" rotation_speed="0.7"/>')
ARENA = """<block id="wall" position="3,2,0.25" size="0.1,4,0.5"/>
    <footbot id="a" position="2,1,0" controller="driver"/><footbot id="b" position="1,3,0" orientation="0,0,90" controller="driver"/>"""


def write(folder, tag="external_controller", ticks=100, parameters=""):
    return experiment(folder / f"{tag}.xml", f"<maxclock>{ticks}</maxclock>",
                      controller(tag, ["dummy_footbot_wheels", "generic_footbot_leds"], SENSORS, parameters, "driver"), ARENA, "4,4,1")
