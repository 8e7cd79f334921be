# The tests load these controllers, kinds, functions and renderers when a scene names them.
get_property(SAMPLES GLOBAL PROPERTY SWARMANOID_SAMPLES)
add_dependencies(unit_every_plugin ${SAMPLES})
foreach(renderer image_render figure_render opengl_render ogre_render web_render ros2_render foxglove_render)
  if(TARGET ${renderer})
    add_dependencies(unit_every_plugin ${renderer})
  endif()
endforeach()
