// A swarm has thousands of bodies of a few kinds. Each kind is uploaded once in three levels of detail, and a body is a
// node with the level that its size on the screen asks for (38 and 11 pixels). OGRE has one material for each part of
// an object, so a mesh is split into sections by material and paint. LEDs change their colour in every frame, so their
// triangles are left out of the meshes and written again for each frame, with lines, glows and drawings.
#include "visualiser/ogre/ogre_scene.h"

#include <fmt/format.h>

#include <OgreEntity.h>
#include <OgreMesh.h>
#include <OgreSceneNode.h>
#include <OgreSubEntity.h>
#include <OgreSubMesh.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "common/space/shape.h"
#include "common/space/space.h"
#include "visualiser/scene/enlargement.h"
#include "visualiser/scene/floor_grid.h"
#include "visualiser/scene/picking.h"

namespace swarmanoid
{
namespace
{

using Ogre::RenderOperation;

// A body with a smaller radius (pixels) gets the next level of detail.
constexpr float kNearPixels = 38;
constexpr float kMiddlePixels = 11;
constexpr float kLeastPixels = 4;     // the width of a robot
constexpr float kPatchLift = 0.004F;  // m above the floor, against flicker at a distance
constexpr int kGlowCorners = 20;

Ogre::Vector3 ToOgre(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }
Ogre::Vector3 ToOgre(const Vector3& v)
{
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

bool IsLight(Material material) { return LookOf(material).led >= 0; }

// A part of a mesh with one OGRE material. In painted meshes each colour is a section.
using Section = std::pair<Material, Colour>;
Section SectionOf(const MeshVertex& vertex)
{
  return {vertex.material, vertex.material == Material::kPainted ? vertex.colour : palette::kWall};
}
// Returns the sections in the order of the parts of OGRE's mesh.
std::set<Section> SectionsOf(const Mesh& mesh)
{
  std::set<Section> sections;
  for (const MeshVertex& vertex : mesh.vertices) sections.insert(SectionOf(vertex));
  return sections;
}

// Starts a section of an object that is rebuilt each frame.
void Begin(Ogre::ManualObject* object, const char* material, RenderOperation::OperationType type)
{
  if (object->getSections().empty())
    object->begin(material, type);
  else
    object->beginUpdate(0);
}

// OGRE refuses an empty section, so a point out of sight is added.
void AddNothing(Ogre::ManualObject* object, int vertices)
{
  for (int i = 0; i < vertices; ++i)
  {
    object->position(0, 0, -1000);
    object->colour(0, 0, 0, 0);
  }
}

}  // namespace

OgreScene::OgreScene(Ogre::SceneManager& manager, const Scene& scene) : manager_(manager)
{
  manager_.setAmbientLight(Ogre::ColourValue(0.52F, 0.54F, 0.58F));
  Ogre::Light* sun = manager_.createLight("sun");
  sun->setType(Ogre::Light::LT_DIRECTIONAL);
  sun->setDiffuseColour(0.62F, 0.60F, 0.56F);
  sun->setSpecularColour(0.5F, 0.5F, 0.5F);
  Ogre::SceneNode* sun_node = manager_.getRootSceneNode()->createChildSceneNode();
  sun_node->setDirection(Ogre::Vector3(0.45F, 0.35F, -0.85F).normalisedCopy(), Ogre::Node::TS_WORLD);
  sun_node->attachObject(sun);

  camera_ = manager_.createCamera("camera");
  camera_->setAutoAspectRatio(true);
  camera_node_ = manager_.getRootSceneNode()->createChildSceneNode();
  camera_node_->attachObject(camera_);

  MakeGround(scene);
  lights_ = MakeDynamic("lights", Ogre::RENDER_QUEUE_MAIN);
  glows_ = MakeDynamic("glows", Ogre::RENDER_QUEUE_7);
  lines_ = MakeDynamic("lines", Ogre::RENDER_QUEUE_8);
  lines_on_top_ = MakeDynamic("lines_on_top", Ogre::RENDER_QUEUE_9);
  paint_ = MakeDynamic("paint", Ogre::RENDER_QUEUE_MAIN);
  clear_paint_ = MakeDynamic("clear_paint", Ogre::RENDER_QUEUE_8);
  bodies_.resize(scene.Items().size());
  meshes_.resize(scene.Models().size());
  led_meshes_.resize(scene.Models().size());
}

Ogre::ManualObject* OgreScene::MakeDynamic(const char* name, Ogre::uint8 queue)
{
  Ogre::ManualObject* object = manager_.createManualObject(name);
  object->setDynamic(true);
  object->setCastShadows(false);
  object->setRenderQueueGroup(queue);
  object->setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
  manager_.getRootSceneNode()->attachObject(object);
  return object;
}

void OgreScene::MakeGround(const Scene& scene)
{
  const auto width = static_cast<float>(scene.ArenaSize().x());
  const auto depth = static_cast<float>(scene.ArenaSize().y());
  const auto cell = static_cast<float>(FloorSpacing(scene.ArenaSize()));
  const auto rectangle =
      [&](const char* name, const Ogre::MaterialPtr& material, float x0, float y0, float x1, float y1, float z)
  {
    Ogre::ManualObject* object = manager_.createManualObject(name);
    object->begin(material, RenderOperation::OT_TRIANGLE_LIST);
    const float corners[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    for (const auto& [x, y] : corners)
    {
      object->position(x, y, z);
      object->normal(0, 0, 1);
      object->textureCoord(x / (2 * cell), y / (2 * cell));  // the texture has two by two cells
    }
    object->quad(0, 1, 2, 3);
    object->end();
    object->setCastShadows(false);
    manager_.getRootSceneNode()->attachObject(object);
    return object;
  };
  const float around = 10 * std::hypot(width, depth);
  rectangle("outside", materials_.Lit(Material::kTint, palette::kOutside), -around, -around, width + around,
            depth + around, -0.02F);
  floor_ = rectangle("floor", materials_.Floor(true), 0, 0, width, depth, 0);
}

Ogre::MeshPtr OgreScene::MeshOf(const Scene& scene, std::uint16_t model, int level)
{
  const auto l = static_cast<std::size_t>(level);
  Ogre::MeshPtr& made = meshes_[model][l];
  if (made) return made;
  const Mesh& mesh = scene.Models()[model].levels[l];
  Ogre::ManualObject object("upload");
  for (const auto& [material, colour] : SectionsOf(mesh))
  {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    {
      const MeshVertex& first = mesh.vertices[mesh.indices[i]];
      if (SectionOf(first) != Section(material, colour)) continue;
      if (IsLight(material))
      {
        const MaterialLook& look = LookOf(material);
        for (std::size_t k = 0; k < 3; ++k)
          led_meshes_[model][l].push_back({mesh.vertices[mesh.indices[i + k]].position, look.led, look.colour});
        continue;
      }
      if (next == 0) object.begin(materials_.Lit(material, colour), RenderOperation::OT_TRIANGLE_LIST);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const MeshVertex& vertex = mesh.vertices[mesh.indices[i + k]];
        object.position(ToOgre(vertex.position));
        object.normal(ToOgre(vertex.normal));
      }
      object.triangle(next, next + 1, next + 2);
      next += 3;
    }
    if (next > 0) object.end();
  }
  if (object.getSections().empty()) return {};
  made = object.convertToMesh(fmt::format("model_{}_{}", model, level));
  return made;
}

Ogre::Entity* OgreScene::EntityOf(Body& body, const Scene& scene, const SceneItem& item, int level)
{
  Ogre::Entity*& entity = body.levels[static_cast<std::size_t>(level)];
  if (entity == nullptr)
  {
    const Ogre::MeshPtr mesh = MeshOf(scene, item.model, level);
    if (!mesh) return nullptr;
    entity = manager_.createEntity(mesh);
    entity->setCastShadows(item.role == SceneItem::Role::kBody);
    body.node->attachObject(entity);
    body.tint = ~item.tint;
  }
  if (body.tint != item.tint || body.shown != level)
  {
    body.tint = item.tint;
    const Mesh& mesh = scene.Models()[item.model].levels[static_cast<std::size_t>(level)];
    std::size_t part = 0;
    for (const auto& [material, colour] : SectionsOf(mesh))
    {
      if (IsLight(material) || part >= entity->getNumSubEntities()) continue;
      if (LookOf(material).takes_tint) entity->getSubEntity(part)->setMaterial(materials_.Lit(material, item.tint));
      ++part;
    }
  }
  return entity;
}

void OgreScene::Place(Body& body, const Scene& scene, const SceneItem& item, const Camera& camera,
                      float pixels_per_radian)
{
  if (body.node == nullptr) body.node = manager_.getRootSceneNode()->createChildSceneNode();
  if (!item.present)
  {
    if (body.shown >= 0) body.node->setVisible(false);
    body.shown = -1;
    return;
  }
  Eigen::Vector3f position = item.position;
  Eigen::Vector3f scale = item.scale;
  if (item.role == SceneItem::Role::kPatch) position.z() += kPatchLift;
  if (item.role == SceneItem::Role::kWall && item.entity != kNoEntity)
  {
    const EntityConfiguration& wall = scene.Space().GetEntity(item.entity).GetConfiguration();
    const float left = SolidHeight(wall, scene.ArenaSize(), camera.position);
    if (scale.z() > left)
    {
      position.z() += (left - scale.z()) / 2;
      scale.z() = left;
    }
  }
  body.larger = 1;
  if (item.entity != kNoEntity && IsRobot(scene.Space().GetEntity(item.entity).GetKind()))
  {
    const Vector3 half_size = ShapeOf(scene.Space().GetEntity(item.entity).GetConfiguration()).half_size;
    const auto radius = static_cast<float>(half_size.head<2>().maxCoeff());
    const float away = std::max((position - camera.position.cast<float>()).norm(), 0.01F);
    body.larger = Enlargement(2 * radius / away * pixels_per_radian, kLeastPixels);
    enlargement_ = std::max(enlargement_, body.larger);
    scale *= body.larger;
  }
  body.node->setPosition(ToOgre(position));
  body.node->setOrientation(item.orientation.w(), item.orientation.x(), item.orientation.y(), item.orientation.z());
  body.node->setScale(ToOgre(scale));

  const float distance = (position - camera.position.cast<float>()).norm();
  const float pixels =
      scene.Models()[item.model].radius * scale.maxCoeff() / std::max(distance, 0.01F) * pixels_per_radian;
  const int level = pixels > kNearPixels ? 0 : pixels > kMiddlePixels ? 1 : 2;
  EntityOf(body, scene, item, level);
  if (body.shown == level) return;
  body.shown = level;
  for (int l = 0; l < kLevels; ++l)
    if (Ogre::Entity* entity = body.levels[static_cast<std::size_t>(l)]) entity->setVisible(l == level);
}

void OgreScene::Update(const Scene& scene, const Camera& camera, int height, bool textures)
{
  camera_node_->setPosition(ToOgre(camera.position));
  camera_node_->setOrientation(
      Ogre::Quaternion(ToOgre(camera.Right()), ToOgre(camera.Up()), -ToOgre(camera.Forward())));
  const auto fov = static_cast<float>(camera.field_of_view * std::numbers::pi / 180);
  camera_->setFOVy(Ogre::Radian(fov));
  Vector3 low, high;
  scene.Bounds(low, high);
  const auto [near, far] = camera.DepthRange(low, high);
  camera_->setNearClipDistance(static_cast<float>(near));
  camera_->setFarClipDistance(static_cast<float>(far));
  floor_->getSections()[0]->setMaterial(materials_.Floor(textures));

  const float pixels_per_radian = static_cast<float>(height) / (2 * std::tan(fov / 2));
  enlargement_ = 1;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (scene.Items()[i].role != SceneItem::Role::kFloor)
      Place(bodies_[i], scene, scene.Items()[i], camera, pixels_per_radian);
  BuildLights(scene);
  BuildLines(scene);
  BuildGlows(scene, camera);
  BuildDrawn(scene.Drawn());
}

void OgreScene::BuildLights(const Scene& scene)
{
  Begin(lights_, materials_.Lights(), RenderOperation::OT_TRIANGLE_LIST);
  AddNothing(lights_, 3);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
  {
    const SceneItem& item = scene.Items()[i];
    if (item.lights < 0 || bodies_[i].shown < 0) continue;
    for (const LightVertex& vertex : led_meshes_[item.model][static_cast<std::size_t>(bodies_[i].shown)])
    {
      const Colour colour = scene.Lights()[static_cast<std::size_t>(item.lights + vertex.light)];
      const Eigen::Vector3f scale = bodies_[i].larger * item.scale;
      lights_->position(
          ToOgre(Eigen::Vector3f(item.position + item.orientation * vertex.position.cwiseProduct(scale))));
      lights_->colour(OgreColour(colour == 0 ? vertex.off : colour));
    }
  }
  lights_->end();
}

void OgreScene::BuildLines(const Scene& scene)
{
  for (const bool on_top : {false, true})
  {
    Ogre::ManualObject* object = on_top ? lines_on_top_ : lines_;
    Begin(object, on_top ? materials_.LinesOnTop() : materials_.Lines(), RenderOperation::OT_LINE_LIST);
    AddNothing(object, 2);
    for (const SceneLine& line : scene.Lines())
    {
      if (line.on_top != on_top) continue;
      object->position(ToOgre(line.from));
      object->colour(OgreColour(line.colour, line.opacity_from));
      object->position(ToOgre(line.to));
      object->colour(OgreColour(line.colour, line.opacity_to));
    }
    for (const DrawnMarks::Line& line : scene.Drawn().lines)
    {
      if (on_top) break;
      for (const Eigen::Vector3f& end : {line.from, line.to})
      {
        object->position(ToOgre(end));
        object->colour(OgreColour(line.colour, line.opacity));
      }
    }
    object->end();
  }
}

void OgreScene::BuildDrawn(const DrawnMarks& drawn)
{
  for (const bool clear : {false, true})
  {
    Ogre::ManualObject* object = clear ? clear_paint_ : paint_;
    Begin(object, clear ? materials_.Lines() : materials_.Lights(), RenderOperation::OT_TRIANGLE_LIST);
    AddNothing(object, 3);
    for (const DrawnMarks::Triangle& triangle : drawn.triangles)
    {
      if ((triangle.opacity < 1) != clear) continue;
      for (const Eigen::Vector3f& corner : triangle.corners)
      {
        object->position(ToOgre(corner));
        object->colour(OgreColour(triangle.colour, triangle.opacity));
      }
    }
    object->end();
  }
}

// Builds discs that fade towards their rims.
void OgreScene::BuildGlows(const Scene& scene, const Camera& camera)
{
  Begin(glows_, materials_.Glows(), RenderOperation::OT_TRIANGLE_LIST);
  AddNothing(glows_, 3);
  for (const SceneGlow& glow : scene.Glows())
  {
    Eigen::Vector3f right = Eigen::Vector3f::UnitX();
    Eigen::Vector3f up = Eigen::Vector3f::UnitY();
    if (!glow.flat)
    {
      right = camera.Right().cast<float>();
      up = camera.Up().cast<float>();
    }
    const auto rim = [&](int corner)
    {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(corner) / kGlowCorners;
      return Eigen::Vector3f(glow.position + glow.radius * (std::cos(angle) * right + std::sin(angle) * up));
    };
    for (int corner = 0; corner < kGlowCorners; ++corner)
    {
      glows_->position(ToOgre(glow.position));
      glows_->colour(OgreColour(glow.colour, 0.8F));
      for (const int other : {corner, corner + 1})
      {
        glows_->position(ToOgre(rim(other)));
        glows_->colour(OgreColour(glow.colour, 0));
      }
    }
  }
  glows_->end();
}

}  // namespace swarmanoid
