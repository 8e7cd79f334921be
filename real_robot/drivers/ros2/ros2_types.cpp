// The messages that the drivers and simulations speak, with what Fast DDS needs to send them (generated from idl/ros2).
#include "geometry_msgsPubSubTypes.h"
#include "nav_msgsPubSubTypes.h"
#include "real_robot/drivers/ros2/ros2_endpoints.h"
#include "rosgraph_msgsPubSubTypes.h"
#include "sensor_msgsPubSubTypes.h"
#include "std_msgsPubSubTypes.h"
#include "tf2_msgsPubSubTypes.h"
#include "visualization_msgsPubSubTypes.h"

// One line for each message: package and name.
#define ROS2_MESSAGE(PACKAGE, NAME)                                                                              \
  template <>                                                                                                    \
  MessageType TypeOf<::PACKAGE::msg::dds_::NAME##_>()                                                            \
  {                                                                                                              \
    return {#PACKAGE "/msg/" #NAME,                                                                              \
            static_cast<eprosima::fastdds::dds::TopicDataType*>(new ::PACKAGE::msg::dds_::NAME##_PubSubType())}; \
  }

namespace swarmanoid::ros2
{

ROS2_MESSAGE(std_msgs, Bool)
ROS2_MESSAGE(std_msgs, Float64)
ROS2_MESSAGE(std_msgs, ColorRGBA)
ROS2_MESSAGE(std_msgs, Float32MultiArray)
ROS2_MESSAGE(std_msgs, UInt8MultiArray)
ROS2_MESSAGE(geometry_msgs, PoseStamped)
ROS2_MESSAGE(geometry_msgs, Twist)
ROS2_MESSAGE(geometry_msgs, TwistStamped)
ROS2_MESSAGE(geometry_msgs, WrenchStamped)
ROS2_MESSAGE(sensor_msgs, LaserScan)
ROS2_MESSAGE(sensor_msgs, Range)
ROS2_MESSAGE(sensor_msgs, Illuminance)
ROS2_MESSAGE(sensor_msgs, Imu)
ROS2_MESSAGE(sensor_msgs, JointState)
ROS2_MESSAGE(sensor_msgs, PointCloud2)
ROS2_MESSAGE(nav_msgs, Odometry)
ROS2_MESSAGE(rosgraph_msgs, Clock)
ROS2_MESSAGE(tf2_msgs, TFMessage)
ROS2_MESSAGE(visualization_msgs, MarkerArray)

}  // namespace swarmanoid::ros2
