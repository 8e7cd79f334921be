"""A scene of footbots that Python steers, for the tests of this folder."""
import pathlib

TEMPLATE = """<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>{ticks}</maxclock></framework>
  <controllers>
    <{tag} id="driver">
      <actuators>
        <footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels>
        <footbot_leds><implementation>generic_footbot_leds</implementation></footbot_leds>
      </actuators>
      <sensors>
        <footbot_proximity><implementation>generic_footbot_proximity</implementation></footbot_proximity>
        <footbot_omnidirectional_camera><implementation>generic_footbot_omnidirectional_camera</implementation></footbot_omnidirectional_camera>
        <footbot_distance_scanner implementation="generic_footbot_distance_scanner" rotation_speed="0.7"/>
      </sensors>
      <parameters>{parameters}</parameters>
    </{tag}>
  </controllers>
  <arena size="4, 4, 1" optimization="2D">
    <block id="wall"><position>3, 2, 0.25</position><orientation>0, 0, 0</orientation><size>0.1, 4, 0.5</size></block>
    <footbot id="a"><position>2, 1, 0</position><orientation>0, 0, 0</orientation><controller>driver</controller></footbot>
    <footbot id="b"><position>1, 3, 0</position><orientation>0, 0, 90</orientation><controller>driver</controller></footbot>
  </arena>
  <engines><dummy_engine id="ground"><perpendicular_axis>z</perpendicular_axis></dummy_engine></engines>
  <arena_physics><engine id="ground"><all/></engine></arena_physics>
</ahss-config>
"""


def write(folder, tag="external_controller", ticks=100, parameters=""):
    path = pathlib.Path(folder) / f"{tag}.xml"
    path.write_text(TEMPLATE.format(tag=tag, ticks=ticks, parameters=parameters))
    return path
