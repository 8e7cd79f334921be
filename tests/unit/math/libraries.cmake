# The reference of reproducible_math_test.cpp, with 113 bits.
target_link_libraries(unit_math PRIVATE quadmath)
add_library(conversions OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/libraries/conversions.cpp)
target_include_directories(conversions PRIVATE ${CMAKE_SOURCE_DIR})
target_compile_options(conversions PRIVATE ${SWARMANOID_WARNINGS} -O3)
target_link_libraries(unit_math PRIVATE conversions)
