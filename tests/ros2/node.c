/* A node of ROS 2 that controls robots of a simulation, by Cyclone DDS from idl/ros2:
     ros2_node DOMAIN plain|stamped REPEATS SILENT_FROM SILENT_UNTIL LATEST ROBOT...
   Once the scan and the odometry of a time stamp are here they are answered by a command that follows from the scan and
   the stamp alone: REPEATS times; with none in [SILENT_FROM, SILENT_UNTIL), seconds of simulated time. Prints, until its input ends, "ready", a line
     scan ROBOT SEC NANOSEC NEAR
   for each scan, NEAR the number of rays that see something, and a line
     odom ROBOT SEC NANOSEC X Y FORWARD TURN
   for each odometry. With LATEST a stamped command is preceded by one of another time, that must not count.
   Environment: NODE_TOGETHER=1 answers nobody before it has the readings of all robots. NODE_LEDS=1 commands LEDs and
   beacon, too: all LEDs but the first are dark green, that and the beacon red by a tenth more each tick. */
#include <dds/dds.h>
#include <math.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "geometry_msgs.h"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "stand_in_endpoints.h"
#include "std_msgs.h"

#define MOST_ROBOTS 128

typedef geometry_msgs_msg_dds__Twist_ Twist;
typedef geometry_msgs_msg_dds__TwistStamped_ TwistStamped;
typedef sensor_msgs_msg_dds__LaserScan_ Scan;

static dds_entity_t Writer(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name)
{
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &xcdr1);
  const dds_entity_t writer =
      dds_create_writer(participant, dds_create_topic(participant, type, name, NULL, NULL), qos, NULL);
  dds_delete_qos(qos);
  if (writer < 0) exit(2);
  return writer;
}

static unsigned Near(const Scan* scan)
{
  unsigned near = 0;
  for (uint32_t i = 0; i < scan->ranges._length; ++i)
    if (isinf(scan->ranges._buffer[i]) == 0 || scan->ranges._buffer[i] < 0) ++near;
  return near;
}

struct Robot
{
  const char* name;
  dds_entity_t scans, odometries, commands, leds, beacon;
  std_msgs_msg_dds__Header_ scan, odometry; /* of what came last, until it is answered */
  bool has_scan, has_odometry;
  Twist answer;
};

static Twist Answer(const Scan* scan)
{
  const double time = scan->header.stamp.sec + scan->header.stamp.nanosec * 1e-9;
  Twist twist = {{0.05 + 0.03 * sin(time), 0, 0}, {0, 0, 0.5 * cos(2 * time)}};
  if (Near(scan) > 0) twist = (Twist){{0, 0, 0}, {0, 0, 1}};
  return twist;
}

static bool IsSet(const char* variable)
{
  const char* text = getenv(variable);
  return text != NULL && strcmp(text, "1") == 0;
}

static void SendLeds(const struct Robot* robot)
{
  const float red = (float)(robot->scan.stamp.nanosec / 100000000) / 10;
  float channels[36];
  for (int led = 0; led < 12; ++led)
  {
    channels[3 * led] = led == 0 ? red : 0;
    channels[3 * led + 1] = led == 0 ? 0 : 0.2F;
    channels[3 * led + 2] = 0;
  }
  std_msgs_msg_dds__Float32MultiArray_ leds;
  memset(&leds, 0, sizeof leds);
  leds.data._buffer = channels;
  leds.data._length = leds.data._maximum = 36;
  dds_write(robot->leds, &leds);
  const std_msgs_msg_dds__ColorRGBA_ beacon = {red, 0, 0, red > 0 ? 1 : 0};
  dds_write(robot->beacon, &beacon);
}

static bool IsComplete(const struct Robot* robot)
{
  return robot->has_scan && robot->has_odometry && robot->scan.stamp.sec == robot->odometry.stamp.sec &&
         robot->scan.stamp.nanosec == robot->odometry.stamp.nanosec;
}

static void Send(const struct Robot* robot, bool stamped, bool with_others)
{
  if (!stamped)
  {
    dds_write(robot->commands, &robot->answer);
    return;
  }
  TwistStamped message = {robot->scan, robot->answer};
  message.header.frame_id = (char*)robot->name;
  if (with_others)
  {
    TwistStamped other = message;
    other.header.stamp.sec += 1;
    other.twist.linear.x = -1;
    dds_write(robot->commands, &other);
  }
  dds_write(robot->commands, &message);
}

int main(int count, char** arguments)
{
  if (count < 8 || count > 7 + MOST_ROBOTS) return 2;
  const dds_entity_t participant = Participant(atoi(arguments[1]));
  if (participant < 0) return 2;
  const bool stamped = strcmp(arguments[2], "stamped") == 0;
  const int repeats = atoi(arguments[3]);
  const double silent_from = atof(arguments[4]), silent_until = atof(arguments[5]);
  const bool with_others = atoi(arguments[6]) != 0;
  const bool together = IsSet("NODE_TOGETHER"), with_leds = IsSet("NODE_LEDS");
  const int robots = count - 7;
  struct Robot all[MOST_ROBOTS];
  memset(all, 0, sizeof all);
  for (int k = 0; k < robots; ++k)
  {
    struct Robot* robot = &all[k];
    robot->name = arguments[7 + k];
    char topic[200];
    snprintf(topic, sizeof topic, "rt/%s/scan", robot->name);
    robot->scans = MakeReader(participant, &sensor_msgs_msg_dds__LaserScan__desc, topic);
    snprintf(topic, sizeof topic, "rt/%s/odom", robot->name);
    robot->odometries = MakeReader(participant, &nav_msgs_msg_dds__Odometry__desc, topic);
    snprintf(topic, sizeof topic, "rt/%s/cmd_vel", robot->name);
    robot->commands = Writer(
        participant, stamped ? &geometry_msgs_msg_dds__TwistStamped__desc : &geometry_msgs_msg_dds__Twist__desc, topic);
    if (robot->scans < 0 || robot->odometries < 0) return 2;
    if (!with_leds) continue;
    snprintf(topic, sizeof topic, "rt/%s/leds", robot->name);
    robot->leds = Writer(participant, &std_msgs_msg_dds__Float32MultiArray__desc, topic);
    snprintf(topic, sizeof topic, "rt/%s/beacon", robot->name);
    robot->beacon = Writer(participant, &std_msgs_msg_dds__ColorRGBA__desc, topic);
  }
  puts("ready");
  fflush(stdout);
  for (;;)
  {
    struct pollfd input = {STDIN_FILENO, POLLIN, 0};
    const bool ended = poll(&input, 1, 0) > 0;
    bool idle = true;
    for (struct Robot* robot = all; robot < all + robots; ++robot)
    {
      void* sample;
      while ((sample = Next(robot->scans)) != NULL)
      {
        idle = false;
        const Scan* scan = sample;
        printf("scan %s %d %u %u\n", robot->name, scan->header.stamp.sec, scan->header.stamp.nanosec, Near(scan));
        robot->answer = Answer(scan);
        robot->scan = scan->header;
        robot->has_scan = true;
        dds_return_loan(robot->scans, &sample, 1);
      }
      while ((sample = Next(robot->odometries)) != NULL)
      {
        idle = false;
        const nav_msgs_msg_dds__Odometry_* odometry = sample;
        printf("odom %s %d %u %.9g %.9g %.9g %.9g\n", robot->name, odometry->header.stamp.sec,
               odometry->header.stamp.nanosec, odometry->pose.pose.position.x, odometry->pose.pose.position.y,
               odometry->twist.twist.linear.x, odometry->twist.twist.angular.z);
        robot->odometry = odometry->header;
        robot->has_odometry = true;
        dds_return_loan(robot->odometries, &sample, 1);
      }
    }
    int complete = 0;
    for (const struct Robot* robot = all; robot < all + robots; ++robot) complete += IsComplete(robot);
    for (struct Robot* robot = all; robot < all + robots; ++robot)
    {
      if (!IsComplete(robot) || (together && complete < robots)) continue;
      robot->has_scan = robot->has_odometry = false;
      const double time = robot->scan.stamp.sec + robot->scan.stamp.nanosec * 1e-9;
      for (int repeat = 0; repeat < repeats && !(time >= silent_from && time < silent_until); ++repeat)
      {
        Send(robot, stamped, with_others);
        if (with_leds) SendLeds(robot);
      }
    }
    if (ended) break;
    if (idle) usleep(100);
  }
  dds_delete(participant);
  return 0;
}
