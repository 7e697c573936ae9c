// Interface of a machine's compensator, which hides the prefix and the counts of the generated header.
#pragma once

#include <string>
#include <vector>

namespace machine {

/// Outcome of one command.
enum class Status {
    corrected,
    /// Not converged, at a limit or near a singular pose: the best command so far.
    best_so_far,
    /// Invalid: must not be sent to the drives.
    failed,
};

/// Returns the number of joints of the machine.
int joints();

/// Computes drive commands, in the spec's units and order, that put the real tool where the ideal one is at `q`.
Status correct(const std::vector<double> &q, std::vector<double> &drives);

/// Returns whether this compiler, its library and this processor reproduce the generator's results.
bool self_test();

/// Joints of messages, by name, in the order and the units of the spec.
class Joints {
  public:
    /// `names` are the joint names in messages, in the order of the spec; `scales` are one rad or metre in the spec's units.
    Joints(std::vector<std::string> names, std::vector<double> scales);

    /// Corrects one point of a trajectory with the joints `names`. Positions are unchanged unless the outcome is
    /// `corrected` or `best_so_far`.
    Status correct(const std::vector<std::string> &names, std::vector<double> &positions) const;

  private:
    std::vector<std::string> names_;
    std::vector<double> scales_;
};

}  // namespace machine
