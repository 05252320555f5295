// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/xml.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

#include "sim/base/text.h"

namespace ncsim::machine::xml {
namespace {

/// The first element that xacro should have replaced, or nullptr.
const tinyxml2::XMLElement* FindMacro(const tinyxml2::XMLElement& element) {
  if (std::strncmp(element.Name(), "xacro:", 6) == 0) return &element;
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string_view value = a->Value();
    if (value.find("${") != value.npos || value.find("$(") != value.npos) return &element;
  }
  for (const auto* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (const tinyxml2::XMLElement* macro = FindMacro(*e)) return macro;
  }
  return nullptr;
}

}  // namespace

std::optional<std::vector<double>> ParseNumbers(const char* text) {
  std::vector<double> numbers;
  const char* at = text;
  const char* const end = text + std::strlen(text);
  constexpr std::string_view kBlanks = " ";
  while (true) {
    while (at != end && kBlanks.find(*at) != std::string_view::npos) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    if (next != end && kBlanks.find(*next) == std::string_view::npos) return std::nullopt;
    numbers.push_back(value);
    at = next;
  }
}

const tinyxml2::XMLElement* Reader::Parse(const std::string& text) {
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    diagnostics_->Error(file_, document_.ErrorLineNum(), 0,
                        std::string("not XML: ") + document_.ErrorName());
    return nullptr;
  }
  const tinyxml2::XMLElement* root = document_.RootElement();
  if (root == nullptr || std::strcmp(root->Name(), "robot") != 0) {
    diagnostics_->Error(file_, root == nullptr ? 0 : root->GetLineNum(), 0,
                        "the root element must be <robot>");
    return nullptr;
  }
  if (const tinyxml2::XMLElement* macro = FindMacro(*root)) {
    Error(*macro, "this is xacro, not URDF: expand it first (xacro IN > OUT.urdf)");
    return nullptr;
  }
  return root;
}

void Reader::Error(const tinyxml2::XMLElement& at, std::string message) const {
  ++errors_;
  diagnostics_->Error(file_, at.GetLineNum(), 0, std::move(message));
}

void Reader::Warning(const tinyxml2::XMLElement& at, std::string message) const {
  diagnostics_->Warning(file_, at.GetLineNum(), 0, std::move(message));
}

std::string Reader::Name(const tinyxml2::XMLElement& element, const char* attribute) const {
  const char* value = element.Attribute(attribute);
  if (value != nullptr && *value != '\0') return value;
  Error(element, "<" + std::string(element.Name()) + "> has no " + attribute);
  return "";
}

std::optional<std::vector<double>> Reader::Numbers(const tinyxml2::XMLElement& element,
                                                   const char* attribute, std::size_t count,
                                                   bool required) const {
  const char* text = element.Attribute(attribute);
  const std::string name = "<" + std::string(element.Name()) + " " + attribute + ">";
  if (text == nullptr) {
    if (required) Error(element, name + " is missing");
    return std::nullopt;
  }
  std::optional<std::vector<double>> numbers = ParseNumbers(text);
  // urdfdom takes a blank after a list, but not after a single number.
  const bool trailing = count == 1 && std::string_view(text).ends_with(' ');
  if (numbers && numbers->size() == count && !trailing) return numbers;
  Error(element, name + " must be " +
                     (count == 1 ? std::string("a number") : std::to_string(count) + " numbers") +
                     ", not \"" + std::string(text).substr(0, 60) + "\"");
  return std::nullopt;
}

void Reader::CheckChildren(const tinyxml2::XMLElement& element,
                           const std::vector<std::string>& known) const {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const std::string name = child->Name();
    const bool extension = name.find(':') != std::string::npos && !name.starts_with("ncsim:");
    if (extension || std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string message = "<" + name + "> in <" + element.Name() + "> is not known";
    const std::string nearest = DidYouMean(name, known);
    if (nearest.empty()) {
      Warning(*child, message + ": it is not read");
    } else {
      Error(*child, message + nearest);
    }
  }
}

}  // namespace ncsim::machine::xml
