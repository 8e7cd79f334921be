// The messages of the drivers and simulations, with the types that Fast DDS needs to send them (generated from
// idl/ros2).
#include "common/bus/dds/fast_dds.h"
#include "geometry_msgsPubSubTypes.h"
#include "nav_msgsPubSubTypes.h"
#include "real_robot/drivers/ros2/ros2_endpoints.h"
#include "rosgraph_msgsPubSubTypes.h"
#include "sensor_msgsPubSubTypes.h"
#include "std_msgsPubSubTypes.h"
#include "tf2_msgsPubSubTypes.h"
#include "visualization_msgsPubSubTypes.h"

// The list has one line for each message: package, name, and the hash of ROS 2 (tests/repository/type_hashes.py
// computes it).
#define ROS2_MESSAGE(PACKAGE, NAME, HASH)                                                     \
  template <>                                                                                 \
  MessageType TypeOf<::PACKAGE::msg::dds_::NAME##_>()                                         \
  {                                                                                           \
    return {#PACKAGE "/msg/" #NAME, HASH,                                                     \
            static_cast<dds::TopicDataType*>(new ::PACKAGE::msg::dds_::NAME##_PubSubType())}; \
  }

namespace swarmanoid::ros2
{

ROS2_MESSAGE(std_msgs, Bool, "RIHS01_feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9")
ROS2_MESSAGE(std_msgs, Float64, "RIHS01_705ba9c3d1a09df43737eb67095534de36fd426c0587779bda2bc51fe790182a")
ROS2_MESSAGE(std_msgs, ColorRGBA, "RIHS01_77a7a5b9ae477306097665106e0413ba74440245b1f3d0c6d6405fe5c7813fe8")
ROS2_MESSAGE(std_msgs, Float32MultiArray, "RIHS01_0599f6f85b4bfca379873a0b4375a0aca022156bd2d7021275d116ed1fa8bfe0")
ROS2_MESSAGE(std_msgs, UInt8MultiArray, "RIHS01_5687e861b8d307a5e48b7515467ae7a5fc2daf805bd0ce6d8e9e604bade9f385")
ROS2_MESSAGE(geometry_msgs, PoseStamped, "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8")
ROS2_MESSAGE(geometry_msgs, Twist, "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a")
ROS2_MESSAGE(geometry_msgs, TwistStamped, "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64")
ROS2_MESSAGE(geometry_msgs, WrenchStamped, "RIHS01_8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77")
ROS2_MESSAGE(sensor_msgs, LaserScan, "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828")
ROS2_MESSAGE(sensor_msgs, Range, "RIHS01_9430b1915b94d4268ff903679e8ecd09b6a67d331bd028738ec1eeb592891ebd")
ROS2_MESSAGE(sensor_msgs, Illuminance, "RIHS01_b954b25f452fcf81a91c9c2a7e3b3fd85c4c873d452aecb3cfd8fd1da732a22d")
ROS2_MESSAGE(sensor_msgs, Imu, "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b")
ROS2_MESSAGE(sensor_msgs, JointState, "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e")
ROS2_MESSAGE(sensor_msgs, PointCloud2, "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5")
ROS2_MESSAGE(nav_msgs, Odometry, "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0")
ROS2_MESSAGE(rosgraph_msgs, Clock, "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564")
ROS2_MESSAGE(tf2_msgs, TFMessage, "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087")
ROS2_MESSAGE(visualization_msgs, MarkerArray, "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf")

}  // namespace swarmanoid::ros2
