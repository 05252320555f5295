// SPDX-License-Identifier: BSD-3-Clause
// What the planner is to know of a post.
#pragma once

#include <string_view>

#include "post/planner.h"
#include "post/post_data.h"

namespace ncsim::post {

/// `mode`: the one that every operation is to run in; "" for what each needs (ProgramInfo::mode has
/// the same name).
PlanOptions PlanOptionsOf(const PostData& post, std::string_view mode);

}  // namespace ncsim::post
