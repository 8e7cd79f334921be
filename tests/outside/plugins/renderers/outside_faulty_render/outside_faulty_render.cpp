// A renderer that shows nothing, and fails by OUTSIDE_FAULT.
#include "controllers/outside_faults/faults.h"

#include "visualiser/render.h"

using namespace swarmanoid;

class COutsideFaultyRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override { space_ = &setup.space; }
  void Draw() override { faults::FailIfAsked("render", space_->GetTick()); }

private:
  const CSwarmanoidSpace* space_ = nullptr;
};

REGISTER_RENDER(COutsideFaultyRender, {.label = "outside_faulty_render", .brief = "nothing, until it fails"})
