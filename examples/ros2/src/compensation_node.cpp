// Corrects every point of every trajectory on its way to the controller: ~/in to ~/out. Drops trajectories with a
// point that cannot be corrected. On the way back, ~/drives to ~/commands, measured positions become the commands that
// they carry out: a planner that begins there neither steps by a correction nor corrects it again.
#include <memory>
#include <string>
#include <vector>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <trajectory_msgs/msg/joint_trajectory.hpp>

#include "machine.hpp"

using sensor_msgs::msg::JointState;
using trajectory_msgs::msg::JointTrajectory;

class CompensationNode : public rclcpp::Node {
  public:
    CompensationNode()
        : Node("compensation"),
          joints_(declare_parameter<std::vector<std::string>>("joints"), declare_parameter<std::vector<double>>("scales"))
    {
        if (!machine::self_test()) {
            throw std::runtime_error("the compensator does not compute here what it should");
        }
        out_ = create_publisher<JointTrajectory>("~/out", 10);
        in_ = create_subscription<JointTrajectory>(
            "~/in", 10, [this](const JointTrajectory::SharedPtr trajectory) { pass_on(*trajectory); });
        commands_ = create_publisher<JointState>("~/commands", 10);
        drives_ = create_subscription<JointState>(
            "~/drives", 10, [this](const JointState::SharedPtr state) { pass_back(*state); });
    }

  private:
    void pass_on(JointTrajectory trajectory)
    {
        for (auto &point : trajectory.points) {
            switch (joints_.correct(trajectory.joint_names, point.positions)) {
                case machine::Status::corrected:
                    break;
                case machine::Status::not_reached:
                    RCLCPP_ERROR(get_logger(), "a point is at a limit or near a singular pose, where the tool cannot be "
                                               "corrected: the trajectory is not passed on");
                    return;
                case machine::Status::failed:
                    RCLCPP_ERROR(get_logger(), "a point cannot be corrected: the trajectory is not passed on");
                    return;
            }
        }
        out_->publish(trajectory);
    }

    void pass_back(JointState state)
    {
        if (joints_.begin(state.name, state.position) != machine::Status::corrected) {
            RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 1000, "the drives are where no command can be corrected");
            return;
        }
        commands_->publish(state);
    }

    machine::Joints joints_;
    rclcpp::Publisher<JointTrajectory>::SharedPtr out_;
    rclcpp::Subscription<JointTrajectory>::SharedPtr in_;
    rclcpp::Publisher<JointState>::SharedPtr commands_;
    rclcpp::Subscription<JointState>::SharedPtr drives_;
};

int main(int argc, char **argv)
{
    rclcpp::init(argc, argv);
    rclcpp::spin(std::make_shared<CompensationNode>());
    rclcpp::shutdown();
    return 0;
}
