// Flocking: keeps a distance to the neighbours whose LEDs it sees, and goes to a common light.
//
// The force between two robots at distance d follows the generalised Lennard-Jones potential of the foot-bot flocking
// experiments: f(d) = -4 gain / d ((s/d)^4 - (s/d)^2). s is the wanted distance (Spears et al., "Distributed,
// physics-based control of swarms of vehicles", 2004).
#pragma once

#include "behavior/ci_behavior.h"
#include "behavior/ci_footbot_state.h"

class CBTFootbotFlocking : public CCI_Behavior<CCI_FootBotState>
{
public:
  // `colour` is that of the neighbours' LEDs (0xRRGGBB), `wanted_distance` that between robots (m), and `speed` is in
  // m/s.
  explicit CBTFootbotFlocking(std::uint32_t colour, double wanted_distance = 0.4, double speed = 0.1);

  void Step(CCI_FootBotState& cRobotState) override;

private:
  std::uint32_t colour_;
  double wanted_distance_;
  double speed_;
};
