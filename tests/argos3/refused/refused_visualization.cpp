#include <argos3/core/simulator/visualization/visualization.h>

using namespace argos;

class CShow : public CVisualization
{
  void Execute() override {}
};

REGISTER_VISUALIZATION(CShow, "show", "A user", "1.0", "A visualization.", "A visualization.", "Usable");
