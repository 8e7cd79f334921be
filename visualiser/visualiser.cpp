#include "visualiser/visualiser.h"

namespace swarmanoid
{

Visualiser::Visualiser(const RenderConfiguration& configuration, const CSwarmanoidSpace& space,
                       const Assignment& assignment, const std::string& output_folder, ExperimentControl* control,
                       RunMonitor* monitor)
    : id_(configuration.id)
{
  const auto* entry = PluginRegistry<CRender>::Instance().Find(configuration.tag);
  if (entry == nullptr)
    throw ConfigurationError(configuration.location, "no renderer is registered as '" + configuration.tag +
                                                         "'; `swarmanoid list plugins` shows those of this build");
  render_ = entry->create();
  render_->Init({Parameters(configuration.tree, entry->description.parameters), space, assignment, output_folder,
                 control, monitor});
}

Visualiser::~Visualiser() = default;

bool Visualiser::Draw()
{
  render_->Draw();
  return render_->Terminate();
}

bool Visualiser::Idle()
{
  render_->Idle();
  return render_->Terminate();
}

void Visualiser::Finish()
{
  if (!finished_) render_->Finish();
  finished_ = true;
}

}  // namespace swarmanoid
