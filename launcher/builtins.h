// All built-in engines, devices and renderers, so that experiments can be read.
#pragma once

namespace swarmanoid
{

// Idempotent.
void RegisterBuiltins();

}  // namespace swarmanoid
