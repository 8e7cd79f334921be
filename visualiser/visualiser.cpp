#include "visualiser/visualiser.h"

#include <memory>
#include <string>
#include <utility>

#include "common/experiment/actors.h"
#include "common/space/space.h"

namespace swarmanoid
{

namespace
{

// A visualisation that is attached from outside is not in the experiment.
Actor ActorOf(const RenderConfiguration& configuration, const Experiment& experiment)
{
  std::size_t number = 0;
  while (number < experiment.visualisations.size() && experiment.visualisations[number].id != configuration.id)
    ++number;
  return VisualisationActor(configuration, number);
}

const PluginRegistry<CRender>::Entry& EntryOf(const RenderConfiguration& configuration)
{
  const auto* entry = PluginRegistry<CRender>::Instance().Find(configuration.tag);
  if (entry == nullptr)
    throw ConfigurationError(configuration.location, "no renderer is registered as '" + configuration.tag +
                                                         "'; `swarmanoid list plugins` shows those of this build");
  return *entry;
}

}  // namespace

std::unique_ptr<CRender> MakeRenderer(const RenderConfiguration& configuration)
{
  const auto& entry = EntryOf(configuration);
  try
  {
    return entry.create();
  }
  catch (const ConfigurationError& error)
  {
    const bool is_attached = configuration.location.line == 0;
    throw ConfigurationError(configuration.location,
                             error.Message() + (is_attached ? "" : "; --no-visualisers runs without it"));
  }
}

Visualiser::Visualiser(const RenderConfiguration& configuration, const CSwarmanoidSpace& space,
                       const Assignment& assignment, const std::string& output_folder, ExperimentControl* control,
                       RunMonitor* monitor)
    : space_(space), configuration_(configuration), actor_(ActorOf(configuration_, space.GetExperiment()))
{
  const auto& entry = EntryOf(configuration);
  context_.Enter();
  RunCodeOf<ConfigurationError>(actor_, ActivityStep::kInit, space.GetTick(),
                                [&]
                                {
                                  render_ = MakeRenderer(configuration);
                                  render_->Init({Parameters(configuration.tree, entry.description.parameters), space,
                                                 assignment, output_folder, control, monitor});
                                });
}

Visualiser::~Visualiser()
{
  context_.Enter();
  render_.reset();
}

template <class Code>
void Visualiser::Run(ActivityStep step, const Code& code)
{
  context_.Enter();
  RunCodeOf(actor_, step, space_.GetTick(), code);
}

bool Visualiser::Draw()
{
  Run(ActivityStep::kDraw, [&] { render_->Draw(); });
  return render_->Terminate();
}

bool Visualiser::Idle()
{
  Run(ActivityStep::kIdle, [&] { render_->Idle(); });
  return render_->Terminate();
}

void Visualiser::Finish()
{
  if (std::exchange(finished_, true)) return;
  Run(ActivityStep::kFinish, [&] { render_->Finish(); });
}

}  // namespace swarmanoid
