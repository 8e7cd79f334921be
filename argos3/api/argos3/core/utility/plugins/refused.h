// Macros of ARGoS3 for plug-ins that do not run here. Their use is an error that names the alternative.
#pragma once

// The error appears where a macro is used, not here.
#define ARGOS3_REFUSED(TEXT) static_assert(sizeof(int) == 0, TEXT)
#define ARGOS3_REFUSED_ENTITY                                                                                        \
  ARGOS3_REFUSED(                                                                                                    \
      "entities written for ARGoS3 do not run here: make a kind of robot or object of your own (docs/own_kind.md), " \
      "whose devices are found in docs/own_device.md")

#define ENABLE_VTABLE() ARGOS3_REFUSED_ENTITY
#define INIT_VTABLE_FOR(BASE) ARGOS3_REFUSED_ENTITY;
#define REGISTER_ENTITY(CLASSNAME, LABEL, AUTHOR, VERSION, BRIEF, LONG, STATUS) ARGOS3_REFUSED_ENTITY;
#define REGISTER_ENTITY_OPERATION(LABEL, PLUGIN, OPERATION, RETURN_VALUE, DERIVED) ARGOS3_REFUSED_ENTITY;
#define REGISTER_SPACE_OPERATION(ACTION, OPERATION, ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATION_ADD_ENTITY(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATION_REMOVE_ENTITY(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATIONS_ON_ENTITY(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATION_ADD_COMPOSABLE(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATION_REMOVE_COMPOSABLE(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_STANDARD_SPACE_OPERATIONS_ON_COMPOSABLE(ENTITY) ARGOS3_REFUSED_ENTITY;
#define REGISTER_PHYSICS_ENGINE(CLASSNAME, LABEL, AUTHOR, VERSION, BRIEF, LONG, STATUS) \
  ARGOS3_REFUSED("engines written for ARGoS3 do not run here: see docs/own_engine.md for one of your own");
#define REGISTER_MEDIUM(CLASSNAME, LABEL, AUTHOR, VERSION, BRIEF, LONG, STATUS)                                  \
  ARGOS3_REFUSED(                                                                                                \
      "media written for ARGoS3 do not run here: a sensor of REGISTER_SENSOR may look at the arena itself, and " \
      "loop functions at all robots");
#define REGISTER_VISUALIZATION(CLASSNAME, LABEL, AUTHOR, VERSION, BRIEF, LONG, STATUS)                             \
  ARGOS3_REFUSED(                                                                                                  \
      "visualizations written for ARGoS3 do not run here: see docs/visualisers.md for a renderer of your own, or " \
      "use Qt user functions");
#define REGISTER_SYMBOL(BASECLASS, CLASSNAME, LABEL, AUTHOR, VERSION, BRIEF, LONG, STATUS) \
  ARGOS3_REFUSED(                                                                          \
      "libraries for ARGoS3 register controllers, loop functions, Qt user functions, sensors and actuators here");
