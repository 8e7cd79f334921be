find_package(nlohmann_json REQUIRED)
target_link_libraries(unit_visualiser PRIVATE scene interaction nlohmann_json::nlohmann_json)

# swarmanoid_renderer_tests(LIBRARY RENDERER PATTERN) links LIBRARY and depends on RENDERER. If these are not part of the build, it
# leaves out the tests in files that match PATTERN.
function(swarmanoid_renderer_tests library renderer pattern)
  if(TARGET ${library})
    target_link_libraries(unit_visualiser PRIVATE ${library})
    add_dependencies(unit_visualiser ${renderer})
    return()
  endif()
  get_target_property(SOURCES unit_visualiser SOURCES)
  list(FILTER SOURCES EXCLUDE REGEX "${pattern}")
  set_target_properties(unit_visualiser PROPERTIES SOURCES "${SOURCES}")
endfunction()
swarmanoid_renderer_tests(offscreen image_render "(gl_scene|image_render)_test.cpp$")
swarmanoid_renderer_tests(figure figure_render "figure_render_test.cpp$")
