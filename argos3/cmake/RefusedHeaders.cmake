# These headers of ARGoS3 belong to parts that do not exist here. The build makes a header for each, whose inclusion is an error
# that names the alternative.
set(kEngines "engines and physics models written for ARGoS3 do not run here: see docs/own_engine.md for an engine of your own")
set(kIndices "positional indices of ARGoS3 do not exist here: find bodies by GetEmbodiedEntitiesIntersectedByRay, or by CSpace")
set(kRobots "this robot of ARGoS3 does not exist here: see docs/own_kind.md for a kind of robot of your own")
set(kParts "this part of robots does not exist here: docs/argos3.md lists those that do")
set(kDevices "this device of ARGoS3 does not exist here: docs/argos3.md lists those that do; REGISTER_SENSOR and REGISTER_ACTUATOR add others")
set(ENGINES simulator/physics_engines)
set(REFUSED_HEADERS
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_engine.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_model.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_single_body_object_model.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_multi_body_object_model.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_stretchable_object_model.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_differentialsteering_control.h
  kEngines:plugins/${ENGINES}/dynamics2d/dynamics2d_velocity_control.h
  kEngines:plugins/${ENGINES}/dynamics3d/dynamics3d_engine.h
  kEngines:plugins/${ENGINES}/dynamics3d/dynamics3d_model.h
  kEngines:plugins/${ENGINES}/dynamics3d/dynamics3d_single_body_object_model.h
  kEngines:plugins/${ENGINES}/dynamics3d/dynamics3d_plugin.h
  kEngines:plugins/${ENGINES}/pointmass3d/pointmass3d_engine.h
  kEngines:plugins/${ENGINES}/pointmass3d/pointmass3d_model.h
  kIndices:core/simulator/space/positional_indices/grid.h
  kIndices:core/simulator/space/positional_indices/positional_index.h
  kIndices:core/simulator/space/positional_indices/space_hash.h
  kRobots:plugins/robots/prototype/simulator/prototype_entity.h
  kRobots:plugins/robots/builderbot/simulator/builderbot_entity.h
  kRobots:plugins/robots/drone/simulator/drone_entity.h
  kParts:plugins/simulator/entities/quadrotor_entity.h
  kParts:plugins/simulator/entities/radio_equipped_entity.h
  kParts:plugins/simulator/entities/simple_radio_equipped_entity.h
  kParts:plugins/simulator/entities/magnet_equipped_entity.h
  kParts:plugins/simulator/entities/tag_entity.h
  kParts:plugins/simulator/entities/tag_equipped_entity.h
  kParts:plugins/simulator/entities/directional_led_entity.h
  kParts:plugins/simulator/entities/directional_led_equipped_entity.h
  kParts:plugins/simulator/entities/perspective_camera_equipped_entity.h
  kParts:plugins/simulator/entities/omnidirectional_camera_equipped_entity.h
  kParts:plugins/robots/foot-bot/simulator/footbot_turret_entity.h
  kParts:plugins/robots/foot-bot/simulator/footbot_distance_scanner_equipped_entity.h
  kParts:plugins/simulator/media/directional_led_medium.h
  kParts:plugins/simulator/media/tag_medium.h
  kParts:plugins/simulator/media/radio_medium.h
  kDevices:plugins/robots/generic/control_interface/ci_camera_sensor.h
  kDevices:plugins/robots/generic/control_interface/ci_radios_sensor.h
  kDevices:plugins/robots/generic/control_interface/ci_radios_actuator.h
  kDevices:plugins/robots/generic/control_interface/ci_simple_radios_sensor.h
  kDevices:plugins/robots/generic/control_interface/ci_simple_radios_actuator.h
  kDevices:plugins/robots/generic/control_interface/ci_magnets_actuator.h
  kDevices:plugins/robots/generic/control_interface/ci_tags_actuator.h
  kDevices:plugins/robots/generic/control_interface/ci_directional_leds_actuator.h
  kDevices:plugins/robots/pi-puck/control_interface/ci_pipuck_front_camera_sensor.h
  kDevices:plugins/robots/pi-puck/control_interface/ci_pipuck_imu_sensor.h
  kParts:plugins/robots/pi-puck/simulator/pipuck_differential_drive_entity.h
  kDevices:plugins/robots/prototype/control_interface/ci_prototype_joints_sensor.h
  kDevices:plugins/robots/prototype/control_interface/ci_prototype_joints_actuator.h)
foreach(header IN LISTS REFUSED_HEADERS)
  string(REGEX MATCH "^([A-Za-z]+):(.+)$" header ${header})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/argos3_refused/argos3/${CMAKE_MATCH_2} CONTENT "#error \"${${CMAKE_MATCH_1}}\"\n")
endforeach()
