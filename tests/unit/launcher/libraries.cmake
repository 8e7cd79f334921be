# The tables of the samples are part of the reference pages.
get_property(SAMPLES GLOBAL PROPERTY SWARMANOID_SAMPLES)
add_dependencies(unit_launcher ${SAMPLES})
