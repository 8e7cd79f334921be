#include "visualiser/render.h"

namespace swarmanoid
{

template <>
PluginRegistry<CRender>& PluginRegistry<CRender>::Instance()
{
  static PluginRegistry registry;
  return registry;
}

template class PluginRegistry<CRender>;

}  // namespace swarmanoid
