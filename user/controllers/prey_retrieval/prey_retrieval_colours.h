// The colours with which the eyebot and the footbots of the prey retrieval experiment communicate.
#pragma once

#include "ci_colour.h"

namespace prey_retrieval
{

constexpr std::uint32_t kLaser = CCI_Colour::RED;
constexpr std::uint32_t kNest = CCI_Colour::GREEN;
constexpr std::uint32_t kGripping = CCI_Colour::BLUE;  // LEDs of a footbot that holds a prey
constexpr std::uint32_t kPreys[] = {CCI_Colour::YELLOW, CCI_Colour::MAGENTA};

}  // namespace prey_retrieval
