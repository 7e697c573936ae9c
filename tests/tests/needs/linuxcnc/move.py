#!/usr/bin/python3
"""Moves a simulated machine through commands.csv and writes the positions sent to its motors.

LinuxCNC starts it in place of a user interface, in the folder of the configuration.
"""

import csv
import time

import hal
import linuxcnc

LETTERS = "XYZABC"


def main():
    command, status = linuxcnc.command(), linuxcnc.stat()

    def wait(is_reached, what):
        end = time.time() + 30
        while True:
            status.poll()
            if is_reached():
                return
            if time.time() > end:
                raise SystemExit("not reached: " + what)
            time.sleep(0.002)

    command.state(linuxcnc.STATE_ESTOP_RESET)
    command.wait_complete()
    command.state(linuxcnc.STATE_ON)
    command.wait_complete()
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.teleop_enable(0)
    command.wait_complete()
    status.poll()
    joints = status.joints
    # Pins can be read by components only.
    component = hal.component("move")
    component.ready()
    command.home(-1)
    wait(lambda: all(status.homed[:joints]), "home")
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()
    with open("commands.csv") as file:
        rows = list(csv.DictReader(file))
    sent = []
    for row in rows:
        command.mdi("G90 G21 G53 G0 " + " ".join(letter + value for letter, value in row.items()))
        at = {LETTERS.index(letter): float(value) for letter, value in row.items()}
        wait(
            lambda: status.interp_state == linuxcnc.INTERP_IDLE
            and status.inpos
            and all(abs(status.position[i] - value) < 1e-9 for i, value in at.items()),
            str(row),
        )
        # Compensation follows the command within a few cycles.
        time.sleep(0.02)
        pins = ["joint.%d.backlash-" % joint for joint in range(joints)]
        wait(
            lambda: all(abs(hal.get_value(pin + "corr") - hal.get_value(pin + "filt")) < 2e-5 for pin in pins),
            "compensation at " + str(row),
        )
        sent.append([hal.get_value("joint.%d.motor-pos-cmd" % joint) for joint in range(joints)])
    with open("motors.csv", "w") as file:
        for row in sent:
            file.write(",".join("%.9f" % position for position in row) + "\n")


main()
