#include "machine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

// The only file that depends on the machine.
#include "pps.h"

namespace machine {

int joints() { return PPS_VARIABLES; }

bool self_test() { return pps_self_test() == 0; }

Status correct(const std::vector<double> &q, std::vector<double> &drives)
{
    if (q.size() != PPS_VARIABLES) {
        return Status::failed;
    }
    // The points of a trajectory are no cycles: only the size of a correction is bounded.
    const double last[PPS_VARIABLES] = {};
    double change[PPS_VARIABLES];
    std::fill_n(change, PPS_VARIABLES, HUGE_VAL);
    double corrected[PPS_VARIABLES];
    double correction[PPS_VARIABLES];
    double before[6];
    double after[6];
    // The nominal inputs: the heaviest patient. A load cell would give those of this patient.
    const int status = pps_compensated(q.data(), pps_parameters, pps_inputs, last, change, pps_largest, pps_whole_pose,
                                       corrected, correction, before, after);
    if (status != PPS_OK) {
        return status >= PPS_NOT_CONVERGED ? Status::not_reached : Status::failed;
    }
    drives.assign(corrected, corrected + PPS_VARIABLES);
    return Status::corrected;
}

Status begin(const std::vector<double> &drives, std::vector<double> &q)
{
    if (drives.size() != PPS_VARIABLES) {
        return Status::failed;
    }
    double command[PPS_VARIABLES];
    double last[PPS_VARIABLES];
    double after[6];
    const int status = pps_begin(drives.data(), pps_parameters, pps_inputs, pps_whole_pose, command, last, after);
    if (status != PPS_OK) {
        return status >= PPS_NOT_CONVERGED ? Status::not_reached : Status::failed;
    }
    q.assign(command, command + PPS_VARIABLES);
    return Status::corrected;
}

Joints::Joints(std::vector<std::string> names, std::vector<double> scales)
    : names_(std::move(names)), scales_(std::move(scales))
{
    if (names_.size() != PPS_VARIABLES || scales_.size() != names_.size()) {
        throw std::invalid_argument("a name and a scale for each joint of the spec are needed");
    }
}

Status Joints::correct(const std::vector<std::string> &names, std::vector<double> &positions) const
{
    return replace(machine::correct, names, positions);
}

Status Joints::begin(const std::vector<std::string> &names, std::vector<double> &positions) const
{
    return replace(machine::begin, names, positions);
}

Status Joints::replace(Status (*by)(const std::vector<double> &, std::vector<double> &),
                       const std::vector<std::string> &names, std::vector<double> &positions) const
{
    std::vector<std::size_t> places;
    std::vector<double> q;
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const auto found = std::find(names.begin(), names.end(), names_[i]);
        const auto place = static_cast<std::size_t>(found - names.begin());
        if (found == names.end() || place >= positions.size()) {
            return Status::failed;
        }
        places.push_back(place);
        q.push_back(positions[place] * scales_[i]);
    }
    std::vector<double> others;
    const Status status = by(q, others);
    for (std::size_t i = 0; i < others.size(); ++i) {
        positions[places[i]] = others[i] / scales_[i];
    }
    return status;
}

}  // namespace machine
