// The file study.sqlite is the only state of a study. It is made under another name and renamed when it is complete. A
// lock of the process (fcntl) keeps others away, and goes with the process. Each run has a checksum over its rows,
// since SQLite does not notice flipped bits; damaged results are dropped when the study is opened, and computed again.
#include "studies/tables/study_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

#include "common/configuration/output_file.h"
#include "common/errors/print_error.h"
#include "common/program/csv.h"
#include "common/program/shell_word.h"
#include "common/version/version.h"
#include "studies/runs/study_setup.h"
#include "studies/tables/study_tables.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kDatabase = "study.sqlite";
// The name of the file until its tables are complete.
constexpr const char* kUnfinished = "study.sqlite.new";
constexpr const char* kLock = "lock";

// Returns whether a study may begin in the folder. It may also contain the rest of a study that ended before it began.
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

void RequireDatabase(const std::string& folder)
{
  std::error_code none;
  if (!fs::exists(folder + "/" + kDatabase, none))
    throw StudyStoreError(fmt::format("'{}' is no folder of a study: it has no {}", folder, kDatabase));
}

}  // namespace

StudyStore::StudyStore(std::string folder) : folder_(std::move(folder)) {}

StudyStore::~StudyStore()
{
  // The database is closed before the lock is released, so that the next owner has it alone.
  update_run_.reset();
  add_sample_.reset();
  database_.reset();
  if (lock_ >= 0) close(lock_);
}

std::string StudyStore::PathInFolder(const char* file) const { return folder_ + "/" + file; }

// The lock belongs to the process, so that it ends with it.
void StudyStore::Lock()
{
  const std::string path = PathInFolder(kLock);
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

void StudyStore::Connect()
{
  database_ = std::make_unique<StudyDatabase>(PathInFolder(kDatabase), PathInFolder(kDatabase));
  // Other processes may read the database. A kill loses no committed data.
  database_->Execute("PRAGMA busy_timeout=10000; PRAGMA journal_mode=WAL; PRAGMA synchronous=NORMAL");
}

std::unique_ptr<StudyStore> StudyStore::Create(const std::string& folder, const Study& study, const Design& design)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw StudyStoreError(fmt::format("cannot make the folder '{}': {}", folder, error.message()));
  if (const std::string mistake = OutputFolderMistake(folder); !mistake.empty())
    throw StudyStoreError(
        fmt::format("'{}' cannot be the folder of the study: {}; name another one by --output", folder, mistake));
  if (!IsEmpty(folder))
    throw StudyStoreError(
        fmt::format("'{0}' is no empty folder; name another one by --output, or go on with the study there: swarmanoid "
                    "sweep {1} --resume",
                    folder, ShellWord(folder)));
  std::unique_ptr<StudyStore> store(new StudyStore(folder));
  store->Lock();
  store->MakeDatabase(study, design);
  store->Connect();
  store->ReadColumns();
  store->PrepareCommands();
  return store;
}

std::unique_ptr<StudyStore> StudyStore::Open(const std::string& folder)
{
  RequireDatabase(folder);
  std::unique_ptr<StudyStore> store(new StudyStore(folder));
  store->Lock();
  store->Connect();
  store->RequireGoodFacts();
  store->PrepareCommands();
  store->DropDamagedResults();
  return store;
}

void StudyStore::RequireWhole(const std::string& folder)
{
  RequireDatabase(folder);
  StudyStore store(folder);
  store.database_ = std::make_unique<StudyDatabase>(store.PathInFolder(kDatabase), store.PathInFolder(kDatabase),
                                                    StudyDatabase::Access::kRead);
  // One transaction makes all reads consistent.
  store.database_->Execute("PRAGMA busy_timeout=10000; BEGIN");
  store.RequireGoodFacts();
  if (const std::vector<RunName> damaged = store.DamagedRuns(); !damaged.empty())
    throw StudyStoreError(fmt::format(
        "'{0}/{1}' is damaged: the result of run {2} does not fit its checksum{3}; `swarmanoid sweep {4} --resume` "
        "computes it again",
        folder, kDatabase, damaged.front().Text(),
        damaged.size() == 1 ? "" : fmt::format(", nor do those of {} more runs", damaged.size() - 1),
        ShellWord(folder)));
}

void StudyStore::RequireGoodFacts()
{
  if (Fact("format") != std::to_string(kStoreFormat))
    throw StudyStoreError(fmt::format("'{}/{}' is of another version of Swarmanoid", folder_, kDatabase));
  if (Fact(kFactsChecksum) != ChecksumOfFacts(*database_))
    throw StudyStoreError(
        fmt::format("'{}/{}' is damaged: what it says of the study does not fit its checksum; begin the study again in "
                    "another folder",
                    folder_, kDatabase));
  ReadColumns();
  for (const std::string& factor : factors_)
  {
    const auto differs = database_->Prepare(
        fmt::format("SELECT point FROM runs GROUP BY point HAVING COUNT(DISTINCT {}) > 1", NameInSql(factor)));
    if (differs->Step())
      throw StudyStoreError(fmt::format(
          "'{}/{}' is damaged: the runs of point {} have different values of the factor '{}'; begin the study again in "
          "another folder",
          folder_, kDatabase, differs->Whole(0), factor));
  }
}

std::string StudyStore::ChecksumOf(const RunName& name)
{
  std::string factors;
  for (const std::string& factor : factors_) factors += ", " + NameInSql(factor);
  std::string checksum;
  for (const std::string& rows :
       {"SELECT point, seed, exit, hash, ticks, failure, wall_s, peak_bytes" + factors + " FROM runs",
        std::string("SELECT * FROM samples"), std::string("SELECT * FROM grids"), std::string("SELECT * FROM ways")})
  {
    const auto found = database_->Prepare(rows + " WHERE point = ? AND seed = ? ORDER BY 1, 2, 3");
    found->BindWhole(name.point).BindWhole(name.seed);
    checksum = ChecksumOfRows(*found, checksum);
  }
  return checksum;
}

std::vector<RunName> StudyStore::DamagedRuns()
{
  std::vector<RunName> damaged;
  const auto kept = database_->Prepare("SELECT checksum FROM runs WHERE point = ? AND seed = ?");
  for (const RunState& run : Runs())
  {
    if (!run.is_done) continue;
    kept->BindWhole(run.name.point).BindWhole(run.name.seed);
    const bool fits = kept->Step() && kept->Text(0) == ChecksumOf(run.name);
    kept->Run();
    if (!fits) damaged.push_back(run.name);
  }
  return damaged;
}

void StudyStore::DropDamagedResults()
{
  for (const RunName& name : DamagedRuns())
  {
    PrintError(
        "swarmanoid: warning: '{}/{}' is damaged: the result of run {} does not fit its checksum; it runs again\n",
        folder_, kDatabase, name.Text());
    Begin();
    for (const char* table : {"samples", "grids", "ways"})
      database_->Prepare(fmt::format("DELETE FROM {} WHERE point = ? AND seed = ?", table))
          ->BindWhole(name.point)
          .BindWhole(name.seed)
          .Run();
    database_->Prepare("UPDATE runs SET state = 'waiting', checksum = NULL WHERE point = ? AND seed = ?")
        ->BindWhole(name.point)
        .BindWhole(name.seed)
        .Run();
  }
  Commit();
}

// The file gets its name only when it is complete, so that every process that finds it can read it.
void StudyStore::MakeDatabase(const Study& study, const Design& design)
{
  const std::string path = PathInFolder(kUnfinished);
  for (const char* part : {"", "-journal"}) std::remove((path + part).c_str());
  {
    StudyDatabase database(path, PathInFolder(kDatabase));
    MakeStudyTables(database, study, design, folder_);
  }
  if (std::rename(path.c_str(), PathInFolder(kDatabase).c_str()) != 0)
    throw StudyStoreError(fmt::format("cannot rename '{}': {}", path, std::strerror(errno)));
}

void StudyStore::ReadColumns()
{
  factors_ = FactorsIn(*database_);
  columns_ = MetricColumnsIn(*database_);
}

void StudyStore::PrepareCommands()
{
  update_run_ = database_->Prepare(
      "UPDATE runs SET state = ?, attempts = attempts + 1, exit = ?, hash = ?, ticks = ?, failure = ?, wall_s = ?, "
      "peak_bytes = ?, host = ?, version = ? WHERE point = ? AND seed = ?");
  std::string places;
  for (std::size_t c = 0; c < columns_.size(); ++c) places += ", ?";
  add_sample_ = database_->Prepare(fmt::format("INSERT OR REPLACE INTO samples SELECT ?, ?, ?, ?{}", places));
}

std::string StudyStore::Fact(const std::string& name)
{
  const auto row = database_->Prepare("SELECT value FROM study WHERE name = ?");
  return row->Bind(name).Step() ? row->Text(0) : "";
}

std::vector<std::string> StudyStore::StartsOfPaths()
{
  std::vector<std::string> starts;
  // Studies of version 1.0 do not have this fact.
  if (const std::string from_here = Fact("folder_from_here"); !from_here.empty())
    starts.push_back((fs::canonical(folder_) / from_here).lexically_normal().string());
  starts.push_back(Fact("folder"));
  return starts;
}

std::vector<StudyStore::RunState> StudyStore::Runs()
{
  std::vector<RunState> runs;
  const auto rows = database_->Prepare("SELECT point, seed, state, attempts, wall_s FROM runs ORDER BY point, seed");
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
  const auto row = database_->Prepare("SELECT 1 FROM runs WHERE point = ? AND seed = ? AND state = 'done'");
  return row->BindWhole(name.point).BindWhole(name.seed).Step();
}

void StudyStore::Begin()
{
  if (!in_transaction_) database_->Execute("BEGIN");
  in_transaction_ = true;
}

void StudyStore::Add(const RunOutcome& outcome)
{
  Begin();
  const bool done = outcome.IsDone();
  update_run_->Bind(std::string(done ? "done" : "failed")).BindWhole(static_cast<std::uint64_t>(outcome.exit_code));
  update_run_->Bind(done ? fmt::format("{:016x}", outcome.hash) : "").BindWhole(outcome.ticks).Bind(outcome.failure);
  update_run_->Bind(outcome.wall_s)
      .BindWhole(outcome.peak_bytes)
      .Bind(outcome.host.empty() ? NameOfThisHost() : outcome.host)
      .Bind(std::string(GitRevision()));
  update_run_->BindWhole(outcome.name.point).BindWhole(outcome.name.seed).Run();
  if (!done) return;
  AddSamples(outcome);
  database_->Prepare("UPDATE runs SET checksum = ? WHERE point = ? AND seed = ?")
      ->Bind(ChecksumOf(outcome.name))
      .BindWhole(outcome.name.point)
      .BindWhole(outcome.name.seed)
      .Run();
}

void StudyStore::AddSamples(const RunOutcome& outcome)
{
  const RunSamples& samples = outcome.samples;
  for (std::size_t row = 0; row < samples.ticks.size(); ++row)
  {
    add_sample_->BindWhole(outcome.name.point).BindWhole(outcome.name.seed).BindWhole(samples.ticks[row]);
    add_sample_->Bind(static_cast<double>(samples.ticks[row]) * samples.tick_s);
    for (std::size_t c = 0; c < columns_.size(); ++c) add_sample_->Bind(samples.values[row * columns_.size() + c]);
    add_sample_->Run();
  }
  for (const RunSamples::Grid& grid : samples.grids)
    database_->Prepare("INSERT OR REPLACE INTO grids VALUES (?, ?, ?, ?, ?, ?, ?)")
        ->BindWhole(outcome.name.point)
        .BindWhole(outcome.name.seed)
        .Bind(grid.metric)
        .BindWhole(grid.columns)
        .BindWhole(grid.rows)
        .Bind(grid.cell_m)
        .BindBytes(grid.visits)
        .Run();
  if (samples.followed.empty()) return;
  database_->Prepare("INSERT OR REPLACE INTO ways VALUES (?, ?, ?, ?, ?)")
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
  const auto row = database_->Prepare(fmt::format(
      "INSERT INTO runs SELECT point, ?, 'waiting', 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL{} FROM "
      "runs WHERE point = ? LIMIT 1",
      factors));
  row->BindWhole(name.seed).BindWhole(name.point).Run();
}

void StudyStore::AddPoint(std::uint32_t point, const std::vector<ExpressionValue>& values,
                          const std::vector<std::uint64_t>& seeds)
{
  Begin();
  AddWaitingRuns(*WaitingRun(*database_, values.size()), point, values, seeds);
}

std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> StudyStore::PointValues()
{
  std::string factors;
  for (const std::string& factor : factors_) factors += ", " + NameInSql(factor);
  std::vector<std::pair<std::uint32_t, std::vector<ExpressionValue>>> points;
  const auto rows = database_->Prepare(fmt::format("SELECT DISTINCT point{} FROM runs ORDER BY point", factors));
  while (rows->Step())
  {
    auto& [point, values] = points.emplace_back();
    point = static_cast<std::uint32_t>(rows->Whole(0));
    for (int f = 1; f <= static_cast<int>(factors_.size()); ++f)
    {
      if (rows->IsReal(f))
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
  const auto rows = database_->Prepare(fmt::format(
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
  const auto rows = database_->Prepare(fmt::format(
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
  if (in_transaction_) database_->Execute("COMMIT");
  in_transaction_ = false;
}

void StudyStore::WriteTable()
{
  const std::string path = folder_ + "/table.csv";
  const std::string draft = path + ".new";
  std::FILE* file = std::fopen(draft.c_str(), "we");
  if (file == nullptr) throw StudyStoreError(fmt::format("cannot write '{}': {}", draft, std::strerror(errno)));
  const auto rows = database_->Prepare("SELECT * FROM results ORDER BY point, seed, tick");
  const int columns = rows->Columns();
  std::string line;
  for (int c = 0; c < columns; ++c) line += (c == 0 ? "" : ",") + CsvField(rows->ColumnName(c));
  bool good = std::fputs((line + "\n").c_str(), file) >= 0;
  while (good && rows->Step())
  {
    line.clear();
    for (int c = 0; c < columns; ++c) line += (c == 0 ? "" : ",") + CsvField(rows->Text(c));
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
