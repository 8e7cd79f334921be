# The tests load the plug-in, the kinds of robots and objects that their experiments have, and behaviours of Kilobots.
add_dependencies(unit_argos3 argos3_plugin argos3_program argos3_epuck argos3_demiurge_epuck argos3_kheperaiv argos3_pipuck argos3_spiri
  argos3_box kilobot version)
if(TARGET swarmanoid)
  add_dependencies(unit_argos3 kilo_blink kilo_gradient)
endif()
# The plug-in is a module that no program links, so these of its sources are compiled for the tests.
set(PARTS_OF_PLUGIN ${CMAKE_SOURCE_DIR}/argos3/plugin/device_noise.cpp ${CMAKE_SOURCE_DIR}/argos3/plugin/qt_keys.cpp)
target_sources(unit_argos3 PRIVATE ${PARTS_OF_PLUGIN})
set_source_files_properties(${PARTS_OF_PLUGIN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
