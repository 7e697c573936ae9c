// A machine's compensator behind names: C++ sees neither the prefix nor the counts of the generated header.
#pragma once

#include <string>
#include <vector>

namespace machine {

/// What became of one command.
enum class Status {
    corrected,
    /// At a limit or near a singular pose: the best command so far.
    best_so_far,
    /// Nothing that a drive may be given.
    failed,
};

/// How many joints the machine has.
int joints();

/// Command `q` for the drives, in the spec's units and order: where the real tool is where the ideal one would be at `q`.
Status correct(const std::vector<double> &q, std::vector<double> &drives);

/// Whether this compiler, its library and this processor compute what the generator did.
bool self_test();

/// Joints of messages, by name, in the order and the units of the spec.
class Joints {
  public:
    /// `names` as the messages call them, in the order of the spec; `scales`: one rad or metre in the spec's units.
    Joints(std::vector<std::string> names, std::vector<double> scales);

    /// Corrects one point of a trajectory whose joints are called `names`. Positions stay as they are unless it is
    /// `corrected` or `best_so_far`.
    Status correct(const std::vector<std::string> &names, std::vector<double> &positions) const;

  private:
    std::vector<std::string> names_;
    std::vector<double> scales_;
};

}  // namespace machine
