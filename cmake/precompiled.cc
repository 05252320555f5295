// SPDX-License-Identifier: BSD-3-Clause
// Nothing: CMake precompiles headers for a target that has a source.
