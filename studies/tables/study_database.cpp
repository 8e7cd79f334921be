#include "studies/tables/study_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

namespace swarmanoid
{

StudyDatabase::StudyDatabase(const std::string& path, std::string shown, Access access) : shown_(std::move(shown))
{
  const int flags = access == Access::kRead ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  if (sqlite3_open_v2(path.c_str(), &database_, flags, nullptr) == SQLITE_OK) return;
  const std::string reason = Reason();
  sqlite3_close(database_);
  throw StudyStoreError(reason);
}

StudyDatabase::~StudyDatabase() { sqlite3_close(database_); }

void StudyDatabase::Fail(const std::string& what) const
{
  throw StudyStoreError(Reason() + (what.empty() ? "" : " (" + what + ")"));
}

std::string StudyDatabase::Reason() const
{
  return fmt::format("'{}': {}", shown_, database_ == nullptr ? "no memory is left" : sqlite3_errmsg(database_));
}

void StudyDatabase::Execute(const std::string& commands)
{
  if (sqlite3_exec(database_, commands.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail();
}

std::unique_ptr<SqlCommand> StudyDatabase::Prepare(const std::string& command)
{
  return std::make_unique<SqlCommand>(*this, command);
}

SqlCommand::SqlCommand(const StudyDatabase& database, const std::string& command) : database_(database)
{
  if (sqlite3_prepare_v2(database.database_, command.c_str(), -1, &statement_, nullptr) != SQLITE_OK)
    database.Fail(command);
}

SqlCommand::~SqlCommand() { sqlite3_finalize(statement_); }

SqlCommand& SqlCommand::Bind(const std::string& text)
{
  sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  return *this;
}

SqlCommand& SqlCommand::Bind(double number)
{
  sqlite3_bind_double(statement_, ++bound_, number);
  return *this;
}

SqlCommand& SqlCommand::BindWhole(std::uint64_t number)
{
  sqlite3_bind_int64(statement_, ++bound_, static_cast<sqlite3_int64>(number));
  return *this;
}

SqlCommand& SqlCommand::BindBytes(const void* bytes, std::size_t count)
{
  sqlite3_bind_blob64(statement_, ++bound_, bytes, count, SQLITE_TRANSIENT);
  return *this;
}

bool SqlCommand::Step()
{
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.Fail();
  return code == SQLITE_ROW;
}

void SqlCommand::Run()
{
  while (Step()) continue;
  sqlite3_reset(statement_);
  bound_ = 0;
}

int SqlCommand::Columns() const { return sqlite3_column_count(statement_); }

std::string SqlCommand::ColumnName(int column) const { return sqlite3_column_name(statement_, column); }

std::uint64_t SqlCommand::Whole(int column) const
{
  return static_cast<std::uint64_t>(sqlite3_column_int64(statement_, column));
}

double SqlCommand::Number(int column) const { return sqlite3_column_double(statement_, column); }

bool SqlCommand::IsNull(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_NULL; }

bool SqlCommand::IsReal(int column) const { return sqlite3_column_type(statement_, column) == SQLITE_FLOAT; }

std::string SqlCommand::Image(int column) const
{
  const auto append = [](std::string& image, const auto& number)
  { image.append(reinterpret_cast<const char*>(&number), sizeof number); };
  const int type = sqlite3_column_type(statement_, column);
  std::string image(1, static_cast<char>(type));
  if (type == SQLITE_INTEGER) append(image, sqlite3_column_int64(statement_, column));
  if (type == SQLITE_FLOAT) append(image, sqlite3_column_double(statement_, column));
  if (type != SQLITE_TEXT && type != SQLITE_BLOB) return image;
  const void* bytes = sqlite3_column_blob(statement_, column);
  const int count = sqlite3_column_bytes(statement_, column);
  append(image, count);
  if (count > 0) image.append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
  return image;
}

std::string SqlCommand::Text(int column) const
{
  if (IsReal(column)) return fmt::format("{}", Number(column));
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return text == nullptr ? "" : text;
}

}  // namespace swarmanoid
