// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/app.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <utility>

#include "sim/app/check_command.h"
#include "sim/app/compare_command.h"
#include "sim/app/explain.h"
#include "sim/app/nightly_command.h"
#include "sim/app/options.h"
#include "sim/app/post_command.h"
#include "sim/app/program_dir.h"
#include "sim/machine/load.h"

namespace ncsim::app {
namespace {

int InspectModel(const std::string& model, std::ostream& out, std::ostream& err) {
  const std::string path = machine::FindModel(model, ProgramDir());
  if (path.empty()) {
    err << "ncsim: there is no model '" << model
        << "': not a file, and not in $NCSIM_MODELS or among the models that ship\n";
    return kExitBadInput;
  }
  Diagnostics diagnostics;
  const auto machine = machine::LoadMachine(path, &diagnostics);
  if (machine) {
    out << machine::Inspect(*machine, diagnostics);
  } else {
    for (const Diagnostic& diagnostic : diagnostics.all()) err << ToString(diagnostic) << "\n";
  }
  return machine && !diagnostics.has_errors() ? kExitPass : kExitBadInput;
}

int RunCommand(const Command& command, std::ostream& out, std::ostream& err) {
  switch (command.kind) {
    case Command::Kind::kCheck:
      return Check(command.check, out, err);
    case Command::Kind::kPost:
      return Post(command.post, out, err);
    case Command::Kind::kCompare:
      return Compare(command.compare, out, err);
    case Command::Kind::kNightly:
      return Nightly(command.nightly, out, err);
    case Command::Kind::kInspect:
      return InspectModel(command.model, out, err);
    case Command::Kind::kExplain:
      return Explain(command.rule, out, err);
    case Command::Kind::kDone:
      return command.exit_code;
  }
  return kExitInternalError;
}

}  // namespace

std::string ProgramDir() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "" : executable.parent_path().string();
}

ExitCode ExitOf(Verdict verdict) {
  return verdict == Verdict::kPass   ? kExitPass
         : verdict == Verdict::kFail ? kExitFail
                                     : kExitUnproven;
}

int CombinedExit(const std::vector<int>& codes) {
  for (const int code : {kExitInternalError, kExitBadInput, kExitFail, kExitUnproven}) {
    if (std::find(codes.begin(), codes.end(), code) != codes.end()) return code;
  }
  return kExitPass;
}

int Run(std::vector<std::string> args, std::ostream& out, std::ostream& err) {
  try {
    const int code = RunCommand(ParseCommandLine(std::move(args), out, err), out, err);
    out.flush();
    return code;
  } catch (const std::bad_alloc&) {
    err << "ncsim: internal error: out of memory\n";
  } catch (const std::exception& error) {
    err << "ncsim: internal error: " << error.what() << "\n";
  } catch (...) {
    err << "ncsim: internal error\n";
  }
  return kExitInternalError;
}

}  // namespace ncsim::app
