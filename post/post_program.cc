// SPDX-License-Identifier: BSD-3-Clause
#include "post/post_program.h"

#include <algorithm>
#include <deque>
#include <map>
#include <sstream>
#include <string>
#include <utility>

namespace ncsim::post {
namespace {

/// Texts are in memory: some 400 MB of them.
constexpr std::size_t kMostMoves = 10'000'000;

/// The texts as they are written, and where in them each operation begins.
class Recorder : public PlanSink {
 public:
  Recorder(const PostJob& job, Diagnostics* diagnostics)
      : writer_(*job.post, job.info, diagnostics, &Open(""), OpenerOf(job)) {}

  void OnStep(const PlanStep& step) override {
    if (program_.moves > kMostMoves) return;
    const std::size_t before = streams_.size() - 1;
    writer_.OnStep(step);
    // A step writes to the program, to the file of the operation that it ends, and to its own.
    for (const std::size_t file : {std::size_t{0}, before, streams_.size() - 1}) {
      TellLines(file, step.where.line);
    }
    if (const auto* operation = std::get_if<PlanOperation>(&step.what)) {
      PostedOperation begun;
      begun.operation = step.modal->operation->index;
      begun.where = step.where;
      begun.mode = operation->mode;
      begun.file = streams_.size() - 1;
      begun.line = written_.back().lines + 1;
      program_.operations.push_back(begun);
    } else if (std::holds_alternative<PlanMove>(step.what) ||
               std::holds_alternative<PlanHole>(step.what)) {
      ++program_.moves;
    }
  }

  bool full() const { return program_.moves > kMostMoves; }

  PostedProgram Take(const std::vector<PlanChoice>& choices) {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
      program_.files[i].text = std::move(streams_[i]).str();
    }
    for (std::size_t i = 0; i < program_.operations.size() && i < choices.size(); ++i) {
      PostedOperation& operation = program_.operations[i];
      operation.ways = choices[i].ways;
      operation.taken = choices[i].taken;
    }
    return std::move(program_);
  }

 private:
  std::ostringstream& Open(const std::string& name) {
    program_.files.push_back({name, ""});
    written_.emplace_back();
    return streams_.emplace_back();
  }
  /// What has come to a file comes from that line.
  void TellLines(std::size_t file, int cl_line) {
    Written& written = written_[file];
    const std::string_view text = streams_[file].view();
    if (text.size() == written.bytes) return;
    program_.files[file].lines.Add(written.lines + 1, cl_line);
    const std::string_view more = text.substr(written.bytes);
    written.lines += static_cast<int>(std::count(more.begin(), more.end(), '\n'));
    written.bytes = text.size();
  }
  NcWriter::OpenFile OpenerOf(const PostJob& job) {
    if (!job.file_for_operation) return nullptr;
    return [this](const std::string& name) { return &Open(name); };
  }

  struct Written {
    std::size_t bytes = 0;
    int lines = 0;
  };

  PostedProgram program_;
  std::vector<Written> written_;            ///< To each file.
  std::deque<std::ostringstream> streams_;  // A deque: the writer keeps pointers.
  NcWriter writer_;
};

}  // namespace

ClSummary ReadCl(const std::shared_ptr<const nc::Program>& cl, const ClOptions& options,
                 Diagnostics* diagnostics) {
  ClSummary summary;
  std::map<std::pair<std::optional<int>, std::string>, std::size_t> known;
  SourcePosition loaded;
  ClPath path(cl, 0, options, diagnostics);
  for (ClEvent event; path.Next(&event);) {
    summary.operations = std::max(summary.operations, event.modal->operation->index);
    if (std::holds_alternative<ClToolLoad>(event.what)) loaded = event.where;
    if (!std::holds_alternative<ClMotion>(event.what) &&
        !std::holds_alternative<ClHole>(event.what)) {
      continue;
    }
    ++summary.motions;
    const ClTool& tool = *event.modal->tool;
    // A number is a pocket of the machine, whatever the file calls the tool in it.
    const auto [found, first] =
        known.insert({{tool.number, tool.number ? "" : tool.name}, summary.tools.size()});
    if (first) summary.tools.push_back({tool, loaded.line > 0 ? loaded : event.where, false});
    ToolUse& use = summary.tools[found->second];
    use.compensated = use.compensated || event.modal->comp.side != cl::CutterComp::Side::kOff;
  }
  summary.unit = path.unit();
  return summary;
}

PostedProgram PostProgram(const PostJob& job, const PlanOptions& options,
                          Diagnostics* diagnostics) {
  Recorder recorder(job, diagnostics);
  Planner planner(*job.geometry, options, job.cl->name(), diagnostics, &recorder);
  ClPath path(job.cl, 0, job.cl_options, diagnostics);
  for (ClEvent event; !diagnostics->has_errors() && path.Next(&event);) planner.Take(event);
  if (recorder.full()) {
    diagnostics->Error(job.cl->name(), 0, 0,
                       "the program would have more than " + std::to_string(kMostMoves) + " moves");
  }
  return recorder.Take(planner.choices());
}

}  // namespace ncsim::post
