#include "tests/unit/experiment/fake_plugins.h"

namespace swarmanoid::test
{

const char* const kChapter4 = R"xml(<ahss-config>
  <!-- ***** -->
  <framework>

<clocktick>100</clocktick>
<maxclock>500</maxclock>
<controller_path> /path/to/swarmanoid_dev/user/pincy/simulation_build/\
  controllers/mycontroller1/.libs:/path/to/swarmanoid_dev/\
  user/pincy/simulation_build/controllers/mycontroller2/.libs
</controller_path>

  </framework>
  <!-- ***** -->
  <controllers>
    <footbot_sample_controller id="fc" library="footbot_sample_controller">
      <actuators>
        <footbot_wheels>
          <implementation> dummy_footbot_wheels </implementation>
        </footbot_wheels>
        <footbot_gripper>
          <implementation> dummy_footbot_gripper </implementation>
        </footbot_gripper>
      </actuators>
      <sensors>
        <pie_camera>
          <implementation> generic_pie_camera </implementation>
        </pie_camera>
        <footbot_proximity>
          <implementation> generic_footbot_polynomial_proximity
          </implementation>
        </footbot_proximity>
      </sensors>
      <parameters>
        <min_distance>7</min_distance>
        <wheels_speed>10</wheels_speed>
      </parameters>
    </footbot_sample_controller>
    <eyebot_sample_controller id="ec" library="eyebot_sample_controller">
      <actuators/>
      <sensors/>
      <parameters/>
    </eyebot_sample_controller>
  </controllers>
  <!-- ***** -->
  <arena size="10,10,3" optimization="2D">
    <footbot id="fb">
      <position>9, 9, 0</position>
      <orientation>0, 0, 45</orientation>
      <controller>fc</controller>
    </footbot>
    <eyebot id="eb">
      <position>5, 5, 1</position>
      <orientation>0, 0, 0</orientation>
      <controller>ec</controller>
    </eyebot>
    <block id="obstacle">
      <position>5, 5, .25</position>
      <orientation>0, 0, 0</orientation>
      <size>.5, .05, .5</size>
    </block>
    <cyllindric_prej id="cp">
      <position>8, 8, 0</position>
      <orientation>0, 0, 0</orientation>
      <radius>0.10</radius>
      <height>0.10</height>
    </cyllindric_prej>
  </arena>
  <!-- ***** -->
  <engines>
    <dummy_engine id="ground">
      <subclock>1</subclock>
      <perpendicular_axis>z</perpendicular_axis>
      <distance>0</distance>
    </dummy_engine>
    <dummy_engine id="sky">
      <subclock>1</subclock>
      <perpendicular_axis>z</perpendicular_axis>
      <distance>1</distance>
    </dummy_engine>
  </engines>
  <!-- ***** -->
  <arena_physics>
    <engine id="ground">
      <entity id="obstacle"/>
      <entity id="fb"/>
      <entity id="cp"/>
    </engine>
    <engine id="sky">
      <entity id="eb"/>
    </engine>
  </arena_physics>
  <!-- ***** -->
  <visualisations>
    <text_render id="text_world">
      <file>experiment_output.txt</file>
      <precision>2</precision>
    </text_render>
    <opengl_render id="mainwindow">
      <window_size>1024, 768</window_size>
      <window_title>Sample Experiment</window_title>
      <camera_view_XYZ_0>3.30811, 3.36071, 1.0</camera_view_XYZ_0>
      <camera_view_HPR_0>39, -34, 0</camera_view_HPR_0>
      <camera_view_XYZ_1>6.2875, 3.33551, 1.25</camera_view_XYZ_1>
      <camera_view_HPR_1>125, -21.5, 0</camera_view_HPR_1>
      <camera_view_XYZ_2>7.05332, 6.88148, 0.83</camera_view_XYZ_2>
      <camera_view_HPR_2>-155, 0, 0</camera_view_HPR_2>
      <use_textures>true</use_textures>
      <write_frames>false</write_frames>
      <frame_directory>Movies</frame_directory>
      <frame_filename>frame</frame_filename>
    </opengl_render>
  </visualisations>
</ahss-config>
)xml";

}  // namespace swarmanoid::test
