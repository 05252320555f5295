// SPDX-License-Identifier: BSD-3-Clause
// Internal to sim/nc: the text of an expression -> postfix code.
#pragma once

#include <string>
#include <vector>

#include "sim/nc/block.h"
#include "sim/nc/expression.h"
#include "sim/nc/scanner.h"

namespace ncsim::nc {

enum class ExpressionForm {
  kOperand,  ///< After an address or label: `#1`, `##1`, `#[..]`, `[..]`.
  kFull,     ///< Right side of an assignment: ends where no operator follows.
};

/// Compiles the expression at the scanner into `block->code`. In an address (`in_address`) ROUND
/// rounds to the address's places. On failure adds one error to the block and returns false; the
/// scanner then stands somewhere in the line.
bool ParseExpression(Scanner* scanner, ExpressionForm form, bool in_address, Block* block,
                     Expression* expression);

}  // namespace ncsim::nc
