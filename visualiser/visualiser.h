// The role that shows the space through one renderer. It is a step function: Draw is called at each state of its space.
#pragma once

#include <memory>

#include "common/activity/failure_report.h"
#include "visualiser/drawing_context.h"
#include "visualiser/render.h"

namespace swarmanoid
{

// Makes the renderer of a visualisation, without Init. Throws ConfigurationError, with its place in the experiment
// file, if no such renderer is registered or installed.
std::unique_ptr<CRender> MakeRenderer(const RenderConfiguration& configuration);

class Visualiser
{
public:
  // Makes and initialises the renderer. Throws ConfigurationError, or ActivityError with the renderer that failed; the
  // other functions throw the same.
  Visualiser(const RenderConfiguration& configuration, const CSwarmanoidSpace& space, const Assignment& assignment,
             const std::string& output_folder, ExperimentControl* control, RunMonitor* monitor);
  ~Visualiser();

  // Returns true once the renderer wants the run to end.
  bool Draw();
  bool Idle();
  // Closes the outputs; later calls do nothing.
  void Finish();

  const std::string& Id() const { return configuration_.id; }
  bool IsInteractive() const { return render_->IsInteractive(); }

private:
  template <class Code>
  void Run(ActivityStep step, const Code& code);

  const CSwarmanoidSpace& space_;
  RenderConfiguration configuration_;
  Actor actor_;
  DrawingContext context_;
  std::unique_ptr<CRender> render_;
  bool finished_ = false;
};

}  // namespace swarmanoid
