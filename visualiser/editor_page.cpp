#include "visualiser/editor_page.h"

#include "visualiser/renderer_library.h"

namespace swarmanoid
{

std::unique_ptr<EditorPage> MakeEditorPage()
{
  void* const make = FunctionOfRendererLibrary("web_render", kWebPackages, "MakeSwarmanoidEditorPage");
  return std::unique_ptr<EditorPage>(reinterpret_cast<EditorPage* (*)()>(make)());
}

}  // namespace swarmanoid
