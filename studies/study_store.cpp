#include "studies/study_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

#include "common/configuration/configuration_tree.h"
#include "common/program/csv.h"
#include "common/version/version.h"
#include "studies/study_setup.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kDatabase = "study.sqlite";
// Until its tables are made.
constexpr const char* kUnfinished = "study.sqlite.new";
constexpr const char* kLock = "lock";
// Of the tables of a database.
constexpr int kStoreFormat = 1;

std::string NameInSql(const std::string& name) { return "\"" + name + "\""; }

// Whether a study may begin there: also where one was ended before it had begun.
bool IsEmpty(const fs::path& folder)
{
  std::error_code error;
  for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
  {
    const std::string name = each->path().filename().string();
    if (name != kLock && !name.starts_with(kUnfinished)) return false;
  }
  return !error;
}

}  // namespace

// A prepared command. Values are bound one after the other.
struct StudyStore::Statement
{
  Statement(StudyStore& of, const std::string& command) : store(of)
  {
    if (sqlite3_prepare_v2(store.database_, command.c_str(), -1, &statement, nullptr) != SQLITE_OK) store.Fail(command);
  }
  ~Statement() { sqlite3_finalize(statement); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& Bind(const std::string& text)
  {
    sqlite3_bind_text(statement, ++bound, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
    return *this;
  }
  Statement& Bind(double number)
  {
    // NaN is no number of SQL: it becomes NULL.
    sqlite3_bind_double(statement, ++bound, number);
    return *this;
  }
  Statement& BindWhole(std::uint64_t number)
  {
    sqlite3_bind_int64(statement, ++bound, static_cast<sqlite3_int64>(number));
    return *this;
  }
  template <class Number>
  Statement& BindBytes(const std::vector<Number>& numbers)
  {
    sqlite3_bind_blob64(statement, ++bound, numbers.data(), numbers.size() * sizeof(Number), SQLITE_TRANSIENT);
    return *this;
  }
  // To the next row; false if there is none.
  bool Step()
  {
    const int code = sqlite3_step(statement);
    if (code != SQLITE_ROW && code != SQLITE_DONE) store.Fail("");
    return code == SQLITE_ROW;
  }
  void Run()
  {
    while (Step()) continue;
    sqlite3_reset(statement);
    bound = 0;
  }
  std::uint64_t Whole(int column) { return static_cast<std::uint64_t>(sqlite3_column_int64(statement, column)); }
  double Number(int column) { return sqlite3_column_double(statement, column); }
  bool IsNull(int column) { return sqlite3_column_type(statement, column) == SQLITE_NULL; }
  std::string Text(int column)
  {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
    return text == nullptr ? "" : text;
  }

  StudyStore& store;
  sqlite3_stmt* statement = nullptr;
  int bound = 0;
};

StudyStore::StudyStore(std::string folder) : folder_(std::move(folder)) {}

StudyStore::~StudyStore()
{
  update_run_.reset();
  add_sample_.reset();
  sqlite3_close(database_);
  if (lock_ >= 0) close(lock_);
}

void StudyStore::Fail(const std::string& what)
{
  const std::string reason = database_ == nullptr ? "no memory is left" : sqlite3_errmsg(database_);
  throw StudyStoreError(
      fmt::format("'{}/{}': {}{}", folder_, kDatabase, reason, what.empty() ? "" : " (" + what + ")"));
}

// Of the process, so that it goes with it.
void StudyStore::Lock()
{
  const std::string path = folder_ + "/" + kLock;
  lock_ = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (lock_ < 0) throw StudyStoreError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
  struct flock whole
  {
  };
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(lock_, F_SETLK, &whole) != 0)
    throw StudyStoreError(fmt::format("another process works on the study '{}'; wait until it has ended", folder_));
}

void StudyStore::Connect(const char* file)
{
  const std::string path = folder_ + "/" + file;
  if (sqlite3_open_v2(path.c_str(), &database_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr) != SQLITE_OK)
    Fail("");
}

void StudyStore::Connect()
{
  Connect(kDatabase);
  sqlite3_busy_timeout(database_, 10'000);  // of somebody who looks at it
  // A killed process loses nothing that was committed.
  Execute("PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL");
}

void StudyStore::Execute(const std::string& commands)
{
  if (sqlite3_exec(database_, commands.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) Fail("");
}

std::unique_ptr<StudyStore::Statement> StudyStore::Prepare(const std::string& command)
{
  return std::make_unique<Statement>(*this, command);
}

std::unique_ptr<StudyStore> StudyStore::Create(const std::string& folder, const Study& study, const Design& design)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw StudyStoreError(fmt::format("cannot make the folder '{}': {}", folder, error.message()));
  if (!IsEmpty(folder))
    throw StudyStoreError(
        fmt::format("'{0}' is no empty folder; name another one by --output, or go on with the study there: swarmanoid "
                    "sweep {0} --resume",
                    folder));
  std::unique_ptr<StudyStore> store(new StudyStore(folder));
  store->Lock();
  store->MakeDatabase(study, design);
  store->Connect();
  store->ReadColumns();
  return store;
}

std::unique_ptr<StudyStore> StudyStore::Open(const std::string& folder)
{
  std::error_code none;
  if (!fs::exists(folder + "/" + kDatabase, none))
    throw StudyStoreError(fmt::format("'{}' is no folder of a study: it has no {}", folder, kDatabase));
  std::unique_ptr<StudyStore> store(new StudyStore(folder));
  store->Lock();
  store->Connect();
  if (store->Fact("format") != std::to_string(kStoreFormat))
    throw StudyStoreError(fmt::format("'{}/{}' is of another version of Swarmanoid", folder, kDatabase));
  store->ReadColumns();
  return store;
}

// Under its name only when it is complete: whoever finds it can read it.
void StudyStore::MakeDatabase(const Study& study, const Design& design)
{
  const std::string path = folder_ + "/" + kUnfinished;
  for (const char* part : {"", "-journal"}) std::remove((path + part).c_str());
  Connect(kUnfinished);
  MakeTables(study, design);
  sqlite3_close(database_);
  database_ = nullptr;
  if (std::rename(path.c_str(), (folder_ + "/" + kDatabase).c_str()) != 0)
    throw StudyStoreError(fmt::format("cannot rename '{}': {}", path, std::strerror(errno)));
}

void StudyStore::MakeTables(const Study& study, const Design& design)
{
  std::string factors, metrics, of_results;
  for (const Factor* factor : study.Factors())
  {
    factors += fmt::format(", {} {}", NameInSql(factor->id), factor->is_numeric ? "REAL" : "TEXT");
    of_results += ", r." + NameInSql(factor->id);
  }
  of_results += ", r.seed, s.tick, s.time_s";
  for (const std::string& column : MetricColumns(study))
  {
    metrics += fmt::format(", {} REAL", NameInSql(column));
    of_results += ", s." + NameInSql(column);
  }
  Execute("BEGIN");
  Execute("CREATE TABLE study (name TEXT PRIMARY KEY, value TEXT)");
  Execute(
      "CREATE TABLE runs (point INTEGER, seed INTEGER, state TEXT, attempts INTEGER, exit INTEGER, hash TEXT, ticks "
      "INTEGER, "
      "failure TEXT, wall_s REAL, peak_bytes INTEGER, host TEXT, version TEXT" +
      factors + ", PRIMARY KEY (point, seed))");
  Execute("CREATE TABLE samples (point INTEGER, seed INTEGER, tick INTEGER, time_s REAL" + metrics +
          ", PRIMARY KEY (point, seed, tick)) WITHOUT ROWID");
  Execute(
      "CREATE TABLE grids (point INTEGER, seed INTEGER, metric TEXT, columns INTEGER, rows INTEGER, cell_m REAL, "
      "visits BLOB, "
      "PRIMARY KEY (point, seed, metric))");
  Execute(
      "CREATE TABLE ways (point INTEGER, seed INTEGER, entities TEXT, samples INTEGER, places BLOB, PRIMARY KEY "
      "(point, seed))");
  Execute(
      "CREATE VIEW results AS SELECT r.point" + of_results +
      ", r.exit, r.hash FROM runs r JOIN samples s ON r.point = s.point AND r.seed = s.seed WHERE r.state = 'done'");

  const auto fact = Prepare("INSERT INTO study VALUES (?, ?)");
  for (const auto& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"format", std::to_string(kStoreFormat)},
           {"name", study.name},
           {"study", study.text},
           {"folder", study.folder},
           {"experiments", design.ExperimentsHash()},
           {"version", Version()},
           {"revision", GitRevision()},
           {"search", study.search ? study.search->column : ""},
           {"goal", study.search && !study.search->maximise ? "min" : "max"},
           {"aggregate", study.search ? study.search->aggregate : ""},
           {"seeds", fmt::format("{}", fmt::join(study.seeds, " "))}})
    fact->Bind(name).Bind(value).Run();

  std::string places;
  const std::vector<const Factor*> all = study.Factors();
  for (std::size_t f = 0; f < all.size(); ++f) places += ", ?";
  const auto run = Prepare(
      "INSERT INTO runs VALUES (?, ?, 'waiting', 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL" + places + ")");
  // A search adds its points itself.
  for (std::size_t point = 0; point < (study.search ? 0 : design.Points()); ++point)
  {
    const std::vector<const FactorLevel*> levels = design.Levels(point);
    for (const std::uint64_t seed : study.seeds)
    {
      run->BindWhole(point).BindWhole(seed);
      for (std::size_t f = 0; f < all.size(); ++f)
      {
        if (all[f]->is_numeric)
          run->Bind(*ParseNumber(levels[f]->value));
        else
          run->Bind(levels[f]->value);
      }
      run->Run();
    }
  }
  Execute("COMMIT");
}

void StudyStore::ReadColumns()
{
  const auto names = [&](const char* table, std::size_t from)
  {
    std::vector<std::string> all;
    const auto rows = Prepare(fmt::format("SELECT name FROM pragma_table_info('{}')", table));
    for (std::size_t i = 0; rows->Step(); ++i)
      if (i >= from) all.push_back(rows->Text(0));
    return all;
  };
  factors_ = names("runs", 12);
  columns_ = names("samples", 4);
  update_run_ = Prepare(
      "UPDATE runs SET state = ?, attempts = attempts + 1, exit = ?, hash = ?, ticks = ?, failure = ?, wall_s = ?, "
      "peak_bytes = ?, "
      "host = ?, version = ? WHERE point = ? AND seed = ?");
  std::string places;
  for (std::size_t c = 0; c < columns_.size(); ++c) places += ", ?";
  add_sample_ = Prepare(fmt::format("INSERT OR REPLACE INTO samples SELECT ?, ?, ?, ?{}", places));
}

std::string StudyStore::Fact(const std::string& name)
{
  const auto row = Prepare("SELECT value FROM study WHERE name = ?");
  return row->Bind(name).Step() ? row->Text(0) : "";
}

std::vector<StudyStore::RunState> StudyStore::Runs()
{
  std::vector<RunState> runs;
  const auto rows = Prepare("SELECT point, seed, state, attempts, wall_s FROM runs ORDER BY point, seed");
  while (rows->Step())
  {
    const std::string state = rows->Text(2);
    runs.push_back({{static_cast<std::uint32_t>(rows->Whole(0)), rows->Whole(1)},
                    state == "done",
                    state == "failed",
                    static_cast<unsigned>(rows->Whole(3)),
                    rows->Number(4)});
  }
  return runs;
}

bool StudyStore::IsDone(const RunName& name)
{
  const auto row = Prepare("SELECT 1 FROM runs WHERE point = ? AND seed = ? AND state = 'done'");
  return row->BindWhole(name.point).BindWhole(name.seed).Step();
}

void StudyStore::Add(const RunOutcome& outcome)
{
  if (!in_transaction_) Execute("BEGIN");
  in_transaction_ = true;
  const bool done = outcome.IsDone();
  update_run_->Bind(std::string(done ? "done" : "failed")).BindWhole(static_cast<std::uint64_t>(outcome.exit_code));
  update_run_->Bind(done ? fmt::format("{:016x}", outcome.hash) : "").BindWhole(outcome.ticks).Bind(outcome.failure);
  update_run_->Bind(outcome.wall_s)
      .BindWhole(outcome.peak_bytes)
      .Bind(outcome.host.empty() ? NameOfThisHost() : outcome.host)
      .Bind(std::string(GitRevision()));
  update_run_->BindWhole(outcome.name.point).BindWhole(outcome.name.seed).Run();
  if (!done) return;
  const RunSamples& samples = outcome.samples;
  for (std::size_t row = 0; row < samples.ticks.size(); ++row)
  {
    add_sample_->BindWhole(outcome.name.point).BindWhole(outcome.name.seed).BindWhole(samples.ticks[row]);
    add_sample_->Bind(static_cast<double>(samples.ticks[row]) * samples.tick_s);
    for (std::size_t c = 0; c < columns_.size(); ++c) add_sample_->Bind(samples.values[row * columns_.size() + c]);
    add_sample_->Run();
  }
  for (const RunSamples::Grid& grid : samples.grids)
    Prepare("INSERT OR REPLACE INTO grids VALUES (?, ?, ?, ?, ?, ?, ?)")
        ->BindWhole(outcome.name.point)
        .BindWhole(outcome.name.seed)
        .Bind(grid.metric)
        .BindWhole(grid.columns)
        .BindWhole(grid.rows)
        .Bind(grid.cell_m)
        .BindBytes(grid.visits)
        .Run();
  if (samples.followed.empty()) return;
  Prepare("INSERT OR REPLACE INTO ways VALUES (?, ?, ?, ?, ?)")
      ->BindWhole(outcome.name.point)
      .BindWhole(outcome.name.seed)
      .Bind(fmt::format("{}", fmt::join(samples.followed, " ")))
      .BindWhole(samples.ticks.size())
      .BindBytes(samples.ways)
      .Run();
}

void StudyStore::AddRun(const RunName& name)
{
  std::string factors;
  for (const std::string& factor : factors_) factors += ", " + NameInSql(factor);
  const auto row = Prepare(fmt::format(
      "INSERT INTO runs SELECT point, ?, 'waiting', 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL{} FROM "
      "runs WHERE point = ? LIMIT 1",
      factors));
  row->BindWhole(name.seed).BindWhole(name.point).Run();
}

void StudyStore::AddPoint(std::uint32_t point, const std::vector<ExpressionValue>& values,
                          const std::vector<std::uint64_t>& seeds)
{
  if (!in_transaction_) Execute("BEGIN");
  in_transaction_ = true;
  std::string places;
  for (std::size_t f = 0; f < values.size(); ++f) places += ", ?";
  const auto run = Prepare(
      "INSERT INTO runs VALUES (?, ?, 'waiting', 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL" + places + ")");
  for (const std::uint64_t seed : seeds)
  {
    run->BindWhole(point).BindWhole(seed);
    for (const ExpressionValue& value : values)
    {
      if (const double* number = std::get_if<double>(&value))
        run->Bind(*number);
      else
        run->Bind(std::get<std::string>(value));
    }
    run->Run();
  }
}

std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> StudyStore::PointValues()
{
  std::string factors;
  for (const std::string& factor : factors_) factors += ", " + NameInSql(factor);
  std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> points;
  const auto rows = Prepare(fmt::format("SELECT DISTINCT point{} FROM runs ORDER BY point", factors));
  while (rows->Step())
  {
    auto& [point, values] = points.emplace_back();
    point = static_cast<std::uint32_t>(rows->Whole(0));
    for (int f = 1; f <= static_cast<int>(factors_.size()); ++f)
    {
      if (sqlite3_column_type(rows->statement, f) == SQLITE_FLOAT)
        values.emplace_back(rows->Number(f));
      else
        values.emplace_back(rows->Text(f));
    }
  }
  return points;
}

std::map<RunName, double> StudyStore::LastValues(const std::string& column)
{
  std::map<RunName, double> values;
  const auto rows = Prepare(fmt::format(
      "SELECT s.point, s.seed, s.{}, MAX(s.tick) FROM samples s JOIN runs r ON r.point = s.point AND r.seed = s.seed "
      "WHERE r.state = 'done' GROUP BY s.point, s.seed",
      NameInSql(column)));
  while (rows->Step())
    values[{static_cast<std::uint32_t>(rows->Whole(0)), rows->Whole(1)}] =
        rows->IsNull(2) ? std::numeric_limits<double>::quiet_NaN() : rows->Number(2);
  return values;
}

std::vector<double> StudyStore::LastValues(std::uint32_t point, const std::string& column)
{
  std::vector<double> values;
  const auto rows = Prepare(fmt::format(
      "SELECT s.{} FROM samples s JOIN runs r ON r.point = s.point AND r.seed = s.seed WHERE r.state = 'done' AND "
      "s.point = ? AND s.tick = (SELECT MAX(tick) FROM samples l WHERE l.point = s.point AND l.seed = s.seed) "
      "ORDER BY s.seed",
      NameInSql(column)));
  rows->BindWhole(point);
  while (rows->Step())
    if (!rows->IsNull(0)) values.push_back(rows->Number(0));
  return values;
}

void StudyStore::Commit()
{
  if (in_transaction_) Execute("COMMIT");
  in_transaction_ = false;
}

void StudyStore::WriteTable()
{
  const std::string path = folder_ + "/table.csv";
  const std::string draft = path + ".new";
  std::FILE* file = std::fopen(draft.c_str(), "we");
  if (file == nullptr) throw StudyStoreError(fmt::format("cannot write '{}': {}", draft, std::strerror(errno)));
  const auto rows = Prepare("SELECT * FROM results ORDER BY point, seed, tick");
  const int columns = sqlite3_column_count(rows->statement);
  std::string line;
  for (int c = 0; c < columns; ++c) line += (c == 0 ? "" : ",") + CsvField(sqlite3_column_name(rows->statement, c));
  bool good = std::fputs((line + "\n").c_str(), file) >= 0;
  while (good && rows->Step())
  {
    line.clear();
    for (int c = 0; c < columns; ++c)
    {
      if (c > 0) line += ',';
      const int type = sqlite3_column_type(rows->statement, c);
      if (type == SQLITE_INTEGER) line += std::to_string(sqlite3_column_int64(rows->statement, c));
      // The shortest text that is the same number.
      if (type == SQLITE_FLOAT) line += fmt::format("{}", rows->Number(c));
      if (type == SQLITE_TEXT) line += CsvField(rows->Text(c));
    }
    line += '\n';
    good = std::fputs(line.c_str(), file) >= 0;
  }
  good = std::fclose(file) == 0 && good;
  if (good) good = std::rename(draft.c_str(), path.c_str()) == 0;
  if (good) return;
  const std::string reason = std::strerror(errno);
  std::remove(draft.c_str());
  throw StudyStoreError(fmt::format("cannot write '{}': {}", path, reason));
}

}  // namespace swarmanoid
