// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_path.h"

#include <utility>

#include "post/cl_machine.h"

namespace ncsim::post {
namespace {

/// Then nothing more of the file is looked at.
constexpr std::size_t kMostDiagnostics = 100;

/// The options with flavour and unit filled in; reports what the file leaves open.
ClOptions Settle(const nc::Program& program, ClOptions options, Diagnostics* diagnostics) {
  const ClSurvey survey = Survey(program);
  const auto fail = [&](const std::string& message) {
    diagnostics->Error(program.name(), 0, 0, message);
  };
  if (!options.flavour && !survey.flavour_contradiction.empty()) {
    fail("words of two systems: " + survey.flavour_evidence + ", " + survey.flavour_contradiction +
         "; name the one that wrote it (nx, creo or solidworks)");
  }
  if (!options.flavour) options.flavour = survey.flavour;
  if (!survey.other_feed_unit.empty()) {
    diagnostics->Warning(program.name(), 0, 0,
                         "points and feed rates are in different units: " + survey.unit_evidence +
                             ", " + survey.other_feed_unit);
  }
  if (!survey.unit_contradiction.empty()) {
    if (!options.unit) {
      fail("two units: " + survey.unit_evidence + ", " + survey.unit_contradiction +
           "; name that of the points (mm or inch)");
    }
  } else if (survey.unit) {
    if (options.unit && options.unit != survey.unit) {
      fail("the points are said to be in " +
           std::string(options.unit == ClUnit::kInch ? "inch" : "mm") + ", the file has " +
           survey.unit_evidence);
    }
    options.unit = survey.unit;
  } else if (!options.unit) {
    fail("neither UNITS nor a feed rate says the unit of the points: name it (mm or inch)");
  }
  if (!options.unit) options.unit = survey.unit.value_or(ClUnit::kMillimetre);
  return options;
}

}  // namespace

struct ClPath::State {
  State(const std::shared_ptr<const nc::Program>& program, int file, const ClOptions& settled,
        Diagnostics* to)
      : options(settled),
        diagnostics(to),
        before(to->all().size()),
        name(program->name()),
        reader(program, file, to),
        machine(program->name(), file, settled, to) {}

  ClOptions options;
  Diagnostics* diagnostics;
  std::size_t before;  ///< Diagnostics of others.
  std::string name;
  ClReader reader;
  ClMachine machine;
  ClRecord record;
  bool ended = false;
};

ClPath::ClPath(const std::shared_ptr<const nc::Program>& program, int file,
               const ClOptions& options, Diagnostics* diagnostics)
    : state_(std::make_unique<State>(program, file, Settle(*program, options, diagnostics),
                                     diagnostics)) {}

ClPath::~ClPath() = default;

ClFlavour ClPath::flavour() const { return *state_->options.flavour; }

ClUnit ClPath::unit() const { return *state_->options.unit; }

bool ClPath::Next(ClEvent* event) {
  std::deque<ClEvent>& events = state_->machine.events();
  while (events.empty()) {
    if (state_->ended) return false;
    if (state_->diagnostics->all().size() - state_->before > kMostDiagnostics) {
      state_->diagnostics->Error(state_->name, state_->record.where.line, 0,
                                 "too many errors: the rest is not read");
      state_->ended = true;
      return false;
    }
    if (state_->reader.Next(&state_->record)) {
      state_->machine.Take(std::move(state_->record));
    } else {
      state_->machine.End(state_->reader.line());
      state_->ended = true;
    }
  }
  *event = std::move(events.front());
  events.pop_front();
  return true;
}

}  // namespace ncsim::post
