/* Speaks to a run with Cyclone DDS, from the types that idlc makes of idl/swarmanoid.idl, without being asked.
   cyclone_stranger DOMAIN EXPERIMENT ROBOTS PROCESS [TOPIC...]: waits until somebody reads the topics (all of the run
   if none is named), and writes a well-formed message to each, again and again until it is killed: stop the run, robots
   elsewhere, PROCESS ("host:pid"), the engine, has failed ... Prints the topics that were written. The number of the
   run is read from its World, if that can be read. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "swarmanoid.h"

enum
{
  kMostRobots = 100,
  kColumns = 7, /* of a pose */
  kDepth = 16
};

static char forged[] = "forged";
static char engine[] = "engine 'e0'";
static double poses[kMostRobots * kColumns];

static swarmanoid_wire_SpaceState space_state;
static swarmanoid_wire_ControlCommands control_commands;
static swarmanoid_wire_EngineUpdate engine_update = {.header.tick = 1};
static swarmanoid_wire_SensorFrame sensor_frame;
static swarmanoid_wire_Drawn drawn;
static swarmanoid_wire_World world = {
    .experiment = forged, .host = forged, .pid = 1, .file = forged, .folder = forged, .xml = forged};
static swarmanoid_wire_Join join = {.name = engine, .ready = true, .incarnation = 7};
static swarmanoid_wire_View view;
static swarmanoid_wire_ControlRequest control_request = {
    .number = 1, .order.verb = (char*)"stop", .user = forged};
static swarmanoid_wire_ControlReply control_reply = {.number = 1, .text = forged};
static swarmanoid_wire_Status status = {.name = engine, .text = forged};
static swarmanoid_wire_SavedState saved_state = {.name = engine};
static swarmanoid_wire_RecoveryRequest recovery_request = {.name = engine};
static swarmanoid_wire_RecoveryBlock recovery_block = {0};
static swarmanoid_wire_ViewRequest view_request = {.views = 30, .every_tick = true};
static swarmanoid_wire_RunStatus run_status = {
    .status = {.phase = swarmanoid_wire_RUN_PHASE_FINISHED, .ended = forged}};
static swarmanoid_wire_RobotStatus robot_status;
static swarmanoid_wire_Leave leave = {.name = engine, .error = forged};

#define TOPIC(name, sample)                                         \
  {                                                                 \
#name, &swarmanoid_wire_##name##_desc, &(sample), &(sample).run \
  }
#define TOPIC_OF_TICK(name, sample)                                        \
  {                                                                        \
#name, &swarmanoid_wire_##name##_desc, &(sample), &(sample).header.run \
  }
static struct
{
  const char* name;
  const dds_topic_descriptor_t* type;
  void* sample;
  uint64_t* run;
} topics[] = {
    TOPIC_OF_TICK(SpaceState, space_state),
    TOPIC_OF_TICK(ControlCommands, control_commands),
    TOPIC_OF_TICK(EngineUpdate, engine_update),
    TOPIC_OF_TICK(SensorFrame, sensor_frame),
    TOPIC_OF_TICK(Drawn, drawn),
    TOPIC(World, world),
    TOPIC(Join, join),
    TOPIC(View, view),
    TOPIC(ControlRequest, control_request),
    {"ControlReply", &swarmanoid_wire_ControlReply_desc, &control_reply, NULL},
    TOPIC(Status, status),
    TOPIC(SavedState, saved_state),
    TOPIC(RecoveryRequest, recovery_request),
    TOPIC(RecoveryBlock, recovery_block),
    TOPIC(ViewRequest, view_request),
    TOPIC(RunStatus, run_status),
    TOPIC(RobotStatus, robot_status),
    TOPIC(Leave, leave),
};

static dds_qos_t* quality(bool reliable)
{
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, kDepth);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &xcdr1);
  return qos;
}

static bool is_wanted(int count, char** names, const char* topic)
{
  for (int k = 0; k < count; ++k)
    if (strcmp(names[k], topic) == 0) return true;
  return count == 0;
}

/* The number of the run; 0 if its World cannot be read. */
static uint64_t read_run(dds_entity_t participant, dds_entity_t subscriber)
{
  const dds_entity_t topic = dds_create_topic(participant, &swarmanoid_wire_World_desc, "World", NULL, NULL);
  dds_qos_t* qos = quality(true);
  const dds_entity_t reader = dds_create_reader(subscriber, topic, qos, NULL);
  dds_delete_qos(qos);
  uint64_t run = 0;
  for (int wait_ms = 0; run == 0 && wait_ms < 3000; ++wait_ms)
  {
    void* sample = NULL;
    dds_sample_info_t about;
    if (dds_take(reader, &sample, &about, 1, 1) == 1 && about.valid_data)
      run = ((const swarmanoid_wire_World*)sample)->run;
    else
      dds_sleepfor(DDS_MSECS(1));
    if (sample != NULL) dds_return_loan(reader, &sample, 1);
  }
  dds_delete(reader);
  return run;
}

/* The writer of a topic, once it has a reader; 0 without a reader. */
static dds_entity_t open_writer(dds_entity_t participant, dds_entity_t publisher, const char* name,
                                const dds_topic_descriptor_t* type, int patience_ms)
{
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  dds_qos_t* qos = quality(true);
  const dds_entity_t writer = dds_create_writer(publisher, topic, qos, NULL);
  dds_delete_qos(qos);
  for (; writer > 0 && patience_ms > 0; --patience_ms)
  {
    dds_publication_matched_status_t matched;
    if (dds_get_publication_matched_status(writer, &matched) == 0 && matched.current_count > 0) return writer;
    dds_sleepfor(DDS_MSECS(1));
  }
  return 0;
}

int main(int argc, char** argv)
{
  if (argc < 5) return 2;
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"true\"/></Interfaces></General>"
         "</Domain></CycloneDDS>",
         0);
  const int robots = atoi(argv[3]);
  if (robots < 0 || robots > kMostRobots) return 2;
  /* A unit quaternion, and a place in the arena. */
  for (int k = 0; k < robots * kColumns; ++k) poses[k] = 0.5;
  space_state.poses._buffer = engine_update.poses._buffer = poses;
  space_state.poses._length = engine_update.poses._length = (uint32_t)(robots * kColumns);

  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  const char* partition = argv[2];
  dds_qos_t* qos = dds_create_qos();
  dds_qset_partition(qos, 1, &partition);
  const dds_entity_t subscriber = dds_create_subscriber(participant, qos, NULL);
  const dds_entity_t publisher = dds_create_publisher(participant, qos, NULL);
  dds_delete_qos(qos);
  const uint64_t run = read_run(participant, subscriber);

  char* const process = argv[4];
  control_request.client = control_reply.client = view_request.client = process;
  join.process = recovery_request.process = recovery_block.process = leave.process = process;
  const int wanted = argc - 5;
  dds_entity_t writers[sizeof topics / sizeof topics[0]] = {0};
  for (size_t k = 0; k < sizeof topics / sizeof topics[0]; ++k)
  {
    if (!is_wanted(wanted, argv + 5, topics[k].name)) continue;
    if (topics[k].run != NULL) *topics[k].run = run;
    /* Of all topics some have no reader yet. */
    const int patience_ms = wanted == 0 ? 2000 : 60000;
    const dds_entity_t writer = open_writer(participant, publisher, topics[k].name, topics[k].type, patience_ms);
    writers[k] = writer;
    if (writer == 0) continue;
    const dds_return_t written = dds_write(writer, topics[k].sample);
    dds_wait_for_acks(writer, DDS_SECS(1));
    printf("%s %s\n", topics[k].name, written == 0 ? "written" : dds_strretcode(-written));
    fflush(stdout);
  }
  printf("done, run %s\n", run == 0 ? "unknown" : "known");
  fflush(stdout);
  for (int k = 0; k < 6000; ++k)
  {
    dds_sleepfor(DDS_MSECS(100));
    for (size_t topic = 0; topic < sizeof topics / sizeof topics[0]; ++topic)
      if (writers[topic] != 0) dds_write(writers[topic], topics[topic].sample);
  }
  dds_delete(participant);
  return 0;
}
