/* Topics of the stand-ins, by Cyclone DDS, with the qualities of service of ROS 2. */
#pragma once

#include <dds/dds.h>

/* Makes a participant on the loopback interface alone. Returns a negative number if that fails. */
dds_entity_t Participant(int domain);
dds_entity_t MakeWriter(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
dds_entity_t MakeReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
/* Makes a reader that also gets messages that were published before it existed. */
dds_entity_t MakeLateReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
/* Returns the next message of a reader, or NULL. The caller returns it by dds_return_loan. */
void* Next(dds_entity_t reader);
/* Returns the time of a monotonic clock. */
double Seconds(void);
