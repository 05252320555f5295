// SPDX-License-Identifier: BSD-3-Clause
#include "post/cl_reader.h"

#include <string>
#include <utility>
#include <vector>

#include "post/cl_words.h"
#include "sim/base/text.h"

namespace ncsim::post {
namespace {

cl::Text::Kind TextKind(std::string_view major) {
  if (major == "PARTNO") return cl::Text::Kind::kPartNo;
  if (major == "INSERT") return cl::Text::Kind::kInsert;
  if (major == "PPRINT") return cl::Text::Kind::kPrint;
  if (major == "LETTER") return cl::Text::Kind::kLetter;
  return cl::Text::Kind::kRemark;
}

ClStatement ReadStatement(ClArguments& arguments) {
  const ClLine& line = arguments.line();
  const ClWord* word = FindClWord(line.major);
  if (word == nullptr) {
    std::vector<std::string> known;
    for (const ClWord& each : ClWords()) known.emplace_back(each.major);
    // No more than a word can be near one.
    const std::string near = line.major.size() < 32 ? DidYouMean(line.major, known) : "";
    arguments.ErrorAtStart("unknown statement " + Quoted(line.major) + near);
    return cl::Unknown{};
  }
  switch (word->use) {
    case ClWord::Use::kIgnored:
      return cl::Ignored{};
    case ClWord::Use::kRefused:
      arguments.ErrorAtStart(line.major + " is not supported: it " + std::string(word->meaning));
      return cl::Unknown{};
    case ClWord::Use::kPassed: {
      cl::PostWord passed{line.major, {}};
      while (!arguments.done()) passed.values.push_back(arguments.TakeText());
      return passed;
    }
    case ClWord::Use::kRead:
      break;
  }
  ClStatement statement = word->parse(arguments);
  return arguments.Finish() ? std::move(statement) : ClStatement(cl::Unknown{});
}

/// What Creo says in comments.
ClStatement ReadData(ClArguments& arguments) {
  const ClLine& line = arguments.line();
  if (line.major == "CUTTER") {
    ClStatement cutter = ParseCutter(arguments);
    return arguments.Finish() ? std::move(cutter) : ClStatement(cl::Unknown{});
  }
  if (line.major == "FEATNO") return cl::OperationBegin{"FEATNO " + std::string(line.text), ""};
  std::string text = line.major;
  if (!line.text.empty()) text += " / " + std::string(line.text);
  return cl::Text{cl::Text::Kind::kData, std::move(text)};
}

}  // namespace

ClReader::ClReader(const std::shared_ptr<const nc::Program>& program, int file,
                   Diagnostics* diagnostics)
    : name_(program->name()), file_(file), diagnostics_(diagnostics), text_(program, diagnostics) {}

bool ClReader::Next(ClRecord* record) {
  if (!text_.Next(&line_)) return false;
  record->where = {file_, line_.line, line_.column};
  ClArguments arguments(line_, name_, diagnostics_);
  switch (line_.kind) {
    case ClLine::Kind::kStatement:
      record->statement = ReadStatement(arguments);
      break;
    case ClLine::Kind::kNumbers: {
      ClStatement point = ParsePoint(arguments);
      record->statement = arguments.Finish() ? std::move(point) : ClStatement(cl::Unknown{});
      break;
    }
    case ClLine::Kind::kText:
      record->statement = cl::Text{TextKind(line_.major), std::string(line_.text)};
      break;
    case ClLine::Kind::kComment:
      record->statement = cl::Text{cl::Text::Kind::kComment, std::string(line_.text)};
      break;
    case ClLine::Kind::kData:
      record->statement = ReadData(arguments);
      break;
    case ClLine::Kind::kBroken:
      record->statement = cl::Unknown{};
      break;
  }
  return true;
}

}  // namespace ncsim::post
