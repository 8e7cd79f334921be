// Reads the factors of a study from its file: <factor>, <variants> and <zip>, and reports their mistakes. Part of
// LoadStudyText.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/experiment/diagnostics.h"
#include "common/experiment/element_reader.h"
#include "studies/design/study.h"

namespace swarmanoid
{

// These characters separate the words of a list.
inline constexpr std::string_view kListed = ", \t\r\n";

// The ids of factors and metrics, which must be unique.
class StudyIds
{
public:
  explicit StudyIds(Diagnostics& diagnostics);
  // Reads an id. `what` names its owner: "factor", "metric".
  std::string Read(const ElementReader& reader, const char* what);

private:
  Diagnostics& diagnostics_;
  std::map<std::string, SourceLocation> ids_;
};

// Returns the path relative to the folder of the study; "" stays "".
std::string ResolvedPath(const std::string& folder, const std::string& path);
// Reads a <set> of `spec`.
StudyChange ReadSet(const TConfigurationTree& tree, const ElementSpec& spec, Diagnostics& diagnostics);

class FactorReader
{
public:
  // Reads the file in that folder. It keeps references to `folder`, `ids` and `diagnostics`. `is_search`: ranges belong
  // to a <search>.
  FactorReader(const std::string& folder, bool is_search, StudyIds& ids, Diagnostics& diagnostics);

  // Reads <factor> or <variants>; returns nothing if it has no values.
  std::optional<Factor> Read(const TConfigurationTree& tree);
  // Returns nothing if it contains no factor.
  std::optional<Dimension> ReadZip(const TConfigurationTree& tree);

private:
  void ReadVariants(const TConfigurationTree& tree, Factor& factor);
  void ReadVariant(const TConfigurationTree& tree, Factor& factor);
  void ReadPaths(const TConfigurationTree& tree, Factor& factor);
  std::vector<std::string> ReadValues(const TConfigurationTree& tree, const ElementReader& reader);
  std::vector<std::string> ReadRange(const TConfigurationTree& tree, const ElementReader& reader);
  SearchRange ReadSearchRange(const TConfigurationTree& tree, const ElementReader& reader);

  const std::string& folder_;
  bool is_search_;
  StudyIds& ids_;
  Diagnostics& diagnostics_;
};

}  // namespace swarmanoid
