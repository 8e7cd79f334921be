// CPhysicsModel: it stands beside the body.
#pragma once

#include <argos3/core/simulator/entity/embodied_entity.h>
