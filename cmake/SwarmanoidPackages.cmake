# CPack makes the Debian packages (`./build_framework package`): swarmanoid-core, swarmanoid, swarmanoid-dev, swarmanoid-doc and, if the
# Python module is built, python3-swarmanoid. Each component is a package. cmake/packages has the further files that Debian requires.
# This file is included last.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME swarmanoid)
set(CPACK_PACKAGE_CONTACT "The Swarmanoid developers <swarmanoid@localhost>" CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_COMPONENTS_ALL core pictures dev doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/packages/finish.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_CORE_PACKAGE_NAME swarmanoid-core)
set(CPACK_DEBIAN_PICTURES_PACKAGE_NAME swarmanoid)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME swarmanoid-dev)
set(CPACK_DEBIAN_DOC_PACKAGE_NAME swarmanoid-doc)

# dpkg-shlibdeps finds the libraries that the programs load.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY =)

# The package swarmanoid of an earlier version may have files that swarmanoid-core has now: until 0.1 all, in 1.0 the web page.
set(CPACK_DEBIAN_CORE_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_CORE_PACKAGE_BREAKS "swarmanoid (<< ${PROJECT_VERSION})")
set(CPACK_DEBIAN_CORE_PACKAGE_REPLACES "swarmanoid (<< ${PROJECT_VERSION})")
set(CPACK_DEBIAN_CORE_PACKAGE_RECOMMENDS "openssh-client")
set(CPACK_DEBIAN_CORE_PACKAGE_SUGGESTS "swarmanoid, swarmanoid-dev, swarmanoid-doc")
set(CPACK_DEBIAN_CORE_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/packages/triggers)
set(CPACK_COMPONENT_CORE_DESCRIPTION "simulator of robot swarms - without pictures
Runs experiments with footbots, handbots, eyebots and robots of one's own as
a cluster of processes over DDS, or in one process, with the same result bit
by bit. Physics engines, controllers, sensors, actuators and visualisations
are plug-ins. This package has what a node of a cluster needs: programs,
engines, devices, samples and a page for browsers that watches and steers
experiments, and no library of graphics.")

# Pictures need a font and an OpenGL driver, and plots a module of Python. Installations without them still run.
set(CPACK_DEBIAN_PICTURES_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PICTURES_PACKAGE_DEPENDS "swarmanoid-core (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PICTURES_PACKAGE_RECOMMENDS "fonts-dejavu-core, libegl1, libgl1-mesa-dri, python3-matplotlib, python3-scipy")
set(CPACK_DEBIAN_PICTURES_PACKAGE_SUGGESTS "swarmanoid-dev, swarmanoid-doc")
set(CPACK_DEBIAN_PICTURES_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/packages/triggers)
set(CPACK_COMPONENT_PICTURES_DESCRIPTION "simulator of robot swarms
The simulator with all that shows experiments: pictures, films, plans and
windows, beside the page for browsers and the terminal.")

set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "swarmanoid-core (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "g++, cmake, ninja-build | make, pkgconf")
set(CPACK_COMPONENT_DEV_DESCRIPTION "simulator of robot swarms - development files
Headers, the CMake package Swarmanoid and the pkg-config files with which
controllers, devices, physics engines, renderers, experiment functions and
drivers of robots are built.")

set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOC_DESCRIPTION "simulator of robot swarms - documentation
Tutorial, reference of experiment files and plug-ins, the pages about
engines, devices, determinism and clusters, notebooks and examples.")

# The module works with one minor version of Python, which its file name states.
if(TARGET python_module)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next "${SWARMANOID_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-swarmanoid)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "swarmanoid-core (= ${PROJECT_VERSION}), "
    "python3 (>= ${SWARMANOID_PYTHON_MAJOR}.${SWARMANOID_PYTHON_MINOR}~), python3 (<< ${SWARMANOID_PYTHON_MAJOR}.${next}), "
    "libpython${SWARMANOID_PYTHON_MAJOR}.${SWARMANOID_PYTHON_MINOR}, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "jupyter-notebook, python3-matplotlib, swarmanoid-doc")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${CMAKE_SOURCE_DIR}/cmake/packages/python/postinst ${CMAKE_SOURCE_DIR}/cmake/packages/python/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "simulator of robot swarms - module for Python 3
Runs experiments step by step with NumPy arrays, controllers in Python,
environments for learning, looks at runs as a cluster and steers them, and
reads what runs and studies have left.")
endif()

include(CPack)
