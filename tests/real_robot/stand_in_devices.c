/* A robot that neither moves nor feels: it publishes the same value on every topic that a driver reads, and prints
   every value that comes on a topic that a driver writes, once. Made with Cyclone DDS, as stand_in_robot.c is.

   stand_in_devices DOMAIN SECONDS: prints "topic value …" and ends. The values are those of devices_test.py. */
#include <dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry_msgs.h"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "stand_in_endpoints.h"
#include "std_msgs.h"

#define RING 24
#define COUNT(ARRAY) (sizeof(ARRAY) / sizeof((ARRAY)[0]))

static dds_entity_t participant;

static void Name(char* name, const char* start, int number) { snprintf(name, 64, "%s_%d", start, number); }

/* ---- what the sensors publish ---- */

static void PublishRing(const dds_entity_t* proximity, const dds_entity_t* light)
{
  for (int i = 0; i < RING; ++i)
  {
    sensor_msgs_msg_dds__Range_ range = {0};
    range.header.frame_id = "ring";
    range.radiation_type = 1;
    range.field_of_view = 0.1F;
    range.min_range = 0.01F;
    range.max_range = 0.3F;
    range.range = i == 21 ? -INFINITY : i == 22 ? INFINITY : 0.021F + 0.005F * (float)i;
    dds_write(proximity[i], &range);
    sensor_msgs_msg_dds__Illuminance_ illuminance = {.header.frame_id = "ring", .illuminance = 50.0 * i, .variance = 7};
    dds_write(light[i], &illuminance);
  }
}

/* From 1.55 rad on the right to 1.55 rad on the left, ever farther. */
static void PublishScan(dds_entity_t writer)
{
  float ranges[32];
  for (int ray = 0; ray < 32; ++ray) ranges[ray] = 0.105036758F + 0.002F * (float)ray;
  ranges[5] = -INFINITY;
  ranges[20] = INFINITY;
  sensor_msgs_msg_dds__LaserScan_ scan = {.header.frame_id = "base_link"};
  scan.angle_min = -1.55F;
  scan.angle_increment = 0.1F;
  scan.angle_max = 1.55F;
  scan.range_min = 0.05F;
  scan.range_max = 1;
  scan.ranges._buffer = ranges;
  scan.ranges._length = scan.ranges._maximum = COUNT(ranges);
  dds_write(writer, &scan);
}

static void PublishMotion(dds_entity_t odom, dds_entity_t imu, dds_entity_t wrench, dds_entity_t altitude)
{
  nav_msgs_msg_dds__Odometry_ odometry = {.header.frame_id = "odom", .child_frame_id = "base_link"};
  odometry.pose.pose.position.x = 3;
  odometry.pose.pose.position.y = -0.5;
  odometry.pose.pose.orientation.z = 2;  // not quite of length 1: a quarter turn
  odometry.pose.pose.orientation.w = 2;
  odometry.pose.covariance[35] = 11;
  odometry.twist.twist.linear.x = 0.1;
  odometry.twist.twist.linear.y = 13;
  odometry.twist.twist.angular.z = 0.5;
  dds_write(odom, &odometry);

  sensor_msgs_msg_dds__Imu_ felt = {.header.frame_id = "imu_link"};
  felt.orientation.w = 1;
  felt.angular_velocity.z = 17;
  felt.angular_velocity_covariance[8] = 19;
  felt.linear_acceleration = (geometry_msgs_msg_dds__Vector3_){0.5, -1.25, 9.81};
  dds_write(imu, &felt);

  geometry_msgs_msg_dds__WrenchStamped_ pull = {.header.frame_id = "turret"};
  pull.wrench.force = (geometry_msgs_msg_dds__Vector3_){5, -30, 23};
  pull.wrench.torque = (geometry_msgs_msg_dds__Vector3_){29, 31, -0.375};
  dds_write(wrench, &pull);

  sensor_msgs_msg_dds__Range_ above = {
      .header.frame_id = "base_link", .min_range = 0.1F, .max_range = 10, .range = 1.75F};
  dds_write(altitude, &above);
}

static void PublishJoints(dds_entity_t writer, char** names, const double* positions, const double* velocities,
                          unsigned count)
{
  sensor_msgs_msg_dds__JointState_ state = {.header.frame_id = ""};
  state.name._buffer = names;
  state.name._length = state.name._maximum = count;
  state.position._buffer = (double*)positions;
  state.position._length = state.position._maximum = positions == NULL ? 0 : count;
  state.velocity._buffer = (double*)velocities;
  state.velocity._length = state.velocity._maximum = velocities == NULL ? 0 : count;
  dds_write(writer, &state);
}

/* As from three nodes: each tells of its own joints. */
static void PublishAllJoints(dds_entity_t writer)
{
  static char* wheels[] = {"left_wheel", "right_wheel"};
  static const double speeds[] = {1.5, -2.5};
  PublishJoints(writer, wheels, NULL, speeds, COUNT(speeds));
  static char* upper[] = {"gripper", "turret"};
  static const double angles[] = {0.3, 4.712388980384690};
  PublishJoints(writer, upper, angles, NULL, COUNT(angles));
  static char* arms[] = {"rope",      "hand_right", "hand_left", "wrist_right", "wrist_left",
                         "arm_right", "arm_left",   "head",      "unknown"};
  static const double places[] = {0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 99};
  PublishJoints(writer, arms, places, NULL, COUNT(places));
}

static void PublishFloor(dds_entity_t ground, dds_entity_t colour)
{
  static float brightness[8] = {0, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 1.5F};
  std_msgs_msg_dds__Float32MultiArray_ floor = {0};
  floor.data._buffer = brightness;
  floor.data._length = floor.data._maximum = COUNT(brightness);
  dds_write(ground, &floor);
  const std_msgs_msg_dds__ColorRGBA_ orange = {1, 0.5F, 0, 1};
  dds_write(colour, &orange);
}

/* Two rows of one point each, rgb as a float32 whose highest byte is an alpha, and other bytes between: a cloud as
   drivers of cameras make them. */
static void PublishBlobs(dds_entity_t writer)
{
  struct Point
  {
    float x, y, z, unused;
    uint32_t rgb;
  } points[2] = {{1, 1, 0, 0, 0xffff0000}, {0, -2, 1, 0, 0x800000ff}};
  sensor_msgs_msg_dds__PointField_ fields[4] = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"rgb", 16, 7, 1}};
  sensor_msgs_msg_dds__PointCloud2_ cloud = {.header.frame_id = "base_link", .height = 2, .width = 1};
  cloud.fields._buffer = fields;
  cloud.fields._length = cloud.fields._maximum = COUNT(fields);
  cloud.point_step = cloud.row_step = sizeof(struct Point);
  cloud.data._buffer = (uint8_t*)points;
  cloud.data._length = cloud.data._maximum = sizeof(points);
  cloud.is_dense = true;
  dds_write(writer, &cloud);
}

/* Two robots heard, one ahead on the left, one behind and above; the bytes stand before the places, and there are more
 * of them than are read. */
static void PublishPackets(dds_entity_t writer)
{
  struct Point
  {
    uint8_t data[12];
    float x, y, z;
  } points[2] = {{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 77, 77}, 1.5F, 2, 0},
                 {{255, 0, 0, 0, 0, 0, 0, 0, 0, 128, 77, 77}, -3, 0, 4}};
  sensor_msgs_msg_dds__PointField_ fields[4] = {{"data", 0, 2, 12}, {"x", 12, 7, 1}, {"y", 16, 7, 1}, {"z", 20, 7, 1}};
  sensor_msgs_msg_dds__PointCloud2_ cloud = {.header.frame_id = "base_link", .height = 1, .width = 2};
  cloud.fields._buffer = fields;
  cloud.fields._length = cloud.fields._maximum = COUNT(fields);
  cloud.point_step = sizeof(struct Point);
  cloud.row_step = sizeof(points);
  cloud.data._buffer = (uint8_t*)points;
  cloud.data._length = cloud.data._maximum = sizeof(points);
  cloud.is_dense = true;
  dds_write(writer, &cloud);
}

/* ---- what the actuators are told ---- */

static void PrintTwist(char* text, const void* sample)
{
  const geometry_msgs_msg_dds__Twist_* twist = sample;
  sprintf(text, "%.6g %.6g %.6g %.6g %.6g %.6g", twist->linear.x, twist->linear.y, twist->linear.z, twist->angular.x,
          twist->angular.y, twist->angular.z);
}

static void PrintPose(char* text, const void* sample)
{
  const geometry_msgs_msg_dds__PoseStamped_* pose = sample;
  const geometry_msgs_msg_dds__Point_* place = &pose->pose.position;
  const geometry_msgs_msg_dds__Quaternion_* turn = &pose->pose.orientation;
  sprintf(text, "%.32s %.6g %.6g %.6g %.6g %.6g %.6g %.6g", pose->header.frame_id, place->x, place->y, place->z,
          turn->x, turn->y, turn->z, turn->w);
}

static void PrintColour(char* text, const void* sample)
{
  const std_msgs_msg_dds__ColorRGBA_* colour = sample;
  sprintf(text, "%.4g %.4g %.4g %.4g", (double)colour->r, (double)colour->g, (double)colour->b, (double)colour->a);
}

static void PrintNumber(char* text, const void* sample)
{
  sprintf(text, "%.6g", ((const std_msgs_msg_dds__Float64_*)sample)->data);
}

static void PrintSwitch(char* text, const void* sample)
{
  sprintf(text, "%s", ((const std_msgs_msg_dds__Bool_*)sample)->data ? "yes" : "no");
}

static void PrintJoints(char* text, const void* sample)
{
  const sensor_msgs_msg_dds__JointState_* state = sample;
  text += sprintf(text, "%u positions", state->position._length);
  for (uint32_t i = 0; i < state->name._length && i < state->velocity._length && i < 8; ++i)
    text += sprintf(text, " %.32s %.6g", state->name._buffer[i], state->velocity._buffer[i]);
}

/* Each LED as a digit for each channel: 0, 1, or ? for what is between. */
static void PrintLeds(char* text, const void* sample)
{
  const std_msgs_msg_dds__Float32MultiArray_* leds = sample;
  for (uint32_t d = 0; d < leds->layout.dim._length && d < 2; ++d)
    text += sprintf(text, "%.8s %u ", leds->layout.dim._buffer[d].label, leds->layout.dim._buffer[d].size);
  for (uint32_t i = 0; i < leds->data._length && i < 48; ++i)
    text += sprintf(text, "%s%c", i > 0 && i % 3 == 0 ? " " : "",
                    leds->data._buffer[i] == 0   ? '0'
                    : leds->data._buffer[i] == 1 ? '1'
                                                 : '?');
}

static void PrintBytes(char* text, const void* sample)
{
  const std_msgs_msg_dds__UInt8MultiArray_* array = sample;
  for (uint32_t d = 0; d < array->layout.dim._length && d < 2; ++d)
    text += sprintf(text, "%.8s %u %u:", array->layout.dim._buffer[d].label, array->layout.dim._buffer[d].size,
                    array->layout.dim._buffer[d].stride);
  for (uint32_t i = 0; i < array->data._length && i < 48; ++i) text += sprintf(text, " %u", array->data._buffer[i]);
}

static struct Heard
{
  const char* topic;
  const dds_topic_descriptor_t* type;
  void (*print)(char* text, const void* sample);
  dds_entity_t reader;
  char last[512];
} heard[] = {{"cmd_vel", &geometry_msgs_msg_dds__Twist__desc, PrintTwist, 0, ""},
             {"goal_pose", &geometry_msgs_msg_dds__PoseStamped__desc, PrintPose, 0, ""},
             {"beacon", &std_msgs_msg_dds__ColorRGBA__desc, PrintColour, 0, ""},
             {"laser/color", &std_msgs_msg_dds__ColorRGBA__desc, PrintColour, 0, ""},
             {"laser/pan", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"laser/tilt", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"gripper/command", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"turret/velocity", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"hand_left/command", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"hand_right/command", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"rope/velocity", &std_msgs_msg_dds__Float64__desc, PrintNumber, 0, ""},
             {"rope/attach", &std_msgs_msg_dds__Bool__desc, PrintSwitch, 0, ""},
             {"attach", &std_msgs_msg_dds__Bool__desc, PrintSwitch, 0, ""},
             {"joint_commands", &sensor_msgs_msg_dds__JointState__desc, PrintJoints, 0, ""},
             {"leds", &std_msgs_msg_dds__Float32MultiArray__desc, PrintLeds, 0, ""},
             {"range_and_bearing/send", &std_msgs_msg_dds__UInt8MultiArray__desc, PrintBytes, 0, ""}};

static void Listen(struct Heard* topic)
{
  void* sample = NULL;
  while ((sample = Next(topic->reader)) != NULL)
  {
    char text[512];
    topic->print(text, sample);
    if (strcmp(text, topic->last) != 0)
    {
      strcpy(topic->last, text);
      printf("%s %s\n", topic->topic, text);
      fflush(stdout);
    }
    dds_return_loan(topic->reader, &sample, 1);
  }
}

/* Participants other than this one that are there. */
static int Others(dds_entity_t participants)
{
  enum
  {
    kMost = 8
  };
  void* samples[kMost] = {NULL};
  dds_sample_info_t about[kMost];
  const uint32_t alive = DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE;
  const int count = dds_read_mask(participants, samples, about, kMost, kMost, alive);
  if (count > 0) dds_return_loan(participants, samples, count);
  return count - 1;
}

/* Plays the robot until all that joined the domain have left it, or for that many seconds. */
int main(int argc, char** argv)
{
  if (argc != 3) return 2;
  participant = Participant(atoi(argv[1]));
  if (participant < 0)
  {
    fprintf(stderr, "cannot join domain %s\n", argv[1]);
    return 1;
  }
  dds_entity_t proximity[RING], light[RING];
  for (int i = 0; i < RING; ++i)
  {
    char name[64];
    Name(name, "rt/proximity", i);
    proximity[i] = MakeWriter(participant, &sensor_msgs_msg_dds__Range__desc, name);
    Name(name, "rt/light", i);
    light[i] = MakeWriter(participant, &sensor_msgs_msg_dds__Illuminance__desc, name);
  }
  const dds_entity_t scan = MakeWriter(participant, &sensor_msgs_msg_dds__LaserScan__desc, "rt/scan");
  const dds_entity_t odom = MakeWriter(participant, &nav_msgs_msg_dds__Odometry__desc, "rt/odom");
  const dds_entity_t imu = MakeWriter(participant, &sensor_msgs_msg_dds__Imu__desc, "rt/imu");
  const dds_entity_t wrench = MakeWriter(participant, &geometry_msgs_msg_dds__WrenchStamped__desc, "rt/turret/wrench");
  const dds_entity_t altitude = MakeWriter(participant, &sensor_msgs_msg_dds__Range__desc, "rt/altitude");
  const dds_entity_t joints = MakeWriter(participant, &sensor_msgs_msg_dds__JointState__desc, "rt/joint_states");
  const dds_entity_t ground = MakeWriter(participant, &std_msgs_msg_dds__Float32MultiArray__desc, "rt/ground");
  const dds_entity_t colour = MakeWriter(participant, &std_msgs_msg_dds__ColorRGBA__desc, "rt/floor_color");
  const dds_entity_t blobs = MakeWriter(participant, &sensor_msgs_msg_dds__PointCloud2__desc, "rt/blobs");
  const dds_entity_t packets = MakeWriter(participant, &sensor_msgs_msg_dds__PointCloud2__desc, "rt/range_and_bearing");
  static const struct
  {
    const char* topic;
    bool value;
  } kSwitches[] = {{"rt/gripper/holding", true},
                   {"rt/hand_left/holding", true},
                   {"rt/hand_right/holding", false},
                   {"rt/rope/attached", true}};
  dds_entity_t switches[COUNT(kSwitches)];
  for (size_t k = 0; k < COUNT(kSwitches); ++k)
    switches[k] = MakeWriter(participant, &std_msgs_msg_dds__Bool__desc, kSwitches[k].topic);
  for (size_t k = 0; k < COUNT(heard); ++k)
  {
    char name[64];
    snprintf(name, sizeof(name), "rt/%s", heard[k].topic);
    heard[k].reader = MakeReader(participant, heard[k].type, name);
  }

  const dds_entity_t participants = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL);
  bool joined = false;
  bool left = false;
  const double end = Seconds() + atof(argv[2]);
  while (!left && Seconds() < end)
  {
    const int others = Others(participants);
    joined = joined || others > 0;
    left = joined && others == 0;
    for (size_t k = 0; k < COUNT(heard); ++k) Listen(&heard[k]);
    PublishRing(proximity, light);
    PublishScan(scan);
    PublishMotion(odom, imu, wrench, altitude);
    PublishAllJoints(joints);
    PublishFloor(ground, colour);
    PublishBlobs(blobs);
    PublishPackets(packets);
    for (size_t k = 0; k < COUNT(kSwitches); ++k)
    {
      const std_msgs_msg_dds__Bool_ value = {kSwitches[k].value};
      dds_write(switches[k], &value);
    }
    dds_sleepfor(DDS_MSECS(20));
  }
  dds_delete(participant);
  return 0;
}
