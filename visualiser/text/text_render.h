// text_render: the space as a plain table, one line an entity, to the screen or a file. Meant to be derived from:
// override the columns, or which entities get a line.
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
  bool Terminate() override { return reader_has_gone_; }
  // Writes the text out while the run is paused or slow, so that it can be read.
  void Idle() override;
  void Finish() override;

  static PluginDescription Description();

protected:
  // A column of the table: its title, and what it appends for an entity.
  struct Column
  {
    std::string title;
    bool is_number = true;  // false: a text in JSON
    std::function<void(const CSwarmanoidSpaceEntity& entity, std::string& line)> append;
    bool by_default = true;  // false: written only if the parameter `columns` names it
  };

  // Returns the columns that exist. Init calls it once; a derived renderer may add columns.
  virtual std::vector<Column> Columns() const;
  // Returns whether an entity gets a line.
  virtual bool IsShown(const CSwarmanoidSpaceEntity& entity) const;

  // Appends a number rounded to `precision` decimals, without trailing zeros.
  void AppendNumber(double value, std::string& line) const;
  const CSwarmanoidSpace& Space() const { return *space_; }
  // Returns the monitor, or nullptr if the renderer is used outside a run.
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
  // Makes what was appended from `start` on one cell of the format.
  void MendCell(std::size_t start, bool is_number);
  void Write();
  void FailToWrite();

  const CSwarmanoidSpace* space_ = nullptr;
  const Assignment* assignment_ = nullptr;
  RunMonitor* monitor_ = nullptr;
  bool shows_status_ = false;
  std::optional<RunStatus::Phase> told_phase_;  // by the latest line about the run
  std::vector<Column> columns_;
  std::vector<bool> shown_kinds_;  // by EntityKind
  Format format_ = Format::kTable;
  std::string path_;  // empty: the screen
  bool reader_has_gone_ = false;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  std::vector<std::string> keys_;  // the titles of the columns as JSON has them
  int precision_ = 3;
  std::uint64_t every_ = 1;
  std::optional<std::uint64_t> period_;  // of `every_` ticks, in which the latest tick was
  bool is_left_out_ = false;             // the latest tick has no table
};

}  // namespace swarmanoid
