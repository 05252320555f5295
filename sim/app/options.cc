// SPDX-License-Identifier: BSD-3-Clause
#include "sim/app/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "sim/app/app.h"
#include "sim/app/version.h"
#include "sim/base/text.h"
#include "sim/nightly/baseline.h"

namespace ncsim::app {
namespace {

constexpr const char* kDescription =
    "ncsim: will this NC program crash the machine? It reads the program as the control would, "
    "drives\n"
    "a model of the machine through it, and proves block by block that nothing overtravels, winds "
    "up\n"
    "or touches what it must not.";

constexpr const char* kExamples =
    "Examples:\n"
    "  ncsim check part.nc --model umc750.urdf           is part.nc safe? uses part.nc.job.toml if "
    "it is there\n"
    "  ncsim check part.nc --job vise.toml --clearance 2 warn where anything comes closer than 2 "
    "mm\n"
    "  ncsim post part.cls --model umc750.urdf -o part.nc\n"
    "                                                    write part.nc for the machine, and check "
    "it\n"
    "  ncsim compare old.nc new.nc --model umc750.urdf   do both move the tool alike in the part?\n"
    "  ncsim nightly parts                               check every program below parts, and say "
    "what is new\n"
    "  ncsim inspect umc750.urdf                         what the model says, and what is wrong "
    "with it\n"
    "  ncsim explain rotary-wrap                         what a finding means and what to do about "
    "it\n"
    "\n"
    "Exit code: 0 pass, 1 fail, 2 unproven (something was not simulated or is only assumed),\n"
    "3 bad input or usage, 4 internal error.";

const std::vector<std::pair<std::string, Format>> kCheckFormats = {{"text", Format::kText},
                                                                   {"json", Format::kJson},
                                                                   {"sarif", Format::kSarif},
                                                                   {"junit", Format::kJunit},
                                                                   {"github", Format::kGithub}};
const std::vector<std::pair<std::string, Format>> kCompareFormats = {{"text", Format::kText},
                                                                     {"json", Format::kJson}};

std::vector<std::string> SplitNames(const std::vector<std::string>& arguments) {
  std::vector<std::string> names;
  for (const std::string& argument : arguments) {
    for (std::string name : CLI::detail::split(argument, ',')) {
      CLI::detail::trim(name);
      if (!name.empty()) names.push_back(std::move(name));
    }
  }
  return names;
}

/// The parser and what it fills.
class CommandLine {
 public:
  CommandLine() {
    app_.set_version_flag("--version", std::string("ncsim ") + kVersion);
    app_.footer(kExamples);
    app_.allow_extras();
    AddCheck();
    AddPost();
    AddCompare();
    AddNightly();
    inspect_ = AddCommand("inspect", "print a machine model in words, and what its lint found");
    inspect_->add_option("MODEL", command_.model, "the machine, as for check --model");
    explain_ = AddCommand("explain", "what a rule means, what the machine would do, what to do");
    explain_->add_option("RULE", command_.rule, "for example rotary-wrap; without it, all rules");
  }

  /// Throws CLI::ParseError. Returns a usage error in words, or "".
  std::string Parse(std::vector<std::string> args) {
    std::reverse(args.begin(), args.end());  // CLI11 takes them from the back.
    app_.parse(std::move(args));
    if (const std::string error = Leftover(); !error.empty()) return error;
    if (check_->parsed()) return FinishCheck();
    if (post_->parsed()) return FinishPost();
    if (compare_->parsed()) return FinishCompare();
    if (nightly_->parsed()) return FinishNightly();
    if (inspect_->parsed()) {
      command_.kind = Command::Kind::kInspect;
      return command_.model.empty() ? "inspect needs a model: ncsim inspect umc750.urdf" : "";
    }
    if (explain_->parsed()) {
      command_.kind = Command::Kind::kExplain;
      return "";
    }
    return "which command? check, post, compare, nightly, inspect or explain (ncsim --help)";
  }

  const Command& command() const { return command_; }
  std::string Help() const { return app_.help(); }

 private:
  CLI::App* AddCommand(const char* name, const char* description) {
    CLI::App* command = app_.add_subcommand(name, description);
    command->allow_extras();
    return command;
  }

  void AddCheck() {
    CheckOptions& o = command_.check;
    check_ = AddCommand("check", "check NC programs: pass, fail or unproven, and why");
    check_->footer(kExamples);
    check_->add_option("PROGRAM", o.programs, "NC programs");
    check_
        ->add_option("--model", o.model,
                     "the machine: a .urdf file, or its name in $NCSIM_MODELS or among the models "
                     "that ship")
        ->type_name("M.urdf");
    check_
        ->add_option(
            "--job", o.job,
            "what stands on the machine and in the control: offsets, tools, fixtures, part "
            "(else PROGRAM.job.toml, if it exists)")
        ->type_name("J.toml");
    check_->add_option("--assume", assume_, "accept assumptions by name, or all of them")
        ->type_name("all|NAME,...")
        ->allow_extra_args(false);
    check_->add_flag("--strict", o.strict, "any assumption that is not accepted makes unproven");
    check_
        ->add_option("--clearance", clearance_,
                     "warn (near-miss) where two bodies come closer than this")
        ->type_name("MM");
    check_
        ->add_option("--jobs", o.jobs,
                     "threads to use; the report is the same for any number (default: as many as "
                     "there are processors)")
        ->type_name("N");
    check_->add_option("--format", format_, "text, json, sarif, junit or github")
        ->type_name("FORMAT");
    check_->add_option("--out", o.out, "write the report to this file")->type_name("FILE");
    check_
        ->add_option("--trace", o.trace, "write a row at the end of each motion (one program only)")
        ->type_name("T.csv");
    check_
        ->add_option("--report", o.report,
                     "write a page that shows the run in three dimensions: opens from disk in any "
                     "browser (one program only)")
        ->type_name("R.html");
    check_
        ->add_option("--gltf", o.gltf,
                     "write the machine in motion as a binary glTF file (one program only)")
        ->type_name("G.glb");
    check_
        ->add_option("--cache", o.cache,
                     "keep what was computed in this folder, and compute only what has changed; "
                     "the report is the same")
        ->type_name("DIR");
    check_->add_flag("--interpret-only", o.interpret_only,
                     "leave out the collision checks; the verdict is unproven at best");
    check_->add_option("--inputs", o.inputs, "")->group("");
  }

  void AddPost() {
    PostCommandOptions& o = command_.post;
    post_ = AddCommand("post",
                       "write the NC program of a cutter-location file (CLSF, APT), and check it");
    post_->add_option("CLFILE", o.cl_file, "what the CAM system has written");
    post_->add_option("--model", o.model, "the machine, as for check")->type_name("M.urdf");
    post_
        ->add_option("--mode", o.mode,
                     "a mode of the post for all operations (default: what each one needs)")
        ->type_name("NAME");
    post_->add_option("--job", o.job, "as for check: what the program is checked with")
        ->type_name("J.toml");
    post_->add_option("-o,--out", o.out, "the program (default: standard output)")
        ->type_name("OUT.nc");
    post_
        ->add_option("--post", o.post,
                     "what the program looks like (default: MODEL.post.toml beside the model)")
        ->type_name("P.post.toml");
    post_->add_option("--set", constants_, "a constant of the post: --set offset=G55")
        ->type_name("NAME=TEXT")
        ->allow_extra_args(false);
    post_->add_option("--number", number_, "O number of the program")->type_name("N");
    post_->add_option("--unit", unit_, "of the program: mm or inch")->type_name("UNIT");
    post_
        ->add_option("--tolerance", tolerance_,
                     "how far what is made of an arc or a turn may be off it (default: 0.004 mm)")
        ->type_name("MM");
    post_->add_option("--first-tool", first_tool_, "the tool, where the file loads none")
        ->type_name("T");
    post_->add_flag("--split", o.file_for_operation,
                    "a file for each operation beside OUT, and a program that calls them");
    post_->add_flag("--map", o.map,
                    "leave OUT.lines beside OUT, from which check knows the CL file's lines");
    post_->add_flag("--no-check", no_check_, "write without checking");
    post_->add_option("--assume", assume_, "as for check")
        ->type_name("all|NAME,...")
        ->allow_extra_args(false);
    post_->add_flag("--strict", o.strict, "as for check");
    AddClInput(post_);
  }

  void AddClInput(CLI::App* command) {
    command->add_option("--cl-unit", cl_unit_, "of a CL file that does not say: mm or inch")
        ->type_name("UNIT");
    command
        ->add_option("--cl-system", cl_system_,
                     "that wrote a CL file which does not show it: nx, creo, solidworks or apt")
        ->type_name("SYSTEM");
  }

  void AddCompare() {
    CompareOptions& o = command_.compare;
    compare_ = AddCommand("compare",
                          "hold two programs (NC or CL) together: the same motion in the part?");
    compare_->add_option("A", o.reference, "the program that is right, or its CL file");
    compare_->add_option("B", o.tested, "the program that is held against it");
    compare_->add_option("--model", o.model, "the machine, as for check; of both")
        ->type_name("M.urdf");
    compare_->add_option("--model-b", o.model_b, "the machine of B, where it is another")
        ->type_name("M.urdf");
    compare_->add_option("--job", o.job, "as for check; of both")->type_name("J.toml");
    compare_->add_option("--job-b", o.job_b, "of B, where it is another")->type_name("J.toml");
    compare_
        ->add_option("--tolerance", tolerance_,
                     "how far the tip may be off (default: 0.005 mm and one output increment)")
        ->type_name("MM");
    compare_
        ->add_option("--angle-tolerance", angle_tolerance_,
                     "how far the tool axis may be off (default: 0.01 deg)")
        ->type_name("DEG");
    compare_->add_option("--assume", assume_, "accept assumptions by name, or all of them")
        ->type_name("all|NAME,...")
        ->allow_extra_args(false);
    compare_->add_flag("--strict", o.strict, "any assumption that is not accepted makes unproven");
    compare_->add_option("--format", format_, "text or json")->type_name("FORMAT");
    compare_->add_option("--out", o.out, "write the report to this file")->type_name("FILE");
    AddClInput(compare_);
  }

  void AddNightly() {
    NightlyOptions& o = command_.nightly;
    nightly_ = AddCommand("nightly", "check many programs: one table, and what is new");
    nightly_->add_option("DIR", o.what,
                         "a folder: its programs that have a job beside them; or a manifest");
    nightly_->add_option("--out", o.out, "for tables, page and history (default: ncsim-nightly)")
        ->type_name("DIR");
    nightly_->add_option("--model", o.model, "of programs whose job names none, or that have none")
        ->type_name("M.urdf");
    nightly_->add_option("--assume", assume_, "as for check")
        ->type_name("all|NAME,...")
        ->allow_extra_args(false);
    nightly_->add_flag("--strict", o.strict, "as for check");
    nightly_->add_option("--baseline", o.baseline, "findings that are known and accepted")
        ->type_name("B.toml");
    nightly_->add_option("--timeout", o.timeout, "of each program (default: 3600)")->type_name("S");
    nightly_
        ->add_option("--jobs", o.jobs, "programs to check at a time (default: one after another)")
        ->type_name("N");
    nightly_->add_flag(
        "--reports", o.reports,
        "a page of each program, as check --report writes it, linked from the table");
    nightly_->add_flag("--all", o.all, "check also what has not changed");
    nightly_
        ->add_option("--shard", shard_, "check part I, from 0, of N parts, and leave it in --out")
        ->type_name("I/N");
    nightly_->add_flag("--merge", o.merge, "make a night of the parts");
    nightly_->add_option("--today", o.today, "the day of the night (default: by the clock)")
        ->type_name("YYYY-MM-DD");
  }

  /// What the parser could not place, with a suggestion.
  std::string Leftover() const {
    const std::vector<std::string> extras = app_.remaining(true);
    if (extras.empty()) return "";
    const std::string& extra = extras.front();
    const std::vector<CLI::App*> chosen = app_.get_subcommands();
    std::vector<std::string> known;
    if (extra.starts_with("-")) {
      const std::string name = extra.substr(0, extra.find('='));
      for (const CLI::Option* option : (chosen.empty() ? &app_ : chosen.front())->get_options()) {
        for (const std::string& longer : option->get_lnames()) known.push_back("--" + longer);
      }
      return "unknown option '" + name + "'" + DidYouMean(name, known);
    }
    if (!chosen.empty()) return "unexpected argument '" + extra + "'";
    for (const CLI::App* command : app_.get_subcommands(nullptr)) {
      known.push_back(command->get_name());
    }
    return "unknown command '" + extra + "'" + DidYouMean(extra, known);
  }

  std::string ReadFormat(const std::vector<std::pair<std::string, Format>>& formats,
                         Format* format) const {
    std::vector<std::string> known;
    std::string list;
    for (const auto& [name, value] : formats) {
      if (name == format_) {
        *format = value;
        return "";
      }
      known.push_back(name);
      list += list.empty() ? name : (&name == &formats.back().first ? " and " : ", ") + name;
    }
    return "unknown format '" + format_ + "'" + DidYouMean(format_, known) + "; there are " + list;
  }

  /// --format and --assume.
  std::string FinishCommon(const CLI::App* command,
                           const std::vector<std::pair<std::string, Format>>& formats,
                           Format* format, std::vector<std::string>* assume) const {
    if (const std::string error = ReadFormat(formats, format); !error.empty()) return error;
    *assume = SplitNames(assume_);
    if (command->count("--assume") > 0 && assume->empty()) return "--assume needs a name, or all";
    return "";
  }

  static std::string ReadUnit(const std::string& name, const std::string& text,
                              std::optional<post::ClUnit>* unit) {
    if (text.empty()) return "";
    if (text != "mm" && text != "inch") return name + " takes mm or inch";
    *unit = text == "mm" ? post::ClUnit::kMillimetre : post::ClUnit::kInch;
    return "";
  }

  std::string FinishClInput(ClInput* cl) const {
    if (!cl_system_.empty()) {
      std::vector<std::string> known;
      for (const auto flavour : {post::ClFlavour::kNx, post::ClFlavour::kCreo,
                                 post::ClFlavour::kSolidWorksCam, post::ClFlavour::kApt}) {
        known.emplace_back(ToString(flavour));
        if (known.back() == cl_system_) cl->flavour = flavour;
      }
      if (!cl->flavour) {
        return "--cl-system takes nx, creo, solidworks or apt" + DidYouMean(cl_system_, known);
      }
    }
    return ReadUnit("--cl-unit", cl_unit_, &cl->unit);
  }

  /// NAME=TEXT
  std::string FinishConstants(std::map<std::string, std::string>* constants) const {
    for (const std::string& constant : constants_) {
      const std::size_t sign = constant.find('=');
      if (sign == std::string::npos || sign == 0) return "--set takes NAME=TEXT";
      (*constants)[constant.substr(0, sign)] = constant.substr(sign + 1);
    }
    return "";
  }

  std::string FinishPost() {
    command_.kind = Command::Kind::kPost;
    PostCommandOptions& o = command_.post;
    o.assume = SplitNames(assume_);
    o.check = !no_check_;
    for (const std::string& error : {FinishClInput(&o.cl), FinishConstants(&o.constants),
                                     ReadUnit("--unit", unit_, &o.unit)}) {
      if (!error.empty()) return error;
    }
    if (post_->count("--number") > 0) {
      if (number_ < 1 || number_ > 99999) return "--number takes a number from 1 to 99999";
      o.number = number_;
    }
    if (post_->count("--first-tool") > 0) {
      if (first_tool_ < 1) return "--first-tool takes a number from 1";
      o.first_tool = first_tool_;
    }
    if (post_->count("--tolerance") > 0) {
      if (!(tolerance_ > 0.0) || !std::isfinite(tolerance_)) {
        return "--tolerance takes a distance in mm above 0";
      }
      o.tolerance = tolerance_;
    }
    if (o.cl_file.empty()) {
      return "post needs a CL file: ncsim post part.cls --model umc750.urdf -o part.nc";
    }
    if (o.file_for_operation && o.out.empty()) return "--split needs --out: the files go beside it";
    if (o.map && o.out.empty()) return "--map needs --out: the map goes beside it";
    return "";
  }

  std::string FinishCompare() {
    command_.kind = Command::Kind::kCompare;
    CompareOptions& o = command_.compare;
    if (const std::string error = FinishCommon(compare_, kCompareFormats, &o.format, &o.assume);
        !error.empty()) {
      return error;
    }
    if (const std::string error = FinishClInput(&o.cl); !error.empty()) return error;
    const auto positive = [&](const char* name, double value, std::optional<double>* option) {
      if (compare_->count(name) == 0) return true;
      *option = value;
      return value > 0.0 && std::isfinite(value);
    };
    if (!positive("--tolerance", tolerance_, &o.tolerance)) {
      return "--tolerance takes a distance in mm above 0";
    }
    if (!positive("--angle-tolerance", angle_tolerance_, &o.angle_tolerance) ||
        angle_tolerance_ > 90.0) {
      return "--angle-tolerance takes an angle in degrees above 0, at most 90";
    }
    if (o.reference.empty() || o.tested.empty()) {
      return "compare needs two programs: ncsim compare old.nc new.nc --model umc750.urdf";
    }
    return "";
  }

  std::string FinishShard(NightlyOptions* o) const {
    if (nightly_->count("--shard") == 0) return "";
    const std::size_t slash = shard_.find('/');
    const auto read = [&](const std::string& text, int* number) {
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
      return error == std::errc() && end == text.data() + text.size();
    };
    if (slash == std::string::npos || !read(shard_.substr(0, slash), &o->shard) ||
        !read(shard_.substr(slash + 1), &o->shard_count) || o->shard < 0 ||
        o->shard_count > 100'000 || o->shard >= o->shard_count) {
      return "--shard takes I/N: 0/4, 1/4, 2/4 or 3/4 of four";
    }
    return "";
  }

  std::string FinishNightly() {
    command_.kind = Command::Kind::kNightly;
    NightlyOptions& o = command_.nightly;
    o.assume = SplitNames(assume_);
    if (o.what.empty()) return "nightly needs a folder or a manifest: ncsim nightly parts";
    if (nightly_->count("--out") == 0) o.out = "ncsim-nightly";
    if (o.out.empty()) return "--out takes a folder";
    if (o.jobs < 1 || o.jobs > 1000) return "--jobs takes a number from 1";
    if (!(o.timeout > 0.0) || o.timeout > 1e6) return "--timeout takes a number of seconds above 0";
    if (!o.today.empty() && !nightly::IsDay(o.today)) return "--today takes a day: 2026-11-22";
    if (const std::string error = FinishShard(&o); !error.empty()) return error;
    if (o.merge && (o.shard_count > 0 || o.all)) {
      return "--merge makes a night of what was checked: without --shard and --all";
    }
    if (o.merge && o.reports) return "--reports goes with --shard: a merge checks nothing";
    if (o.shard_count > 0 && !o.baseline.empty()) return "--baseline goes with --merge";
    return "";
  }

  std::string FinishCheck() {
    command_.kind = Command::Kind::kCheck;
    CheckOptions& o = command_.check;
    if (const std::string error = FinishCommon(check_, kCheckFormats, &o.format, &o.assume);
        !error.empty()) {
      return error;
    }
    if (check_->count("--clearance") > 0) {
      if (!(clearance_ >= 0.0) || !std::isfinite(clearance_)) {
        return "--clearance takes a distance in mm that is not negative";
      }
      o.clearance = clearance_;
    }
    if (check_->count("--jobs") > 0 && o.jobs < 1) return "--jobs takes a number from 1";
    if (o.programs.empty()) return "check needs a program: ncsim check part.nc --model umc750.urdf";
    if (check_->count("--cache") > 0 && o.cache.empty()) return "--cache takes a folder";
    if (!o.trace.empty() && o.programs.size() > 1) return "--trace takes one program";
    if (!o.report.empty() && o.programs.size() > 1) return "--report takes one program";
    if (!o.gltf.empty() && o.programs.size() > 1) return "--gltf takes one program";
    return "";
  }

  CLI::App app_{kDescription, "ncsim"};
  CLI::App* check_ = nullptr;
  CLI::App* post_ = nullptr;
  CLI::App* compare_ = nullptr;
  CLI::App* nightly_ = nullptr;
  CLI::App* inspect_ = nullptr;
  CLI::App* explain_ = nullptr;
  Command command_;
  std::vector<std::string> assume_;
  double clearance_ = 0.0;
  double tolerance_ = 0.0, angle_tolerance_ = 0.0;
  std::string format_ = "text";
  std::vector<std::string> constants_;
  std::string shard_;
  std::string unit_, cl_unit_, cl_system_;
  int number_ = 0, first_tool_ = 0;
  bool no_check_ = false;
};

Command UsageError(const std::string& message, std::ostream& err) {
  err << "ncsim: " << message << "\n";
  Command command;
  command.exit_code = kExitBadInput;
  return command;
}

}  // namespace

Command ParseCommandLine(std::vector<std::string> args, std::ostream& out, std::ostream& err) {
  CommandLine line;
  try {
    const std::string error = line.Parse(std::move(args));
    return error.empty() ? line.command() : UsageError(error, err);
  } catch (const CLI::CallForVersion& version) {
    out << version.what() << "\n";
  } catch (const CLI::CallForHelp&) {
    out << line.Help();
  } catch (const CLI::ParseError& error) {
    return UsageError(error.what(), err);
  }
  return Command();
}

}  // namespace ncsim::app
