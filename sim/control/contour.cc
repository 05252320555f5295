// SPDX-License-Identifier: BSD-3-Clause
#include "sim/control/contour.h"

#include <utility>

#include "sim/control/cutter_comp.h"

namespace ncsim::control {

struct Contour::State {
  State(const ContourOptions& options, Out sink, const Report& report, const Report& corner_report)
      : out(std::move(sink)),
        comp(
            options, [this](const Command& c) { out(c); }, report),
        corners([this](const Command& c) { comp.Push(c); }, corner_report ? corner_report : report,
                options.corner_names) {}

  Out out;
  CutterComp comp;
  CornerStage corners;
};

Contour::Contour(const ContourOptions& options, Out out, const Report& report,
                 const Report& corner_report)
    : state_(std::make_unique<State>(options, std::move(out), report, corner_report)) {}

Contour::~Contour() = default;

void Contour::SetPosition(const AxisValues& start) {
  state_->corners.SetPosition(start);
  state_->comp.SetPosition(start);
}

void Contour::LookAhead(bool on) { state_->comp.set_look_ahead(on); }

void Contour::Push(const Command& command) { state_->corners.Push(command); }

void Contour::Flush() {
  state_->corners.Flush();
  state_->comp.Flush();
}

void Contour::Stop(const SourcePosition& where, bool commanded) {
  Flush();
  if (commanded) state_->comp.AlarmAtStop(where);
}

AxisValues Contour::position() const { return state_->comp.position(); }

}  // namespace ncsim::control
