// SPDX-License-Identifier: BSD-3-Clause
// Functions of values alone (NC programming 12/2019, pp. 387, 446-460; PGA 03/2006, "String
// operations", "Frames").
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/base/text.h"
#include "sim/base/units.h"
#include "sim/nc/sinumerik_token.h"
#include "sim/nc/sinumerik_value.h"

namespace ncsim::nc {
namespace {

using Arguments = std::vector<SinumerikValue>;
using Type = SinumerikType;

std::string NoNumber(const SinumerikValue& value) {
  return AlarmText(12150, "a function of numbers takes no " + std::string(ToString(value.type)));
}

std::string NoString(const SinumerikValue& value) {
  return AlarmText(12150, "a function of strings takes no " + std::string(ToString(value.type)));
}

/// A function REAL -> REAL; an argument that has no value is an arithmetic error.
template <double (*kFunction)(double)>
std::string OfReal(const Arguments& arguments, SinumerikValue* result) {
  if (!arguments[0].is_number()) return NoNumber(arguments[0]);
  const double value = kFunction(arguments[0].number);
  if (!std::isfinite(value)) return AlarmText(14051, "the function has no value there");
  *result = SinumerikValue::Real(value);
  return "";
}

double Sin(double a) { return std::sin(Radians(a)); }
double Cos(double a) { return std::cos(Radians(a)); }
double Tan(double a) {
  return std::abs(std::remainder(a, 180.0)) == 90.0 ? HUGE_VAL : std::tan(Radians(a));
}
double Asin(double a) { return Degrees(std::asin(a)); }
double Acos(double a) { return Degrees(std::acos(a)); }
double Sqrt(double a) { return std::sqrt(a); }
double Pot(double a) { return a * a; }
double Trunc(double a) { return std::trunc(a); }
double Round(double a) { return std::round(a); }
double RoundUp(double a) { return std::ceil(a); }
double Ln(double a) { return std::log(a); }
double Exp(double a) { return std::exp(a); }

std::string Abs(const Arguments& arguments, SinumerikValue* result) {
  if (!arguments[0].is_number()) return NoNumber(arguments[0]);
  *result = arguments[0];
  result->number = std::abs(result->number);
  return "";
}

std::string Atan2(const Arguments& arguments, SinumerikValue* result) {
  for (const SinumerikValue& argument : arguments) {
    if (!argument.is_number()) return NoNumber(argument);
  }
  const double y = arguments[0].number;
  const double x = arguments[1].number;
  if (x == 0.0 && y == 0.0) return AlarmText(14051, "ATAN2(0,0) has no value");
  *result = SinumerikValue::Real(Degrees(std::atan2(y, x)));
  return "";
}

/// MINVAL and MAXVAL; BOUND(minimum, maximum, value).
std::string Choose(const Arguments& arguments, SinumerikValue* result, bool least) {
  for (const SinumerikValue& argument : arguments) {
    if (!argument.is_number()) return NoNumber(argument);
  }
  const bool first = least ? arguments[0].number <= arguments[1].number
                           : arguments[0].number >= arguments[1].number;
  *result = arguments[first ? 0 : 1];
  return "";
}
std::string MinVal(const Arguments& arguments, SinumerikValue* result) {
  return Choose(arguments, result, true);
}
std::string MaxVal(const Arguments& arguments, SinumerikValue* result) {
  return Choose(arguments, result, false);
}
std::string Bound(const Arguments& arguments, SinumerikValue* result) {
  for (const SinumerikValue& argument : arguments) {
    if (!argument.is_number()) return NoNumber(argument);
  }
  if (arguments[0].number > arguments[1].number) {
    return AlarmText(14051, "BOUND has its limits in the wrong order");
  }
  const double value = arguments[2].number;
  *result = value < arguments[0].number   ? arguments[0]
            : value > arguments[1].number ? arguments[1]
                                          : arguments[2];
  return "";
}

template <Type kType>
std::string To(const Arguments& arguments, SinumerikValue* result) {
  return Convert(arguments[0], kType, result);
}

// --- strings ---

std::string StrLen(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  *result = SinumerikValue::Int(static_cast<double>(arguments[0].text.size()));
  return "";
}

std::string ToUpper(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  *result = SinumerikValue::String(UpperName(arguments[0].text));
  return "";
}

std::string ToLower(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  std::string text = arguments[0].text;
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  *result = SinumerikValue::String(std::move(text));
  return "";
}

enum class Search { kFirst, kLast, kAnyOf, kWhole };

/// The place of the second argument in the first, from 0; -1 for none.
template <Search kSearch>
std::string Find(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  const bool is_char = arguments[1].type == Type::kChar;
  if (!is_char && arguments[1].type != Type::kString) return NoString(arguments[1]);
  const std::string key =
      is_char ? std::string(1, static_cast<char>(arguments[1].number)) : arguments[1].text;
  const std::string& text = arguments[0].text;
  const std::size_t place = kSearch == Search::kLast    ? text.rfind(key)
                            : kSearch == Search::kAnyOf ? text.find_first_of(key)
                                                        : text.find(key);
  const bool found = place != std::string::npos;
  *result = SinumerikValue::Int(found ? static_cast<double>(place) : -1.0);
  return "";
}

/// SUBSTR(text, from[, count]), from 0.
std::string SubStr(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (!arguments[i].is_number()) return NoNumber(arguments[i]);
  }
  const std::string& text = arguments[0].text;
  const auto size = static_cast<double>(text.size());
  const double from = std::round(arguments[1].number);
  const double count = arguments.size() > 2 ? std::round(arguments[2].number) : size;
  if (from < 0.0 || count < 0.0) return AlarmText(12160, "SUBSTR takes no negative number");
  const bool beyond = from >= size;
  *result =
      SinumerikValue::String(beyond ? std::string()
                                    : text.substr(static_cast<std::size_t>(from),
                                                  static_cast<std::size_t>(std::min(count, size))));
  return "";
}

/// The number that a text is, as the language writes it.
bool ReadNumberText(const std::string& text, double* value) {
  Scanner scanner(text, 0);
  scanner.SkipSpaces();
  const char sign = scanner.Peek();
  if (sign == '-' || sign == '+') scanner.Advance();
  SinumerikNumber number;
  const bool bits = scanner.Peek() == '\'';
  const std::string error =
      bits ? ReadSinumerikBits(&scanner, &number) : ReadSinumerikNumber(&scanner, &number);
  scanner.SkipSpaces();
  *value = sign == '-' ? -number.value : number.value;
  return error.empty() && scanner.AtEnd() && scanner.consumed() == text.size();
}

std::string IsNumber(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  double value = 0.0;
  *result = SinumerikValue::Bool(ReadNumberText(arguments[0].text, &value));
  return "";
}

std::string ToNumber(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  double value = 0.0;
  if (!ReadNumberText(arguments[0].text, &value)) {
    return AlarmText(14051, "NUMBER of a text that is no number");
  }
  *result = SinumerikValue::Real(value);
  return "";
}

std::string AxName(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kString) return NoString(arguments[0]);
  *result = SinumerikValue::Axis(UpperName(arguments[0].text));
  return "";
}

std::string AxString(const Arguments& arguments, SinumerikValue* result) {
  if (arguments[0].type != Type::kAxis) {
    return AlarmText(12040, "AXSTRING takes an axis");
  }
  *result = SinumerikValue::String(arguments[0].text);
  return "";
}

// --- frames ---

/// CTRANS(X,1,Y,2): pairs of axis and value; CMIRROR: axes alone.
template <typename Set>
std::string MakeFrame(const Arguments& arguments, bool pairs, Set set, SinumerikValue* result) {
  SinumerikFrame::Part part;
  const std::size_t step = pairs ? 2 : 1;
  if (arguments.size() % step != 0) {
    return AlarmText(14020, "a frame function takes pairs of axis and value");
  }
  for (std::size_t i = 0; i < arguments.size(); i += step) {
    if (arguments[i].type != Type::kAxis) return AlarmText(12040, "an axis is missing here");
    if (pairs && !arguments[i + 1].is_number()) return NoNumber(arguments[i + 1]);
    SinumerikFrame::Axis axis;
    axis.name = arguments[i].text;
    set(&axis, pairs ? arguments[i + 1].number : 1.0);
    part.push_back(std::move(axis));
  }
  SinumerikFrame frame;
  if (!part.empty()) frame.chain.push_back(std::move(part));
  *result = SinumerikValue::Frame(std::move(frame));
  return "";
}

std::string CTrans(const Arguments& arguments, SinumerikValue* result) {
  return MakeFrame(
      arguments, true, [](SinumerikFrame::Axis* axis, double value) { axis->tr = value; }, result);
}
std::string CFine(const Arguments& arguments, SinumerikValue* result) {
  return MakeFrame(
      arguments, true, [](SinumerikFrame::Axis* axis, double value) { axis->fi = value; }, result);
}
std::string CRot(const Arguments& arguments, SinumerikValue* result) {
  return MakeFrame(
      arguments, true, [](SinumerikFrame::Axis* axis, double value) { axis->rt = value; }, result);
}
std::string CScale(const Arguments& arguments, SinumerikValue* result) {
  return MakeFrame(
      arguments, true, [](SinumerikFrame::Axis* axis, double value) { axis->sc = value; }, result);
}
std::string CMirror(const Arguments& arguments, SinumerikValue* result) {
  return MakeFrame(
      arguments, false, [](SinumerikFrame::Axis* axis, double) { axis->mi = true; }, result);
}

constexpr std::size_t kMaxFrameArguments = 20;

constexpr std::array<SinumerikFunction, 40> kSinumerikFunctions = {{
    {"ABS", 1, 1, Abs},
    {"ACOS", 1, 1, OfReal<Acos>},
    {"ASIN", 1, 1, OfReal<Asin>},
    {"ATAN2", 2, 2, Atan2},
    {"AXNAME", 1, 1, AxName},
    {"AXSTRING", 1, 1, AxString},
    {"BOUND", 3, 3, Bound},
    {"BTOI", 1, 1, To<Type::kInt>},
    {"BTOR", 1, 1, To<Type::kReal>},
    {"CFINE", 0, kMaxFrameArguments, CFine},
    {"CMIRROR", 0, kMaxFrameArguments, CMirror},
    {"COS", 1, 1, OfReal<Cos>},
    {"CROT", 0, kMaxFrameArguments, CRot},
    {"CSCALE", 0, kMaxFrameArguments, CScale},
    {"CTRANS", 0, kMaxFrameArguments, CTrans},
    {"EXP", 1, 1, OfReal<Exp>},
    {"INDEX", 2, 2, Find<Search::kFirst>},
    {"ISNUMBER", 1, 1, IsNumber},
    {"ITOB", 1, 1, To<Type::kBool>},
    {"ITOR", 1, 1, To<Type::kReal>},
    {"LN", 1, 1, OfReal<Ln>},
    {"MATCH", 2, 2, Find<Search::kWhole>},
    {"MAXVAL", 2, 2, MaxVal},
    {"MINDEX", 2, 2, Find<Search::kAnyOf>},
    {"MINVAL", 2, 2, MinVal},
    {"NUMBER", 1, 1, ToNumber},
    {"POT", 1, 1, OfReal<Pot>},
    {"RINDEX", 2, 2, Find<Search::kLast>},
    {"ROUND", 1, 1, OfReal<Round>},
    {"ROUNDUP", 1, 1, OfReal<RoundUp>},
    {"RTOB", 1, 1, To<Type::kBool>},
    {"RTOI", 1, 1, To<Type::kInt>},
    {"SIN", 1, 1, OfReal<Sin>},
    {"SQRT", 1, 1, OfReal<Sqrt>},
    {"STRLEN", 1, 1, StrLen},
    {"SUBSTR", 2, 3, SubStr},
    {"TAN", 1, 1, OfReal<Tan>},
    {"TOLOWER", 1, 1, ToLower},
    {"TOUPPER", 1, 1, ToUpper},
    {"TRUNC", 1, 1, OfReal<Trunc>},
}};

}  // namespace

const SinumerikFunction* FindSinumerikFunction(std::string_view name) {
  for (const SinumerikFunction& function : kSinumerikFunctions) {
    if (SameName(name, function.name)) return &function;
  }
  return nullptr;
}

}  // namespace ncsim::nc
