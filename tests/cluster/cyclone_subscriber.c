/* Reads the poses of a running experiment with Cyclone DDS, from the types that idlc makes of idl/swarmanoid.idl.
   cyclone_subscriber DOMAIN EXPERIMENT COUNT: prints "tick x y" of the first movable entity for COUNT states. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "swarmanoid.h"

int main(int argc, char** argv)
{
  if (argc != 4) return 2;
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"true\"/></Interfaces></General>"
         "</Domain></CycloneDDS>",
         0);
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  const dds_entity_t topic = dds_create_topic(participant, &swarmanoid_wire_SpaceState_desc, "SpaceState", NULL, NULL);
  const char* partition = argv[2];
  dds_qos_t* subscriber_qos = dds_create_qos();
  dds_qset_partition(subscriber_qos, 1, &partition);
  const dds_entity_t subscriber = dds_create_subscriber(participant, subscriber_qos, NULL);
  dds_qos_t* reader_qos = dds_create_qos();
  dds_qset_reliability(reader_qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_history(reader_qos, DDS_HISTORY_KEEP_LAST, 4);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(reader_qos, 1, &xcdr1);
  const dds_entity_t reader = dds_create_reader(subscriber, topic, reader_qos, NULL);
  if (reader < 0)
  {
    fprintf(stderr, "cannot read: %s\n", dds_strretcode(-reader));
    return 1;
  }
  dds_delete_qos(subscriber_qos);
  dds_delete_qos(reader_qos);
  printf("ready\n");
  fflush(stdout);

  int wanted = atoi(argv[3]);
  for (int wait_ms = 0; wanted > 0 && wait_ms < 20000; ++wait_ms)
  {
    void* sample = NULL;
    dds_sample_info_t about;
    if (dds_take(reader, &sample, &about, 1, 1) == 1 && about.valid_data)
    {
      const swarmanoid_wire_SpaceState* state = sample;
      uint32_t single = 0;  /* columns of one number */
      for (uint32_t flag = swarmanoid_wire_FLAG_UNIFORM_X; flag <= swarmanoid_wire_FLAG_UNIFORM_QW; flag *= 2)
        single += (state->flags & flag) != 0;
      const uint32_t count = (state->poses._length - single) / (7 - single);
      const uint32_t y = state->flags & swarmanoid_wire_FLAG_UNIFORM_X ? 1 : count;
      printf("%llu %.4f %.4f\n", (unsigned long long)state->tick, state->poses._buffer[0], state->poses._buffer[y]);
      fflush(stdout);
      --wanted;
    }
    else
      dds_sleepfor(DDS_MSECS(1));
    if (sample != NULL) dds_return_loan(reader, &sample, 1);
  }
  dds_delete(participant);
  return wanted == 0 ? 0 : 1;
}
