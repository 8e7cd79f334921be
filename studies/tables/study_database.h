// The SQLite database of a study: its connection and prepared commands. StudyStore knows the tables; this file does
// not.
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
    kWrite,  // makes the file if it does not exist
  };
  // `shown` is the path in errors. All functions throw StudyStoreError.
  StudyDatabase(const std::string& path, std::string shown, Access access = Access::kWrite);
  ~StudyDatabase();
  StudyDatabase(const StudyDatabase&) = delete;
  StudyDatabase& operator=(const StudyDatabase&) = delete;

  // Executes commands without values or results.
  void Execute(const std::string& commands);
  // The command must be destroyed before the database.
  std::unique_ptr<SqlCommand> Prepare(const std::string& command);

private:
  friend class SqlCommand;
  [[noreturn]] void Fail(const std::string& what = "") const;
  std::string Reason() const;

  std::string shown_;
  sqlite3* database_ = nullptr;
};

// A prepared command. Values are bound in order; columns count from 0.
class SqlCommand
{
public:
  SqlCommand(const StudyDatabase& database, const std::string& command);
  ~SqlCommand();
  SqlCommand(const SqlCommand&) = delete;
  SqlCommand& operator=(const SqlCommand&) = delete;

  // Bind the next value.
  SqlCommand& Bind(const std::string& text);
  // Binds a number; NaN becomes NULL.
  SqlCommand& Bind(double number);
  SqlCommand& BindWhole(std::uint64_t number);
  template <class Number>
  SqlCommand& BindBytes(const std::vector<Number>& numbers)
  {
    return BindBytes(numbers.data(), numbers.size() * sizeof(Number));
  }
  // Moves to the next row; returns false if none exists.
  bool Step();
  // Executes to the end; the next execution needs new values.
  void Run();

  // Returns the number of columns of the result.
  int Columns() const;
  std::string ColumnName(int column) const;
  // Return values of the current row.
  std::uint64_t Whole(int column) const;
  double Number(int column) const;
  bool IsNull(int column) const;
  bool IsReal(int column) const;
  // Returns the type and the bytes, for checksums.
  std::string Image(int column) const;
  // Returns the shortest text that is read back as the same number; empty for NULL.
  std::string Text(int column) const;

private:
  SqlCommand& BindBytes(const void* bytes, std::size_t count);

  const StudyDatabase& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

}  // namespace swarmanoid
