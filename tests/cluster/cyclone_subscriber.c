/* Reads the poses of a running experiment with Cyclone DDS, from the types that idlc makes of idl/swarmanoid.idl.
   cyclone_subscriber DOMAIN EXPERIMENT COUNT [open]: prints "tick x y" of the first movable entity for COUNT states, or
   for COUNT views of one that has an open view; fails if there are not so many. */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "swarmanoid.h"

static void Print(uint64_t tick, uint32_t flags, const double* poses, uint32_t length)
{
  uint32_t single = 0; /* columns of one number */
  for (uint32_t flag = swarmanoid_wire_FLAG_UNIFORM_X; flag <= swarmanoid_wire_FLAG_UNIFORM_QW; flag *= 2)
    single += (flags & flag) != 0;
  const uint32_t count = (length - single) / (7 - single);
  const uint32_t y = flags & swarmanoid_wire_FLAG_UNIFORM_X ? 1 : count;
  printf("%llu %.4f %.4f\n", (unsigned long long)tick, poses[0], poses[y]);
  fflush(stdout);
}

int main(int argc, char** argv)
{
  if (argc != 4 && argc != 5) return 2;
  const int open_view = argc == 5;
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"true\"/></Interfaces></General>"
         "</Domain></CycloneDDS>",
         0);
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL);
  const dds_entity_t topic =
      open_view ? dds_create_topic(participant, &swarmanoid_wire_View_desc, "View/open", NULL, NULL)
                : dds_create_topic(participant, &swarmanoid_wire_SpaceState_desc, "SpaceState", NULL, NULL);
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
      if (open_view)
      {
        const swarmanoid_wire_SpaceSnapshot* view = &((const swarmanoid_wire_View*)sample)->snapshot;
        Print(view->tick, view->flags, view->poses._buffer, view->poses._length);
      }
      else
      {
        const swarmanoid_wire_SpaceState* state = sample;
        Print(state->header.tick, state->flags, state->poses._buffer, state->poses._length);
      }
      --wanted;
    }
    else
      dds_sleepfor(DDS_MSECS(1));
    if (sample != NULL) dds_return_loan(reader, &sample, 1);
  }
  dds_delete(participant);
  return wanted == 0 ? 0 : 1;
}
