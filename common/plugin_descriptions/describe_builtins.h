// The simulator's own engines, sensors, actuators and renderers as an experiment file sees them: names, parameters,
// channels, robots. Every process that reads experiments describes them all. The code of each is with its role, which
// binds it to the description by name (PluginRegistry::Bind). Called before roles start; idempotent.
#pragma once

namespace swarmanoid
{

void DescribeBuiltinEngines();
void DescribeBuiltinDevices();
void DescribeBuiltinRenderers();
// Describes all of them.
void DescribeBuiltins();

}  // namespace swarmanoid
