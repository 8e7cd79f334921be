// Viewpoints 0 to 9: read from the parameters of a renderer, recalled, stored, and written as XML again.
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
  // From camera_view_XYZ_n and camera_view_HPR_n. Throws ConfigurationError for numbers above 9, and for a heading
  // without a place.
  explicit Viewpoints(const Parameters& parameters);

  const std::optional<Camera>& At(int number) const { return views_[static_cast<std::size_t>(number)]; }
  void Store(int number, const Camera& camera) { views_[static_cast<std::size_t>(number)] = camera; }
  // Of the first visualisation of an experiment that gives some: what a page offers that was given none itself.
  static Viewpoints Of(const Experiment& experiment);

  // The one with the smallest number, if there is any.
  std::optional<Camera> First() const;

private:
  std::array<std::optional<Camera>, kCount> views_;
};

// The two elements that give this viewpoint in an experiment file.
std::string ViewpointXml(int number, const Camera& camera);

// The arena from outside, whole; from straight above with `top`.
Camera DefaultView(const Experiment& experiment, double aspect, bool top = false);

// A camera from text: the number of a viewpoint, "top", "default", or "x,y,z/heading,pitch,roll" (m, degrees; the
// second part may be left out). Throws ConfigurationError with the place given.
Camera CameraFromText(const std::string& text, const Viewpoints& viewpoints, const Experiment& experiment,
                      double aspect, const SourceLocation& location);

}  // namespace swarmanoid
