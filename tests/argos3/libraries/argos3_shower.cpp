// Qt user functions of ARGoS3, as users write them: ids over robots, the ways that loop functions remember, and robots
// that keys drive.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/entity/controllable_entity.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

#include <QKeyEvent>

#include <fstream>

using namespace argos;

// Drives as the user functions command it.
class CDriven : public CCI_Controller
{
public:
  void Init(TConfigurationNode& node) override
  {
    GetNodeAttributeOrDefault(node, "speed", left, left);
    right = left;
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
  }
  void ControlStep() override { wheels_->SetLinearVelocity(left, right); }

  Real left = 0, right = 0;  // cm/s

private:
  CCI_DifferentialSteeringActuator* wheels_ = nullptr;
};

REGISTER_CONTROLLER(CDriven, "driven")

// Remembers where robots were.
class CWays : public CLoopFunctions
{
public:
  void PostStep() override
  {
    for (auto& robot : GetSpace().GetEntitiesByType("foot-bot"))
    {
      auto* footbot = any_cast<CFootBotEntity*>(robot.second);
      ways[footbot->GetId()].push_back(footbot->GetEmbodiedEntity().GetOriginAnchor().Position);
    }
  }

  std::map<std::string, std::vector<CVector3>> ways;
};

REGISTER_LOOP_FUNCTIONS(CWays, "ways")

// Draws a text and a triangle in the frame of each foot-bot, and a lid on each box.
class CIds : public CQTOpenGLUserFunctions
{
public:
  CIds()
  {
    RegisterUserFunction<CIds, CFootBotEntity>(&CIds::Mark);
    RegisterUserFunction<CIds, CBoxEntity>(&CIds::Cover);
  }

private:
  void Mark(CFootBotEntity& footbot)
  {
    DrawText(CVector3(0.0, 0.0, 0.3), footbot.GetId());
    DrawTriangle(CVector3(0.2, 0, 0.01), CQuaternion(), 0.2, 0.2, CColor::MAGENTA);
  }
  void Cover(CBoxEntity& box)
  {
    const CVector3& size = box.GetSize();
    DrawBox(CVector3(0, 0, size.GetZ() + 0.01), CQuaternion(), CVector3(size.GetX(), size.GetY(), 0.02), CColor::CYAN);
  }
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CIds, "ids")

// Draws the ways that the loop functions remember.
class CShownWays : public CQTOpenGLUserFunctions
{
public:
  CShownWays() : ways_(dynamic_cast<CWays&>(CSimulator::GetInstance().GetLoopFunctions())) {}
  void Init(TConfigurationNode& node) override { GetNodeAttributeOrDefault(node, "width", width_, width_); }
  void DrawInWorld() override
  {
    for (const auto& way : ways_.ways)
      for (std::size_t k = 1; k < way.second.size(); ++k)
        DrawRay(CRay3(way.second[k - 1], way.second[k]), CColor::MAGENTA, width_);
    DrawCircle(CVector3(1, 1, 0.01), CQuaternion(), 0.2, CColor::CYAN);
    DrawCylinder(CVector3(-1, -1, 0.1), CQuaternion(), 0.1, 0.2, CColor::GREEN);
  }

private:
  CWays& ways_;
  Real width_ = 1;
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CShownWays, "shown_ways")

// Draws by OpenGL, as old code does.
class CRaw : public CQTOpenGLUserFunctions
{
public:
  void DrawInWorld() override
  {
    glDisable(GL_LIGHTING);
    glPushMatrix();
    glTranslatef(-1, -1, 0.01F);
    glRotatef(90, 0, 0, 1);
    glColor3ub(255, 0, 255);
    glBegin(GL_QUADS);
    glVertex3f(0, -0.1F, 0);
    glVertex3f(1, -0.1F, 0);
    glVertex3f(1, 0.1F, 0);
    glVertex3f(0, 0.1F, 0);
    glEnd();
    glPopMatrix();
    glColor3f(1, 1, 0);
    glBegin(GL_TRIANGLE_STRIP);
    glVertex3f(0.5F, -1.5F, 0.01F);
    glVertex3f(0.5F, -0.5F, 0.01F);
    glVertex3f(1.5F, -1.5F, 0.01F);
    glVertex3f(1.5F, -0.5F, 0.01F);
    glEnd();
    glLineWidth(5);
    glColor3f(0, 1, 1);
    glBegin(GL_LINE_LOOP);
    glVertex3f(0.5F, 0.5F, 0.01F);
    glVertex3f(1.5F, 0.5F, 0.01F);
    glVertex3f(1.5F, 1.5F, 0.01F);
    glEnd();
    glEnable(GL_LIGHTING);
    GetQTOpenGLWidget().renderText(0, 0, 0.3, "text");
  }
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CRaw, "raw")

// Keys drive the robot that is selected.
class CDriver : public CQTOpenGLUserFunctions
{
public:
  void Destroy() override { std::ofstream("driver.txt") << said_; }
  void KeyPressed(QKeyEvent* event) override { Key(event, 1); }
  void KeyReleased(QKeyEvent* event) override { Key(event, 0); }
  void EntitySelected(CEntity& entity) override
  {
    said_ += "+" + entity.GetId() + " ";
    auto* footbot = dynamic_cast<CFootBotEntity*>(&entity);
    if (footbot != nullptr) driven_ = dynamic_cast<CDriven*>(&footbot->GetControllableEntity().GetController());
  }
  void EntityDeselected(CEntity& entity) override
  {
    said_ += "-" + entity.GetId() + " ";
    if (driven_ != nullptr) driven_->left = driven_->right = 0;
    driven_ = nullptr;
  }

private:
  void Key(QKeyEvent* event, Real speed)
  {
    if (driven_ == nullptr) return GetQTOpenGLWidget().KeyPressed(event);
    switch (event->key())
    {
      case Qt::Key_I:
        driven_->left = driven_->right = 10 * speed;
        break;
      case Qt::Key_Up:
        driven_->left = driven_->right = (event->modifiers() & Qt::ShiftModifier) != 0 ? 20 * speed : 5 * speed;
        break;
      default:
        said_ += event->text().toStdString() + " ";
        CQTOpenGLUserFunctions::KeyPressed(event);
    }
  }

  CDriven* driven_ = nullptr;
  std::string said_;
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CDriver, "driver")

// Draws in a function in which nothing may be drawn.
class CTooEarly : public CQTOpenGLUserFunctions
{
public:
  void Init(TConfigurationNode&) override { DrawPoint(CVector3()); }
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CTooEarly, "too_early")

// Moves robots in a function in which it must not.
class CMeddler : public CQTOpenGLUserFunctions
{
public:
  void DrawInWorld() override
  {
    auto& robots = CSimulator::GetInstance().GetSpace().GetEntitiesByType("foot-bot");
    any_cast<CFootBotEntity*>(robots.begin()->second)
        ->GetEmbodiedEntity()
        .MoveTo(CVector3(), CQuaternion(), false, true);
  }
};

REGISTER_QTOPENGL_USER_FUNCTIONS(CMeddler, "meddler")
