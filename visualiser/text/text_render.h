// text_render: the space as a plain table with one line an entity, on the screen or in a file. Derived classes can
// override the columns and the selection of entities.
#pragma once

#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/space/entity.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class CTextRender : public CRender
{
public:
  ~CTextRender() override;
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  // Flushes the output, so that it can be read while the run is paused or slow.
  void Idle() override;
  void Finish() override;

  static PluginDescription Description();

protected:
  // A column of the table: its title, and the function that appends its value for an entity.
  struct Column
  {
    std::string title;
    bool is_number = true;  // false: a text in JSON
    std::function<void(const CSwarmanoidSpaceEntity& entity, std::string& line)> append;
    bool by_default = true;  // false: written only if the parameter `columns` names it
  };

  // Extension points: the available columns (Init calls this once), and the entities that get a line.
  virtual std::vector<Column> Columns() const;
  virtual bool IsShown(const CSwarmanoidSpaceEntity& entity) const;

  // Appends a number rounded to `precision` decimals, without trailing zeros.
  void AppendNumber(double value, std::string& line) const;
  const CSwarmanoidSpace& Space() const { return *space_; }
  // Returns nullptr if the renderer is used outside a run.
  RunMonitor* Monitor() const { return monitor_; }

private:
  enum class Format
  {
    kTable,
    kTsv,
    kCsv,
    kJson
  };

  void ChooseColumns(const std::string& names, const SourceLocation& location);
  void ChooseEntities(const std::string& kinds, const SourceLocation& location);
  void WatchShownRobots();
  void AppendTable();
  void AppendHeader();
  void AppendStatus();
  void AppendLine(const CSwarmanoidSpaceEntity& entity);
  // Makes the text from `start` on a valid cell of the format.
  void MendCell(std::size_t start, bool is_number);
  void Write();

  const CSwarmanoidSpace* space_ = nullptr;
  const Assignment* assignment_ = nullptr;
  RunMonitor* monitor_ = nullptr;
  bool shows_status_ = false;
  std::optional<RunStatus::Phase> told_phase_;  // the phase in the latest line about the run
  std::vector<Column> columns_;
  std::vector<bool> shown_kinds_;  // by EntityKind
  Format format_ = Format::kTable;
  std::string path_;  // empty: the screen
  std::FILE* file_ = nullptr;
  std::string buffer_;
  std::vector<std::string> keys_;  // the titles of the columns as JSON keys
  int precision_ = 3;
  std::uint64_t every_ = 1;
  std::optional<std::uint64_t> period_;  // the period of `every_` ticks that contains the latest tick
  bool is_left_out_ = false;             // the latest tick has no table
};

}  // namespace swarmanoid
