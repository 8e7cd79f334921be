#include "stand_in_endpoints.h"

#include <stdlib.h>
#include <time.h>

double Seconds(void)
{
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

dds_entity_t Participant(int domain)
{
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces>"
         "</General></Domain></CycloneDDS>",
         0);
  return dds_create_participant((dds_domainid_t)domain, NULL, NULL);
}

static dds_qos_t* Qos(dds_reliability_kind_t reliability)
{
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliability, DDS_MSECS(10));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &xcdr1);
  return qos;
}

dds_entity_t MakeWriter(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name)
{
  /* As ROS 2 publishes sensors. */
  dds_qos_t* qos = Qos(DDS_RELIABILITY_BEST_EFFORT);
  const dds_entity_t writer =
      dds_create_writer(participant, dds_create_topic(participant, type, name, NULL, NULL), qos, NULL);
  dds_delete_qos(qos);
  return writer;
}

static dds_entity_t ReaderWith(dds_qos_t* qos, dds_entity_t participant, const dds_topic_descriptor_t* type,
                               const char* name)
{
  const dds_entity_t reader =
      dds_create_reader(participant, dds_create_topic(participant, type, name, NULL, NULL), qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

dds_entity_t MakeReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name)
{
  return ReaderWith(Qos(DDS_RELIABILITY_RELIABLE), participant, type, name);
}

dds_entity_t MakeLateReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name)
{
  dds_qos_t* qos = Qos(DDS_RELIABILITY_RELIABLE);
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  return ReaderWith(qos, participant, type, name);
}

void* Next(dds_entity_t reader)
{
  void* sample = NULL;
  dds_sample_info_t about;
  while (dds_take(reader, &sample, &about, 1, 1) == 1)
  {
    if (about.valid_data) return sample;
    dds_return_loan(reader, &sample, 1);
    sample = NULL;
  }
  return NULL;
}
