// Prints the corrected command of one point and compares its inverse, joints in another order than the spec's and slides in metres.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "machine.hpp"

int main()
{
    const std::vector<std::string> spec{"lateral", "vertical", "longitudinal", "spin", "roll", "pitch"};
    const machine::Joints joints(spec, {1000.0, 1000.0, 1000.0, 1.0, 1.0, 1.0});
    const std::vector<std::string> message{"longitudinal", "lateral", "pitch", "roll", "spin", "vertical"};
    std::vector<double> positions{0.3, 0.5, 0.01, -0.02, 0.4, 0.2};
    if (!machine::self_test() || joints.correct(message, positions) != machine::Status::corrected) {
        return 1;
    }
    // The drives carry out the command that was corrected.
    const std::vector<double> command{0.3, 0.5, 0.01, -0.02, 0.4, 0.2};
    std::vector<double> back = positions;
    if (joints.begin(message, back) != machine::Status::corrected) {
        return 1;
    }
    for (std::size_t i = 0; i < message.size(); ++i) {
        if (std::fabs(back[i] - command[i]) > 1e-9) {
            return 1;
        }
    }
    for (std::size_t i = 0; i < message.size(); ++i) {
        std::printf("%s %.17g\n", message[i].c_str(), positions[i]);
    }
    std::vector<double> unknown{0.0};
    return joints.correct({"elbow"}, unknown) == machine::Status::failed ? 0 : 1;
}
