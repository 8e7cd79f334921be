// Viewpoints 0 to 9: reads them from the parameters of a renderer, recalls and stores them, and writes them as XML.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/configuration/parameter.h"
#include "common/experiment/experiment.h"
#include "visualiser/scene/camera.h"

namespace swarmanoid
{

class Viewpoints
{
public:
  static constexpr int kCount = 10;

  Viewpoints() = default;
  // Reads camera_view_XYZ_n and camera_view_HPR_n. Throws ConfigurationError for numbers above 9, and for a heading
  // without a position.
  explicit Viewpoints(const Parameters& parameters);

  const std::optional<Camera>& At(int number) const { return views_[static_cast<std::size_t>(number)]; }
  void Store(int number, const Camera& camera) { views_[static_cast<std::size_t>(number)] = camera; }
  // Returns the viewpoints of the first visualisation of an experiment that has some. A page without viewpoints of its
  // own offers them.
  static Viewpoints Of(const Experiment& experiment);

  // Returns the viewpoint with the smallest number, if one exists.
  std::optional<Camera> First() const;

private:
  std::array<std::optional<Camera>, kCount> views_;
};

// Returns the two elements that give this viewpoint in an experiment file.
std::string ViewpointXml(int number, const Camera& camera);

// Returns a view of the whole arena from outside; with `top`, from straight above.
Camera DefaultView(const Experiment& experiment, double aspect, bool top = false, const HiddenEdges& hidden = {});

// Reads a camera from text: the number of a viewpoint, "top", "default", or "x,y,z/heading,pitch,roll" (m, degrees; the
// second part is optional). Throws ConfigurationError with the position in the file.
Camera CameraFromText(const std::string& text, const Viewpoints& viewpoints, const Experiment& experiment,
                      double aspect, const SourceLocation& location);

}  // namespace swarmanoid
