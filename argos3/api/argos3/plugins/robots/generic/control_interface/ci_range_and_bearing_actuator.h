// Broadcasts bytes to all robots in range and sight. A robot always sends; at first it sends zeros.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/utility/datatypes/byte_array.h>

namespace argos
{

class CCI_RangeAndBearingActuator : public CCI_Actuator
{
public:
  size_t GetSize() const { return m_cData.Size(); }
  // Throws CARGoSException if the data do not have GetSize() bytes.
  void SetData(const CByteArray& data)
  {
    if (data.Size() != m_cData.Size())
      THROW_ARGOSEXCEPTION(data.Size() << " bytes for a range-and-bearing message of " << m_cData.Size());
    m_cData = data;
  }
  void SetData(size_t index, UInt8 value) { m_cData[index] = value; }
  void SetData(const UInt8* bytes) { std::copy_n(bytes, m_cData.Size(), m_cData.ToCArray()); }
  void ClearData() { m_cData.Zero(); }

protected:
  CByteArray m_cData;
};

}  // namespace argos
