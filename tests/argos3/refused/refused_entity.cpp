#include <argos3/core/simulator/entity/composable_entity.h>

using namespace argos;

class CLamp : public CComposableEntity
{
public:
  ENABLE_VTABLE();
  CLamp() : CComposableEntity("lamp") {}
};

REGISTER_ENTITY(CLamp, "lamp", "A user", "1.0", "A lamp.", "A lamp.", "Usable");
REGISTER_STANDARD_SPACE_OPERATIONS_ON_COMPOSABLE(CLamp);
