// Registers the renderers of the simulator; common/plugin_descriptions describes them.
#include "common/plugin_descriptions/describe_builtins.h"
#include "visualiser/render.h"
#include "visualiser/renderer_library.h"
#include "visualiser/text/text_render.h"

namespace swarmanoid
{
namespace
{

void BindLibrary(const std::string& label, const std::string& packages)
{
  PluginRegistry<CRender>::Instance().Bind(label, "", RendererFromLibrary(label, packages));
}

}  // namespace

void RegisterBuiltinRenderers()
{
  static const bool registered = []
  {
    DescribeBuiltinRenderers();
    PluginRegistry<CRender>::Instance().Bind("text_render", "", [] { return std::make_unique<CTextRender>(); });
    BindLibrary("image_render", "libepoxy-dev libstb-dev libegl1");
    BindLibrary("figure_render", "libcairo2-dev");
    BindLibrary("opengl_render", "libepoxy-dev libstb-dev libglfw3-dev libimgui-dev");
    BindLibrary("ogre_render", "libogre-1.12-dev libimgui-dev libx11-dev");
    BindLibrary("web_render", kWebPackages);
    PluginRegistry<CRender>::Instance().Bind(
        "page_render", "", RendererFromLibrary("web_render", kWebPackages, "CreateSwarmanoidPageRender"));
    BindLibrary("ros2_render", "fastddsgen");
    BindLibrary("foxglove_render", "libboost-dev");
    PluginRegistry<CRender>::Instance().RequireCode();
    return true;
  }();
  static_cast<void>(registered);
}

}  // namespace swarmanoid
