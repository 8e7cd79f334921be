// The controllers that contain the two behaviours.
#include "behavior/ci_behavior_controller.h"
#include "eyebot_guide.h"
#include "footbot_retriever.h"

template <class RobotState, class Behavior>
class CRetrievalController : public CCI_BehaviorController<RobotState>
{
public:
  int Init(const TConfigurationTree) override
  {
    this->m_pcState = new RobotState(this->GetRobot());
    this->m_pcState->Init();
    this->m_pcRootBehavior = new Behavior();
    this->m_pcRootBehavior->Init();
    return CCI_Controller::RETURN_OK;
  }
  void Destroy() override
  {
    this->m_pcRootBehavior->Destroy();
    delete this->m_pcState;
    delete this->m_pcRootBehavior;
    this->m_pcState = nullptr;
    this->m_pcRootBehavior = nullptr;
  }
};

using CFootbotRetrieverController = CRetrievalController<CCI_FootBotState, CBTFootbotRetriever>;
using CEyebotGuideController = CRetrievalController<CCI_EyeBotState, CBTEyebotGuide>;

REGISTER_CONTROLLER(CFootbotRetrieverController, {.label = "footbot_retriever",
                                                  .brief = "brings the prey that the eyebot's laser marks to the nest"})
REGISTER_CONTROLLER(CEyebotGuideController,
                    {.label = "eyebot_guide",
                     .brief = "chooses a prey, marks it with its laser and leads the footbot to the nest"})
