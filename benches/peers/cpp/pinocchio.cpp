// Pinocchio: forward kinematics of the joints, then block columns frame by frame. Everything is compiled for this
// processor: the wheel's library is for any processor and aligns Eigen's types differently.

#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/kinematics.hpp>

namespace {

using pinocchio::SE3;
using Vector = Eigen::Vector3d;

constexpr int kTurns[] = {1, 2, 0};  // spin about y, roll about z, pitch about x

// Twelve numbers: x, y, z axis and position.
SE3 placement(const double *columns) {
  return SE3(Eigen::Map<const Eigen::Matrix3d>(columns), Eigen::Map<const Vector>(columns + 9));
}

struct Robot {
  pinocchio::Model model;
  pinocchio::Data data;
  // Sign of every variable; pose of F_i relative to its joint, where it is not the joint's own frame.
  Eigen::VectorXd sign, q;
  std::vector<bool> apart;
  std::vector<SE3, Eigen::aligned_allocator<SE3>> offset, frames;
  SE3 tool;

  SE3 kinematics(const double *values) {
    const int n = int(frames.size());
    q = sign.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(values, n));
    pinocchio::forwardKinematics(model, data, q);
    for (int i = 0; i < n; ++i) {
      if (apart[i]) frames[i] = data.oMi[i + 1] * offset[i];
    }
    return frame(n - 1) * tool;
  }

  const SE3 &frame(int i) const { return apart[i] ? frames[i] : data.oMi[i + 1]; }
};

void write_pose(const SE3 &tool, double *pose) {
  Eigen::Map<Eigen::Matrix3d> axes(pose);
  Eigen::Map<Vector> position(pose + 9);
  axes = tool.rotation();
  position = tool.translation();
}

}  // namespace

extern "C" {

// For each frame: kind (0, 1, 2 rotates about x, y, z of the joint; 3, 4, 5 translates along it), sign of the variable,
// pose of the joint relative to F_{i-1} and of F_i relative to the joint, twelve numbers each; and the tool.
void *pinocchio_robot(int n, const int *kinds, const double *signs, const double *joints, const double *offsets,
                      const double *tool) {
  auto *robot = new Robot;
  robot->sign = Eigen::Map<const Eigen::VectorXd>(signs, n);
  robot->tool = placement(tool);
  SE3 behind = SE3::Identity();
  for (int i = 0; i < n; ++i) {
    const pinocchio::JointModel models[] = {
        pinocchio::JointModelRX(), pinocchio::JointModelRY(), pinocchio::JointModelRZ(),
        pinocchio::JointModelPX(), pinocchio::JointModelPY(), pinocchio::JointModelPZ()};
    robot->model.addJoint(i, models[kinds[i]], behind * placement(joints + 12 * i), std::to_string(i));
    behind = placement(offsets + 12 * i);
    robot->offset.push_back(behind);
    robot->apart.push_back(!behind.isIdentity(0.0));
  }
  robot->frames.resize(n);
  robot->data = pinocchio::Data(robot->model);
  return robot;
}

void pinocchio_dense(void *handle, const double *q, double *pose, double *columns) {
  auto &robot = *static_cast<Robot *>(handle);
  const SE3 tool = robot.kinematics(q);
  write_pose(tool, pose);
  for (size_t i = 0; i < robot.frames.size(); ++i) {
    const SE3 &frame = robot.frame(int(i));
    const Vector lever = tool.translation() - frame.translation();
    Eigen::Map<Eigen::Matrix<double, 6, 6>> block(columns + 36 * i);
    block.topLeftCorner<3, 3>() = frame.rotation();
    block.bottomLeftCorner<3, 3>().setZero();
    for (int k = 0; k < 3; ++k) {
      const auto axis = frame.rotation().col(kTurns[k]);
      block.col(3 + k).head<3>() = axis.cross(lever);
      block.col(3 + k).tail<3>() = axis;
    }
  }
}

void pinocchio_distinct(void *handle, const double *q, double *pose, double *numbers) {
  auto &robot = *static_cast<Robot *>(handle);
  const SE3 tool = robot.kinematics(q);
  write_pose(tool, pose);
  for (size_t i = 0; i < robot.frames.size(); ++i) {
    const SE3 &frame = robot.frame(int(i));
    const Vector lever = tool.translation() - frame.translation();
    Eigen::Map<Eigen::Matrix<double, 3, 6>> block(numbers + 18 * i);
    block.leftCols<3>() = frame.rotation();
    for (int k = 0; k < 3; ++k) block.col(3 + k) = frame.rotation().col(kTurns[k]).cross(lever);
  }
}

// J_e, then its product with ε.
void pinocchio_displacement(void *handle, const double *q, const double *e, double *shift) {
  auto &robot = *static_cast<Robot *>(handle);
  const int n = int(robot.frames.size());
  constexpr int kMost = 16;
  double pose[12], columns[36 * kMost];
  pinocchio_dense(handle, q, pose, columns);
  Eigen::Map<Eigen::Matrix<double, 6, 1>> result(shift);
  result.noalias() = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(columns, 6, 6 * n) *
                     Eigen::Map<const Eigen::VectorXd>(e, 6 * n);
}

// J_e, then J_e diag(σ²) J_eᵀ.
void pinocchio_covariance(void *handle, const double *q, const double *variances, double *covariance) {
  auto &robot = *static_cast<Robot *>(handle);
  const int n = int(robot.frames.size());
  constexpr int kMost = 16;
  double pose[12], columns[36 * kMost];
  pinocchio_dense(handle, q, pose, columns);
  using Columns = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6 * kMost>;
  const Eigen::Map<const Columns> jacobian(columns, 6, 6 * n);
  const Columns weighted = jacobian * Eigen::Map<const Eigen::VectorXd>(variances, 6 * n).asDiagonal();
  Eigen::Map<Eigen::Matrix<double, 6, 6>> result(covariance);
  result.noalias() = weighted * jacobian.transpose();
}

// ΔX without J_e: sum of the contributions of the frames.
void pinocchio_displacement_by_frames(void *handle, const double *q, const double *e, double *shift) {
  auto &robot = *static_cast<Robot *>(handle);
  const SE3 tool = robot.kinematics(q);
  Vector linear = Vector::Zero(), angular = Vector::Zero();
  for (size_t i = 0; i < robot.frames.size(); ++i, e += 6) {
    const SE3 &frame = robot.frame(int(i));
    const Vector turn = frame.rotation() * Vector(e[5], e[3], e[4]);
    linear += frame.rotation() * Vector(e[0], e[1], e[2]) + turn.cross(tool.translation() - frame.translation());
    angular += turn;
  }
  Eigen::Map<Eigen::Matrix<double, 6, 1>> result(shift);
  result << linear, angular;
}

}  // extern "C"
