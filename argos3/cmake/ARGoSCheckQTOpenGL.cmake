# Included by users who found ARGoS3 by pkg-config (argos3_simulator).
find_package(ARGoS REQUIRED HINTS ${ARGOS_PREFIX})
