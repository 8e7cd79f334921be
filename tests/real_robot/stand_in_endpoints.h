/* Topics of the stand-ins, by Cyclone DDS, with the qualities of service of ROS 2. */
#pragma once

#include <dds/dds.h>

/* On the loopback interface alone; negative where it cannot be made. */
dds_entity_t Participant(int domain);
dds_entity_t MakeWriter(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
dds_entity_t MakeReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
/* Likewise; it gets what was published before it was there, too. */
dds_entity_t MakeLateReader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name);
/* The next message of a reader, to be given back by dds_return_loan; NULL where there is none. */
void* Next(dds_entity_t reader);
/* Of a clock that only goes forward. */
double Seconds(void);
