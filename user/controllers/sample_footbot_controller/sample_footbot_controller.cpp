#include "sample_footbot_controller.h"
using namespace swarmanoid;
using namespace ahss;
using namespace std;

int CSampleFootBotController::Init(const TConfigurationTree t_tree)
{
    m_pcFootBotWheelsActuator = (CCI_FootBotWheelsActuator*)(GetRobot( )->GetActuator( "footbot_wheels" ));
    return CCI_Controller::RETURN_OK;
}

void CSampleFootBotController::ControlStep ( )
{
    m_pcFootBotWheelsActuator->SetFootBotWheelsAngularVelocity( 0.314, 0.628 );
}

void CSampleFootBotController::Destroy ( ){}
REGISTER_CONTROLLER( CSampleFootBotController, "sample_footbot_controller" )
