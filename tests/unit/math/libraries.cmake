# quadmath is the reference of reproducible_math_test.cpp, with 113 bits. On aarch64 long double has as many.
if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  target_link_libraries(unit_math PRIVATE quadmath)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Clang does not look in the folder where GCC has its header, which has others that Clang must not find.
    execute_process(COMMAND ${CMAKE_C_COMPILER} -print-file-name=include/quadmath.h OUTPUT_VARIABLE header OUTPUT_STRIP_TRAILING_WHITESPACE)
    file(COPY ${header} DESTINATION ${CMAKE_BINARY_DIR}/tests/include)
  endif()
endif()
add_library(conversions OBJECT ${CMAKE_CURRENT_SOURCE_DIR}/libraries/conversions.cpp)
target_include_directories(conversions PRIVATE ${CMAKE_SOURCE_DIR})
target_compile_options(conversions PRIVATE ${SWARMANOID_WARNINGS} -O3)
target_link_libraries(unit_math PRIVATE conversions)
