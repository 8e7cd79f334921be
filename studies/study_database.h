// The SQLite database of a study: its connection and prepared commands. It knows nothing of tables; StudyStore does.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace swarmanoid
{

// what() names the file and the cause.
class StudyStoreError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class SqlCommand;

class StudyDatabase
{
public:
  enum class Access
  {
    kRead,
    kWrite,  // makes the file if it is not there
  };
  // `shown`: its path in errors. Throws StudyStoreError, as everything here does.
  StudyDatabase(const std::string& path, std::string shown, Access access = Access::kWrite);
  ~StudyDatabase();
  StudyDatabase(const StudyDatabase&) = delete;
  StudyDatabase& operator=(const StudyDatabase&) = delete;

  void Execute(const std::string& commands);
  // To be gone before this is.
  std::unique_ptr<SqlCommand> Prepare(const std::string& command);

private:
  friend class SqlCommand;
  [[noreturn]] void Fail(const std::string& what = "") const;
  std::string Reason() const;

  std::string shown_;
  sqlite3* database_ = nullptr;
};

// Values are bound one after the other; columns count from 0.
class SqlCommand
{
public:
  SqlCommand(const StudyDatabase& database, const std::string& command);
  ~SqlCommand();
  SqlCommand(const SqlCommand&) = delete;
  SqlCommand& operator=(const SqlCommand&) = delete;

  SqlCommand& Bind(const std::string& text);
  // NaN is no number of SQL: it becomes NULL.
  SqlCommand& Bind(double number);
  SqlCommand& BindWhole(std::uint64_t number);
  template <class Number>
  SqlCommand& BindBytes(const std::vector<Number>& numbers)
  {
    return BindBytes(numbers.data(), numbers.size() * sizeof(Number));
  }
  // To the next row; false if there is none.
  bool Step();
  // To the end; values are bound anew for the next time.
  void Run();

  int Columns() const;
  std::string ColumnName(int column) const;
  // Of the row that it stands at.
  std::uint64_t Whole(int column) const;
  double Number(int column) const;
  bool IsNull(int column) const;
  bool IsReal(int column) const;
  // Its type and its bytes, for checksums.
  std::string Image(int column) const;
  // Of numbers the shortest that is read as the same one; of NULL none.
  std::string Text(int column) const;

private:
  SqlCommand& BindBytes(const void* bytes, std::size_t count);

  const StudyDatabase& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace swarmanoid
