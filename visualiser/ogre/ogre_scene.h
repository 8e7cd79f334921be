// OgreScene: the content of a Scene as objects of OGRE. Models are uploaded once and bodies are placed each frame.
// Lights, lines and glows, which change all the time, are rebuilt each frame. The main thread uses it, while its Root
// lives.
#pragma once

#include <OgreCamera.h>
#include <OgreManualObject.h>
#include <OgreSceneManager.h>

#include <array>
#include <vector>

#include "visualiser/ogre/ogre_materials.h"
#include "visualiser/scene/camera.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{

class OgreScene
{
public:
  OgreScene(Ogre::SceneManager& manager, const Scene& scene);

  Ogre::Camera* OgreCamera() { return camera_; }
  // Updates all objects to the scene's state. `height`: of the picture in pixels, for the level of detail.
  void Update(const Scene& scene, const Camera& camera, int height, bool textures);

  // Returns how much wider than they are robots are drawn, at most.
  float MostEnlargement() const { return enlargement_; }

private:
  // The model of an item in three levels of detail, of which one is visible. It is made when first seen.
  struct Body
  {
    Ogre::SceneNode* node = nullptr;
    std::array<Ogre::Entity*, kLevels> levels{};
    Colour tint = 0;
    int shown = -1;
    float larger = 1;  // how much larger than it is it is drawn
  };
  // The vertices of a model's LEDs, three a triangle.
  struct LightVertex
  {
    Eigen::Vector3f position;
    int light;
    Colour off;
  };

  void MakeGround(const Scene& scene);
  Ogre::MeshPtr MeshOf(const Scene& scene, std::uint16_t model, int level);
  void Place(Body& body, const Scene& scene, const SceneItem& item, const Camera& camera, float pixels_per_radian);
  Ogre::Entity* EntityOf(Body& body, const Scene& scene, const SceneItem& item, int level);
  void BuildLights(const Scene& scene);
  void BuildLines(const Scene& scene);
  void BuildGlows(const Scene& scene, const Camera& camera);
  void BuildDrawn(const DrawnMarks& drawn);
  Ogre::ManualObject* MakeDynamic(const char* name, Ogre::uint8 queue);

  Ogre::SceneManager& manager_;
  OgreMaterials materials_;
  Ogre::Camera* camera_ = nullptr;
  Ogre::SceneNode* camera_node_ = nullptr;
  Ogre::ManualObject* floor_ = nullptr;
  Ogre::ManualObject* lights_ = nullptr;
  Ogre::ManualObject* lines_ = nullptr;
  Ogre::ManualObject* lines_on_top_ = nullptr;
  Ogre::ManualObject* glows_ = nullptr;
  Ogre::ManualObject* paint_ = nullptr;  // triangles of experiment functions
  Ogre::ManualObject* clear_paint_ = nullptr;
  std::vector<Body> bodies_;
  float enlargement_ = 1;
  std::vector<std::array<Ogre::MeshPtr, kLevels>> meshes_;                 // by model
  std::vector<std::array<std::vector<LightVertex>, kLevels>> led_meshes_;  // by model
};

}  // namespace swarmanoid
