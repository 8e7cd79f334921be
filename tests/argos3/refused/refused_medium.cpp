#include <argos3/core/simulator/medium/medium.h>

using namespace argos;

class CAir : public CMedium
{
};

REGISTER_MEDIUM(CAir, "air", "A user", "1.0", "A medium.", "A medium.", "Usable");
