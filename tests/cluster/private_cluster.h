// SPDX-License-Identifier: BSD-3-Clause
// Slurm with two nodes of a processor each on this machine, of this process alone: its own munge
// key, ports and folders. Nothing of it is left running when the cluster is destroyed, or when this
// process dies.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ncsim::cluster {

class PrivateCluster {
 public:
  /// Why there can be none on this machine; "" where there can.
  static std::string Missing();

  /// Starts it in `folder`, which is made, and waits until both nodes are idle. SLURM_CONF of this
  /// process then names it. Throws std::runtime_error.
  PrivateCluster(const std::filesystem::path& folder, int max_array_size);
  ~PrivateCluster();
  PrivateCluster(const PrivateCluster&) = delete;
  PrivateCluster& operator=(const PrivateCluster&) = delete;

  /// What a command of Slurm prints. Throws where it fails.
  std::string Ask(const std::vector<std::string>& command) const;
  /// As when its power fails: the daemon of the node, that of its step, and all that they run.
  void KillNode(const std::string& node);

 private:
  void WriteKey() const;
  void WriteConfiguration(int max_array_size) const;
  void Start(const std::string& name, const std::vector<std::string>& command);
  bool StartAll(int max_array_size);
  void Stop();

  std::filesystem::path folder_;
  int guard_ = -1;
  std::map<std::string, pid_t> daemons_;
};

/// Whether it comes true within `seconds`.
bool Wait(double seconds, const std::function<bool()>& condition);

}  // namespace ncsim::cluster
