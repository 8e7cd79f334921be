# This file has the compiler settings of all targets. docs/determinism.md has the rules of determinism.
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
# Targets are not linked again if only the code of a library that they use changed. They depend on its headers.
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)
# The first folder is for programs that only other programs start, so that they are not on the path of users. The second is for
# plug-ins, so that they are not among the libraries of the system.
set(SWARMANOID_ROLES_FOLDER ${CMAKE_INSTALL_LIBEXECDIR}/swarmanoid)
set(SWARMANOID_PLUGINS_FOLDER ${CMAKE_INSTALL_LIBDIR}/swarmanoid)
# Each installed file belongs to one of the components core, pictures, dev, doc and links. Packages leave out links. Files of core need
# no libraries of graphics and video.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME core)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache caches precompiled headers only with this sloppiness. Relative paths let all checkouts share the cache.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE_PROGRAM})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()

# Results have the same bits at every optimisation level: there is no contraction and no Eigen vector code, which would use FMA
# instructions. GCC 12 fuses rotations whatever -ffp-contract says (its bug 106902), hence -mno-fma.
set(SWARMANOID_EXACT -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND SWARMANOID_EXACT -mno-fma)
endif()
# GCC 12 loses conversions when it computes two numbers at once: (double)(float)x and (double)(int)x become x. GCC 14 keeps them.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  list(APPEND SWARMANOID_EXACT -fno-tree-slp-vectorize)
endif()
add_compile_options(${SWARMANOID_EXACT} -fno-trapping-math -fno-math-errno)
# No other library replaces one of our functions by a function of the same name, so functions of shared libraries may be inlined.
add_compile_options(-fno-semantic-interposition)
# For the same reason the dynamic linker need not look up the functions of a library for the library itself, which takes most of the
# start of a program.
add_link_options(LINKER:-Bsymbolic-functions)
add_compile_definitions(EIGEN_DONT_VECTORIZE)
# Fast DDS 3 defines this macro for all targets that link it. GCC reads precompiled headers only if all macros are the same.
add_compile_definitions(_FILE_OFFSET_BITS=64)
# GCC collects its memory after 1 GiB and not after 128 MiB. This saves a tenth of the time.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1048576>)
if(SWARMANOID_CPU AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  separate_arguments(instruction_set UNIX_COMMAND "-march=${SWARMANOID_CPU}")
  add_compile_options(${instruction_set})
endif()
# These options depend on the level of optimisation. Code at -O1 can use a header that was precompiled at -O3 only if both have the same.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-munroll-only-small-loops> $<$<COMPILE_LANGUAGE:CXX>:-mvzeroupper>)
  elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-mearly-ra=all>)
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

# CMAKE_COMPILE_WARNING_AS_ERROR makes these warnings errors in the presets of developers and in CI. A user's build with a newer
# compiler that has more warnings does not fail.
set(SWARMANOID_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # Some options and pragmas are for GCC alone. Inner loops combine conditions by & where a jump would cost more than both.
  list(APPEND SWARMANOID_WARNINGS -Wno-unknown-warning-option -Wno-unknown-pragmas -Wno-bitwise-instead-of-logical)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 has false alarms about std::string's operator+ at -O3 (its bugs 105329 and 105651).
  list(APPEND SWARMANOID_WARNINGS -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
  if(SWARMANOID_SANITIZE)
    # The second option is for a false alarm in std::regex (its bug 105562).
    list(APPEND SWARMANOID_WARNINGS -Wno-stringop-overread -Wno-maybe-uninitialized)
  endif()
endif()

# Several sources are compiled together. Headers take most of the time, and are then read once for all of them.
set(CMAKE_UNITY_BUILD ON CACHE BOOL "Compile several sources of a library or program together")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16 CACHE STRING "Sources that are compiled together")
if(CMAKE_UNITY_BUILD)
  # Another file includes the sources, so GCC takes their own types for types of a header.
  list(APPEND SWARMANOID_WARNINGS -Wno-subobject-linkage)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # Clang warns if a name in a function is also that of an anonymous namespace in another file.
    list(APPEND SWARMANOID_WARNINGS -Wno-shadow)
  endif()
endif()

# swarmanoid_includes_space(FILE RESULT) tells whether a source includes common/space/space.h, directly or through other headers.
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

# swarmanoid_sort_sources(TARGET [BY_FOLDER]) compiles sources that include the space, which most sources use, apart from sources that
# do not. An edit of the header of the space then recompiles only the sources that include it. With BY_FOLDER only sources of one
# folder are compiled together, because sources of different folders have names in common.
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
      return()  # another unit would read all headers again and cost more
    endif()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    # The sources are split into as many units as needed, of similar size. A folder is one unit.
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

# swarmanoid_install_library(NAME [PICTURES]) installs a library. Code that was linked against one minor version does not load
# another. Libraries of PICTURES are for the renderers alone: users' code cannot link them.
function(swarmanoid_install_library name)
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if("PICTURES" IN_LIST ARGN)
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT pictures NAMELINK_SKIP)
  else()
    install(TARGETS ${name} EXPORT SwarmanoidTargets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT core NAMELINK_COMPONENT dev)
  endif()
endfunction()

# The next two functions set the optimisation of releases. Code that runs in each tick over all robots has CMake's default, -O3. GCC
# needs half of that time at -O1, and two thirds at -O2. The bits of results are the same at each level.
# swarmanoid_optimise_cold(TARGETS...) is for targets of which nothing runs in each tick.
function(swarmanoid_optimise_cold)
  foreach(name ${ARGN})
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# swarmanoid_optimise_warm(TARGETS...) is for targets that draw or pass messages on. They compute nothing for each robot in each tick.
function(swarmanoid_optimise_warm)
  foreach(name ${ARGN})
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O2>)
  endforeach()
endfunction()

# swarmanoid_shared_headers(TARGETS...) precompiles Eigen, fmt and the standard library once for all targets.
function(swarmanoid_shared_headers)
  foreach(name ${ARGN})
    # Targets have no NAME_EXPORTS macro and no -fPIE, because these would keep a target from sharing the headers.
    set_target_properties(${name} PROPERTIES DEFINE_SYMBOL "")
    get_target_property(type ${name} TYPE)
    if(type STREQUAL EXECUTABLE)
      set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
      target_compile_options(${name} PRIVATE -fPIC)
    endif()
    # Clang before 16 refuses precompiled headers of another visibility.
    get_target_property(visibility ${name} CXX_VISIBILITY_PRESET)
    if(NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND visibility STREQUAL "hidden"))
      target_precompile_headers(${name} REUSE_FROM pch)
    endif()
  endforeach()
endfunction()

# swarmanoid_library(NAME [STATIC] [PICTURES] [BY_FOLDER] SOURCES... [OFF_THE_TICK SOURCES...] [PUBLIC libs...] [PRIVATE libs...]) adds
# a library with the warnings above. Shared libraries are installed, and exported as Swarmanoid::NAME unless they are of PICTURES.
# Static libraries stay inside the build.
# BY_FOLDER is passed to swarmanoid_sort_sources.
function(swarmanoid_library name)
  cmake_parse_arguments(ARG "STATIC;PICTURES;BY_FOLDER" "" "SOURCES;OFF_THE_TICK;PUBLIC;PRIVATE" ${ARGN})
  if(ARG_STATIC)
    add_library(${name} STATIC ${ARG_SOURCES})
  else()
    add_library(${name} SHARED ${ARG_SOURCES})
    # Names are looked up when the library is loaded. Each run of a study is a copy of a process, and would otherwise look them up
    # again.
    target_link_options(${name} PRIVATE LINKER:-z,now)
    set(pictures)
    if(ARG_PICTURES)
      set(pictures PICTURES)
    endif()
    swarmanoid_install_library(${name} ${pictures})
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
    # These sources are a target of their own, because options of single sources would keep them from being compiled together.
    set(part ${name}_off_the_tick)
    add_library(${part} OBJECT ${ARG_OFF_THE_TICK})
    target_compile_options(${part} PRIVATE ${SWARMANOID_WARNINGS})
    target_include_directories(${part} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${part} PRIVATE ${ARG_PUBLIC} ${ARG_PRIVATE})
    swarmanoid_shared_headers(${part})
    swarmanoid_sort_sources(${part})
    swarmanoid_optimise_cold(${part})
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${part}>)
  endif()
  # Code outside this build needs these two settings, because they decide the layout of a Pose and the bits of a sum.
  target_compile_definitions(${name} INTERFACE EIGEN_DONT_VECTORIZE)
  target_compile_options(${name} INTERFACE ${SWARMANOID_EXACT})
  target_compile_features(${name} INTERFACE cxx_std_20)
  set_property(GLOBAL APPEND PROPERTY SWARMANOID_LIBRARIES ${name})
endfunction()

# swarmanoid_program(NAME SOURCES... LINK libs... [ROLE]) adds a program. `swarmanoid` starts the programs of roles. For users who
# start them by hand, `bin` has links to them, except in Debian packages.
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
      set(bin \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
      file(MAKE_DIRECTORY \"\${bin}\")
      file(CREATE_LINK ${place} \"\${bin}/${name}\" SYMBOLIC)" COMPONENT links)
  endif()
  file(RELATIVE_PATH libraries /${folder} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
  install(TARGETS ${name} RUNTIME DESTINATION ${folder})
  set_property(GLOBAL APPEND PROPERTY SWARMANOID_PROGRAMS ${name})
endfunction()
