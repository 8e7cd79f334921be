/* What a program of ROS 2 hears of a simulation, by Cyclone DDS from idl/ros2: ros2_listener DOMAIN ROBOT prints, until
   its input ends, a line for each message:
     clock SEC NANOSEC
     tf SEC NANOSEC FRAME CHILD X Y Z QX QY QZ QW
     static SEC NANOSEC FRAME CHILD X Y Z QX QY QZ QW     asked for once time has come to 2 s
     odom SEC NANOSEC FRAME CHILD X Y VX VY WZ
     marker NS ID TYPE ACTION FRAME X Y Z SX SY SZ R G B
   for each writer that it finds
     writer TOPIC TYPE USER_DATA FIELDS       FIELDS: "known" if the description of the type came and was decoded
   and first "ready". */
#include <dds/dds.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "nav_msgs.h"
#include "rosgraph_msgs.h"
#include "stand_in_endpoints.h"
#include "tf2_msgs.h"
#include "visualization_msgs.h"

static dds_entity_t Reader(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name)
{
  const dds_entity_t reader = MakeReader(participant, type, name);
  if (reader < 0) exit(2);
  return reader;
}

static void PrintTransforms(dds_entity_t reader, const char* kind)
{
  void* sample;
  while ((sample = Next(reader)) != NULL)
  {
    const tf2_msgs_msg_dds__TFMessage_* message = sample;
    for (uint32_t i = 0; i < message->transforms._length; ++i)
    {
      const geometry_msgs_msg_dds__TransformStamped_* one = &message->transforms._buffer[i];
      printf("%s %d %u %s %s %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", kind, one->header.stamp.sec,
             one->header.stamp.nanosec, one->header.frame_id, one->child_frame_id, one->transform.translation.x,
             one->transform.translation.y, one->transform.translation.z, one->transform.rotation.x,
             one->transform.rotation.y, one->transform.rotation.z, one->transform.rotation.w);
    }
    dds_return_loan(reader, &sample, 1);
  }
}

/* Exported by Cyclone DDS, whose header for it does not compile by itself. */
const dds_typeid_t* ddsi_typeinfo_complete_typeid(const dds_typeinfo_t* information);

/* Whether the writer says what its type is made of (XTypes), so that a program without the IDL could read it. */
static const char* Fields(dds_entity_t reader, dds_builtintopic_endpoint_t* writer)
{
  const dds_typeinfo_t* information = NULL;
  if (dds_builtintopic_get_endpoint_type_info(writer, &information) != DDS_RETCODE_OK || information == NULL)
    return "unknown";
  dds_typeobj_t* object = NULL;
  const dds_return_t result =
      dds_get_typeobj(dds_get_participant(reader), ddsi_typeinfo_complete_typeid(information), DDS_SECS(10), &object);
  if (result != DDS_RETCODE_OK || object == NULL) return dds_strretcode(result);
  dds_free_typeobj(object);
  return "known";
}

static void PrintWriters(dds_entity_t reader)
{
  void* sample;
  while ((sample = Next(reader)) != NULL)
  {
    dds_builtintopic_endpoint_t* writer = sample;
    void* data = NULL;
    size_t size = 0;
    if (writer->qos != NULL) dds_qget_userdata(writer->qos, &data, &size);
    printf("writer %s %s %.*s %s\n", writer->topic_name, writer->type_name, (int)size, data != NULL ? (char*)data : "",
           Fields(reader, writer));
    dds_free(data);
    dds_return_loan(reader, &sample, 1);
  }
}

int main(int count, char** arguments)
{
  if (count != 3) return 2;
  const dds_entity_t participant = Participant(atoi(arguments[1]));
  if (participant < 0) return 2;
  char odometry[200];
  snprintf(odometry, sizeof odometry, "rt/%s/odom", arguments[2]);
  const dds_entity_t clock = Reader(participant, &rosgraph_msgs_msg_dds__Clock__desc, "rt/clock");
  const dds_entity_t tf = Reader(participant, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf");
  const dds_entity_t odom = Reader(participant, &nav_msgs_msg_dds__Odometry__desc, odometry);
  const dds_entity_t arena = Reader(participant, &visualization_msgs_msg_dds__MarkerArray__desc, "rt/arena");
  const dds_entity_t writers = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL);
  dds_entity_t statics = 0;
  puts("ready");
  fflush(stdout);
  for (;;)
  {
    struct pollfd input = {STDIN_FILENO, POLLIN, 0};
    const int ended = poll(&input, 1, 5) > 0;
    void* sample;
    while ((sample = Next(clock)) != NULL)
    {
      const rosgraph_msgs_msg_dds__Clock_* message = sample;
      printf("clock %d %u\n", message->clock.sec, message->clock.nanosec);
      if (statics == 0 && message->clock.sec >= 2)
        statics = MakeLateReader(participant, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf_static");
      dds_return_loan(clock, &sample, 1);
    }
    PrintWriters(writers);
    PrintTransforms(tf, "tf");
    if (statics > 0) PrintTransforms(statics, "static");
    while ((sample = Next(odom)) != NULL)
    {
      const nav_msgs_msg_dds__Odometry_* message = sample;
      printf("odom %d %u %s %s %.17g %.17g %.17g %.17g %.17g\n", message->header.stamp.sec,
             message->header.stamp.nanosec, message->header.frame_id, message->child_frame_id,
             message->pose.pose.position.x, message->pose.pose.position.y, message->twist.twist.linear.x,
             message->twist.twist.linear.y, message->twist.twist.angular.z);
      dds_return_loan(odom, &sample, 1);
    }
    while ((sample = Next(arena)) != NULL)
    {
      const visualization_msgs_msg_dds__MarkerArray_* message = sample;
      for (uint32_t i = 0; i < message->markers._length; ++i)
      {
        const visualization_msgs_msg_dds__Marker_* one = &message->markers._buffer[i];
        printf("marker %s %d %d %d %s %g %g %g %g %g %g %g %g %g\n", one->ns, one->id, one->type, one->action,
               one->header.frame_id, one->pose.position.x, one->pose.position.y, one->pose.position.z, one->scale.x,
               one->scale.y, one->scale.z, one->color.r, one->color.g, one->color.b);
      }
      dds_return_loan(arena, &sample, 1);
    }
    if (ended) break;
  }
  dds_delete(participant);
  return 0;
}
