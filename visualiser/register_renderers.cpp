#include "visualiser/image/description.h"
#include "visualiser/ogre/description.h"
#include "visualiser/opengl/description.h"
#include "visualiser/render.h"
#include "visualiser/renderer_library.h"
#include "visualiser/text/text_render.h"
#include "visualiser/web/description.h"

namespace swarmanoid
{

void RegisterBuiltinRenderers()
{
  static const bool registered = []
  {
    PluginRegistry<CRender>& registry = PluginRegistry<CRender>::Instance();
    registry.Add(CTextRender::Description(), [] { return std::make_unique<CTextRender>(); });
    registry.Add(ImageRenderDescription(), RendererFromLibrary("image_render", "libepoxy-dev libstb-dev libegl1"));
    registry.Add(OpenGlRenderDescription(),
                 RendererFromLibrary("opengl_render", "libepoxy-dev libstb-dev libglfw3-dev libimgui-dev"));
    registry.Add(OgreRenderDescription(),
                 RendererFromLibrary("ogre_render", "libogre-1.12-dev libimgui-dev libx11-dev"));
    registry.Add(WebRenderDescription(), RendererFromLibrary("web_render", "nodejs npm libboost-dev"));
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
