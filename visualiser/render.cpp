#include "visualiser/render.h"

namespace swarmanoid
{

template <>
PluginRegistry<CRender>& PluginRegistry<CRender>::Instance()
{
  static PluginRegistry registry(PluginKind::kRenderer);
  return registry;
}

}  // namespace swarmanoid
