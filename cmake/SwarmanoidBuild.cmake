# Compiler settings shared by every target. Determinism rules: docs/determinism.md.
option(SWARMANOID_BUILD_TESTS "Build the tests" ON)
option(SWARMANOID_BUILD_BENCH "Build the benchmarks" ON)
set(SWARMANOID_CPU "x86-64-v3" CACHE STRING
  "Instruction set of the build, as for -march=, and further options (x86-64-v3 -mno-lzcnt); results do not depend on it. build_framework asks the processor")
set(SWARMANOID_SANITIZE "" CACHE STRING "Sanitizers of the build, as for -fsanitize=; empty for none")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_INSTALL_RPATH "$ORIGIN")
# A library whose code changed does not make all that use it be linked again: what they see of it is in its headers.
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)
# Programs that only the others start, and plug-ins: not on the path of users, not among the libraries of the system.
set(SWARMANOID_ROLES_FOLDER ${CMAKE_INSTALL_LIBEXECDIR}/swarmanoid)
set(SWARMANOID_PLUGINS_FOLDER ${CMAKE_INSTALL_LIBDIR}/swarmanoid)
# What is installed is of one of these components: runtime, dev, doc, and links, which packages leave out.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Precompiled headers are cached only with this sloppiness; relative paths let all checkouts share what is compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE_PROGRAM})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()

# Same bits whatever the optimisation level: no contraction, no Eigen vector code (it would use FMA instructions). GCC 12
# makes fused instructions out of rotations whatever -ffp-contract says (its bug 106902).
set(SWARMANOID_EXACT -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND SWARMANOID_EXACT -mno-fma)
endif()
# GCC 12 loses conversions when it computes two numbers at once: (double)(float)x and (double)(int)x become x. GCC 14 keeps them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  list(APPEND SWARMANOID_EXACT -fno-tree-slp-vectorize)
endif()
add_compile_options(${SWARMANOID_EXACT} -fno-trapping-math -fno-math-errno)
# Nobody replaces a function of ours by one of the same name elsewhere, so those of shared libraries may be inlined.
add_compile_options(-fno-semantic-interposition)
add_compile_definitions(EIGEN_DONT_VECTORIZE)
# Fast DDS 3 defines it for all that link it; precompiled headers are read only where all macros are as they were.
add_compile_definitions(_FILE_OFFSET_BITS=64)
# GCC looks for memory to free when it has used 1 GiB, not 128 MiB: a tenth less time.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1048576>)
if(SWARMANOID_CPU AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  separate_arguments(instruction_set UNIX_COMMAND "-march=${SWARMANOID_CPU}")
  add_compile_options(${instruction_set})
  # From GCC 13 on -O2 has these. Code at -O1 can use a header that was precompiled at -O3 only if both have them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-munroll-only-small-loops>
      $<$<COMPILE_LANGUAGE:CXX>:-mvzeroupper>)
  endif()
endif()
if(SWARMANOID_SANITIZE)
  add_compile_options(-fsanitize=${SWARMANOID_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SWARMANOID_SANITIZE})
endif()

option(SWARMANOID_BUILD_FUZZERS "Build the fuzzers of tests/fuzz with libFuzzer (Clang only), and everything instrumented for them" OFF)
if(SWARMANOID_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SWARMANOID_BUILD_FUZZERS needs Clang: add -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-g -O1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

# CMAKE_COMPILE_WARNING_AS_ERROR makes them errors: in the presets of developers and in CI. A user's build with a compiler that came
# later and warns of more does not fail.
set(SWARMANOID_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms of GCC 12 about std::string's operator+ at -O3 (its bugs 105329 and 105651).
  list(APPEND SWARMANOID_WARNINGS -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
  if(SWARMANOID_SANITIZE)
    # The second one: in std::regex (its bug 105562).
    list(APPEND SWARMANOID_WARNINGS -Wno-stringop-overread -Wno-maybe-uninitialized)
  endif()
endif()

# Several sources are compiled as one: the headers, which take most of the time, are read once for all of them.
set(CMAKE_UNITY_BUILD ON CACHE BOOL "Compile several sources of a library or program together")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16 CACHE STRING "Sources that are compiled together")
if(CMAKE_UNITY_BUILD)
  # They are included by another file, so that GCC takes their own types for those of a header.
  list(APPEND SWARMANOID_WARNINGS -Wno-subobject-linkage)
endif()

# swarmanoid_includes_space(FILE RESULT): whether a source includes common/space/space.h, itself or by other headers.
function(swarmanoid_includes_space file result)
  get_property(known GLOBAL PROPERTY SWARMANOID_INCLUDES_SPACE:${file})
  if("${known}" STREQUAL "")
    set(known FALSE)
    file(STRINGS ${file} lines REGEX "^#include \"[^\"]+\"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "${CMAKE_SOURCE_DIR}/\\1" header "${line}")
      if(header STREQUAL "${CMAKE_SOURCE_DIR}/common/space/space.h")
        set(known TRUE)
      elseif(EXISTS ${header})
        swarmanoid_includes_space(${header} known)
      endif()
      if(known)
        break()
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY SWARMANOID_INCLUDES_SPACE:${file} ${known})
  endif()
  set(${result} ${known} PARENT_SCOPE)
endfunction()

# swarmanoid_sort_sources(TARGET [BY_FOLDER]): those sources are compiled together that include the space, which most work on, and those
# that do not: an edit of its header compiles the former again, not all that happens to stand beside them. BY_FOLDER: only those of one
# folder together, since those of several have names in common.
function(swarmanoid_sort_sources target)
  cmake_parse_arguments(ARG "BY_FOLDER" "" "" ${ARGN})
  get_target_property(sources ${target} SOURCES)
  set(groups)
  set(in_with_space)
  set(in_without_space)
  foreach(source IN LISTS sources)
    if(source MATCHES "\\.cpp$")
      get_filename_component(source ${source} ABSOLUTE)
      set(group without_space)
      if(EXISTS ${source})
        swarmanoid_includes_space(${source} includes)
        if(includes)
          set(group with_space)
        endif()
      endif()
      if(ARG_BY_FOLDER)
        get_filename_component(folder ${source} DIRECTORY)
        get_filename_component(folder ${folder} NAME)
        string(PREPEND group ${folder}_)
      endif()
      list(APPEND groups ${group})
      list(APPEND in_${group} ${source})
    endif()
  endforeach()
  if(NOT ARG_BY_FOLDER)
    list(LENGTH in_with_space with)
    list(LENGTH in_without_space without)
    if(with LESS 3 OR without LESS 3)
      return()  # another unit, which reads all headers again, would cost more
    endif()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    # As many units as are needed, of like size; a folder is one.
    list(LENGTH in_${group} length)
    set(units 1)
    if(NOT ARG_BY_FOLDER)
      math(EXPR units "(${length} + ${CMAKE_UNITY_BUILD_BATCH_SIZE} - 1) / ${CMAKE_UNITY_BUILD_BATCH_SIZE}")
    endif()
    set(index 0)
    foreach(source IN LISTS in_${group})
      math(EXPR number "${index} * ${units} / ${length}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${number})
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
endfunction()

# What was linked against one minor version goes with no other.
function(swarmanoid_install_library name)
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS ${name} EXPORT SwarmanoidTargets
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT dev)
endfunction()

# How well code is optimised in releases: what runs at each tick over all robots as CMake has it, at -O3. GCC needs half the time at
# -O1, and two thirds at -O2; the bits of results are those of any level.
# swarmanoid_off_the_tick(TARGETS...): nothing of them runs at each tick.
function(swarmanoid_off_the_tick)
  foreach(name ${ARGN})
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# swarmanoid_beside_the_tick(TARGETS...): they draw, or pass messages on; they compute nothing for each robot at each tick.
function(swarmanoid_beside_the_tick)
  foreach(name ${ARGN})
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O2>)
  endforeach()
endfunction()

# swarmanoid_shared_headers(TARGETS...): Eigen, fmt and the standard library are precompiled once for all of them.
function(swarmanoid_shared_headers)
  foreach(name ${ARGN})
    # No NAME_EXPORTS macro, and no -fPIE: they would keep a target from sharing them.
    set_target_properties(${name} PROPERTIES DEFINE_SYMBOL "")
    get_target_property(type ${name} TYPE)
    if(type STREQUAL EXECUTABLE)
      set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${name} PRIVATE -fPIC)
    endif()
    target_precompile_headers(${name} REUSE_FROM pch)
  endforeach()
endfunction()

# swarmanoid_library(NAME [STATIC] [BY_FOLDER] SOURCES... [OFF_THE_TICK SOURCES...] [PUBLIC libs...] [PRIVATE libs...]): one library of
# ours, warnings as errors. Shared ones are installed and exported as Swarmanoid::NAME; static ones stay inside the build. BY_FOLDER: as
# of swarmanoid_sort_sources.
function(swarmanoid_library name)
  cmake_parse_arguments(ARG "STATIC;BY_FOLDER" "" "SOURCES;OFF_THE_TICK;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_STATIC)
    add_library(${name} STATIC ${ARG_SOURCES})
  else()
    add_library(${name} SHARED ${ARG_SOURCES})
    # Names are looked up when it is loaded: each run of a study is a copy of a process, and would look up its own.
    target_link_options(${name} PRIVATE LINKER:-z,now)
    swarmanoid_install_library(${name})
  endif()
  add_library(Swarmanoid::${name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES OUTPUT_NAME swarmanoid_${name})
  target_compile_options(${name} PRIVATE ${SWARMANOID_WARNINGS})
  target_include_directories(${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid>)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  swarmanoid_shared_headers(${name})
  set(grouping)
  if(ARG_BY_FOLDER)
    set(grouping BY_FOLDER)
  endif()
  swarmanoid_sort_sources(${name} ${grouping})
  if(ARG_OFF_THE_TICK)
    # Options of single sources would keep them from being compiled together.
    set(part ${name}_off_the_tick)
    add_library(${part} OBJECT ${ARG_OFF_THE_TICK})
    target_compile_options(${part} PRIVATE ${SWARMANOID_WARNINGS})
    target_include_directories(${part} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${part} PRIVATE ${ARG_PUBLIC} ${ARG_PRIVATE})
    swarmanoid_shared_headers(${part})
    swarmanoid_sort_sources(${part})
    swarmanoid_off_the_tick(${part})
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${part}>)
  endif()
  # Code built outside needs these two of the settings above: they decide the layout of a Pose and the bits of a sum.
  target_compile_definitions(${name} INTERFACE EIGEN_DONT_VECTORIZE)
  target_compile_options(${name} INTERFACE ${SWARMANOID_EXACT})
  target_compile_features(${name} INTERFACE cxx_std_20)
  set_property(GLOBAL APPEND PROPERTY SWARMANOID_LIBRARIES ${name})
endfunction()

# swarmanoid_program(NAME SOURCES... LINK libs... [ROLE]): one program of ours. A role's is started by `swarmanoid`; those who
# start it by hand find it beside that, too, where packages do not forbid it.
function(swarmanoid_program name)
  cmake_parse_arguments(ARG "ROLE" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${SWARMANOID_WARNINGS})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  swarmanoid_shared_headers(${name})
  set(folder ${CMAKE_INSTALL_BINDIR})
  if(ARG_ROLE)
    set(folder ${SWARMANOID_ROLES_FOLDER})
    file(RELATIVE_PATH place /${CMAKE_INSTALL_BINDIR} /${folder}/${name})
    install(CODE "
      set(bin \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR})
      file(MAKE_DIRECTORY \${bin})
      file(CREATE_LINK ${place} \${bin}/${name} SYMBOLIC)" COMPONENT links)
  endif()
  file(RELATIVE_PATH libraries /${folder} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
  install(TARGETS ${name} RUNTIME DESTINATION ${folder})
  set_property(GLOBAL APPEND PROPERTY SWARMANOID_PROGRAMS ${name})
endfunction()
