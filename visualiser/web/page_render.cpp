// page_render: writes one HTML file with the page of web_render, the models of robots, and the states of the run. The
// page plays the run in a browser without a server (page/src/recording.js). Blocks of states are written as soon as
// they are full, so memory does not grow with the run. What describes them comes last.
#include <fmt/format.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/space/space.h"
#include "common/version/version.h"
#include "visualiser/playback_reader.h"
#include "visualiser/render.h"
#include "visualiser/web/page_files.h"
#include "visualiser/web/page_messages.h"
#include "visualiser/web/recording_writer.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
constexpr unsigned kRecordingFormat = 1;

// The page may not contact any server, and loads nothing.
constexpr const char* kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; media-src blob:">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="Swarmanoid {}">
<title>{} · Swarmanoid</title>
<link rel="icon" href="data:image/svg+xml;base64,{}">
<style>{}</style>
</head>
<body>
<div id="app"></div>
<noscript>This page needs JavaScript.</noscript>
<script type="text/plain" id="licences">
{}</script>
)";

// Starts the page when all elements before it are there.
constexpr const char* kEnd = R"(<script>
(async () => {
  const packed = Uint8Array.from(atob(document.getElementById("swarmanoid-code").textContent), (letter) => letter.charCodeAt(0));
  const text = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  const script = document.createElement("script");
  script.type = "module";
  script.textContent = text;
  document.head.append(script);
})().catch((error) => (document.getElementById("app").textContent = `This browser cannot show the page: ${error.message}. Browsers from 2023 on can.`));
</script>
</body>
</html>
)";

std::string TextOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("page_render: cannot read '" + file.string() + "': " + std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string Base64(const std::string& bytes)
{
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  text.resize(static_cast<std::size_t>(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                                       reinterpret_cast<const unsigned char*>(bytes.data()),
                                                       static_cast<int>(bytes.size()))));
  return text;
}

// Compresses in the format of gzip, without a time.
std::string Compressed(const std::string& bytes)
{
  constexpr int kGzip = 15 + 16;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::string compressed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  const bool is_done = deflate(&stream, Z_FINISH) == Z_STREAM_END;
  compressed.resize(stream.total_out);
  deflateEnd(&stream);
  if (!is_done) throw std::runtime_error("page_render: a block of states cannot be compressed");
  return compressed;
}

std::string Escaped(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
    if (c == '&' || c == '<' || c == '>')
      escaped += fmt::format("&#{};", static_cast<int>(c));
    else
      escaped += c;
  return escaped;
}

class CPageRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  void Finish() override;

private:
  void Write(const std::string& text);
  [[noreturn]] void Fail() const;
  // Writes an element with packed bytes, whose attributes are `which`.
  void WriteElement(const std::string& which, const std::string& packed);
  void EndBlock();
  Json Timeline() const;

  const CSwarmanoidSpace* space_ = nullptr;
  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::unique_ptr<RecordingWriter> writer_;
  std::string world_;  // the message
  std::string output_folder_;
  RunMonitor* monitor_ = nullptr;
  std::uint64_t every_ = 1, next_ = 0, end_ = kNever;
  std::uint64_t last_ = 0;                  // the newest recorded tick
  std::vector<std::uint64_t> first_ticks_;  // of the blocks
  Json colours_ = Json::array();            // the ticks at which they changed, and the message
  std::string last_colours_;
  std::uint64_t colours_revision_ = kNever;
};

void CPageRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  space_ = &setup.space;
  monitor_ = setup.monitor;
  output_folder_ = setup.output_folder;
  every_ = static_cast<std::uint64_t>(parameters.Integer("every"));
  next_ = static_cast<std::uint64_t>(parameters.Integer("from"));
  if (const auto to = static_cast<std::uint64_t>(parameters.Integer("to")); to > 0) end_ = to;
  if (end_ < next_)
    throw ConfigurationError(parameters.Tree().ValueLocation("to"),
                             fmt::format("to is {}, but the first tick is {}; it must be the later tick", end_, next_));

  const Experiment& experiment = space_->GetExperiment();
  const Viewpoints given(parameters);
  const bool begins_there = given.First().has_value();
  world_ = WorldText(*space_, setup.assignment, begins_there ? given : Viewpoints::Of(experiment), begins_there);
  writer_ = std::make_unique<RecordingWriter>(*space_);

  const std::filesystem::path page = InstalledPageFolder();
  const std::string code = TextOf(page / "standalone.js.gz"), models = TextOf(page / "meshes.json.gz");
  const std::string head = fmt::format(kHead, Version(), Escaped(experiment.name), Base64(TextOf(page / "favicon.svg")),
                                       TextOf(page / "style.css"), TextOf(page / "licences.txt"));
  path_ = setup.MakeOutputFile("file");
  file_.reset(OpenOutputFile(path_));
  Write(head);
  WriteElement(R"(id="swarmanoid-code")", code);
  WriteElement(R"(id="swarmanoid-meshes")", models);
}

void CPageRender::Draw()
{
  const std::uint64_t tick = space_->GetTick();
  if (tick < next_ || tick > end_) return;
  next_ += ((tick - next_) / every_ + 1) * every_;
  if (writer_->IsFull()) EndBlock();
  writer_->Add();
  last_ = tick;
  if (colours_revision_ == space_->AttributeRevision()) return;
  colours_revision_ = space_->AttributeRevision();
  std::string colours = ColoursText(*space_);
  if (colours == last_colours_) return;
  last_colours_ = std::move(colours);
  colours_.push_back({tick, Json::parse(last_colours_)});
}

void CPageRender::EndBlock()
{
  first_ticks_.push_back(writer_->FirstTick());
  WriteElement(R"(class="swarmanoid-block")", Compressed(writer_->TakeBlock()));
}

Json CPageRender::Timeline() const
{
  std::vector<TimelineEvent> events = TimelineEventsOf(RunFolderOf(output_folder_, monitor_));
  std::erase_if(events,
                [&](const TimelineEvent& event) { return event.tick < first_ticks_.front() || event.tick > last_; });
  Json timeline = Json::parse(TimelineText("", first_ticks_.front(), last_ + 1, events));
  for (const char* not_in_page : {"type", "run"}) timeline.erase(not_in_page);
  timeline["step"] = every_;
  return timeline;
}

void CPageRender::Finish()
{
  if (writer_->IsEmpty() && first_ticks_.empty())
  {
    std::filesystem::remove(path_);
    throw std::runtime_error("page_render: no tick of the run is among those to record");
  }
  if (!writer_->IsEmpty()) EndBlock();
  const Experiment& experiment = space_->GetExperiment();
  Json world = Json::parse(world_);
  const Json head{{"version", kRecordingFormat},
                  {"unit_m", RecordingWriter::kUnit_m},
                  {"left_out", RecordingWriter::LeftOut()},
                  {"firsts", first_ticks_},
                  {"timeline", Timeline()},
                  {"colours", colours_},
                  {"notes",
                   {fmt::format("{}: {} entities, seed {}; recorded by Swarmanoid {}", experiment.name, space_->Size(),
                                experiment.seed, Version()),
                    "positions are rounded to 0.01 mm, directions to 0.006°; readings of sensors are not recorded"}},
                  {"world", std::move(world)}};
  WriteElement(R"(id="swarmanoid-run")", Compressed(head.dump(-1, ' ', false, Json::error_handler_t::replace)));
  Write(kEnd);
  if (std::fclose(file_.release()) != 0) Fail();
}

void CPageRender::WriteElement(const std::string& which, const std::string& packed)
{
  Write("<script type=\"text/plain\" " + which + ">" + Base64(packed) + "</script>\n");
}

void CPageRender::Write(const std::string& text)
{
  if (file_ == nullptr || std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) Fail();
}

void CPageRender::Fail() const
{
  throw std::runtime_error("page_render: cannot write '" + path_ + "': " + std::strerror(errno));
}

}  // namespace
}  // namespace swarmanoid

extern "C" __attribute__((visibility("default"))) swarmanoid::CRender* CreateSwarmanoidPageRender()
{
  return new swarmanoid::CPageRender;
}
