// CPhysicsModel, which embodied_entity.h declares.
#pragma once

#include <argos3/core/simulator/entity/embodied_entity.h>
