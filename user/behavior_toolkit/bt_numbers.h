// Numbers in the saved states of behaviours, as text that is read back with the same bits.
#pragma once

#include <iosfwd>

void BTSaveNumber(std::ostream& state, double value);
// Throws std::runtime_error if no number follows.
double BTLoadNumber(std::istream& state);
