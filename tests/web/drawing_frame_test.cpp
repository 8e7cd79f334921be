#include "visualiser/web/drawing_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/unit/engines/jointed_robots.h"
#include "tests/web/four_entities.h"
#include "visualiser/scene/material.h"
#include "visualiser/web/drawn_links.h"

namespace swarmanoid
{
namespace
{

TEST(DrawingFrame, HasLinesTrianglesDotsAndTextsInTheSpace)
{
  FourEntities four;
  Drawing drawing;
  drawing.Segment({0, 0, 0}, {1, 2, 3}, {0x102030, 0.5, 4});
  const Vector3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  drawing.Polygon(corners, {0x00ff00});
  drawing.InFrameOf(0);
  drawing.Point({0, 0, 0.5}, {0xff0000, 1, 8});
  drawing.Text({0, 0, 1}, "fb \"0\" \xc3\xa9\xff");
  four.space.SwapDrawing(drawing);
  four.space.SetTick(9);
  const std::string bytes = DrawingBytes(four.space);
  DrawingHeader header;
  ASSERT_GE(bytes.size(), sizeof header);
  std::memcpy(&header, bytes.data(), sizeof header);
  EXPECT_EQ(header.magic, kDrawingMagic);
  EXPECT_EQ(header.lines, 1U);
  EXPECT_EQ(header.triangles, 1U);
  EXPECT_EQ(header.dots, 1U);
  EXPECT_EQ(header.tick, 9U);
  ASSERT_EQ(bytes.size(),
            sizeof header + sizeof(DrawingLine) + sizeof(DrawingTriangle) + sizeof(DrawingDot) + header.text_bytes);
  const char* place = bytes.data() + sizeof header;
  DrawingLine line;
  std::memcpy(&line, place, sizeof line);
  EXPECT_EQ(line.from[0], 0);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(line.to[axis], axis + 1);
  EXPECT_EQ(line.colour, 0x10203080U);
  EXPECT_EQ(line.width, 4);
  DrawingTriangle triangle;
  std::memcpy(&triangle, place + sizeof line, sizeof triangle);
  EXPECT_EQ(triangle.colour, 0x00ff00ffU);
  const float corner_numbers[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (int k = 0; k < 9; ++k) EXPECT_EQ(triangle.corners[k], corner_numbers[k]) << k;
  DrawingDot dot;
  std::memcpy(&dot, place + sizeof line + sizeof triangle, sizeof dot);
  // The footbot is at 1, 1.
  EXPECT_EQ(dot.colour, 0xff0000ffU);
  EXPECT_EQ(dot.place[0], 1);
  EXPECT_EQ(dot.place[1], 1);
  EXPECT_EQ(dot.place[2], 0.5F);
  EXPECT_EQ(dot.diameter, 8);
  const auto texts = nlohmann::json::parse(bytes.substr(bytes.size() - header.text_bytes));
  ASSERT_EQ(texts.size(), 1U);
  EXPECT_EQ(header.magic, 0x344d5753U);
  EXPECT_EQ(texts[0][0], 1);
  EXPECT_EQ(texts[0][1], 1);
  EXPECT_EQ(texts[0][2], 1);
  EXPECT_EQ(texts[0][3], 0xffU);
  EXPECT_EQ(texts[0][4], "fb \"0\" \xc3\xa9\xef\xbf\xbd") << "what is no UTF-8 is replaced";
}

TEST(DrawnLinks, FollowTheJointsOfRobotsInTheArena)
{
  Experiment experiment = FourEntities::Make();
  // What collides is also what is drawn.
  const std::string links_of_cart = std::regex_replace(
      test::LinksOfCartWithArm(), std::regex("<collision>(.*?)</collision>"), "$&<visual>$1</visual>");
  const EntityKind cart = test::KindOfUrdf("test_drawn_cart", links_of_cart);
  test::Add(experiment, test::Entity(cart, "cart", {1, 3, 0}, {0.3, 0.2, 0.4}, true));
  CSwarmanoidSpace space(experiment);
  const DrawnLinks links(space);
  ASSERT_TRUE(links.AreThere());
  std::vector<DrawnMarks::Triangle> before, lifted;
  links.Add(before);
  // The boxes of the upper arm and the hand; the mast has no shape.
  ASSERT_GE(before.size(), 24U);
  space.SetAttribute(space.GetEntity(4).SlotOf("joint_lift"), 0.1);
  links.Add(lifted);
  ASSERT_EQ(lifted.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k)
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const Eigen::Vector3f moved = lifted[k].corners[corner] - before[k].corners[corner];
      EXPECT_NEAR((moved - Eigen::Vector3f(0, 0, 0.1F)).norm(), 0, 1e-6);
      EXPECT_LT((before[k].corners[corner] - Eigen::Vector3f(1.3F, 3, 0.1F)).norm(), 0.4F) << "beside the cart";
    }
  // The drawing of the tick has them, in full, and in no colour brighter than the paint of the kind.
  const std::string bytes = DrawingBytes(space, &links);
  DrawingHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  EXPECT_EQ(header.triangles, before.size());
  const Colour paint = Paint(DescriptionOf(cart).colour);
  for (const DrawnMarks::Triangle& triangle : before)
  {
    EXPECT_EQ(triangle.opacity, 1);
    for (const unsigned shift : {0U, 8U, 16U})
    {
      const auto channel = static_cast<float>(triangle.colour >> shift & 0xffU);
      const auto full = static_cast<float>(paint >> shift & 0xffU);
      EXPECT_LE(channel, full);
      EXPECT_GE(channel, 0.49F * full);
    }
  }
  EXPECT_EQ(before[0].colour >> 24U, 0U);
  const auto is_paint = [&](const DrawnMarks::Triangle& triangle) { return triangle.colour == paint; };
  EXPECT_TRUE(std::ranges::any_of(before, is_paint)) << "faces that look up have the full colour";
  space.SetAttribute(space.PresenceSlot(4), 0);
  lifted.clear();
  links.Add(lifted);
  EXPECT_TRUE(lifted.empty()) << "outside the arena";
  FourEntities four;
  EXPECT_FALSE(DrawnLinks(four.space).AreThere());
}

}  // namespace
}  // namespace swarmanoid
