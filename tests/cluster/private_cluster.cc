// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cluster/private_cluster.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "sim/nightly/child.h"

namespace ncsim::cluster {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConfiguration = R"(ClusterName=ncsim
SlurmctldHost=HOST(127.0.0.1)
SlurmUser=USER
SlurmdUser=USER
AuthType=auth/munge
# cred_expire: a task that is put back into the queue waits that long, in s; the least there is.
AuthInfo=socket=FOLDER/munge.socket,cred_expire=5
SlurmctldPort=PORT0
StateSaveLocation=FOLDER/state
SlurmdSpoolDir=FOLDER/spool-%n
SlurmctldPidFile=FOLDER/slurmctld.pid
SlurmdPidFile=FOLDER/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
# A node that is silent that long, in s, is dead.
SlurmdTimeout=5
MessageTimeout=2
TCPTimeout=1
SchedulerParameters=sched_interval=1,bf_interval=1,sched_min_interval=0,batch_sched_delay=0
MaxArraySize=ARRAY
NodeName=n1 NodeHostname=HOST NodeAddr=127.0.0.1 Port=PORT1 CPUs=1
NodeName=n2 NodeHostname=HOST NodeAddr=127.0.0.1 Port=PORT2 CPUs=1
PartitionName=q Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
)";

/// "" where it is not there. Daemons lie where not every user looks.
std::string Find(const std::string& program) {
  for (const char* folder : {"/usr/sbin/", "/usr/bin/"}) {
    if (fs::exists(folder + program)) return folder + program;
  }
  return "";
}

std::string ReadText(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// Three that nobody listens on now.
std::array<int, 3> FreePorts() {
  std::array<int, 3> ports{}, sockets{};
  for (std::size_t i = 0; i < ports.size(); ++i) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    sockets.at(i) = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (bind(sockets.at(i), any, size) != 0 || getsockname(sockets.at(i), any, &size) != 0) {
      throw std::runtime_error("no free port");
    }
    ports.at(i) = ntohs(address.sin_port);
  }
  for (const int socket : sockets) close(socket);
  return ports;
}

bool IsZombie(pid_t pid) {
  const std::string text = ReadText("/proc/" + std::to_string(pid) + "/stat");
  return text.substr(std::min(text.rfind(')'), text.size())).starts_with(") Z");
}

/// All processes but this one of which `holds`, given their folder in /proc, is true.
std::vector<pid_t> Processes(const std::function<bool(const fs::path&)>& holds) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto pid = static_cast<pid_t>(std::stol(name));
    if (pid != getpid() && !IsZombie(pid) && holds(entry.path())) found.push_back(pid);
  }
  return found;
}

/// `variable` as "NAME=value".
bool HasVariable(const fs::path& process, const std::string& variable) {
  const std::string zero(1, '\0');
  return (zero + ReadText(process / "environ")).find(zero + variable + zero) != std::string::npos;
}

/// Whether it is of the cluster in `folder`: daemons, steps, and what they run.
bool IsOf(const fs::path& folder, const fs::path& process) {
  std::error_code error;
  return HasVariable(process, "SLURM_CONF=" + (folder / "slurm.conf").string()) ||
         fs::read_symlink(process / "cwd", error).string().starts_with(folder.string());
}

void KillAllOf(const fs::path& folder) {
  // What is forked while we look is seen the next time.
  Wait(20.0, [&] {
    const std::vector<pid_t> all = Processes([&](const fs::path& p) { return IsOf(folder, p); });
    for (const pid_t pid : all) kill(pid, SIGKILL);
    return all.empty();
  });
}

/// Starts a process that does so when this one has closed the returned end of a pipe, or died. It
/// is nobody's child, so that it is not killed with a tree.
int StartGuard(const fs::path& folder) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    if (setsid() < 0 || fork() != 0) _exit(0);
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO, ends[1]}) close(fd);
    char none = 0;
    while (read(ends[0], &none, 1) < 0 && errno == EINTR) {
    }
    KillAllOf(folder);
    _exit(0);
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return ends[1];
}

std::string Replace(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace

bool Wait(double seconds, const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

std::string PrivateCluster::Missing() {
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "scontrol"}) {
    if (Find(program).empty()) {
      return std::string("there is no ") + program + " (Debian: slurm-wlm, munge)";
    }
  }
  return "";
}

PrivateCluster::PrivateCluster(const fs::path& folder, int max_array_size) : folder_(folder) {
  fs::create_directories(folder_ / "state");
  guard_ = StartGuard(folder_);
  setenv("SLURM_CONF", (folder_ / "slurm.conf").c_str(), 1);
  WriteKey();
  Start("munged",
        {Find("munged"), "--foreground", "--force", "--key-file=" + (folder_ / "key").string(),
         "--socket=" + (folder_ / "munge.socket").string(),
         "--pid-file=" + (folder_ / "munge.pid").string(),
         "--log-file=" + (folder_ / "munge.log").string(),
         "--seed-file=" + (folder_ / "munge.seed").string()});
  bool started = Wait(20.0, [&] { return fs::exists(folder_ / "munge.socket"); });
  // Somebody else may have taken a port meanwhile.
  for (int i = 0; started && i < 3; ++i) {
    if (StartAll(max_array_size)) return;
  }
  const std::string words = ReadText(folder_ / "slurmctld.err") + ReadText(folder_ / "n1.err");
  Stop();
  throw std::runtime_error("the cluster does not start: " + words);
}

PrivateCluster::~PrivateCluster() { Stop(); }

void PrivateCluster::Stop() {
  KillAllOf(folder_);
  for (const auto& [name, pid] : daemons_) {
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
  }
  close(guard_);
}

void PrivateCluster::WriteKey() const {
  std::ofstream key(folder_ / "key", std::ios::binary);
  std::random_device random;
  for (int i = 0; i < 1024; ++i) key.put(static_cast<char>(random() & 255U));
  key.close();
  fs::permissions(folder_ / "key", fs::perms::owner_read);
}

void PrivateCluster::WriteConfiguration(int max_array_size) const {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::string text = kConfiguration;
  text =
      Replace(text, "HOST", std::string(host.data()).substr(0, std::string(host.data()).find('.')));
  text = Replace(text, "USER", getpwuid(geteuid())->pw_name);
  text = Replace(text, "FOLDER", folder_.string());
  text = Replace(text, "ARRAY", std::to_string(max_array_size));
  const std::array<int, 3> ports = FreePorts();
  for (std::size_t i = 0; i < ports.size(); ++i) {
    text = Replace(text, "PORT" + std::to_string(i), std::to_string(ports.at(i)));
  }
  std::ofstream(folder_ / "slurm.conf") << text;
}

void PrivateCluster::Start(const std::string& name, const std::vector<std::string>& command) {
  const std::string log = (folder_ / name).string();
  if (nightly::StartChild(command, folder_.string(), log + ".out", log + ".err", &daemons_[name]) !=
      0) {
    throw std::runtime_error(name + " cannot be started");
  }
}

bool PrivateCluster::StartAll(int max_array_size) {
  WriteConfiguration(max_array_size);
  Start("slurmctld", {Find("slurmctld"), "-D"});
  for (const char* node : {"n1", "n2"}) Start(node, {Find("slurmd"), "-D", "-N", node});
  const bool idle = Wait(20.0, [&] {
    try {
      return Ask({"sinfo", "--noheader", "--format=%D %T"}) == "2 idle\n";
    } catch (const std::runtime_error&) {
      return IsZombie(daemons_["slurmctld"]);
    }
  });
  if (idle && !IsZombie(daemons_["slurmctld"])) return true;
  for (const char* name : {"n1", "n2", "slurmctld"}) {
    kill(daemons_[name], SIGKILL);
    waitpid(daemons_[name], nullptr, 0);
  }
  return false;
}

std::string PrivateCluster::Ask(const std::vector<std::string>& command) const {
  std::vector<std::string> words = command;
  words.front() = Find(command.front());
  const std::string log = (folder_ / "answer").string();
  const nightly::ChildRun run =
      nightly::RunChild(words, folder_.string(), log + ".out", log + ".err", 60.0);
  if (run.exit_code != 0) throw std::runtime_error(command.front() + ": " + ReadText(log + ".err"));
  return ReadText(log + ".out");
}

void PrivateCluster::KillNode(const std::string& node) {
  // A step is named after its job: "slurmstepd: [12.batch]".
  std::istringstream jobs(
      Ask({"squeue", "--noheader", "--states=RUNNING", "--nodelist=" + node, "--format=%A"}));
  std::set<std::string> names;
  for (std::string job; jobs >> job;) names.insert("slurmstepd: [" + job + ".");
  kill(daemons_.at(node), SIGKILL);
  const auto kill_all = [&](const std::function<bool(const fs::path&)>& holds) {
    for (const pid_t pid :
         Processes([&](const fs::path& p) { return IsOf(folder_, p) && holds(p); })) {
      kill(pid, SIGKILL);
    }
  };
  // The steps first: they would tell of the end of what they run.
  kill_all([&](const fs::path& process) {
    const std::string words = ReadText(process / "cmdline");
    return names.count(words.substr(0, words.find('.') + 1)) > 0;
  });
  kill_all(
      [&](const fs::path& process) { return HasVariable(process, "SLURMD_NODENAME=" + node); });
}

}  // namespace ncsim::cluster
