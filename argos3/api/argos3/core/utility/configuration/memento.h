// CMemento: an object that can be saved into bytes and restored from them.
#pragma once

#include <argos3/core/utility/datatypes/byte_array.h>

namespace argos
{

class CMemento
{
public:
  virtual ~CMemento() = default;
  // Appends to the bytes.
  virtual void SaveState(CByteArray& bytes) = 0;
  // Removes its bytes from the front.
  virtual void LoadState(CByteArray& bytes) = 0;
};

}  // namespace argos
