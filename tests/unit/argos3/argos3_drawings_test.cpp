// Tests the shapes that Qt user functions of ARGoS3 draw, by their own functions and by those of OpenGL.
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "argos3/library/pen.h"
#include "argos3/library/running.h"
#include "common/messages/drawing.h"

namespace
{

using namespace argos;
using swarmanoid::DrawnShape;
using swarmanoid::argos3::TheRunning;
using testing::ElementsAre;

// Draws on request, with all functions of OpenGL.
struct Painter : public CQTOpenGLUserFunctions
{
  using CQTOpenGLUserFunctions::glBegin;
  using CQTOpenGLUserFunctions::glColor3d;
  using CQTOpenGLUserFunctions::glColor3f;
  using CQTOpenGLUserFunctions::glColor3ub;
  using CQTOpenGLUserFunctions::glColor4d;
  using CQTOpenGLUserFunctions::glColor4f;
  using CQTOpenGLUserFunctions::glColor4ub;
  using CQTOpenGLUserFunctions::glEnd;
  using CQTOpenGLUserFunctions::glLineWidth;
  using CQTOpenGLUserFunctions::glMaterialfv;
  using CQTOpenGLUserFunctions::glPointSize;
  using CQTOpenGLUserFunctions::glPolygonMode;
  using CQTOpenGLUserFunctions::glPopAttrib;
  using CQTOpenGLUserFunctions::glPopMatrix;
  using CQTOpenGLUserFunctions::glPushAttrib;
  using CQTOpenGLUserFunctions::glPushMatrix;
  using CQTOpenGLUserFunctions::glRotated;
  using CQTOpenGLUserFunctions::glRotatef;
  using CQTOpenGLUserFunctions::glScaled;
  using CQTOpenGLUserFunctions::glScalef;
  using CQTOpenGLUserFunctions::glTranslated;
  using CQTOpenGLUserFunctions::glTranslatef;
  using CQTOpenGLUserFunctions::glVertex2d;
  using CQTOpenGLUserFunctions::glVertex2f;
  using CQTOpenGLUserFunctions::glVertex3d;
  using CQTOpenGLUserFunctions::glVertex3f;

  void EntitySelected(CEntity& entity) override { told += "+" + entity.GetId(); }
  void EntityDeselected(CEntity& entity) override { told += "-" + entity.GetId(); }
  void DrawFootBot(CFootBotEntity& robot) { told += "robot " + robot.GetId() + " "; }
  void DrawFootBotAgain(CFootBotEntity& robot) { told += "again " + robot.GetId() + " "; }
  void DrawBoxEntity(CBoxEntity& box) { told += "box " + box.GetId() + " "; }
  std::string told;
};

class Argos3Drawings : public testing::Test
{
protected:
  void SetUp() override { TheRunning().pen = &pen; }
  void TearDown() override { TheRunning().pen = nullptr; }

  // Returns the kinds of the shapes.
  std::vector<DrawnShape::Kind> Kinds() const
  {
    std::vector<DrawnShape::Kind> kinds;
    for (const DrawnShape& shape : drawing.shapes) kinds.push_back(shape.kind);
    return kinds;
  }
  // Expects one shape with these numbers, colour (0xRRGGBBAA) and width (pixels), and removes it.
  void ExpectOne(DrawnShape::Kind kind, const std::vector<double>& numbers, std::uint32_t colour = 0xff0000ff,
                 double width = 1)
  {
    ASSERT_EQ(drawing.shapes.size(), 1U);
    EXPECT_EQ(drawing.shapes[0].kind, kind);
    EXPECT_EQ(drawing.shapes[0].colour, colour);
    EXPECT_EQ(drawing.shapes[0].width_16, 16 * width);
    EXPECT_EQ(drawing.shapes[0].frame, 0U);
    ASSERT_EQ(drawing.numbers.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_NEAR(drawing.numbers[i], numbers[i], 1e-6) << i;
    drawing.Clear();
  }
  // Draws vertices at x = 0, 1, … with y = x².
  void Draw(GLenum mode, int vertices)
  {
    painter.glBegin(mode);
    for (int x = 0; x < vertices; ++x) painter.glVertex2d(x, x * x);
    painter.glEnd();
  }
  // Returns the x of all numbers of the drawing, shape by shape, and removes it.
  std::vector<std::vector<int>> Corners()
  {
    std::vector<std::vector<int>> corners;
    std::size_t at = 0;
    for (const DrawnShape& shape : drawing.shapes)
    {
      corners.emplace_back();
      for (std::size_t k = at; k < at + shape.count; k += 3)
      {
        EXPECT_EQ(drawing.numbers[k + 1], drawing.numbers[k] * drawing.numbers[k]);
        corners.back().push_back(static_cast<int>(drawing.numbers[k]));
      }
      at += shape.count;
    }
    drawing.Clear();
    return corners;
  }

  swarmanoid::Drawing drawing;
  swarmanoid::argos3::Translation translation;
  swarmanoid::argos3::Pen pen{drawing, translation};
  Painter painter;
};

TEST_F(Argos3Drawings, ShapesAreRedAndOnePixelWide)
{
  painter.DrawPoint(CVector3(1, 2, 3));
  ExpectOne(DrawnShape::Kind::kPoints, {1, 2, 3}, 0xff0000ff, 5);
  painter.DrawRay(CRay3(CVector3(1, 2, 3), CVector3(4, 5, 6)));
  ExpectOne(DrawnShape::Kind::kSegments, {1, 2, 3, 4, 5, 6});
  painter.DrawCircle(CVector3(1, 2, 3), CQuaternion(), 0.5);
  ExpectOne(DrawnShape::Kind::kDisc, {1, 2, 3, 0, 0, 0, 1, 0.5});
  painter.DrawCylinder(CVector3(1, 2, 3), CQuaternion(), 0.5, 2);
  ExpectOne(DrawnShape::Kind::kCylinder, {1, 2, 3, 0, 0, 0, 1, 0.5, 2});
  painter.DrawBox(CVector3(1, 2, 3), CQuaternion(), CVector3(4, 5, 6));
  ExpectOne(DrawnShape::Kind::kBox, {1, 2, 3, 0, 0, 0, 1, 4, 5, 6});
  painter.DrawTriangle(CVector3(0, 0, 1), CQuaternion(), 2, 3);
  ExpectOne(DrawnShape::Kind::kPolygon, {-1, 0, 1, 1, 0, 1, 0, 3, 1});
  painter.DrawPolygon(CVector3(), CQuaternion(), {CVector2(0, 0), CVector2(1, 0), CVector2(1, 2)});
  ExpectOne(DrawnShape::Kind::kPolygon, {0, 0, 0, 1, 0, 0, 1, 2, 0});
  painter.DrawText(CVector3(1, 2, 3), "word");
  EXPECT_THAT(drawing.texts, ElementsAre("word"));
  ExpectOne(DrawnShape::Kind::kText, {1, 2, 3}, 0x000000ff);
}

TEST_F(Argos3Drawings, ShapesHaveTheColourWidthAndOrientationThatAreAsked)
{
  const CColor colour(1, 2, 3, 51);
  const std::uint32_t drawn = 0x01020333;
  painter.DrawPoint(CVector3(1, 2, 3), colour, 7);
  ExpectOne(DrawnShape::Kind::kPoints, {1, 2, 3}, drawn, 7);
  painter.DrawRay(CRay3(CVector3(), CVector3(1, 0, 0)), colour, 2.5);
  ExpectOne(DrawnShape::Kind::kSegments, {0, 0, 0, 1, 0, 0}, drawn, 2.5);
  const CQuaternion left(CRadians::PI_OVER_TWO, CVector3::Z);
  const double half = std::sqrt(0.5);
  painter.DrawCircle(CVector3(), left, 0.5, colour, false);
  ExpectOne(DrawnShape::Kind::kCircle, {0, 0, 0, 0, 0, half, half, 0.5}, drawn);
  painter.DrawCylinder(CVector3(), left, 0.5, 2, colour);
  ExpectOne(DrawnShape::Kind::kCylinder, {0, 0, 0, 0, 0, half, half, 0.5, 2}, drawn);
  painter.DrawBox(CVector3(), left, CVector3(1, 2, 3), colour);
  ExpectOne(DrawnShape::Kind::kBox, {0, 0, 0, 0, 0, half, half, 1, 2, 3}, drawn);
  painter.DrawTriangle(CVector3(1, 0, 0), left, 2, 3, colour, false);
  ExpectOne(DrawnShape::Kind::kPolyline, {1, -1, 0, 1, 1, 0, -2, 0, 0, 1, -1, 0}, drawn);
  painter.DrawPolygon(CVector3(0, 0, 1), left, {CVector2(0, 0), CVector2(1, 0), CVector2(1, 2)}, colour, false);
  ExpectOne(DrawnShape::Kind::kPolyline, {0, 0, 1, 0, 1, 1, -2, 1, 1, 0, 0, 1}, drawn);
  painter.DrawText(CVector3(), "word", colour);
  ExpectOne(DrawnShape::Kind::kText, {0, 0, 0}, drawn);
  // Text of the widget has the last colour.
  painter.SetColor(colour);
  painter.GetQTOpenGLWidget().renderText(1, 2, 3, "other");
  EXPECT_THAT(drawing.texts, ElementsAre("other"));
  ExpectOne(DrawnShape::Kind::kText, {1, 2, 3}, drawn);
}

TEST_F(Argos3Drawings, WrongShapesAreRefused)
{
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_THROW(painter.DrawPoint(CVector3(endless, 0, 0)), CARGoSException);
  EXPECT_THROW(painter.DrawPoint(CVector3(), CColor::RED, -1), CARGoSException);
  EXPECT_THROW(painter.DrawRay(CRay3(CVector3(endless, 0, 0), CVector3())), CARGoSException);
  EXPECT_THROW(painter.DrawCircle(CVector3(), CQuaternion(), -1), CARGoSException);
  EXPECT_THROW(painter.DrawCylinder(CVector3(), CQuaternion(), 1, -1), CARGoSException);
  EXPECT_THROW(painter.DrawBox(CVector3(), CQuaternion(), CVector3(1, -1, 1)), CARGoSException);
  EXPECT_THROW(painter.DrawTriangle(CVector3(), CQuaternion(), endless, 1), CARGoSException);
  EXPECT_THROW(painter.DrawPolygon(CVector3(), CQuaternion(), {CVector2(), CVector2(1, 0)}), CARGoSException);
  EXPECT_THROW(painter.DrawPolygon(CVector3(), CQuaternion(), {CVector2(), CVector2(1, 0)}, CColor::RED, false),
               CARGoSException);
  EXPECT_THROW(painter.DrawText(CVector3(endless, 0, 0), "word"), CARGoSException);
  EXPECT_TRUE(drawing.IsEmpty());
  TheRunning().pen = nullptr;
  EXPECT_THROW(painter.DrawPoint(CVector3()), CARGoSException) << "nothing is drawn now";
  EXPECT_THROW(painter.SetColor(CColor::RED), CARGoSException);
}

TEST_F(Argos3Drawings, VerticesMakeTheShapesOfOpenGl)
{
  using Lists = std::vector<std::vector<int>>;
  Draw(GL_POINTS, 3);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPoints));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}}));
  // Segments of one look are one shape. A last vertex without a partner draws nothing.
  Draw(GL_LINES, 5);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kSegments));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 3}}));
  Draw(GL_LINE_STRIP, 3);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolyline));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}}));
  Draw(GL_LINE_LOOP, 3);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolyline));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 0}}));
  Draw(GL_TRIANGLES, 8);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolygon, DrawnShape::Kind::kPolygon));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}, {3, 4, 5}}));
  Draw(GL_TRIANGLES, 3);
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}}));
  Draw(GL_TRIANGLE_STRIP, 5);
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));
  Draw(GL_TRIANGLE_FAN, 5);
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  Draw(GL_QUADS, 9);
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  Draw(GL_QUAD_STRIP, 7);
  EXPECT_EQ(Corners(), (Lists{{0, 1, 3, 2}, {2, 3, 5, 4}}));
  Draw(GL_POLYGON, 5);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolygon));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 3, 4}}));
  // Too few vertices draw nothing.
  const std::pair<GLenum, int> few[] = {
      {GL_POINTS, 0},       {GL_LINES, 1}, {GL_LINE_STRIP, 1}, {GL_LINE_LOOP, 0}, {GL_TRIANGLES, 2},
      {GL_TRIANGLE_FAN, 2}, {GL_QUADS, 3}, {GL_QUAD_STRIP, 3}, {GL_POLYGON, 2},   {GL_TRIANGLE_STRIP, 2}};
  for (const auto& [mode, vertices] : few)
  {
    Draw(mode, vertices);
    EXPECT_TRUE(drawing.IsEmpty()) << mode;
  }
}

TEST_F(Argos3Drawings, AreasAreOutlinedInTheModeOfLines)
{
  using Lists = std::vector<std::vector<int>>;
  painter.glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  Draw(GL_TRIANGLES, 3);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolyline));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 0}}));
  Draw(GL_POLYGON, 4);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolyline));
  EXPECT_EQ(Corners(), (Lists{{0, 1, 2, 3, 0}}));
  painter.glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  Draw(GL_POLYGON, 4);
  EXPECT_THAT(Kinds(), ElementsAre(DrawnShape::Kind::kPolygon));
}

TEST_F(Argos3Drawings, BeginAndEndComeInPairs)
{
  EXPECT_THROW(painter.glEnd(), CARGoSException);
  EXPECT_THROW(painter.glVertex3d(0, 0, 0), CARGoSException);
  painter.glBegin(GL_POINTS);
  EXPECT_THROW(painter.glBegin(GL_POINTS), CARGoSException);
  painter.glVertex3d(1, 2, 3);
  painter.glVertex3f(4, 5, 6);
  painter.glVertex2f(7, 8);
  painter.glEnd();
  ExpectOne(DrawnShape::Kind::kPoints, {1, 2, 3, 4, 5, 6, 7, 8, 0});
  EXPECT_THROW(painter.glEnd(), CARGoSException);
  EXPECT_THROW(painter.glBegin(GL_POLYGON + 1), CARGoSException);
  EXPECT_THROW(painter.glPopMatrix(), CARGoSException);
  EXPECT_THROW(painter.glPopAttrib(), CARGoSException);
  for (int pushes = 0; pushes < 64; ++pushes)
  {
    painter.glPushMatrix();
    painter.glPushAttrib(GL_CURRENT_BIT);
  }
  EXPECT_THROW(painter.glPushMatrix(), CARGoSException);
  EXPECT_THROW(painter.glPushAttrib(GL_CURRENT_BIT), CARGoSException);
  // A new drawing has the defaults.
  pen.InWorld();
  EXPECT_THROW(painter.glPopMatrix(), CARGoSException);
  EXPECT_THROW(painter.glPopAttrib(), CARGoSException);
}

TEST_F(Argos3Drawings, ColoursAndWidthsStayUntilTheNext)
{
  const auto line = [&](std::uint32_t colour, double width)
  {
    painter.glBegin(GL_LINES);
    painter.glVertex2d(0, 0);
    painter.glVertex2d(1, 0);
    painter.glEnd();
    ExpectOne(DrawnShape::Kind::kSegments, {0, 0, 0, 1, 0, 0}, colour, width);
  };
  const auto point = [&](std::uint32_t colour, double width)
  {
    painter.glBegin(GL_POINTS);
    painter.glVertex2d(0, 0);
    painter.glEnd();
    ExpectOne(DrawnShape::Kind::kPoints, {0, 0, 0}, colour, width);
  };
  line(0xff0000ff, 1);
  point(0xff0000ff, 1);
  painter.glLineWidth(3);
  painter.glPointSize(4);
  painter.glColor3d(0, 0.5, 1);
  line(0x0080ffff, 3);
  point(0x0080ffff, 4);
  painter.glColor4d(-1, 2, 0, 0.2);
  line(0x00ff0033, 3);
  painter.glColor3f(0.2F, 0.4F, 0.6F);
  line(0x336699ff, 3);
  painter.glColor4f(0.2F, 0.4F, 0.6F, 0.8F);
  line(0x336699cc, 3);
  painter.glColor3ub(1, 2, 3);
  line(0x010203ff, 3);
  painter.glColor4ub(1, 2, 3, 4);
  line(0x01020304, 3);
  const GLfloat diffuse[] = {1, 0.4F, 0.2F, 0.6F};
  painter.glMaterialfv(GL_FRONT, GL_SPECULAR, diffuse);
  line(0x01020304, 3);
  painter.glMaterialfv(GL_FRONT, GL_DIFFUSE, diffuse);
  line(0xff663399, 3);
  painter.glColor3ub(1, 2, 3);
  painter.glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, diffuse);
  line(0xff663399, 3);
  painter.glPushAttrib(GL_CURRENT_BIT);
  painter.glColor3ub(9, 9, 9);
  painter.glLineWidth(9);
  painter.glPointSize(9);
  painter.glPopAttrib();
  line(0xff663399, 3);
  point(0xff663399, 4);
  pen.InWorld();
  line(0xff0000ff, 1);
  point(0xff0000ff, 1);
}

TEST_F(Argos3Drawings, MatricesMoveWhatFollows)
{
  const auto expect_at = [&](double x, double y, double z)
  {
    painter.DrawPoint(CVector3(1, 2, 3), CColor::RED, 1);
    ExpectOne(DrawnShape::Kind::kPoints, {x, y, z});
  };
  painter.glTranslated(10, 20, 30);
  expect_at(11, 22, 33);
  painter.glPushMatrix();
  painter.glRotated(90, 0, 0, 2);
  expect_at(8, 21, 33);
  painter.glScaled(2, 3, 4);
  expect_at(4, 22, 42);
  painter.glPopMatrix();
  expect_at(11, 22, 33);
  // Attributes have no matrices.
  painter.glPushAttrib(GL_LINE_BIT);
  painter.glTranslatef(1, 2, 3);
  painter.glPopAttrib();
  expect_at(12, 24, 36);
  pen.InWorld();
  painter.glRotatef(90, 1, 0, 0);
  painter.glScalef(1, 2, 1);
  expect_at(1, -3, 4);
  EXPECT_THROW(painter.glRotated(90, 0, 0, 0), CARGoSException);
  // Bodies are turned, too.
  painter.DrawBox(CVector3(), CQuaternion(), CVector3(1, 1, 1));
  const double half = std::sqrt(0.5);
  ExpectOne(DrawnShape::Kind::kBox, {0, 0, 0, half, 0, 0, half, 1, 1, 1});
}

TEST_F(Argos3Drawings, WorldsAndEntitiesHaveTheirFrames)
{
  translation.origin = {5, 6, 7};
  pen.InWorld();
  painter.DrawPoint(CVector3(1, 1, 1), CColor::RED, 1);
  ExpectOne(DrawnShape::Kind::kPoints, {6, 7, 8});
  pen.InFrameOf(3, 0.25);
  painter.DrawPoint(CVector3(1, 1, 1), CColor::RED, 1);
  ASSERT_EQ(drawing.shapes.size(), 1U);
  EXPECT_EQ(drawing.shapes[0].frame, 4U);
  EXPECT_THAT(drawing.numbers, ElementsAre(1, 1, 0.75F));
  drawing.Clear();
  pen.InWorld();
  painter.DrawPoint(CVector3(), CColor::RED, 1);
  ExpectOne(DrawnShape::Kind::kPoints, {5, 6, 7});
}

TEST_F(Argos3Drawings, FunctionsAreForEntitiesOfTheirClass)
{
  CFootBotEntity robot("fb");
  CBoxEntity box("box", false, 0, CVector3(1, 1, 1), 1);
  painter.Call(robot);
  EXPECT_EQ(painter.told, "") << "there is no function";
  painter.RegisterUserFunction<Painter, CFootBotEntity>(&Painter::DrawFootBot);
  painter.RegisterUserFunction<Painter, CBoxEntity>(&Painter::DrawBoxEntity);
  painter.Call(robot);
  painter.Call(box);
  painter.RegisterUserFunction<Painter, CFootBotEntity>(&Painter::DrawFootBotAgain);
  painter.Call(robot);
  EXPECT_EQ(painter.told, "robot fb box box again fb ") << "the last one counts";
}

TEST_F(Argos3Drawings, OneEntityIsSelected)
{
  CFootBotEntity robot("fb");
  CBoxEntity box("box", false, 0, CVector3(1, 1, 1), 1);
  EXPECT_EQ(painter.GetSelectedEntity(), nullptr);
  painter.DeselectEntity();
  painter.SelectEntity(robot);
  painter.SelectEntity(robot);
  EXPECT_EQ(painter.GetSelectedEntity(), &robot);
  painter.SelectEntity(box);
  EXPECT_EQ(painter.GetSelectedEntity(), &box);
  painter.DeselectEntity();
  EXPECT_EQ(painter.GetSelectedEntity(), nullptr);
  EXPECT_EQ(painter.told, "+fb-fb+box-box");
}

}  // namespace
