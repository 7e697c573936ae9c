// Interface of a machine's compensator, which hides the prefix and the counts of the generated header.
#pragma once

#include <string>
#include <vector>

namespace machine {

/// Outcome of one command.
enum class Status {
    /// The real tool is within 1 um and 10 urad of the ideal one.
    corrected,
    /// It is not: the command is beyond a limit, needs a joint beyond one, or is near a singular pose.
    not_reached,
    /// A number is not finite, or an input is outside its range.
    failed,
};

/// Returns the number of joints of the machine.
int joints();

/// If it is possible, computes drive commands, in the spec's units and order, that put the real tool where the ideal one is at `q`.
Status correct(const std::vector<double> &q, std::vector<double> &drives);

/// Inverse of `correct`: computes the commands that the drives carry out where they stand.
Status begin(const std::vector<double> &drives, std::vector<double> &q);

/// Returns whether this compiler, its library and this processor reproduce the generator's results.
bool self_test();

/// Joints of messages, by name, in the order and the units of the spec.
class Joints {
  public:
    /// `names` are the joint names in messages, in the order of the spec; `scales` are one rad or metre in the spec's units.
    Joints(std::vector<std::string> names, std::vector<double> scales);

    /// Corrects one point of a trajectory with the joints `names`. Positions are unchanged unless the outcome is
    /// `corrected`.
    Status correct(const std::vector<std::string> &names, std::vector<double> &positions) const;

    /// Replaces measured positions by the commands that belong to them; the rest as in `correct`.
    Status begin(const std::vector<std::string> &names, std::vector<double> &positions) const;

  private:
    Status replace(Status (*by)(const std::vector<double> &, std::vector<double> &),
                   const std::vector<std::string> &names, std::vector<double> &positions) const;

    std::vector<std::string> names_;
    std::vector<double> scales_;
};

}  // namespace machine
