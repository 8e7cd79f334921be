// The medium of Kilobots, with which loop functions send messages of the overhead controller.
#pragma once

#include <argos3/core/simulator/medium/medium.h>
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>

#undef main

namespace argos
{

class CKilobotCommunicationMedium : public CMedium
{
public:
  // The robot receives the message in each step, as the first one, until another message or nullptr is given.
  void SendOHCMessageTo(CKilobotEntity& robot, message_t* message);
  void SendOHCMessageTo(std::vector<CKilobotEntity*>& robots, message_t* message);
  // Returns nullptr if there is none.
  message_t* GetOHCMessageFor(CKilobotEntity& robot);
};

}  // namespace argos
