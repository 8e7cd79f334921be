#ifndef _CSAMPLEFOOTBOTCONTROLLER_H_
#define _CSAMPLEFOOTBOTCONTROLLER_H_
#include "ci_controller.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "config.h"
class CSampleFootBotController: public CCI_Controller {
    // Associations
private:
    CCI_FootBotWheelsActuator* m_pcFootBotWheelsActuator;
    // Attributes
    // Operations
public:
    virtual int Init ( const TConfigurationTree t_tree );
    virtual void ControlStep ( );
    virtual void Destroy ( );
};
#endif
