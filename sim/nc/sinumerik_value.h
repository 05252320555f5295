// SPDX-License-Identifier: BSD-3-Clause
// Values of the SINUMERIK language and what operators make of them (NC programming 12/2019,
// "Flexible NC programming", pp. 387-445).
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/nc/sinumerik_block.h"
#include "sim/nc/sinumerik_expression.h"

namespace ncsim::nc {

/// Components of a frame, as programmed (mm, deg): parts chained by `:`, the leftmost first. Within
/// a part an axis is shifted by tr + fi, turned by rt, scaled by sc, mirrored by mi.
struct SinumerikFrame {
  struct Axis {
    std::string name;  ///< Upper case.
    double tr = 0.0, fi = 0.0, rt = 0.0, sc = 1.0;
    bool mi = false;
  };
  using Part = std::vector<Axis>;
  std::vector<Part> chain;
};

struct SinumerikValue {
  SinumerikType type = SinumerikType::kReal;
  bool omitted = false;  ///< An argument that is not there; type and value mean nothing.
  double number = 0.0;   ///< BOOL (0, 1), CHAR, INT, REAL.
  std::string text;      ///< STRING; AXIS: the axis's name, upper case.
  std::shared_ptr<const SinumerikFrame> frame;  ///< FRAME; null is the zero frame.

  bool is_number() const { return type <= SinumerikType::kReal; }
  static SinumerikValue Real(double value);
  static SinumerikValue Int(double value);
  static SinumerikValue Bool(bool value);
  static SinumerikValue String(std::string value);
  static SinumerikValue Axis(std::string name);
  static SinumerikValue Frame(SinumerikFrame frame);
  static SinumerikValue Omitted();
  /// What a variable holds before it is set.
  static SinumerikValue Default(SinumerikType type);
};

/// As an assignment to a variable of that type does: REAL is rounded to INT, a number that is not 0
/// is TRUE. Returns "" or why not, with the alarm.
std::string Convert(const SinumerikValue& value, SinumerikType type, SinumerikValue* converted);
/// As `<<` writes it.
std::string ToText(const SinumerikValue& value);
/// Numbers that differ by less than 10^-12 of the larger one are equal to the comparison operators
/// (NC programming 12/2019, p. 444; MD10280 bit 0 = 0).
bool RelativelyEqual(double a, double b);

/// Returns "" or why not, with the alarm.
std::string ApplyUnary(SinumerikOp op, const SinumerikValue& a, SinumerikValue* result);
std::string ApplyBinary(SinumerikOp op, const SinumerikValue& a, const SinumerikValue& b,
                        SinumerikValue* result);

/// What stops an evaluation.
struct SinumerikFault {
  int column = 0;            ///< From 1.
  bool unsupported = false;  ///< The control knows it, ncsim does not. Else an alarm.
  std::string message;
};

/// Where an expression finds what its names mean.
class SinumerikReader {
 public:
  virtual ~SinumerikReader() = default;
  /// A variable, system variable, axis or named constant. Fills in all of the fault but its column.
  virtual bool ReadName(std::string_view name, const std::vector<SinumerikValue>& indices,
                        SinumerikValue* value, SinumerikFault* fault) = 0;
  /// A function that is not one of values alone (ISVAR, GETTCOR ...).
  virtual bool CallFunction(std::string_view name, const std::vector<SinumerikValue>& arguments,
                            SinumerikValue* value, SinumerikFault* fault) = 0;
};

/// A function of values alone: SIN, STRLEN, CTRANS ... Null: there is none of that name.
struct SinumerikFunction {
  std::string_view name;            ///< Upper case.
  std::size_t least = 1, most = 1;  ///< Arguments.
  std::string (*call)(const std::vector<SinumerikValue>& arguments, SinumerikValue* result);
};
const SinumerikFunction* FindSinumerikFunction(std::string_view name);

/// False: `fault` says why. Never recurses.
bool Evaluate(const SinumerikBlock& block, SinumerikExpression expression, SinumerikReader& reader,
              SinumerikValue* value, SinumerikFault* fault);

}  // namespace ncsim::nc
