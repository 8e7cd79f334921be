#include "visualiser/render.h"
#include "visualiser/text/text_render.h"

namespace swarmanoid
{

void RegisterBuiltinRenderers()
{
  static const bool registered = []
  {
    PluginRegistry<CRender>::Instance().Add(CTextRender::Description(), [] { return std::make_unique<CTextRender>(); });
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
