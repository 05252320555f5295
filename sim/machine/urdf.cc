// SPDX-License-Identifier: BSD-3-Clause
#include "sim/machine/urdf.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "sim/base/file.h"
#include "sim/base/units.h"
#include "sim/machine/urdf_source.h"

namespace ncsim::machine {
namespace {

constexpr std::uint64_t kMaxUrdfBytes = std::uint64_t{1} << 26;

/// Keeps what urdfdom logs, so that nothing is printed. console_bridge has one handler a process:
/// hence the mutex.
class LogCapture final : public console_bridge::OutputHandler {
 public:
  LogCapture() : lock_(Mutex()) { console_bridge::useOutputHandler(this); }
  ~LogCapture() override { console_bridge::restorePreviousOutputHandler(); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_WARN) return;
    if (!text_.empty()) text_ += "; ";
    text_ += text;
  }
  const std::string& text() const { return text_; }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::lock_guard<std::mutex> lock_;
  std::string text_;
};

urdf::ModelInterfaceSharedPtr Parse(const std::string& text, std::string* log) {
  LogCapture capture;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    *log = error.what();
    return nullptr;
  }
  *log = capture.text();
  return model;
}

Eigen::Isometry3d ToIsometry(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
  X.translation() =
      kMmPerMetre * Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return X;
}

kinematics::Joint ToJoint(const urdf::Joint& source, const std::map<std::string, int>& links) {
  kinematics::Joint joint;
  joint.name = source.name;
  joint.parent_link = links.at(source.parent_link_name);
  joint.child_link = links.at(source.child_link_name);
  joint.X_PJ = ToIsometry(source.parent_to_joint_origin_transform);
  if (source.type == urdf::Joint::FIXED) return joint;
  const bool prismatic = source.type == urdf::Joint::PRISMATIC;
  joint.type = prismatic ? kinematics::JointType::kPrismatic : kinematics::JointType::kRevolute;
  joint.axis = Eigen::Vector3d(source.axis.x, source.axis.y, source.axis.z).normalized();
  if (source.type == urdf::Joint::CONTINUOUS) {
    joint.lower = -std::numeric_limits<double>::infinity();
    joint.upper = std::numeric_limits<double>::infinity();
  } else {
    const double unit = prismatic ? kMmPerMetre : 1.0;
    joint.lower = unit * source.limits->lower;
    joint.upper = unit * source.limits->upper;
  }
  return joint;
}

/// False for a geometry that this function does not know (the pass over the XML has reported it).
bool FillShape(const urdf::Geometry* geometry, UrdfShape* shape) {
  if (geometry == nullptr) return false;
  if (geometry->type == urdf::Geometry::BOX) {
    const auto& box = static_cast<const urdf::Box&>(*geometry);
    shape->kind = UrdfShape::Kind::kBox;
    shape->size = kMmPerMetre * Eigen::Vector3d(box.dim.x, box.dim.y, box.dim.z);
  } else if (geometry->type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = static_cast<const urdf::Cylinder&>(*geometry);
    shape->kind = UrdfShape::Kind::kCylinder;
    shape->size = kMmPerMetre * Eigen::Vector3d(cylinder.radius, cylinder.length, 0.0);
  } else if (geometry->type == urdf::Geometry::SPHERE) {
    const auto& sphere = static_cast<const urdf::Sphere&>(*geometry);
    shape->kind = UrdfShape::Kind::kSphere;
    shape->size = kMmPerMetre * Eigen::Vector3d(sphere.radius, 0.0, 0.0);
  } else if (geometry->type == urdf::Geometry::MESH) {
    const auto& mesh = static_cast<const urdf::Mesh&>(*geometry);
    shape->kind = UrdfShape::Kind::kMesh;
    shape->uri = mesh.filename;
    shape->scale = Eigen::Vector3d(mesh.scale.x, mesh.scale.y, mesh.scale.z);
  } else {
    return false;
  }
  return shape->kind == UrdfShape::Kind::kMesh ? !shape->uri.empty()
                                               : (shape->size.array() >= 0.0).all();
}

/// Shapes of a link: collision, or else visual. What the XML has and urdfdom dropped is an error.
template <typename Elements>
void AddShapes(const Elements& elements, const UrdfSource::Link& link, const std::string& file,
               const std::string& log, bool visual, std::vector<UrdfShape>* shapes,
               Diagnostics* diagnostics) {
  const std::vector<int>& lines = visual ? link.visual_lines : link.collision_lines;
  if (elements.size() != lines.size() && !link.faulty) {
    diagnostics->Error(file, link.line, 0,
                       "link '" + link.name + "': urdfdom kept " + std::to_string(elements.size()) +
                           " of its " + std::to_string(lines.size()) + " shapes" +
                           (log.empty() ? "" : " (" + log + ")"));
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    UrdfShape shape;
    shape.link = link.name;
    shape.visual = visual;
    shape.line = i < lines.size() ? lines[i] : link.line;
    shape.X_LG = ToIsometry(elements[i]->origin);
    if (FillShape(elements[i]->geometry.get(), &shape)) shapes->push_back(std::move(shape));
  }
}

/// What a link looks like, with its colour. What cannot be shown is passed over: it is not checked.
void AddVisuals(const urdf::Link& parsed, const UrdfSource::Link& link,
                std::vector<UrdfShape>* visuals) {
  for (std::size_t i = 0; i < parsed.visual_array.size(); ++i) {
    const urdf::Visual& visual = *parsed.visual_array[i];
    UrdfShape shape;
    shape.link = link.name;
    shape.visual = true;
    shape.line = i < link.visual_lines.size() ? link.visual_lines[i] : link.line;
    shape.X_LG = ToIsometry(visual.origin);
    if (visual.material) {
      const urdf::Color& color = visual.material->color;
      shape.color = {color.r, color.g, color.b, color.a};
    }
    if (FillShape(visual.geometry.get(), &shape)) visuals->push_back(std::move(shape));
  }
}

}  // namespace

std::optional<Urdf> ReadUrdf(const std::string& path, Diagnostics* diagnostics) {
  std::string reason;
  const std::optional<std::string> text = ReadFile(path, kMaxUrdfBytes, &reason);
  if (!text) {
    diagnostics->Error(path, 0, 0, reason);
    return std::nullopt;
  }
  const std::optional<UrdfSource> source = ReadUrdfSource(*text, path, diagnostics);
  if (!source || source->broken) return std::nullopt;
  std::string log;
  const urdf::ModelInterfaceSharedPtr model = Parse(*text, &log);
  if (!model) {
    diagnostics->Error(path, 0, 0, "urdfdom refuses it: " + log);
    return std::nullopt;
  }
  Urdf urdf;
  urdf.name = source->name;
  std::vector<kinematics::Link> links;
  std::map<std::string, int> index;
  for (const UrdfSource::Link& link : source->links) {
    index.emplace(link.name, static_cast<int>(links.size()));
    links.push_back({link.name, -1});
    const urdf::LinkConstSharedPtr parsed = model->getLink(link.name);
    if (!parsed) continue;
    AddVisuals(*parsed, link, &urdf.visuals);
    if (!link.collision_lines.empty()) {
      AddShapes(parsed->collision_array, link, path, log, false, &urdf.shapes, diagnostics);
    } else {
      AddShapes(parsed->visual_array, link, path, log, true, &urdf.shapes, diagnostics);
    }
  }
  std::vector<kinematics::Joint> joints;
  for (const UrdfSource::Joint& joint : source->joints) {
    const urdf::JointConstSharedPtr parsed = model->getJoint(joint.name);
    if (!parsed) {
      diagnostics->Error(path, joint.line, 0, "urdfdom lost joint '" + joint.name + "': " + log);
      return std::nullopt;
    }
    joints.push_back(ToJoint(*parsed, index));
    links[static_cast<std::size_t>(joints.back().child_link)].parent_joint =
        static_cast<int>(joints.size()) - 1;
    urdf.joint_lines[joint.name] = joint.line;
    if (joints.back().type == kinematics::JointType::kFixed) continue;
    const bool prismatic = joints.back().type == kinematics::JointType::kPrismatic;
    const double velocity = parsed->limits ? parsed->limits->velocity : 0.0;
    urdf.velocity[joint.name] = velocity * (prismatic ? kMmPerMetre : 1.0);
  }
  urdf.tree = kinematics::KinematicTree(std::move(links), std::move(joints));
  return urdf;
}

}  // namespace ncsim::machine
