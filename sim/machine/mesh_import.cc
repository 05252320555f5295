// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/mesh_import.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <type_traits>

namespace ncsim::machine {
namespace {

/// Honest files take well under a second a megabyte.
unsigned MaxSeconds(std::size_t bytes) { return 10 + static_cast<unsigned>(bytes >> 20); }

constexpr rlim_t kMaxChildMemory = rlim_t{6} << 30;

/// Appends the meshes of `node` and below, in the frame of the root.
void Collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& X_parent,
             TriangleMesh* mesh) {
  const aiMatrix4x4 X = X_parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
    const int base = static_cast<int>(mesh->vertices.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = X * part.mVertices[v];
      mesh->vertices.emplace_back(p.x, p.y, p.z);
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines bound no solid
      std::array<int, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= part.mNumVertices) return;  // the missing triangle leaves a hole
        triangle[k] = base + static_cast<int>(face.mIndices[k]);
      }
      mesh->triangles.push_back(triangle);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) Collect(scene, *node.mChildren[i], X, mesh);
}

TriangleMesh Import(const std::string& bytes, const std::string& extension, std::string* defect) {
  TriangleMesh mesh;
  try {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                       aiProcess_Triangulate, extension.c_str());
    if (scene == nullptr || scene->mRootNode == nullptr) {
      const std::string reason = importer.GetErrorString();
      *defect = "cannot be read: " + (reason.empty() ? "no mesh in it" : reason);
      return mesh;
    }
    Collect(*scene, *scene->mRootNode, aiMatrix4x4(), &mesh);
  } catch (const std::exception& error) {
    *defect = std::string("cannot be read: ") + error.what();
    return TriangleMesh();
  }
  if (extension == "glb") {
    for (Eigen::Vector3d& v : mesh.vertices) v = Eigen::Vector3d(v.x(), -v.z(), v.y());
  }
  return mesh;
}

/// The child's answer on the wire: this head, the defect's text, vertices, triangles.
struct Head {
  std::uint64_t defect_bytes = 0, vertices = 0, triangles = 0;
};
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
static_assert(sizeof(std::array<int, 3>) == 3 * sizeof(int));

bool WriteAll(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(fd, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

std::string ReadAll(int fd) {
  std::string bytes;
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t got = read(fd, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

[[noreturn]] void RunChild(const std::string& bytes, const std::string& extension, int fd) {
  const int null = open("/dev/null", O_WRONLY);
  dup2(null, STDOUT_FILENO);
  dup2(null, STDERR_FILENO);
  alarm(MaxSeconds(bytes.size()));
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__)
  const rlimit memory{kMaxChildMemory, kMaxChildMemory};
  setrlimit(RLIMIT_AS, &memory);
#endif
  std::string defect;
  const TriangleMesh mesh = Import(bytes, extension, &defect);
  const Head head{defect.size(), mesh.vertices.size(), mesh.triangles.size()};
  const bool sent =
      WriteAll(fd, &head, sizeof(head)) && WriteAll(fd, defect.data(), defect.size()) &&
      WriteAll(fd, mesh.vertices.data(), mesh.vertices.size() * sizeof(Eigen::Vector3d)) &&
      WriteAll(fd, mesh.triangles.data(), mesh.triangles.size() * sizeof(std::array<int, 3>));
  _exit(sent ? 0 : 1);
}

/// Takes the child's answer apart; false where it is not whole.
bool Unpack(const std::string& answer, TriangleMesh* mesh, std::string* defect) {
  Head head;
  if (answer.size() < sizeof(head)) return false;
  std::memcpy(&head, answer.data(), sizeof(head));
  const std::size_t vertex_bytes = head.vertices * sizeof(Eigen::Vector3d);
  const std::size_t triangle_bytes = head.triangles * sizeof(std::array<int, 3>);
  if (answer.size() != sizeof(head) + head.defect_bytes + vertex_bytes + triangle_bytes)
    return false;
  const char* at = answer.data() + sizeof(head);
  defect->assign(at, head.defect_bytes);
  at += head.defect_bytes;
  mesh->vertices.resize(head.vertices);
  for (Eigen::Vector3d& vertex : mesh->vertices) {
    std::memcpy(vertex.data(), at, sizeof(Eigen::Vector3d));
    at += sizeof(Eigen::Vector3d);
  }
  mesh->triangles.resize(head.triangles);
  for (std::array<int, 3>& triangle : mesh->triangles) {
    std::memcpy(triangle.data(), at, sizeof(triangle));
    at += sizeof(triangle);
  }
  return true;
}

TriangleMesh ImportInChild(const std::string& bytes, const std::string& extension,
                           std::string* defect) {
  TriangleMesh mesh;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    *defect = "cannot be read: no pipe to a reader process";
    return mesh;
  }
  const pid_t child = fork();
  if (child == 0) RunChild(bytes, extension, ends[1]);
  close(ends[1]);
  const std::string answer = child > 0 ? ReadAll(ends[0]) : "";
  close(ends[0]);
  int status = 0;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (child < 0) {
    *defect = "cannot be read: no reader process can be started";
  } else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    *defect = "cannot be read: the mesh library is not done with it after " +
              std::to_string(MaxSeconds(bytes.size())) + " s";
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !Unpack(answer, &mesh, defect)) {
    *defect = "cannot be read: it breaks the mesh library";
    mesh = TriangleMesh();
  }
  return mesh;
}

}  // namespace

TriangleMesh ImportMesh(const std::string& bytes, const std::string& extension,
                        std::string* defect) {
  const bool binary_stl = extension == "stl" && !bytes.starts_with("solid");
  return binary_stl ? Import(bytes, extension, defect) : ImportInChild(bytes, extension, defect);
}

}  // namespace ncsim::machine
