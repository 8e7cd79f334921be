// EditedExperiment: the text of an edited experiment with its elements, mistakes and start state. Each change is one
// step of its history. `swarmanoid edit` uses it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/configuration/xml_edit.h"
#include "common/experiment/element_form.h"
#include "common/experiment/load_experiment.h"
#include "launcher/editor/known_controllers.h"

namespace swarmanoid
{

// Refuses a request of a page: throws std::invalid_argument with a text for the user.
[[noreturn]] void RefuseEdit(const std::string& text);

// Returns a handle of an element that outlives it.
TConfigurationTree TreeOf(const ConfigurationNode& node);

using ElementPath = std::vector<std::size_t>;  // child numbers, from the root on

// Convert a path to a text such as "0/3", and back. ParsePath throws std::invalid_argument.
std::string PathText(const ElementPath& path);
ElementPath ParsePath(const std::string& text);

// It tells where an entity stands.
struct Placing
{
  ElementPath path;
  std::optional<Vector3> position;  // m
  std::optional<double> heading;    // degrees; the other angles stay
};

class EditedExperiment
{
public:
  // `folder`: the start of relative paths. Throws ConfigurationError if the text is no XML, or is an experiment of
  // another simulator.
  EditedExperiment(const std::string& text, std::string file_name, std::string folder);

  const std::string& Text() const { return text_.Text(); }
  const EditedText& History() const { return text_; }
  const std::vector<Diagnostic>& Mistakes() const { return loaded_.errors; }
  // Returns the experiment as far as it can be read, or nullptr if it cannot be read at all.
  const Experiment* GetExperiment() const { return loaded_.experiment.get(); }
  const std::string& Places() const { return loaded_.places; }

  const XmlElement& Root() const { return outline_; }
  // The functions below throw std::invalid_argument if the path does not lead to an element.
  const XmlElement& At(const ElementPath& path) const;
  const ConfigurationNode& NodeAt(const ElementPath& path) const;
  ElementForm FormAt(const ElementPath& path) const;
  // Returns the controllers that <controllers> may get with their libraries and devices.
  const std::vector<KnownController>& Controllers() const { return known_controllers_; }
  // Returns the id of an element, or its tag, such as "<arena>", if it has no id.
  std::string NameOf(const ElementPath& path) const;
  // Returns the element that contains a line and column.
  ElementPath PathAt(const SourceLocation& place) const;
  // Returns the element of each entity of the experiment. Entities of one <distribute> or <reserve> share the element
  // within it.
  const std::vector<ElementPath>& EntityPaths() const { return entity_paths_; }
  // Returns whether its entities have their places from the element above it.
  bool IsDistributed(const ElementPath& path) const;

  // The changes. Each throws std::invalid_argument with a text for the user, and then changes nothing.
  void SetValue(const ElementPath& path, const std::string& name, const std::optional<std::string>& value);
  void Place(const std::vector<Placing>& placings);
  // Adds an element and returns its path. `at`: the position of an entity on the floor (m).
  ElementPath Add(const ElementPath& parent, const std::string& tag, const std::optional<Vector2>& at);
  void Remove(const std::vector<ElementPath>& paths);
  // Replaces the whole element.
  void Rewrite(const ElementPath& path, const std::string& xml);
  // Replaces a <distribute> by its entities, one element each.
  void WriteOut(const ElementPath& path);
  // Replaces the text, for example by that of the file.
  void Replace(const std::string& text);
  bool Undo();
  bool Redo();

private:
  // Returns the known controller for an element of that tag; nullptr if none is known, or elsewhere than in
  // <controllers>.
  const KnownController* KnownFor(const ElementPath& parent, const std::string& tag) const;
  // It holds the parsed form of a text. Making it throws if the text cannot be read.
  struct Reading
  {
    std::shared_ptr<const ConfigurationNode> tree;
    XmlElement outline;
    LoadedExperiment loaded;
  };
  Reading Read(const std::string& text) const;
  void Take(Reading reading);
  void Change(const TextEdits& edits, const std::string& name);
  std::size_t OffsetOf(const SourceLocation& place) const;

  std::string file_name_, folder_;
  EditedText text_;
  std::shared_ptr<const ConfigurationNode> tree_;
  XmlElement outline_;
  LoadedExperiment loaded_;
  std::vector<KnownController> known_controllers_;
  std::vector<std::size_t> lines_;  // start of each line
  std::vector<ElementPath> entity_paths_;
};

}  // namespace swarmanoid
