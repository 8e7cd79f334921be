// Kinds of robots with joints, written as URDF files, for the tests of engines.
#pragma once

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <string>

#include "common/experiment/urdf_kind.h"

namespace swarmanoid::test
{

// Returns the kind of a text, which is registered at the first call.
inline EntityKind KindOfUrdf(const std::string& tag, const std::string& links)
{
  if (const auto known = KindOfTag(tag)) return *known;
  const UrdfKind read = KindFromUrdf(tag, "<robot name='r'>\n" + links + "</robot>", tag + ".urdf");
  for (const Diagnostic& error : read.errors) ADD_FAILURE() << error.location.Text() << ": " << error.message;
  RegisterEntityKind(read.kind);
  return *KindOfTag(tag);
}

inline std::string Inertial(double mass, double moment, const std::string& origin = "0 0 0")
{
  return fmt::format(
      "<inertial><origin xyz='{0}'/><mass value='{1}'/><inertia ixx='{2}' ixy='0' ixz='0' iyy='{2}' "
      "iyz='0' izz='{2}'/></inertial>",
      origin, mass, moment);
}

inline std::string UrdfBox(const std::string& size, const std::string& origin = "0 0 0")
{
  return fmt::format("<collision><origin xyz='{}'/><geometry><box size='{}'/></geometry></collision>", origin, size);
}

inline std::string UrdfLink(const std::string& name, const std::string& content)
{
  return "<link name='" + name + "'>" + content + "</link>\n";
}

inline std::string UrdfJoint(const std::string& name, const std::string& type, const std::string& parent,
                             const std::string& child, const std::string& origin, const std::string& axis,
                             const std::string& more = "")
{
  return fmt::format(
      "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/><origin xyz='{}'/><axis "
      "xyz='{}'/>{}</joint>\n",
      name, type, parent, child, origin, axis, more);
}

inline std::string UrdfLimit(double lower, double upper, double effort, double velocity)
{
  return fmt::format("<limit lower='{}' upper='{}' effort='{}' velocity='{}'/>", lower, upper, effort, velocity);
}

// A heavy tower of 0.4 x 0.4 x 1 m, whose origin is in its middle.
inline std::string UrdfTower() { return UrdfLink("tower", Inertial(500, 50) + UrdfBox("0.4 0.4 1")); }

// A walker of 1.2 kg on four legs of two joints each.
inline EntityKind FourLegs()
{
  std::string text = UrdfLink("body", Inertial(0.8, 0.004) + UrdfBox("0.2 0.12 0.04"));
  for (const std::string x : {"0.09", "-0.09"})
    for (const std::string y : {"0.07", "-0.07"})
    {
      const std::string leg = (x[0] == '-' ? "back" : "front") + std::string(y[0] == '-' ? "_right" : "_left");
      text += UrdfLink(leg + "_thigh", Inertial(0.05, 0.00005, "0 0 -0.03"));
      text += UrdfLink(leg + "_shin", Inertial(0.05, 0.00005, "0 0 -0.03") +
                                          "<collision><origin xyz='0 0 -0.06'/><geometry><sphere "
                                          "radius='0.012'/></geometry></collision>");
      text += UrdfJoint(leg + "_hip", "revolute", "body", leg + "_thigh", x + " " + y + " 0", "0 1 0",
                        UrdfLimit(-1, 1, 3, 8));
      text += UrdfJoint(leg + "_knee", "revolute", leg + "_thigh", leg + "_shin", "0 0 -0.06", "0 1 0",
                        UrdfLimit(-1.5, 0.5, 3, 8));
    }
  return KindOfUrdf("test_four_legs", text);
}

// A cart on two wheels with an arm of two joints and a lift.
inline std::string LinksOfCartWithArm()
{
  std::string text = UrdfLink("base", Inertial(3, 0.02) + UrdfBox("0.3 0.2 0.08"));
  for (const std::string side : {"left", "right"})
  {
    const std::string wheel =
        "<collision><origin rpy='1.5707963 0 0'/><geometry><cylinder radius='0.05' "
        "length='0.02'/></geometry></collision>";
    text += UrdfLink(side, Inertial(0.1, 0.0001) + wheel);
    text += UrdfJoint(side + "_wheel", "continuous", "base", side, side == "left" ? "0 0.12 0" : "0 -0.12 0", "0 1 0",
                      "<limit effort='1' velocity='10'/>");
  }
  text += UrdfLink("mast", Inertial(0.2, 0.001));
  text += UrdfLink("upper", Inertial(0.1, 0.0003, "0.1 0 0") + UrdfBox("0.2 0.02 0.02", "0.1 0 0"));
  text += UrdfLink("hand", Inertial(0.05, 0.0001, "0.05 0 0") + UrdfBox("0.1 0.02 0.02", "0.05 0 0"));
  text += UrdfJoint("lift", "prismatic", "base", "mast", "0 0 0.02", "0 0 1", UrdfLimit(0, 0.2, 30, 0.2));
  text += UrdfJoint("shoulder", "continuous", "mast", "upper", "0 0 0.05", "0 0 1", "<limit effort='2' velocity='2'/>");
  text += UrdfJoint("elbow", "revolute", "upper", "hand", "0.2 0 0", "0 1 0", UrdfLimit(-1, 1.2, 2, 3));
  return text;
}
inline EntityKind CartWithArm() { return KindOfUrdf("test_cart_with_arm", LinksOfCartWithArm()); }

}  // namespace swarmanoid::test
