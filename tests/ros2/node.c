/* A node of ROS 2 that controls robots of a simulation, by Cyclone DDS from idl/ros2:
     ros2_node DOMAIN plain|stamped REPEATS SILENT_FROM SILENT_UNTIL LATEST ROBOT...
   Once the scan and the odometry of a time stamp are here they are answered by a command that follows from the scan and
   the stamp alone: REPEATS times; with none in [SILENT_FROM, SILENT_UNTIL), seconds of simulated time. Prints, until
   its input ends, "ready", a line scan ROBOT SEC NANOSEC NEAR for each scan, NEAR the number of rays that see
   something, a line odom ROBOT SEC NANOSEC X Y FORWARD TURN for each odometry, and a line frame ROBOT FRAME CHILD with
   the frames of that. With LATEST a stamped command is preceded by one of another time, that must not count.
   Environment: NODE_TOGETHER=1 answers only when it has the readings of all robots. NODE_LEDS=1 commands LEDs and
   beacon, too: all LEDs but the first are dark green, that and the beacon red by a tenth more each tick.
   NODE_LATE_ODOMETRY=MS hears the odometry of the last robot only so long after the first scan. NODE_COMMANDS has words
   with spaces between, of the devices that it commands by the tick of the readings alone, see Command: gripper, turret
   (footbots), laser, attach (eyebots), bytes (all); with the word wrong what it says for tick 12 is to be refused.
   Footbots then stand or back off instead of driving, and it prints, too,
     packet ROBOT SEC NANOSEC BYTE... for what a robot receives by range and bearing, with the word bytes
     turret ROBOT SEC NANOSEC ANGLE   with the word turret
     floor ROBOT BRIGHTNESS...        with the word floor
     laser ROBOT ANGLE_MIN INCREMENT RANGE_MIN RANGE_MAX RANGE...   with the word scanner
     points ROBOT FRAME, and X Y Z RING of each                     with the word scanner
     holding ROBOT 0|1                whenever it changes, with the word gripper
   A robot whose id begins with eb is an eyebot: it is answered once its altitude is here. */
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
typedef sensor_msgs_msg_dds__Range_ Range;
typedef sensor_msgs_msg_dds__PointCloud2_ Cloud;
typedef sensor_msgs_msg_dds__JointState_ Joints;
typedef std_msgs_msg_dds__Float64_ Number;
typedef std_msgs_msg_dds__Bool_ Bool;
typedef std_msgs_msg_dds__ColorRGBA_ Colour;
typedef std_msgs_msg_dds__UInt8MultiArray_ Bytes;

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
  bool is_eyebot;
  uint8_t number; /* 80 times its place among the arguments */
  dds_entity_t scans, odometries, commands, leds, beacon;
  /* 0 where the device is not commanded. */
  dds_entity_t gripper, turret, bytes, laser_colour, laser_pan, laser_tilt, attach, columns;
  dds_entity_t altitudes, packets, joints, holdings, tables, floors, lasers, points;
  int holding;                              /* as printed last; negative: not yet */
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

/* The first answer takes NODE_FIRST_ANSWER milliseconds, the second one 50. */
static void WaitBeforeAnswer(void)
{
  static int answers = 0;
  const char* text = getenv("NODE_FIRST_ANSWER");
  if (text == NULL || answers++ > 1) return;
  usleep(answers == 1 ? 1000 * (useconds_t)atoi(text) : 50000);
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

/* Whether NODE_COMMANDS has the word; whether it has any, for "". */
static bool IsCommanded(const char* word)
{
  const char* words = getenv("NODE_COMMANDS");
  return words != NULL && strstr(words, word) != NULL;
}

static dds_entity_t WriterOf(dds_entity_t participant, const struct Robot* robot, const dds_topic_descriptor_t* type,
                             const char* name)
{
  char topic[200];
  snprintf(topic, sizeof topic, "rt/%s/%s", robot->name, name);
  return Writer(participant, type, topic);
}

static dds_entity_t ReaderOf(dds_entity_t participant, const struct Robot* robot, const dds_topic_descriptor_t* type,
                             const char* name)
{
  char topic[200];
  snprintf(topic, sizeof topic, "rt/%s/%s", robot->name, name);
  const dds_entity_t reader = MakeReader(participant, type, topic);
  if (reader < 0) exit(2);
  return reader;
}

static void CommandDevices(dds_entity_t participant, struct Robot* robot)
{
  const dds_topic_descriptor_t* number = &std_msgs_msg_dds__Float64__desc;
  const dds_topic_descriptor_t* flag = &std_msgs_msg_dds__Bool__desc;
  if (IsCommanded("bytes"))
  {
    robot->bytes = WriterOf(participant, robot, &std_msgs_msg_dds__UInt8MultiArray__desc, "range_and_bearing/send");
    robot->packets = ReaderOf(participant, robot, &sensor_msgs_msg_dds__PointCloud2__desc, "range_and_bearing");
  }
  if (IsCommanded("columns"))
  {
    robot->columns = WriterOf(participant, robot, &std_msgs_msg_dds__Float32MultiArray__desc, "directional_leds/set");
    robot->tables = ReaderOf(participant, robot, &std_msgs_msg_dds__Float32MultiArray__desc, "battery");
  }
  if (IsCommanded("scanner"))
  {
    robot->lasers = ReaderOf(participant, robot, &sensor_msgs_msg_dds__LaserScan__desc, "laser_scan");
    robot->points = ReaderOf(participant, robot, &sensor_msgs_msg_dds__PointCloud2__desc, "points");
  }
  if (IsCommanded("floor"))
    robot->floors = ReaderOf(participant, robot, &std_msgs_msg_dds__Float32MultiArray__desc, "ground");
  if (robot->is_eyebot)
  {
    if (IsCommanded("laser"))
    {
      robot->laser_colour = WriterOf(participant, robot, &std_msgs_msg_dds__ColorRGBA__desc, "laser/color");
      robot->laser_pan = WriterOf(participant, robot, number, "laser/pan");
      robot->laser_tilt = WriterOf(participant, robot, number, "laser/tilt");
    }
    if (IsCommanded("attach")) robot->attach = WriterOf(participant, robot, flag, "attach");
    return;
  }
  if (IsCommanded("gripper"))
  {
    robot->gripper = WriterOf(participant, robot, number, "gripper/command");
    robot->holdings = ReaderOf(participant, robot, flag, "gripper/holding");
  }
  if (IsCommanded("turret"))
  {
    robot->turret = WriterOf(participant, robot, number, "turret/velocity");
    robot->joints = ReaderOf(participant, robot, &sensor_msgs_msg_dds__JointState__desc, "joint_states");
  }
}

/* What the devices are told for the readings of a tick; the test has the same numbers. */
static void Command(struct Robot* robot)
{
  const int tick = (int)(robot->scan.stamp.sec * 10 + (robot->scan.stamp.nanosec + 50000000) / 100000000);
  const bool is_wrong = tick == 12 && IsCommanded("wrong");
  memset(&robot->answer, 0, sizeof robot->answer);
  if (robot->is_eyebot) robot->answer.linear.x = 0.1;
  if (robot->gripper != 0)
  {
    const Number closed = {is_wrong ? NAN : tick >= 10 && tick < 20 ? 1 : 0};
    dds_write(robot->gripper, &closed);
    robot->answer.linear.x = tick >= 12 ? -0.05 : 0;
  }
  if (robot->turret != 0)
  {
    const Number velocity = {is_wrong ? INFINITY : tick < 10 ? 0.4 : tick < 30 ? -0.8 : 0};
    dds_write(robot->turret, &velocity);
  }
  if (robot->bytes != 0)
  {
    uint8_t bytes[10] = {robot->number, (uint8_t)tick, 0, 255, 1, 2, 3, 4, 5, 6};
    Bytes message;
    memset(&message, 0, sizeof message);
    message.data._buffer = bytes;
    message.data._length = message.data._maximum = is_wrong ? 9 : tick >= 20 && tick < 30 ? 0 : 10;
    dds_write(robot->bytes, &message);
  }
  if (robot->columns != 0)
  {
    float colours[12] = {(float)tick, 0xff8040};
    std_msgs_msg_dds__Float32MultiArray_ message;
    memset(&message, 0, sizeof message);
    message.data._buffer = colours;
    message.data._length = message.data._maximum = is_wrong ? 11 : 12;
    dds_write(robot->columns, &message);
  }
  if (robot->laser_colour != 0)
  {
    const Colour colour = {0.2F, 1, tick >= 15 ? 0.6F : 0, tick >= 5 && tick < 25 ? 1 : 0};
    const Number pan = {is_wrong ? NAN : 0.05 * tick - 1}, tilt = {0.02 * tick};
    dds_write(robot->laser_colour, &colour);
    dds_write(robot->laser_pan, &pan);
    dds_write(robot->laser_tilt, &tilt);
  }
  if (robot->attach != 0)
  {
    const Bool attach = {tick >= 10 && tick < 20};
    dds_write(robot->attach, &attach);
  }
}

static uint32_t OffsetOf(const Cloud* cloud, const char* name)
{
  for (uint32_t i = 0; i < cloud->fields._length; ++i)
    if (strcmp(cloud->fields._buffer[i].name, name) == 0) return cloud->fields._buffer[i].offset;
  exit(2);
}

/* Takes what the robot said of its devices, and prints it; whether it said something. */
static bool Hear(struct Robot* robot)
{
  bool heard = false;
  void* sample;
  while (robot->altitudes != 0 && (sample = Next(robot->altitudes)) != NULL)
  {
    heard = true;
    robot->scan = robot->odometry = ((const Range*)sample)->header;
    robot->has_scan = robot->has_odometry = true;
    dds_return_loan(robot->altitudes, &sample, 1);
  }
  while (robot->packets != 0 && (sample = Next(robot->packets)) != NULL)
  {
    heard = true;
    const Cloud* cloud = sample;
    const uint32_t offset = OffsetOf(cloud, "data");
    for (uint32_t point = 0; point < cloud->width; ++point)
    {
      printf("packet %s %d %u", robot->name, cloud->header.stamp.sec, cloud->header.stamp.nanosec);
      for (uint32_t i = 0; i < 10; ++i) printf(" %u", cloud->data._buffer[point * cloud->point_step + offset + i]);
      puts("");
    }
    dds_return_loan(robot->packets, &sample, 1);
  }
  while (robot->tables != 0 && (sample = Next(robot->tables)) != NULL)
  {
    heard = true;
    const std_msgs_msg_dds__Float32MultiArray_* table = sample;
    printf("table %s %.9g %s\n", robot->name, table->data._buffer[0], table->layout.dim._buffer[1].label);
    dds_return_loan(robot->tables, &sample, 1);
  }
  while (robot->floors != 0 && (sample = Next(robot->floors)) != NULL)
  {
    heard = true;
    const std_msgs_msg_dds__Float32MultiArray_* floor = sample;
    printf("floor %s", robot->name);
    for (uint32_t i = 0; i < floor->data._length; ++i) printf(" %.9g", floor->data._buffer[i]);
    puts("");
    dds_return_loan(robot->floors, &sample, 1);
  }
  while (robot->lasers != 0 && (sample = Next(robot->lasers)) != NULL)
  {
    heard = true;
    const Scan* scan = sample;
    printf("laser %s %.9g %.9g %.9g %.9g", robot->name, scan->angle_min, scan->angle_increment, scan->range_min,
           scan->range_max);
    for (uint32_t i = 0; i < scan->ranges._length; ++i) printf(" %.9g", scan->ranges._buffer[i]);
    puts("");
    dds_return_loan(robot->lasers, &sample, 1);
  }
  while (robot->points != 0 && (sample = Next(robot->points)) != NULL)
  {
    heard = true;
    const Cloud* cloud = sample;
    const uint32_t ring_at = OffsetOf(cloud, "ring");
    printf("points %s %s", robot->name, cloud->header.frame_id);
    for (uint32_t point = 0; point < cloud->width; ++point)
    {
      const uint8_t* bytes = cloud->data._buffer + (size_t)point * cloud->point_step;
      float place[3];
      uint16_t ring;
      memcpy(place, bytes, sizeof place);
      memcpy(&ring, bytes + ring_at, sizeof ring);
      printf(" %.9g %.9g %.9g %u", place[0], place[1], place[2], ring);
    }
    puts("");
    dds_return_loan(robot->points, &sample, 1);
  }
  while (robot->joints != 0 && (sample = Next(robot->joints)) != NULL)
  {
    heard = true;
    const Joints* joints = sample;
    for (uint32_t i = 0; i < joints->name._length; ++i)
      if (strcmp(joints->name._buffer[i], "turret") == 0)
        printf("turret %s %d %u %.9g\n", robot->name, joints->header.stamp.sec, joints->header.stamp.nanosec,
               joints->position._buffer[i]);
    dds_return_loan(robot->joints, &sample, 1);
  }
  while (robot->holdings != 0 && (sample = Next(robot->holdings)) != NULL)
  {
    heard = true;
    const int holding = ((const Bool*)sample)->data;
    if (holding != robot->holding) printf("holding %s %d\n", robot->name, holding);
    robot->holding = holding;
    dds_return_loan(robot->holdings, &sample, 1);
  }
  return heard;
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
  const char* late = getenv("NODE_LATE_ODOMETRY");
  double first_scan = 0;
  struct Robot all[MOST_ROBOTS];
  memset(all, 0, sizeof all);
  for (int k = 0; k < robots; ++k)
  {
    struct Robot* robot = &all[k];
    robot->name = arguments[7 + k];
    robot->is_eyebot = strncmp(robot->name, "eb", 2) == 0;
    robot->number = (uint8_t)(80 * k);
    robot->holding = -1;
    if (robot->is_eyebot)
      robot->altitudes = ReaderOf(participant, robot, &sensor_msgs_msg_dds__Range__desc, "altitude");
    CommandDevices(participant, robot);
    char topic[200];
    snprintf(topic, sizeof topic, "rt/%s/scan", robot->name);
    robot->scans = MakeReader(participant, &sensor_msgs_msg_dds__LaserScan__desc, topic);
    snprintf(topic, sizeof topic, "rt/%s/odom", robot->name);
    if (late == NULL || k < robots - 1)
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
    if (late != NULL && all[robots - 1].odometries == 0 && first_scan > 0 && Seconds() > first_scan + atof(late) / 1000)
      all[robots - 1].odometries = ReaderOf(participant, &all[robots - 1], &nav_msgs_msg_dds__Odometry__desc, "odom");
    for (struct Robot* robot = all; robot < all + robots; ++robot)
    {
      if (Hear(robot)) idle = false;
      void* sample;
      while ((sample = Next(robot->scans)) != NULL)
      {
        idle = false;
        const Scan* scan = sample;
        if (first_scan == 0) first_scan = Seconds();
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
        printf("frame %s %s %s\n", robot->name, odometry->header.frame_id, odometry->child_frame_id);
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
      WaitBeforeAnswer();
      for (int repeat = 0; repeat < repeats && !(time >= silent_from && time < silent_until); ++repeat)
      {
        if (IsCommanded("")) Command(robot);
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
