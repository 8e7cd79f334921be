// Sends messages of e-pucks of argos3-epuck, with 12 emitters around the robot. Emitter 0 looks ahead; the others
// follow counter-clockwise.
#pragma once

#include <algorithm>

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/configuration/argos_exception.h>

namespace argos
{

class CCI_EPuckRangeAndBearingActuator : public CCI_Actuator
{
public:
  static const UInt32 MAX_BYTES_SENT = 4;
  using TData = UInt8[MAX_BYTES_SENT];
  enum EEmitterState
  {
    STATE_ALL_EMITTERS_DISABLED = 0,
    STATE_ALL_EMITTERS_SAME_DATA,
    STATE_EMITTERS_DIFFERENT
  };
  struct SEmitter
  {
    bool Enabled = false;
    TData Data = {0, 0, 0, 0};
  };
  static const UInt32 NUM_EMITTERS = 12;
  struct SDataToSend
  {
    EEmitterState State = STATE_ALL_EMITTERS_DISABLED;
    SEmitter Emitter[NUM_EMITTERS];
  };

  // Sends the bytes in each step from now on.
  virtual void SetData(const TData data)
  {
    for (size_t emitter = 0; emitter < NUM_EMITTERS; ++emitter) SetDataForEmitter(emitter, data);
    m_sDesiredData.State = STATE_ALL_EMITTERS_SAME_DATA;
  }
  // Throw CARGoSException for an emitter that does not exist.
  virtual void SetDataForEmitter(size_t emitter, const TData data)
  {
    SEmitter& changed = EmitterOf(emitter);
    changed.Enabled = true;
    std::copy(data, data + MAX_BYTES_SENT, changed.Data);
  }
  // Stops the messages of an emitter. Throws CARGoSException if it does not exist.
  virtual void DisableEmitter(size_t emitter) { EmitterOf(emitter).Enabled = false; }
  // Stops all messages.
  virtual void Disable()
  {
    for (SEmitter& emitter : m_sDesiredData.Emitter) emitter.Enabled = false;
    m_sDesiredData.State = STATE_ALL_EMITTERS_DISABLED;
  }
  void Reset() override { Disable(); }

protected:
  SEmitter& EmitterOf(size_t emitter)
  {
    if (emitter >= NUM_EMITTERS) THROW_ARGOSEXCEPTION("there is no emitter " << emitter << "; they are 0 to 11");
    m_sDesiredData.State = STATE_EMITTERS_DIFFERENT;
    return m_sDesiredData.Emitter[emitter];
  }

  SDataToSend m_sDesiredData;
};

}  // namespace argos
