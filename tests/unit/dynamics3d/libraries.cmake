# A test uses ODE directly to set bodies turning.
find_package(PkgConfig REQUIRED)
pkg_check_modules(ODE REQUIRED IMPORTED_TARGET ode)
target_link_libraries(unit_${folder} PRIVATE PkgConfig::ODE)
